//! Motion and cuts of fronts that are free to leave their ellipse.
//!
//! Each node of the front moves along the ray on which it lies, at a rate that is given along the
//! normal of the ellipse there. As the ends of the semi-axes move,
//! the ellipse from which the front is measured changes with them, and so do the rays: the motion
//! is integrated with the speed of a node belonging to its angle, not to the material point that
//! happens to lie there.

use crate::growth::{FrontDeviation, FrontShape};
use std::f64::consts::{FRAC_PI_2, PI};

/// Steps of the integration of the motion within one increment.
const SUBSTEPS: usize = 4;
/// Halvings with which points of a front are located.
const HALVINGS: usize = 60;

/// The number of nodes that move by themselves: those of an open front from one end to the other,
/// all of a closed one.
pub(super) fn moving_nodes(shape: &FrontShape, deviation: &FrontDeviation) -> usize {
    if shape.buried.is_some() { 2 * deviation.harmonics() } else { deviation.harmonics() + 1 }
}

/// The weight of the value at moving node `node` in the value at φ.
pub(super) fn weight(shape: &FrontShape, deviation: &FrontDeviation, node: usize, phi: f64) -> f64 {
    let count = 2 * deviation.harmonics();
    let of = |j: usize| crate::math::periodic::weight(count, j, phi);
    let is_doubled = shape.buried.is_none() && node > 0 && node < deviation.harmonics();
    of(node) + if is_doubled { of(count - node) } else { 0.0 }
}

/// The normal speed (mm) of the ellipse at the angle of `node` where it grows at a relative rate of
/// one there.
pub(super) fn normal_reach(shape: &FrontShape, deviation: &FrontDeviation, node: usize) -> f64 {
    normal_reach_at([shape.half_length, shape.length], deviation.angle(node))
}

fn normal_reach_at([c, l]: [f64; 2], phi: f64) -> f64 {
    c * l / (c * phi.sin()).hypot(l * phi.cos())
}

/// A front in its plane.
#[derive(Clone, Copy)]
struct Outline {
    /// Semi-axes along the surface and down the dip, mm.
    axes: [f64; 2],
    /// The middle, from that at the beginning: along the trace and down the dip, mm.
    middle: [f64; 2],
    front: FrontDeviation,
}

/// Rates of an outline: relative ones of the semi-axes, speeds of the middle (relative to the
/// semi-axes), and ∂g/∂t at the nodes.
struct Rates {
    axes: [f64; 2],
    middle: [f64; 2],
    nodes: Vec<f64>,
}

impl Outline {
    /// The rates under `speeds` of the nodes of a period, mm per unit of time: those along the
    /// normals of the ellipse.
    ///
    /// A point at Q = g (cos φ, sin φ), in units of the semi-axes, moves outwards at the rate R(φ)
    /// of the material, less what middle and semi-axes move; g at a fixed angle changes by the
    /// radial part of this and, where the front is inclined to its ray, by −g′/g of the tangential
    /// part. Middle and semi-axes move so that g stays one at their ends.
    fn rates(&self, speeds: &[f64]) -> Rates {
        let front = &self.front;
        let count = speeds.len();
        let (quarter, half) = (count / 4, count / 2);
        let own: Vec<f64> =
            (0..count).map(|j| speeds[j] / normal_reach_at(self.axes, front.angle(j))).collect();
        let slopes: Vec<f64> = (0..count).map(|j| front.slope(front.angle(j))).collect();
        // u = u₀ + b w and w = w₀ − d u.
        let [u0, b] = [0.5 * (own[0] - own[half]), 0.5 * (slopes[0] + slopes[half])];
        let [w0, d] =
            [0.5 * (own[quarter] - own[half + quarter]), 0.5 * (slopes[quarter] + slopes[half + quarter])];
        let along = (u0 + b * w0) / (1.0 + b * d);
        let down = w0 - d * along;
        let wider = own[0] - along + slopes[0] * down;
        let longer = own[quarter] - down - slopes[quarter] * along;
        let of = |j: usize| {
            let (sin, cos) = front.angle(j).sin_cos();
            let g = 1.0 + front.nodes()[j];
            let outwards = own[j] - along * cos - down * sin - g * (wider * cos * cos + longer * sin * sin);
            let around = along * sin - down * cos + g * (wider - longer) * sin * cos;
            outwards - slopes[j] / g * around
        };
        Rates { axes: [wider, longer], middle: [along, down], nodes: (0..count).map(of).collect() }
    }

    /// The outline after the time `by` of these rates.
    fn after(&self, rates: &Rates, by: f64) -> Self {
        let moved = self.front.nodes().iter().zip(&rates.nodes).map(|(node, rate)| node + by * rate);
        Self {
            axes: std::array::from_fn(|i| self.axes[i] * (1.0 + by * rates.axes[i])),
            middle: std::array::from_fn(|i| self.middle[i] + by * self.axes[i] * rates.middle[i]),
            front: self.front.with_nodes(moved),
        }
    }
}

