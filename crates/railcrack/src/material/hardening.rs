//! Linear kinematic hardening.

use thiserror::Error;

/// Inadmissible parameters of the hardening law.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum HardeningError {
    /// Yield stress.
    #[error("yield stress {value} MPa: must be positive and finite")]
    YieldStress {
        /// The given value, MPa.
        value: f64,
    },
    /// Hardening modulus.
    #[error("hardening modulus {value} MPa: must be positive and finite")]
    Modulus {
        /// The given value, MPa.
        value: f64,
    },
}

/// The von Mises criterion with linear kinematic hardening (Prager 1956): |s − X| ≤ √(2/3) σ_y in
/// the Frobenius norm, with the stress deviator s and the backstress X = (2/3) C ε_p; the flow rule
/// is associated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KinematicHardening {
    yield_stress: f64,
    modulus: f64,
}

impl KinematicHardening {
    /// Yield stress in tension `yield_stress` and hardening modulus C `modulus`, MPa, both
    /// positive.
    pub fn new(yield_stress: f64, modulus: f64) -> Result<Self, HardeningError> {
        if !(yield_stress > 0.0 && yield_stress.is_finite()) {
            return Err(HardeningError::YieldStress { value: yield_stress });
        }
        if !(modulus > 0.0 && modulus.is_finite()) {
            return Err(HardeningError::Modulus { value: modulus });
        }
        Ok(Self { yield_stress, modulus })
    }

    /// σ_y, MPa.
    pub fn yield_stress(&self) -> f64 {
        self.yield_stress
    }

    /// C, MPa.
    pub fn modulus(&self) -> f64 {
        self.modulus
    }

    /// k = σ_y / √3, MPa: the yield stress in shear.
    pub fn shear_yield_stress(&self) -> f64 {
        self.yield_stress / 3f64.sqrt()
    }

    /// √(2/3) σ_y = √2 k, MPa: the radius of the yield surface in deviatoric stress space.
    pub fn yield_radius(&self) -> f64 {
        (2.0 / 3.0_f64).sqrt() * self.yield_stress
    }

    /// 2 C / 3, MPa: X over ε_p.
    pub fn back_stress_modulus(&self) -> f64 {
        2.0 / 3.0 * self.modulus
    }
}
