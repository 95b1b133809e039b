//! Rolled rails: material, contact, direction of travel and initial residual stress.

use super::bounds::{
    ContactBounds, DepthBounds, FirstYield, ShakedownLimit, bounds_by_depth, first_yield_ratio,
    shakedown_limit_ratio,
};
use super::error::ShakedownError;
use crate::field::{DepthProfile, StressField, Wheel, wheel_under};
use crate::load::{Contact, WheelLoad};
use crate::material::{IsotropicElastic, KinematicHardening};
use crate::math::{OutOfRange, Stress, Vec2};

pub use crate::load::Travel;

/// A rail of hardening steel under the repeated passage of a wheel, in plane strain.
#[derive(Debug, Clone, PartialEq)]
pub struct RolledRail {
    /// Elasticity of the steel.
    pub steel: IsotropicElastic,
    /// Plasticity of the steel.
    pub hardening: KinematicHardening,
    /// The wheel on the rail.
    pub contact: Contact,
    /// Direction of travel of the wheel.
    pub travel: Travel,
    /// Balanced residual stress from manufacturing, present before the first passage.
    pub initial: Option<DepthProfile>,
}

/// The field of a contact as a function of the abscissa from its middle.
pub(super) struct RollingField {
    wheel: Box<dyn Wheel>,
    middle: f64,
}

impl RollingField {
    /// The stress (MPa) at `x` (mm) from the middle of the contact and `depth` (mm).
    pub(super) fn stress(&self, x: f64, depth: f64) -> Stress {
        self.wheel.stress(Vec2::new(self.middle + x, -depth), 0.0)
    }
}

impl RolledRail {
    /// p0 / k.
    pub fn pressure_ratio(&self) -> f64 {
        self.contact.peak_pressure() / self.hardening.shear_yield_stress()
    }

    /// The contact of the same rail with a wheel that runs towards +x: mirrored where it runs
    /// towards −x, which reverses the sign of the friction (and of the resulting shears).
    fn forward_contact(&self) -> Contact {
        match self.travel {
            Travel::Forward => self.contact.clone(),
            Travel::Backward => self.contact.mirrored(),
        }
    }

    /// The initial residual stress at `depth` (mm), MPa.
    pub fn initial_stress(&self, depth: f64) -> Stress {
        let at = Vec2::new(0.0, -depth);
        self.initial.as_ref().map_or(Stress::ZERO, |profile| profile.stress(at))
    }

    /// First yield under the contact. Errors: an invalid contact.
    pub fn first_yield(&self) -> Result<FirstYield, ShakedownError> {
        match self.contact.sliding() {
            Some(contact) => Ok(first_yield_ratio(contact.friction, self.steel.poisson())),
            None => Ok(self.bounds_of(|bounds| bounds.first_yield())?),
        }
    }

    /// The limit of elastic shakedown under the contact. Errors: an invalid contact.
    pub fn shakedown_limit(&self) -> Result<ShakedownLimit, ShakedownError> {
        match self.contact.sliding() {
            Some(contact) => Ok(shakedown_limit_ratio(contact.friction, self.steel.poisson())),
            None => Ok(self.bounds_of(|bounds| bounds.shakedown_limit())?),
        }
    }

    /// First yield and shakedown limit at each of `depths_over_a`. Errors: an invalid contact.
    pub fn bounds_by_depth(&self, depths_over_a: &[f64]) -> Result<Vec<DepthBounds>, ShakedownError> {
        match self.contact.sliding() {
            Some(contact) => Ok(bounds_by_depth(contact.friction, self.steel.poisson(), depths_over_a)),
            None => Ok(self.bounds_of(|bounds| bounds.by_depth(depths_over_a))?),
        }
    }

    fn bounds_of<T>(&self, of: impl FnOnce(&ContactBounds) -> T) -> Result<T, OutOfRange> {
        let wheel = alone(&self.contact, &self.steel)?;
        Ok(of(&ContactBounds::new(&self.contact, wheel.as_ref())))
    }

    /// The field of the contact. Errors: an invalid contact.
    pub(super) fn field(&self) -> Result<RollingField, ShakedownError> {
        let (wheel, middle) = (alone(&self.contact, &self.steel)?, self.contact.middle());
        Ok(RollingField { wheel, middle })
    }

    /// The field of the contact, or of its mirror image if the wheel runs towards −x.
    pub(super) fn forward_field(&self) -> Result<RollingField, ShakedownError> {
        let contact = self.forward_contact();
        Ok(RollingField { wheel: alone(&contact, &self.steel)?, middle: contact.middle() })
    }
}

/// The field of `contact` on a rail that does not bend.
fn alone(contact: &Contact, steel: &IsotropicElastic) -> Result<Box<dyn Wheel>, OutOfRange> {
    wheel_under(&WheelLoad { contact: contact.clone(), track: None, temperature: None }, steel)
}