/// `shape` after the `increments` (mm) of its moving nodes along the normals of the ellipse.
pub(super) fn moved(shape: &FrontShape, deviation: &FrontDeviation, increments: &[f64]) -> FrontShape {
    let count = 2 * deviation.harmonics();
    let of = |j: usize| increments.get(j).or_else(|| increments.get(count - j)).copied().unwrap_or(0.0);
    let speeds: Vec<f64> = (0..count).map(of).collect();
    let mut outline =
        Outline { axes: [shape.half_length, shape.length], middle: [0.0; 2], front: *deviation };
    let by = 1.0 / SUBSTEPS as f64;
    // The midpoint rule; rates are relative to the outline to which they belong.
    for _ in 0..SUBSTEPS {
        let half = outline.after(&outline.rates(&speeds), 0.5 * by);
        let mut rates = half.rates(&speeds);
        for i in 0..2 {
            let ratio = half.axes[i] / outline.axes[i];
            rates.axes[i] *= ratio;
            rates.middle[i] *= ratio;
        }
        outline = outline.after(&rates, by);
    }
    placed(shape, outline)
}

/// `shape` with its outline replaced.
fn placed(shape: &FrontShape, Outline { axes, middle: [along, down], front }: Outline) -> FrontShape {
    let [x, lateral, _] = shape.frame().position(0.0, along);
    FrontShape {
        length: axes[1],
        half_length: axes[0],
        middle: [shape.middle[0] + x, shape.middle[1] + lateral],
        buried: shape.buried.map(|centre| centre + down),
        deviation: Some(front),
        ..*shape
    }
}

/// The rest of a front that ends at the surface where the surface is cut at the distance `cut` (mm,
/// less than the length of the crack) down the dip: the front below it, about the middle of its
/// chord, which becomes the middle of the trace in that distance; the plane of `shape` still has
/// its trace in the former surface.
pub(super) fn cut(shape: &FrontShape, deviation: &FrontDeviation, cut: f64) -> FrontShape {
    let point = |phi: f64| {
        let (g, (sin, cos)) = (deviation.radius_factor(phi), phi.sin_cos());
        [shape.half_length * g * cos, shape.length * g * sin]
    };
    let below = |phi: f64| point(phi)[1] - cut;
    let ends = [located(0.0, FRAC_PI_2, below), located(PI, FRAC_PI_2, below)];
    let [right, left] = ends.map(|phi| point(phi)[0]);
    let (middle, half_length) = (0.5 * (right + left), 0.5 * (right - left));
    let on_front = |of: &dyn Fn([f64; 2]) -> f64| {
        let [zeta, s] = point(located(ends[0], ends[1], |phi| {
            let [zeta, s] = point(phi);
            of([zeta - middle, s - cut])
        }));
        [zeta - middle, s - cut]
    };
    let length = on_front(&|[zeta, _]| -zeta)[1];
    let count = 2 * deviation.harmonics();
    let of = |j: usize| {
        let j = if j <= count / 2 { j } else { count - j };
        // The ends of the semi-axes stay where they are.
        if j.is_multiple_of(count / 4) {
            return 0.0;
        }
        let (sin, cos) = deviation.angle(j).sin_cos();
        let [along, down] = [half_length * cos, length * sin];
        let [zeta, s] = on_front(&|[zeta, s]| s * along - zeta * down);
        (zeta * along + s * down) / (along * along + down * down) - 1.0
    };
    let front = deviation.with_nodes((0..count).map(of).collect::<Vec<_>>());
    placed(shape, Outline { axes: [half_length, length], middle: [middle, 0.0], front })
}

/// The angle between `from`, where `of` is negative, and `to`, where it is not, at which it changes
/// its sign.
fn located(mut from: f64, mut to: f64, of: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (from + to);
        if of(middle) < 0.0 { from = middle } else { to = middle }
    }
    0.5 * (from + to)
}

#[cfg(test)]
mod tests {
    use super::super::body::{FrontPoint, SpaceBody};
    use super::super::division::{SpaceResolution, VERTEX_LAYER, is_outside};
    use super::super::front_motion::FrontSpeeds;
    use super::super::plane::Surroundings;
    use super::*;

    fn shape(harmonics: usize, buried: Option<f64>) -> FrontShape {
        FrontShape {
            dip: 0.5,
            strike: 0.0,
            length: 3.0,
            half_length: 5.0,
            middle: [0.0, 1.0],
            buried,
            strip: None,
            turns: None,
            deviation: FrontDeviation::none(harmonics),
        }
    }

