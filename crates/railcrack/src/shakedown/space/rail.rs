//! Rails rolled under contacts whose stress varies across them.

use super::super::rail::ShakedownError;
use crate::field::{DepthProfile, StressField};
use crate::load::Travel;
use crate::material::{IsotropicElastic, KinematicHardening};
use crate::math::{OutOfRange, Stress, Tensor, Vec2};
use std::fmt::{self, Debug, Formatter};
use std::sync::Arc;

/// The stress of a contact in the half-space.
pub trait PatchStress: Send + Sync {
    /// The stress (MPa) at `x` (mm) from the wheel's centre, the lateral place `y` (mm) and `depth`
    /// (mm).
    fn stress(&self, x: f64, y: f64, depth: f64) -> Tensor;
}

impl<F: Fn(f64, f64, f64) -> Tensor + Send + Sync> PatchStress for F {
    fn stress(&self, x: f64, y: f64, depth: f64) -> Tensor {
        self(x, y, depth)
    }
}

/// Whether a contact is its own mirror image in the vertical plane along the rail through its
/// middle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Symmetry {
    /// It is.
    Mirrored,
    /// It is not: lateral shear or spin.
    None,
}

/// The contact of a wheel on the rail head.
#[derive(Clone)]
pub struct RolledPatch {
    /// Largest pressure, MPa.
    pub peak_pressure: f64,
    /// Half of its extent along the rail, mm.
    pub half_width: f64,
    /// Half of its extent across the rail, mm.
    pub lateral_half_width: f64,
    /// Lateral place of its middle, mm.
    pub lateral: f64,
    /// Its mirror image.
    pub symmetry: Symmetry,
    /// Direction of travel of its wheel.
    pub travel: Travel,
    /// Its stress.
    pub stress: Arc<dyn PatchStress>,
}

impl Debug for RolledPatch {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.debug_struct("RolledPatch")
            .field("peak_pressure", &self.peak_pressure)
            .field("half_width", &self.half_width)
            .field("lateral_half_width", &self.lateral_half_width)
            .field("lateral", &self.lateral)
            .field("symmetry", &self.symmetry)
            .field("travel", &self.travel)
            .finish_non_exhaustive()
    }
}

impl RolledPatch {
    /// Its stress (MPa) at `x` (mm) from its wheel's centre ahead in the direction of travel, in
    /// axes of which x points there.
    pub(super) fn forward_stress(&self, x: f64, y: f64, depth: f64) -> Tensor {
        match self.travel {
            Travel::Forward => self.stress.stress(x, y, depth),
            Travel::Backward => self.stress.stress(-x, y, depth).mirrored(),
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless_positive("peak pressure (MPa)", self.peak_pressure)?;
        OutOfRange::unless_positive("half width (mm)", self.half_width)?;
        OutOfRange::unless_positive("lateral half width (mm)", self.lateral_half_width)?;
        OutOfRange::unless(self.lateral.is_finite(), "lateral place (mm)", self.lateral, "finite")
    }
}

/// A half-space of hardening steel under the repeated passage of wheels with patches.
#[derive(Debug, Clone)]
pub struct RailInSpace {
    /// Elasticity of the steel.
    pub steel: IsotropicElastic,
    /// Plasticity of the steel.
    pub hardening: KinematicHardening,
    /// The contacts, at least one, which pass in turn.
    pub patches: Vec<RolledPatch>,
    /// Balanced residual stress from manufacturing, present before the first passage: by depth,
    /// along the rail and (zz of the profile) across it.
    pub initial: Option<DepthProfile>,
}

/// p0/k beyond which the pressure is far from elastic.
const HEAVIEST: f64 = 20.0;

impl RailInSpace {
    /// The largest p0 / k of its wheels.
    #[must_use]
    pub fn pressure_ratio(&self) -> f64 {
        let peak = self.patches.iter().map(|patch| patch.peak_pressure).fold(0.0, f64::max);
        peak / self.hardening.shear_yield_stress()
    }

    /// The initial residual stress at `depth` (mm), MPa.
    #[must_use]
    pub fn initial_stress(&self, depth: f64) -> Tensor {
        let Some(profile) = &self.initial else { return Tensor::ZERO };
        let Stress { xx, yy, zz, .. } = profile.stress(Vec2::new(0.0, -depth));
        Tensor { xx, yy: zz, zz: yy, ..Tensor::ZERO }
    }

    /// Whether rail and loads are their own mirror image in one vertical plane along the rail.
    pub(super) fn symmetry(&self) -> Symmetry {
        let Some(first) = self.patches.first() else { return Symmetry::None };
        let is_same =
            |patch: &RolledPatch| patch.symmetry == Symmetry::Mirrored && patch.lateral == first.lateral;
        if self.patches.iter().all(is_same) { Symmetry::Mirrored } else { Symmetry::None }
    }

    /// Checks that its stabilised state can be computed.
    ///
    /// Errors: a load, contact or initial residual stress outside the range of the model.
    pub fn check(&self) -> Result<(), ShakedownError> {
        let ratio = self.pressure_ratio();
        let accepted = ratio > 0.0 && ratio <= HEAVIEST;
        if !accepted {
            return Err(ShakedownError::Load { ratio, most: HEAVIEST });
        }
        for patch in &self.patches {
            patch.check()?;
        }
        for &(depth, xx, zz) in self.initial.iter().flat_map(|profile| profile.rows()) {
            let s = Tensor { xx, yy: zz, ..Tensor::ZERO }.deviator();
            let utilisation = s.iter().map(|c| c * c).sum::<f64>().sqrt() / self.hardening.yield_radius();
            if utilisation > 1.0 {
                return Err(ShakedownError::Initial { utilisation, depth });
            }
        }
        Ok(())
    }
}
