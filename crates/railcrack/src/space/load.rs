//! Loads of a rail with cracks in space, and their nodal forces.

use super::body::{LoadPoint, SpaceBody};
use super::fluid::FluidUnderWheel;
use super::mirror::{MirroredPoints, agree, mirrored_stresses};
use super::nuclei::Symmetric;
use super::wheel_lines::WheelLines;
use super::wheel_stress::WheelStress;
use crate::contact::CrackFluid;
use crate::interruption::{Interrupted, Interruption};
use crate::load::Bending;
use rayon::prelude::*;
use std::cell::RefCell;
use std::collections::HashMap;
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
