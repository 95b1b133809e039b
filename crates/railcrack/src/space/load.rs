//! Loads of a rail with cracks in space, and their nodal forces.
//!
//! The stress of a moving contact at a point is a function of one variable, the distance along the
//! rail. It is analytic except where the distance to a point of the contact's edge vanishes, ξ ± i
//! √((y − η)² + z²), where (ξ, η) is the edge and y and z the lateral distance and depth. The line
//! is divided into panels as long as the ellipses of convergence around them allow, with Chebyshev
//! points in each: far fewer places than the wheel has positions, unless the point lies just below
//! the surface.

use super::bilinear::WheelStress;
use super::body::{LoadPoint, SpaceBody};
use super::fluid::FluidUnderWheel;
use super::mirror::{MirroredPoints, agree, mirrored_stresses};
use super::plane::Symmetric;
use super::wheel::EllipticWheel;
use crate::contact::CrackFluid;
use crate::interruption::{Interrupted, Interruption};
use crate::load::Bending;
use rayon::prelude::*;
use std::cell::RefCell;
use std::collections::HashMap;
use std::f64::consts::{PI, TAU};
use std::rc::Rc;

/// Stress (MPa) of the uncracked rail at x, lateral and depth (mm).
pub(super) type StressAt<'a> = dyn Fn([f64; 3]) -> Symmetric + Sync + 'a;

/// Load of the rail with cracks: a passing wheel that may bend the rail, and a constant stress.
pub struct SpaceLoad<'a> {
    /// Stress of the uncracked rail under the wheel.
    pub wheel: &'a dyn WheelStress,
    /// Bending of the rail under the axles of the train, which moves with the wheel.
    pub bending: Option<&'a Bending>,
    /// Constant stress without the wheel, residual and thermal.
    pub constant: Option<&'a StressAt<'a>>,
    /// Fluid in the cracks.
    pub fluid: Option<SpaceFluidLoad<'a>>,
}

/// Fluid in cracks under a wheel.
#[derive(Clone, Copy)]
pub struct SpaceFluidLoad<'a> {
    /// The fluid.
    pub fluid: &'a CrackFluid,
    /// Pressure of the contact (MPa) with the wheel at an abscissa (mm), at x and lateral position
    /// (mm); zero outside of the contact.
    pub over: &'a (dyn Fn(f64, [f64; 2]) -> f64 + Sync),
}

impl SpaceLoad<'_> {
    /// Nodal forces (N) due to the constant stress.
    pub(super) fn constant_forces(&self, body: &SpaceBody) -> Vec<f64> {
        self.constant.map_or_else(|| vec![0.0; 3 * body.points().len()], |stress| body.nodal_forces(stress))
    }

    /// Whether the load is symmetric about the plane of symmetry of `points` with the wheel at each
    /// of `positions` (mm), by the stress at some points. The constant stress is not considered.
    pub(super) fn is_mirrored(&self, body: &SpaceBody, points: &MirroredPoints, positions: &[f64]) -> bool {
        let probes = points.probes(body);
        let values = |&position: &f64| {
            let of = |&point: &[f64; 3]| {
                let image = points.image(point);
                let [one, other] = [point, image].map(|at| self.wheel.stress(position, at));
                let pressures =
                    self.fluid.map(|fluid| [point, image].map(|at| (fluid.over)(position, [at[0], at[1]])));
                mirrored_stresses(&one, &other).into_iter().chain(pressures)
            };
            probes.iter().flat_map(of).collect::<Vec<_>>()
        };
        let all: Vec<Vec<[f64; 2]>> = positions.par_iter().map(values).collect();
        agree(&all.concat())
    }

    /// The wheel over the faces of `body`, before they touch, for a passage with results at
    /// `positions` (mm); with `mirrored` points, body and load are symmetric.
    ///
    /// Errors: an interruption.
    pub(super) fn over<'b>(
        &'b self,
        (body, mirrored): (&'b SpaceBody, Option<MirroredPoints>),
        fluid: Option<FluidUnderWheel<'b>>,
        positions: &[f64],
        interruption: Interruption<'_>,
    ) -> Result<WheelOverFaces<'b>, Interrupted> {
        let is_loaded = |at| mirrored.as_ref().is_none_or(|points| points.is_beyond(at));
        let lines = WheelLines::new(body, self.wheel, is_loaded, positions, interruption)?;
        Ok(WheelOverFaces { load: self, body, fluid, mirrored, lines })
    }
}

