//! Rolled rails: material, contact, direction of travel and initial residual stress.

use super::bounds::{
    ContactBounds, DepthBounds, FirstYield, ShakedownLimit, bounds_by_depth, first_yield_ratio,
    shakedown_limit_ratio,
};
use crate::field::{DepthProfile, StressField, Wheel, wheel_under};
use crate::interruption::Interrupted;
pub use crate::load::Travel;
use crate::load::{Contact, WheelLoad};
use crate::material::{IsotropicElastic, KinematicHardening};
use crate::math::{OutOfRange, Stress, Vec2};
use thiserror::Error;

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

/// A plastic strain: deviatoric, with tensor shear.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PlasticStrain {
    /// Along the rail.
    pub xx: f64,
    /// Vertical.
    pub yy: f64,
    /// Out of plane.
    pub zz: f64,
    /// Shear, the tensor component.
    pub xy: f64,
}

impl PlasticStrain {
    /// The strain with the coordinates of [`crate::math::Stress::deviator`], whose Euclidean norm
    /// is the Frobenius norm: ((ε_xx − ε_yy)/√2, √(3/2) ε_zz, √2 ε_xy).
    pub(crate) fn from_deviator([difference, out, shear]: [f64; 3]) -> Self {
        const ROOT_2: f64 = std::f64::consts::SQRT_2;
        let zz = (2.0 / 3.0_f64).sqrt() * out;
        Self {
            xx: 0.5 * (ROOT_2 * difference - zz),
            yy: 0.5 * (-ROOT_2 * difference - zz),
            zz,
            xy: shear / ROOT_2,
        }
    }

    /// The coordinates of [`PlasticStrain::from_deviator`].
    pub(crate) fn deviator(self) -> [f64; 3] {
        const ROOT_2: f64 = std::f64::consts::SQRT_2;
        [(self.xx - self.yy) / ROOT_2, 1.5_f64.sqrt() * self.zz, ROOT_2 * self.xy]
    }

    /// √(2/3) |ε_p|: the equivalent plastic strain of a proportional path.
    pub fn equivalent(self) -> f64 {
        let d = self.deviator();
        (2.0 / 3.0 * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2])).sqrt()
    }
}

/// Errors of the stabilised plastic state.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum ShakedownError {
    /// A pressure outside the range of the model.
    #[error("p0/k = {ratio}: must be positive and at most {most}; k is the yield stress over sqrt(3)")]
    Load {
        /// p0/k.
        ratio: f64,
        /// The largest accepted value.
        most: f64,
    },
    /// An invalid contact.
    #[error("{quantity} = {value}: must be {accepted}")]
    Contact {
        /// The quantity.
        quantity: &'static str,
        /// The given value.
        value: f64,
        /// The accepted values.
        accepted: &'static str,
    },
    /// An initial residual stress that the steel cannot carry.
    #[error(
        "initial residual stress: {utilisation} of the yield stress at depth {depth} mm; must be at most 1, otherwise the rail yields without a wheel"
    )]
    Initial {
        /// √(3/2) |s| / σ_y.
        utilisation: f64,
        /// mm.
        depth: f64,
    },
    /// A plastic zone that becomes deeper with every enlargement of the grid.
    #[error(
        "the plastic zone reaches below {depth} mm: the initial residual stress and the wheel make the whole rail yield"
    )]
    Bottomless {
        /// mm.
        depth: f64,
    },
    /// A passage whose plastic strain did not converge.
    #[error(
        "passage {pass} not converged: after {iterations} redistributions the plastic strain still changes by {change:.2e} of the yield strain, the tolerance is {tolerance:.1e}"
    )]
    NotConverged {
        /// Number of the passage, from 1.
        pass: usize,
        /// Number of elastic redistributions.
        iterations: usize,
        /// The last change of the plastic strain, times 2 G over the radius of the yield surface.
        change: f64,
        /// The tolerance of this change.
        tolerance: f64,
    },
    /// Interrupted on request.
    #[error("{0}")]
    Interrupted(#[from] Interrupted),
}

impl From<OutOfRange> for ShakedownError {
    fn from(OutOfRange { quantity, value, accepted }: OutOfRange) -> Self {
        Self::Contact { quantity, value, accepted }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn deviator_coordinates_are_inverted() {
        let strain = PlasticStrain { xx: 1e-3, yy: -3e-3, zz: 2e-3, xy: 5e-4 };
        let back = PlasticStrain::from_deviator(strain.deviator());
        for (a, b) in [(strain.xx, back.xx), (strain.yy, back.yy), (strain.zz, back.zz), (strain.xy, back.xy)]
        {
            assert!((a - b).abs() < 1e-17, "{back:?}"); // round-off
        }
        // Simple tension: the equivalent strain is the axial one.
        let tension = PlasticStrain { xx: 2e-3, yy: -1e-3, zz: -1e-3, xy: 0.0 };
        assert!((tension.equivalent() - 2e-3).abs() < 1e-17);
    }
}
