//! Distance of two cracks.
//!
//! A crack consists of plane pieces, of which a planar crack has one: slices of an ellipse and of a
//! strip, which are convex. The Minkowski difference of two pieces is a convex body, whose point
//! nearest to the origin is found from support points (Gilbert, Johnson & Keerthi 1988).

use super::plane::PlaneFrame;
use super::shape::{Extent, SpaceCrack};
use crate::growth::FrontWay;
use crate::math::dot3;

type Vector = [f64; 3];

/// Largest number of steps.
const STEPS: usize = 500;
/// Relative error of the distance.
const TOLERANCE: f64 = 1e-9;

impl SpaceCrack {
    /// The distance (mm) to another crack; zero where they meet. A front that deviates from its
    /// ellipse is replaced by the smallest enclosing ellipse of the same aspect ratio, arcs of a
    /// crack that turns by chords of 3°.
    pub fn distance(&self, other: &Self) -> f64 {
        let size = self.length.max(self.half_length).max(other.length).max(other.half_length);
        let others = other.pieces();
        let of = |one: &Piece| others.iter().map(|two| one.distance(two, size)).fold(f64::INFINITY, f64::min);
        self.pieces().iter().map(of).fold(f64::INFINITY, f64::min)
    }

    /// Size of the smallest ellipse around the front, relative to its own ellipse.
    fn reach(&self) -> f64 {
        (0..360).map(|degree| self.radius_factor(f64::from(degree).to_radians())).fold(1.0, f64::max)
    }

    fn pieces(&self) -> Vec<Piece> {
        let reach = self.reach();
        let axes = [reach * self.length, reach * self.half_length];
        let [x, lateral] = self.middle;
        let piece = |range, centre, axes, dip, [out, depth]: [f64; 2]| {
            let (sin, cos) = self.strike.sin_cos();
            let origin = [x + out * cos, lateral + out * sin, depth];
            Piece { frame: PlaneFrame::turned(dip, self.strike), origin, range, centre, axes }
        };
        let top = match self.extent {
            Extent::Buried { centre } => {
                return vec![piece([centre - axes[0], centre + axes[0]], centre, axes, self.dip, [0.0; 2])];
            }
            Extent::SurfaceBreaking => self.strip.unwrap_or(0.0),
        };
        let way = FrontWay::new(self.dip, self.turns.as_ref());
        let mut stops = way.stops(top + axes[0]);
        stops.push(top);
        stops.sort_by(f64::total_cmp);
        stops.dedup();
        let of = |ends: &[f64]| {
            let [from, to] = [ends[0], ends[1]];
            let [start, end] = [from, to].map(|s| way.at(s).place);
            let dip = (end[1] - start[1]).atan2(end[0] - start[0]);
            // A slice of the strip is one of an ellipse without end.
            let axes = if to <= top { [f64::INFINITY, axes[1]] } else { axes };
            piece([0.0, to - from], top - from, axes, dip, start)
        };
        stops.windows(2).map(of).collect()
    }
}

/// A slice of an ellipse between two lines along the trace of its plane.
struct Piece {
    frame: PlaneFrame,
    /// x, lateral, depth of the point from which s is measured, mm.
    origin: Vector,
    /// s at the two lines, mm.
    range: [f64; 2],
    /// s at the middle of the ellipse, mm.
    centre: f64,
    /// Semi-axes along s and ζ, mm.
    axes: [f64; 2],
}

impl Piece {
    /// The support point in a direction: x, lateral, depth.
    fn farthest(&self, direction: Vector) -> Vector {
        let [_, ds, dz] = self.frame.components(direction);
        let [l, c] = self.axes;
        let best = match (l * ds).hypot(c * dz) {
            size if size.is_finite() && size > 0.0 => self.centre + l * l * ds / size,
            _ => ds * f64::INFINITY,
        };
        let s = if best.is_nan() { self.range[0] } else { best.clamp(self.range[0], self.range[1]) };
        let across = ((s - self.centre) / l).clamp(-1.0, 1.0);
        let sign = if dz == 0.0 { 0.0 } else { dz.signum() };
        let place = self.frame.position(s, c * (1.0 - across * across).sqrt() * sign);
        std::array::from_fn(|i| self.origin[i] + place[i])
    }

    /// The distance to another piece, of cracks of a `size` (mm).
    fn distance(&self, other: &Self, size: f64) -> f64 {
        let corner = |one: Vector, two: Vector| -> Vector {
            let (one, two) = (self.farthest(one), other.farthest(two));
            std::array::from_fn(|i| one[i] - two[i])
        };
        let start = corner([0.0, 0.0, 1.0], [0.0, 0.0, 1.0]);
        let mut corners = vec![start];
        let mut nearest = start;
        for _ in 0..STEPS {
            let square = dot3(nearest, nearest);
            if square <= (TOLERANCE * size).powi(2) {
                return 0.0;
            }
            let corner = corner(nearest.map(|v| -v), nearest);
            if square - dot3(nearest, corner) <= TOLERANCE * square {
                break;
            }
            corners.push(corner);
            let Some((point, kept)) = nearest_of(&corners) else { break };
            if dot3(point, point) >= square {
                break;
            }
            corners = kept;
            nearest = point;
        }
        dot3(nearest, nearest).sqrt()
    }
}

