//! Tractions of a passing wheel at the load points of a body, interpolated along the rail.
//!
//! The stress of a moving contact at a point is a function of one variable, the distance along the
//! rail. It is analytic except where the distance to a point of the contact's edge vanishes, ξ ± i
//! √((y − η)² + z²), where (ξ, η) is the edge and y and z the lateral distance and depth. The line
//! is divided into panels as long as the ellipses of convergence around them allow, with Chebyshev
//! points in each: far fewer places than the wheel has positions, unless the point lies just below
//! the surface.

use super::body::{LoadPoint, SpaceBody};
use super::wheel::EllipticWheel;
use super::wheel_stress::WheelStress;
use crate::interruption::{Interrupted, Interruption};
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// Chebyshev points of a panel.
const POINTS: usize = 10;
/// Sum of the semi-axes of the smallest ellipse, over the half-length of the panel, that is free of
/// singular points: the error falls as its powers.
const SUM_OF_AXES: f64 = 2.6;
/// Points of the edge of the contact that stand for all.
const EDGE: usize = 32;

/// Traction (opening, slip along the dip and along the trace; MPa) along the line of a load point:
/// Chebyshev coefficients between `from` and `to`, distances from the middle of the contact (mm).
#[derive(Debug, Clone)]
struct Panel {
    from: f64,
    to: f64,
    coefficients: [[f64; 3]; POINTS],
}

/// The lines of all load points; empty where panels would take more evaluations than the positions.
#[derive(Debug, Clone)]
pub(super) struct WheelLines {
    lines: Vec<Vec<Panel>>,
}

impl WheelLines {
    /// The lines of the load points of `body` that are loaded according to `is_loaded`, for
    /// positions (mm) among which `positions` are certain.
    ///
    /// Errors: an interruption.
    pub fn new(
        body: &SpaceBody,
        wheel: &dyn WheelStress,
        is_loaded: impl Fn([f64; 3]) -> bool + Sync,
        positions: &[f64],
        interruption: Interruption<'_>,
    ) -> Result<Self, Interrupted> {
        let Some(contact) = wheel.contact() else { return Ok(Self { lines: Vec::new() }) };
        let [first, last] =
            [f64::min, f64::max].map(|end| positions.iter().copied().reduce(end).unwrap_or(0.0));
        let angles = chebyshev_angles();
        let line = |load: &LoadPoint| {
            interruption.check()?;
            if !is_loaded(load.position) {
                return Ok(Vec::new());
            }
            let [x, lateral, depth] = load.position;
            let ends = [x - last, x - first];
            let singular = Singularities::of(contact, [lateral, depth]);
            let most = positions.len() / POINTS;
            let Some(panels) = singular.panels(ends, most) else { return Ok(Vec::new()) };
            let of = |[from, to]: [f64; 2]| {
                let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
                let values = angles.map(|angle| {
                    let position = x - (middle + half * angle.cos());
                    body.traction_at(load, &wheel.stress(position, load.position))
                });
                Panel { from, to, coefficients: coefficients(&angles, &values) }
            };
            Ok(panels.into_iter().map(of).collect())
        };
        let lines = body.load_points().par_iter().map(line).collect::<Result<_, Interrupted>>()?;
        Ok(Self { lines })
    }

    /// The traction (MPa) at load point `load` (from 0), at x (mm), with the wheel at `position`
    /// (mm); none where it is not interpolated.
    pub fn traction(&self, load: usize, x: f64, position: f64) -> Option<[f64; 3]> {
        let (panels, at) = (self.lines.get(load)?, x - position);
        let panel = panels.get(panels.partition_point(|panel| panel.to < at))?;
        (at >= panel.from).then(|| panel.value(at))
    }
}

impl Panel {
    /// Clenshaw's sum.
    fn value(&self, at: f64) -> [f64; 3] {
        let t = (2.0 * at - self.from - self.to) / (self.to - self.from);
        let (mut next, mut after) = ([0.0; 3], [0.0; 3]);
        for own in self.coefficients[1..].iter().rev() {
            let sum = std::array::from_fn(|c| own[c] + 2.0 * t * next[c] - after[c]);
            (next, after) = (sum, next);
        }
        std::array::from_fn(|c| self.coefficients[0][c] + t * next[c] - after[c])
    }
}

fn chebyshev_angles() -> [f64; POINTS] {
    std::array::from_fn(|j| PI * (j as f64 + 0.5) / POINTS as f64)
}

/// Coefficients of the Chebyshev polynomials that take `values` at the cosines of `angles`.
fn coefficients(angles: &[f64; POINTS], values: &[[f64; 3]; POINTS]) -> [[f64; 3]; POINTS] {
    std::array::from_fn(|k| {
        let share = if k == 0 { 1.0 } else { 2.0 } / POINTS as f64;
        let mut sum = [0.0; 3];
        for (angle, value) in angles.iter().zip(values) {
            let cosine = share * (k as f64 * angle).cos();
            (0..3).for_each(|c| sum[c] += cosine * value[c]);
        }
        sum
    })
}

/// Distances from the middle of the contact at which the stress along a line is singular: real
/// parts, and squared imaginary parts, mm.
struct Singularities {
    points: Vec<[f64; 2]>,
}

