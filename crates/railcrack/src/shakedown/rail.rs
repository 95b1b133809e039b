//! The rolled rail: material, contact, travel, initial residual stress.

use crate::field::{DepthProfile, HertzField, StressField};
use crate::load::HertzianContact;
use crate::material::{IsotropicElastic, KinematicHardening};
use crate::math::{Stress, Vec2};

/// Direction of travel of the wheel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Travel {
    /// Towards +x.
    Forward,
    /// Towards −x.
    Backward,
}

/// A rail of hardening steel under the repeated passage of a wheel, in plane strain.
#[derive(Debug, Clone, PartialEq)]
pub struct RolledRail {
    /// Elasticity of the steel.
    pub steel: IsotropicElastic,
    /// Plasticity of the steel.
    pub hardening: KinematicHardening,
    /// The wheel on the rail.
    pub contact: HertzianContact,
    /// Direction of travel of the wheel.
    pub travel: Travel,
    /// Balanced residual stress from manufacturing, present before the first passage.
    pub initial: Option<DepthProfile>,
}

impl RolledRail {
    /// p0 / k.
    pub fn pressure_ratio(&self) -> f64 {
        self.contact.peak_pressure / self.hardening.shear_yield_stress()
    }

    /// The contact of the same rail with a wheel that runs towards +x: mirrored where it runs
    /// towards −x, which reverses the sign of the friction (and of the resulting shears).
    pub(super) fn forward_contact(&self) -> HertzianContact {
        match self.travel {
            Travel::Forward => self.contact,
            Travel::Backward => HertzianContact { friction: -self.contact.friction, ..self.contact },
        }
    }

    /// The initial residual stress at `depth` (mm), MPa.
    pub fn initial_stress(&self, depth: f64) -> Stress {
        let at = Vec2::new(0.0, -depth);
        self.initial.as_ref().map_or(Stress::ZERO, |profile| profile.stress(at))
    }

    /// The field of [`RolledRail::forward_contact`].
    pub(super) fn forward_field(&self) -> HertzField {
        HertzField::new(&self.forward_contact(), self.steel.poisson())
    }
}