    /// Lateral position and distance from the trace of the plane of the front at φ, mm.
    fn point(shape: &FrontShape, phi: f64) -> [f64; 2] {
        let g = shape.deviation.map_or(1.0, |own| own.radius_factor(phi));
        let (sin, cos) = phi.sin_cos();
        [shape.middle[1] + shape.half_length * g * cos, shape.buried.unwrap_or(0.0) + shape.length * g * sin]
    }

    fn moved_by(shape: &FrontShape, increments: &[f64]) -> FrontShape {
        moved(shape, &shape.deviation.unwrap(), increments)
    }

    /// Points of the front with their normals.
    fn front(shape: &FrontShape, count: usize) -> Vec<FrontPoint> {
        let (last, intervals) = if shape.buried.is_some() { (2.0 * PI, count) } else { (PI, count - 1) };
        let of = |i: usize| {
            let phi = last * i as f64 / intervals as f64;
            let [ahead, behind] = [phi + 1e-5, phi - 1e-5].map(|phi| point(shape, phi));
            let tangent = [ahead[0] - behind[0], ahead[1] - behind[1]];
            let size = tangent[0].hypot(tangent[1]);
            let [zeta, s] = point(shape, phi);
            let normal = [-tangent[0] / size, tangent[1] / size];
            let counts = shape.buried.is_some() || is_outside(VERTEX_LAYER, phi);
            FrontPoint { crack: 0, phi, position: [0.0, zeta, s], normal, counts }
        };
        (0..count).map(of).collect()
    }

    #[test]
    fn with_two_harmonics_the_motion_is_that_of_an_ellipse() {
        // Ends at larger and smaller lateral positions, deepest and highest point.
        for (buried, increments) in [(None, &[3.0, 1.0, 2.0][..]), (Some(10.0), &[3.0, 1.0, 2.0, 0.5])] {
            let grown = moved_by(&shape(2, buried), increments);
            let up = increments.get(3).copied().unwrap_or(0.0);
            let down = if buried.is_some() { 0.5 * (1.0 + up) } else { 1.0 };
            assert!((grown.length - 3.0 - down).abs() < 1e-12 && (grown.half_length - 7.5).abs() < 1e-12);
            assert!((grown.middle[1] - 1.5).abs() < 1e-12 && grown.deviation.unwrap().largest() < 1e-12);
            assert_eq!(grown.buried.map(|centre| (centre - 10.25).abs() < 1e-12), buried.map(|_| true));
        }
    }

    #[test]
    fn a_circle_that_moves_as_a_whole_stays_a_circle() {
        let circle = FrontShape { half_length: 3.0, ..shape(6, Some(10.0)) };
        let front = circle.deviation.unwrap();
        let along = [0.3, -0.2];
        let component = |j: usize| {
            let (sin, cos) = front.angle(j).sin_cos();
            along[0] * cos + along[1] * sin
        };
        let moved = moved_by(&circle, &(0..12).map(component).collect::<Vec<_>>());
        assert!((moved.middle[1] - 1.3).abs() < 1e-12 && (moved.buried.unwrap() - 9.8).abs() < 1e-12);
        assert!(moved.deviation.unwrap().largest() < 1e-12, "{moved:?}");
    }

    /// Largest distance from the curve at the distance 1 outside a free front that has grown by 1
    /// along its normals everywhere in `steps` steps.
    fn offset_error(buried: Option<f64>, steps: usize) -> f64 {
        let mut grown = shape(8, buried);
        // As it must be, zero at the ends of the semi-axes; the two sides differ.
        let bulge = |phi: f64| 0.04 * (phi.cos() - (3.0 * phi).cos());
        grown.deviation = grown.deviation.map(|own| own.with_nodes((0..16).map(|j| bulge(own.angle(j)))));
        let start = grown;
        for _ in 0..steps {
            let points = front(&grown, 65);
            let speeds = FrontSpeeds::nearest(&grown, &points, &vec![1.0 / steps as f64; points.len()]);
            grown = speeds.moved(&grown);
        }
        let from = front(&start, 33);
        let within = |point: &&FrontPoint| buried.is_some() || (0.3..PI - 0.3).contains(&point.phi);
        let error = |own: &FrontPoint| {
            let [_, zeta, s] = own.position;
            let want = [zeta + own.normal[1], s + own.normal[0]];
            let distance = |phi: f64| {
                let [zeta, s] = point(&grown, phi);
                (zeta - want[0]).hypot(s - want[1])
            };
            (0..7200).map(|i| distance(PI * f64::from(i) / 3600.0)).fold(f64::INFINITY, f64::min)
        };
        from.iter().filter(within).map(error).fold(0.0, f64::max)
    }