/// The point nearest to the origin of the convex hull of up to four points, and the points that
/// span it; `None` where round-off leaves no simplex.
fn nearest_of(corners: &[Vector]) -> Option<(Vector, Vec<Vector>)> {
    let sets = 1u32..1 << corners.len();
    let points = sets.filter_map(|set| {
        let chosen: Vec<Vector> =
            (0..corners.len()).filter(|k| set >> k & 1 == 1).map(|k| corners[k]).collect();
        Some((nearest_of_flat(&chosen)?, chosen))
    });
    points.reduce(|a, b| if dot3(b.0, b.0) < dot3(a.0, a.0) { b } else { a })
}

/// The point nearest to the origin of the affine hull of all of these points, if it lies between
/// them.
fn nearest_of_flat(corners: &[Vector]) -> Option<Vector> {
    let (first, others) = corners.split_first()?;
    let sides: Vec<Vector> = others.iter().map(|p| std::array::from_fn(|i| p[i] - first[i])).collect();
    let order = sides.len();
    let mut rows: Vec<Vec<f64>> = sides
        .iter()
        .map(|a| sides.iter().map(|b| dot3(*a, *b)).chain([-dot3(*a, *first)]).collect())
        .collect();
    for k in 0..order {
        let pivot = (k..order).max_by(|&a, &b| rows[a][k].abs().total_cmp(&rows[b][k].abs()))?;
        rows.swap(k, pivot);
        if rows[k][k].is_nan() || rows[k][k].abs() <= f64::MIN_POSITIVE {
            return None;
        }
        for i in (0..order).filter(|&i| i != k) {
            let factor = rows[i][k] / rows[k][k];
            for j in k..=order {
                let above = rows[k][j];
                rows[i][j] -= factor * above;
            }
        }
    }
    let shares: Vec<f64> = (0..order).map(|k| rows[k][order] / rows[k][k]).collect();
    let is_between = shares.iter().all(|share| *share >= 0.0) && shares.iter().sum::<f64>() <= 1.0;
    let add =
        |point: Vector, (side, share): (&Vector, &f64)| std::array::from_fn(|i| point[i] + share * side[i]);
    is_between.then(|| sides.iter().zip(&shares).fold(*first, add))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn placed(crack: SpaceCrack, middle: [f64; 2]) -> SpaceCrack {
        SpaceCrack { middle, ..crack }
    }

    #[test]
    fn of_parallel_crossing_and_coplanar_cracks() {
        let half = |degrees: f64| SpaceCrack::surface_breaking(f64::to_radians(degrees), 6.0, 4.0).unwrap();
        let behind = placed(half(15.0), [3.4, 1.0]);
        let want = 3.4 * 15f64.to_radians().sin();
        assert!((half(15.0).distance(&behind) - want).abs() < 1e-8, "planes");
        assert_eq!(half(60.0).distance(&placed(half(130.0), [1.0, 0.0])), 0.0, "they cross");
        let neighbour = placed(half(30.0), [0.0, 12.5]);
        assert!((half(30.0).distance(&neighbour) - 0.5).abs() < 1e-7, "along the mouth");
        assert!((neighbour.distance(&half(30.0)) - 0.5).abs() < 1e-7, "exchanged");
        // Penny-shaped cracks in one plane, with centres offset obliquely.
        let penny = |centre: f64| SpaceCrack::buried(0.5 * PI, 1.0, 1.0, centre).unwrap();
        let distance = penny(10.0).distance(&placed(penny(13.0), [0.0, 4.0]));
        assert!((distance - 3.0).abs() < 1e-7, "{distance}");
    }

    #[test]
    fn of_ellipses_in_general_places_by_search() {
        let one = SpaceCrack::surface_breaking(0.7, 3.0, 2.0).unwrap();
        let two = placed(SpaceCrack::buried(2.2, 1.5, 1.0, 2.5).unwrap(), [4.5, 2.0]);
        let points = |crack: &SpaceCrack, last: f64| -> Vec<Vector> {
            let frame = crack.frame();
            let mut points = Vec::new();
            for i in 0..=60 {
                for k in 0..=240 {
                    let (sin, cos) = (last * f64::from(k) / 240.0).sin_cos();
                    let r = f64::from(i) / 60.0;
                    let [s, zeta] = crack.point([r * cos, r * sin]);
                    let [x, z, depth] = frame.position(s, zeta);
                    points.push([x + crack.middle[0], z + crack.middle[1], depth]);
                }
            }
            points
        };
        let (first, second) = (points(&one, PI), points(&two, 2.0 * PI));
        let mut least = f64::INFINITY;
        for p in &first {
            for q in &second {
                let d: Vector = std::array::from_fn(|i| p[i] - q[i]);
                least = least.min(dot3(d, d).sqrt());
            }
        }
        let got = one.distance(&two);
        assert!(got <= least + 1e-12 && got > least - 2e-3, "{got} {least}");
    }
}
