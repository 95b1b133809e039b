//! Loads of a rail with cracks in space, and their nodal forces.

use super::body::SpaceBody;
use super::fluid::{FluidUnderWheel, SpaceFluid};
use super::mirror::{MirroredPoints, agree, mirrored_stresses};
use super::nuclei::Symmetric;
use crate::load::Bending;
use rayon::prelude::*;

/// Stress (MPa) of the uncracked rail at x, lateral and depth (mm).
pub(super) type StressAt<'a> = dyn Fn([f64; 3]) -> Symmetric + Sync + 'a;

/// Load of the rail with cracks: a passing wheel that may bend the rail, and a constant stress.
pub struct SpaceLoad<'a> {
    /// Stress (MPa) of the uncracked rail with the wheel at an abscissa (mm), at x, lateral and
    /// depth (mm).
    pub wheel: &'a (dyn Fn(f64, [f64; 3]) -> Symmetric + Sync),
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
    pub fluid: &'a SpaceFluid,
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
                let [one, other] = [point, image].map(|at| (self.wheel)(position, at));
                let pressures =
                    self.fluid.map(|fluid| [point, image].map(|at| (fluid.over)(position, [at[0], at[1]])));
                mirrored_stresses(&one, &other).into_iter().chain(pressures)
            };
            probes.iter().flat_map(of).collect::<Vec<_>>()
        };
        let all: Vec<Vec<[f64; 2]>> = positions.par_iter().map(values).collect();
        agree(&all.concat())
    }

    /// The stress (MPa) with the wheel at `position` (mm) on a crack of `body` at a point (mm),
    /// with the pressure of `fluid` from the mouth and without the constant stress.
    pub(super) fn stress_at<'b>(
        &'b self,
        body: &'b SpaceBody,
        fluid: Option<&'b FluidUnderWheel<'b>>,
        position: f64,
    ) -> impl Fn(usize, [f64; 3]) -> Symmetric + Sync + 'b {
        move |crack, point| {
            let mut stress = (self.wheel)(position, point);
            stress[0] += self.bending.map_or(0.0, |beam| beam.stress(point[0] - position, point[2]));
            // Tension across the faces opens them like a pressure in the crack.
            if let Some(FluidUnderWheel { faces, over }) = fluid {
                let pressure = faces.mouth_pressure(body, crack, (position, *over), point);
                stress[..3].iter_mut().for_each(|normal| *normal += pressure);
            }
            stress
        }
    }

    /// Nodal forces (N) with the wheel at `position` (mm), those of `fluid` from the mouth
    /// included; where body and load are symmetric, from the stress on one half of the faces.
    pub(super) fn forces(
        &self,
        body: &SpaceBody,
        (fluid, mirrored): (Option<&FluidUnderWheel<'_>>, Option<&MirroredPoints>),
        constant: &[f64],
        position: f64,
    ) -> Vec<f64> {
        let stress = self.stress_at(body, fluid, position);
        let forces = match mirrored {
            Some(points) => {
                points.with_mirrored_forces(body.nodal_forces_where(|at| points.is_beyond(at), stress))
            }
            None => body.nodal_forces_by_crack(stress),
        };
        forces.iter().zip(constant).map(|(f, c)| f + c).collect()
    }
}