    #[test]
    fn under_equal_rates_a_front_grows_along_its_normals() {
        for buried in [None, Some(10.0)] {
            let errors = [5, 40].map(|steps| offset_error(buried, steps));
            assert!(errors[0] < 0.012 && errors[1] < 0.004, "{errors:?}");
        }
    }

    /// cos 3φ of the distance of the front from its centre over its mean, and that mean (mm).
    fn third_harmonic(shape: &FrontShape) -> [f64; 2] {
        const POINTS: usize = 720;
        let middle = [shape.middle[1], shape.buried.unwrap()];
        let mut centre = middle;
        let mut found = [0.0; 2];
        // The first harmonic about the centre vanishes.
        for _ in 0..20 {
            let mut sums = [0.0; 4];
            for i in 0..POINTS {
                let [zeta, s] = point(shape, 2.0 * PI * i as f64 / POINTS as f64);
                let [along, down] = [zeta - centre[0], s - centre[1]];
                let (distance, angle) = (along.hypot(down), down.atan2(along));
                let (sin, cos) = angle.sin_cos();
                let terms = [
                    distance,
                    2.0 * distance * cos,
                    2.0 * distance * sin,
                    2.0 * distance * (3.0 * angle).cos(),
                ];
                sums.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term / POINTS as f64);
            }
            centre = [centre[0] + sums[1], centre[1] + sums[2]];
            found = [sums[3] / sums[0], sums[0]];
        }
        found
    }

    /// In tension K along the front a (1 + ε cos nφ) of a penny is K (1 + (1 − n)/2 ε cos nφ) to
    /// first order (Gao & Rice 1987). Under a rate ∝ K^m the amplitude εa thus goes with
    /// a^(m(1 − n)/2): the front becomes a circle.
    #[test]
    fn waves_of_a_front_in_tension_fade() {
        const EXPONENT: f64 = 3.0;
        let mut penny = FrontShape {
            dip: FRAC_PI_2,
            length: 1.0,
            half_length: 1.0,
            middle: [0.0; 2],
            ..shape(8, Some(50.0))
        };
        // About its middle, the front 1 + ε cos 3φ moved by −ε has g = 1 at the ends of its axes.
        let wave = |phi: f64| 0.03 * ((3.0 * phi).cos() - phi.cos());
        penny.deviation = penny.deviation.map(|own| own.with_nodes((0..16).map(|j| wave(own.angle(j)))));
        let [start, from] = third_harmonic(&penny);
        let steel = crate::material::IsotropicElastic::new(2.1e5, 0.3).unwrap();
        let grown = |penny: &FrontShape, by: f64| {
            let resolution = SpaceResolution::new(3, 3);
            let crack = penny.crack().unwrap();
            let body = SpaceBody::new(&[crack], &steel, Surroundings::FullSpace, resolution).unwrap();
            let forces = body.nodal_forces(|_| [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
            let largest = 2.0 / PI.sqrt();
            let rate = |k: &super::super::FrontSif| by * (k.ki / largest).powf(EXPONENT);
            let rates: Vec<f64> = body.sifs(&forces).iter().map(rate).collect();
            FrontSpeeds::nearest(penny, body.front(), &rates)
        };
        // The midpoint rule.
        for _ in 0..4 {
            let half = grown(&penny, 0.04).moved(&penny);
            penny = grown(&half, 0.08).moved(&penny);
        }
        let [left, to] = third_harmonic(&penny);
        let exponent = (left * to / (start * from)).ln() / (to / from).ln();
        assert!(to / from > 1.3 && (exponent + EXPONENT).abs() < 0.08 * EXPONENT, "{to} {from} {exponent}");
    }

    #[test]
    fn what_is_left_below_a_cut_lies_on_the_front() {
        let mut before = shape(8, None);
        let bulges = [0.0, 0.04, -0.02, 0.03, 0.0, 0.02, 0.05, -0.03, 0.0];
        let mirrored = |j: usize| bulges[if j > 8 { 16 - j } else { j }];
        before.deviation = before.deviation.map(|own| own.with_nodes((0..16).map(mirrored)));
        let left = cut(&before, &before.deviation.unwrap(), 0.4);
        let front = left.deviation.unwrap();
        for j in 0..=8 {
            let [zeta, s] = point(&left, front.angle(j));
            // The parametric angle of this place on the front before.
            let phi = ((s + 0.4) / before.length).atan2((zeta - before.middle[1]) / before.half_length);
            let [was_zeta, was_s] = point(&before, phi);
            assert!((was_zeta - zeta).hypot(was_s - s - 0.4) < 1e-9, "{j} {zeta} {s}");
        }
        assert!([0, 4, 8].iter().all(|&j| front.nodes()[j] == 0.0) && left.half_length < 5.0);
    }
}
