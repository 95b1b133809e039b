//! Steel: linear isotropic elasticity in plane strain, and kinematic hardening.

use crate::math::Stress;
use thiserror::Error;

/// An inadmissible elastic constant.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum MaterialError {
    /// Young's modulus.
    #[error("Young's modulus {value} MPa: must be positive and finite")]
    YoungModulus {
        /// The given value, MPa.
        value: f64,
    },
    /// Poisson's ratio.
    #[error("Poisson's ratio {value}: must lie in (-1, 0.5)")]
    PoissonRatio {
        /// The given value.
        value: f64,
    },
}

/// Isotropic linear elasticity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IsotropicElastic {
    young: f64,
    poisson: f64,
}

impl IsotropicElastic {
    /// Young's modulus `young` in MPa (positive), Poisson's ratio `poisson` in (−1, 0.5).
    pub fn new(young: f64, poisson: f64) -> Result<Self, MaterialError> {
        if !(young > 0.0 && young.is_finite()) {
            return Err(MaterialError::YoungModulus { value: young });
        }
        if !(poisson > -1.0 && poisson < 0.5) {
            return Err(MaterialError::PoissonRatio { value: poisson });
        }
        Ok(Self { young, poisson })
    }

    /// E, MPa.
    pub fn young(&self) -> f64 {
        self.young
    }

    /// ν.
    pub fn poisson(&self) -> f64 {
        self.poisson
    }

    /// E′ = E / (1 − ν²), MPa: the modulus of plane strain, K = E′ √(2π/r) ⟦w⟧ / 8 behind a tip.
    pub fn plane_strain_modulus(&self) -> f64 {
        self.young / (1.0 - self.poisson * self.poisson)
    }

    /// The stress (MPa) of the elastic strains ε_xx, ε_yy and γ_xy = 2 ε_xy; ε_zz = 0.
    pub(crate) fn plane_strain_stress(&self, xx: f64, yy: f64, shear: f64) -> Stress {
        let mu = self.shear_modulus();
        let bulk = 2.0 * mu * self.poisson / (1.0 - 2.0 * self.poisson) * (xx + yy);
        Stress { xx: bulk + 2.0 * mu * xx, yy: bulk + 2.0 * mu * yy, zz: bulk, xy: mu * shear }
    }

    /// G = E / (2 (1 + ν)), MPa.
    pub fn shear_modulus(&self) -> f64 {
        0.5 * self.young / (1.0 + self.poisson)
    }
}

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