/// Nodal forces (N) by the position of the wheel, each computed once.
#[derive(Debug, Default)]
pub(super) struct ForcesByPosition(RefCell<HashMap<u64, Rc<[f64]>>>);

impl ForcesByPosition {
    /// The forces at `position` (mm), which are those of `compute` if they are not known yet.
    pub fn at(&self, position: f64, compute: impl FnOnce(f64) -> Vec<f64>) -> Rc<[f64]> {
        let known = self.0.borrow().get(&position.to_bits()).cloned();
        known.unwrap_or_else(|| {
            let forces: Rc<[f64]> = compute(position).into();
            self.0.borrow_mut().insert(position.to_bits(), Rc::clone(&forces));
            forces
        })
    }
}

impl FromIterator<(f64, Vec<f64>)> for ForcesByPosition {
    fn from_iter<I: IntoIterator<Item = (f64, Vec<f64>)>>(known: I) -> Self {
        let by_bits = |(position, forces): (f64, Vec<f64>)| (position.to_bits(), forces.into());
        Self(RefCell::new(known.into_iter().map(by_bits).collect()))
    }
}

/// A wheel over the faces of a body: its forces on them, before they touch.
pub(super) struct WheelOverFaces<'a> {
    load: &'a SpaceLoad<'a>,
    body: &'a SpaceBody,
    pub fluid: Option<FluidUnderWheel<'a>>,
    /// The points of faces that are symmetric, under a load that is.
    pub mirrored: Option<MirroredPoints>,
    lines: WheelLines,
}

impl WheelOverFaces<'_> {
    /// The traction (MPa) with the wheel at `position` (mm), with the pressure of the fluid from
    /// the mouth and without the constant stress; zero on the half of symmetric faces that is not
    /// loaded.
    fn traction(&self, number: usize, load: &LoadPoint, position: f64) -> [f64; 3] {
        let Self { load: SpaceLoad { wheel, bending, .. }, body, fluid, mirrored, lines } = self;
        let [x, _, depth] = load.position;
        if mirrored.as_ref().is_some_and(|points| !points.is_beyond(load.position)) {
            return [0.0; 3];
        }
        let mut traction = lines
            .traction(number, x, position)
            .unwrap_or_else(|| body.traction_at(load, &wheel.stress(position, load.position)));
        let mut stress = [0.0; 6];
        stress[0] += bending.map_or(0.0, |beam| beam.stress(x - position, depth));
        // Tension across the faces opens them like a pressure in the crack.
        if let Some(FluidUnderWheel { faces, over }) = fluid {
            let pressure = faces.mouth_pressure(body, load.crack, (position, *over), load.position);
            stress[..3].iter_mut().for_each(|normal| *normal += pressure);
        }
        let others = body.traction_at(load, &stress);
        traction.iter_mut().zip(others).for_each(|(sum, other)| *sum += other);
        traction
    }

    /// Nodal forces (N) with the wheel at `position` (mm), those of the fluid from the mouth
    /// included.
    pub fn forces(&self, position: f64) -> Vec<f64> {
        let all = 0..self.body.cracks().len();
        let forces = self.body.forces_of_tractions(all, |k, load| self.traction(k, load, position));
        match &self.mirrored {
            Some(points) => points.with_mirrored_forces(forces),
            None => forces,
        }
    }

    /// Nodal forces (N) at the points of `crack` (from 0); of symmetric faces, those of the loads
    /// on one side.
    pub fn forces_on(&self, crack: usize, position: f64) -> Vec<f64> {
        self.body.forces_of_tractions(crack..crack + 1, |k, load| self.traction(k, load, position))
    }
}

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
