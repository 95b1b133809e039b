//! Equivalent ranges: one number for the ranges of two modes.

use super::laws::Bold;
use crate::math::MPA_SQRT_MM;

/// The equivalent range ΔK_eq of ΔK_I and ΔK_II.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum EquivalentRange {
    /// √(ΔK_I² + w ΔK_II²). Source: Hourlier & Pineau 1982; Trollé et al. 2014, eq. 31.
    HourlierPineau {
        /// w, the weight of mode II.
        mode_2_weight: f64,
    },
    /// (ΔK_I⁴ + 8 ΔK_II⁴)^¼. Source: Tanaka 1974, Eng. Fract. Mech. 6, 493–507.
    Tanaka,
    /// ΔK_I/2 + ½ √(ΔK_I² + 4 (1.155 ΔK_II)²). Source: Richard, Fulland & Sander 2005, Fatigue
    /// Fract. Eng. Mater. Struct. 28, 3–12.
    Richard,
    /// That of the law of Bold, Brown and Allen ([`Bold`]).
    Bold,
}

impl EquivalentRange {
    /// The weight of Trollé et al. 2014, eq. 31.
    pub const RAIL_STEEL: Self = Self::HourlierPineau { mode_2_weight: 0.772 };

    /// ΔK_eq of the ranges `delta_ki` and `delta_kii`; all MPa √mm.
    #[must_use]
    pub fn of(&self, delta_ki: f64, delta_kii: f64) -> f64 {
        match *self {
            Self::HourlierPineau { mode_2_weight } => {
                (delta_ki * delta_ki + mode_2_weight * delta_kii * delta_kii).sqrt()
            }
            Self::Tanaka => (delta_ki.powi(4) + 8.0 * delta_kii.powi(4)).sqrt().sqrt(),
            Self::Richard => 0.5 * (delta_ki + delta_ki.hypot(2.0 * 1.155 * delta_kii)),
            Self::Bold => {
                let unit = MPA_SQRT_MM;
                Bold::equivalent(delta_ki / unit, delta_kii / unit) * unit
            }
        }
    }

    /// The formula as a line of text.
    #[must_use]
    pub fn formula(&self) -> String {
        match self {
            Self::HourlierPineau { mode_2_weight } => format!("dK^2 = dKI^2 + {mode_2_weight} dKII^2"),
            Self::Tanaka => "dK^4 = dKI^4 + 8 dKII^4".to_owned(),
            Self::Richard => "dK = dKI/2 + sqrt(dKI^2 + 4 (1.155 dKII)^2)/2".to_owned(),
            Self::Bold => "dK^2 = dKI^2 + [(614/507) dKII^3.21]^(2/3.74)".to_owned(),
        }
    }

    /// The name in case files.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::HourlierPineau { .. } => "hourlier-pineau",
            Self::Tanaka => "tanaka",
            Self::Richard => "richard",
            Self::Bold => "bold",
        }
    }
}