impl Singularities {
    /// Those of the line at this lateral position and depth (mm).
    fn of(contact: &EllipticWheel, [lateral, depth]: [f64; 2]) -> Self {
        let (a, b) = (contact.half_width, contact.lateral_half_width);
        let y = lateral - contact.lateral;
        let square = |across: f64| (y - across).powi(2) + depth * depth;
        let around = (0..EDGE).map(|k| {
            let (sin, cos) = (TAU * k as f64 / EDGE as f64).sin_cos();
            [a * cos, square(b * sin)]
        });
        // The points of the edge that are closest to the line.
        let level = y.clamp(-b, b);
        let along = a * (1.0 - (level / b).powi(2)).max(0.0).sqrt();
        let points = around.chain([-along, along].map(|along| [along, square(level)])).collect();
        Self { points }
    }

    /// Panels from one of `ends` to the other, none if they would be more than `most`.
    fn panels(&self, [first, last]: [f64; 2], most: usize) -> Option<Vec<[f64; 2]>> {
        let axis = 0.5 * (SUM_OF_AXES + 1.0 / SUM_OF_AXES);
        let (mut panels, mut from) = (Vec::new(), first);
        while from < last {
            if panels.len() >= most {
                return None;
            }
            // The longest panel for which the sum of the distances from its ends to each singular
            // point is at least the larger axis of the ellipse.
            let longest = self.points.iter().fold(f64::INFINITY, |least, [along, square]| {
                let ahead = along - from;
                let away = (ahead * ahead + square).sqrt();
                least.min(2.0 * (axis * away - ahead) / (axis * axis - 1.0))
            });
            let to = if longest < last - from { from + longest } else { last };
            if to <= from {
                return None;
            }
            panels.push([from, to]);
            from = to;
        }
        Some(panels)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::IsotropicElastic;
    use crate::space::{PatchOnRail, SpaceCrack, SpaceResolution, Surroundings, WheelPatch};

    const NU: f64 = 0.3;
    const WHEEL: EllipticWheel = EllipticWheel {
        peak_pressure: 1000.0,
        half_width: 6.0,
        lateral_half_width: 5.0,
        lateral: 0.5,
        friction: 0.3,
        lateral_friction: 0.1,
    };
    /// Largest error of the interpolation over p0, less than that of the quadrature.
    const ALLOWED: f64 = 2e-5;

    #[test]
    fn few_evaluations_give_the_stress_along_the_rail() {
        let angles = chebyshev_angles();
        for (lateral, depth, most) in [
            (0.5, 0.02, 200),
            (0.5, 0.5, 110),
            (0.5, 4.0, 60),
            (5.4, 0.02, 260),
            (5.4, 0.5, 130),
            (5.4, 4.0, 60),
            (9.0, 0.02, 60),
        ] {
            let panels = Singularities::of(&WHEEL, [lateral, depth]).panels([-40.0, 40.0], 100).unwrap();
            assert!(POINTS * panels.len() < most, "{lateral} {depth}: {}", POINTS * panels.len());
            for (components, [from, to]) in
                [[0, 1, 2], [3, 4, 5]].into_iter().flat_map(|c| panels.iter().map(move |&p| (c, p)))
            {
                let stress = |at: f64| {
                    let all = WHEEL.stress(0.0, [at, lateral, depth], NU);
                    components.map(|k: usize| all[k])
                };
                let values = angles.map(|angle| stress(0.5 * (from + to) + 0.5 * (to - from) * angle.cos()));
                let panel = Panel { from, to, coefficients: coefficients(&angles, &values) };
                for i in 0..=20 {
                    let at = from + (to - from) * f64::from(i) / 20.0;
                    let off = panel.value(at).into_iter().zip(stress(at));
                    let off = off.fold(0.0, |most: f64, (own, exact)| most.max((own - exact).abs()));
                    assert!(off < 1000.0 * ALLOWED, "{lateral} {depth} {at}: {off}");
                }
            }
        }
    }

    #[test]
    fn tractions_of_a_crack_between_all_positions() {
        let steel = IsotropicElastic::new(210e3, NU).unwrap();
        let crack = SpaceCrack::surface_breaking(0.4, 4.0, 3.0).unwrap();
        let resolution = SpaceResolution::new(2, 2);
        let body = SpaceBody::new(&[crack], &steel, Surroundings::HalfSpace, resolution).unwrap();
        let patch = WheelPatch::Ellipse(WHEEL);
        let wheel = PatchOnRail { patch: &patch, poisson: NU };
        let positions: Vec<f64> = (0..241).map(|k| -30.0 + 0.25 * f64::from(k)).collect();
        let lines = |wheel: &dyn WheelStress, positions: &[f64]| {
            WheelLines::new(&body, wheel, |[_, lateral, _]| lateral > 0.0, positions, Interruption::NEVER)
                .unwrap()
        };
        let own = lines(&wheel, &positions);
        let mut interpolated = 0;
        for (k, load) in body.load_points().iter().enumerate() {
            for position in [-30.0, -7.33, 0.21, 4.0, 29.9] {
                let x = load.position[0];
                let Some(traction) = own.traction(k, x, position) else { continue };
                interpolated += 1;
                assert!(load.position[1] > 0.0);
                let exact = body.traction_at(load, &wheel.stress(position, load.position));
                let off = (0..3).fold(0.0f64, |most, c| most.max((traction[c] - exact[c]).abs()));
                assert!(off < 2.0 * 1000.0 * ALLOWED, "{:?} {position}: {off}", load.position);
            }
            assert!(own.traction(k, load.position[0], 31.0).is_none());
        }
        assert!(interpolated > 2 * body.load_points().len());
        // Evaluated where few positions are asked for, and any other stress.
        let by_function = |position: f64, point: [f64; 3]| WHEEL.stress(position, point, NU);
        for few in [lines(&wheel, &positions[..9]), lines(&by_function, &positions)] {
            assert!((0..body.load_points().len()).all(|k| few.traction(k, 0.0, -29.0).is_none()));
        }
    }
}
