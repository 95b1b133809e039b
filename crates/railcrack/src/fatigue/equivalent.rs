//! Equivalent SIF ranges of mixed modes.

use crate::math::MPA_SQRT_MM;
use crate::words::{Choice, Word};

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
    /// The equivalent range in the law of Bold, Brown and Allen ([`Bold`](super::Bold)).
    Bold,
}

impl EquivalentRange {
    /// The weight of Trollé et al. 2014, eq. 31.
    pub const RAIL_STEEL: Self = Self::HourlierPineau { mode_2_weight: 0.772 };

    /// ΔK_eq of the ranges `delta_ki` and `delta_kii`; all MPa √mm.
    #[must_use]
    pub(crate) fn of(&self, delta_ki: f64, delta_kii: f64) -> f64 {
        match *self {
            Self::HourlierPineau { mode_2_weight } => {
                (delta_ki * delta_ki + mode_2_weight * delta_kii * delta_kii).sqrt()
            }
            Self::Tanaka => (delta_ki.powi(4) + 8.0 * delta_kii.powi(4)).sqrt().sqrt(),
            Self::Richard => 0.5 * (delta_ki + delta_ki.hypot(2.0 * 1.155 * delta_kii)),
            Self::Bold => {
                let unit = MPA_SQRT_MM;
                bold_range(delta_ki / unit, delta_kii / unit) * unit
            }
        }
    }

    /// ΔK_eq with ΔK_III = `delta_kiii` of a front in space; all MPa √mm.
    ///
    /// * Hourlier & Pineau: √(ΔK_I² + w ΔK_II² + w₃ ΔK_III²); without `mode_3_weight` w₃ =
    ///   w/(1 − ν), with which modes II and III count by their energy release rates.
    /// * Tanaka 1974: (ΔK_I⁴ + 8 ΔK_II⁴ + 8 ΔK_III⁴/(1 − ν))^¼.
    /// * Richard, Fulland & Sander 2005: ΔK_I/2 + ½ √(ΔK_I² + 4 (1.155 ΔK_II)² + 4 ΔK_III²).
    /// * Bold, Brown & Allen do not include mode III: the range of ΔK_I and ΔK_II.
    #[must_use]
    pub(crate) fn of_three(
        &self,
        [delta_ki, delta_kii, delta_kiii]: [f64; 3],
        poisson: f64,
        mode_3_weight: Option<f64>,
    ) -> f64 {
        match *self {
            Self::HourlierPineau { mode_2_weight } => {
                let weight = mode_3_weight.unwrap_or(mode_2_weight / (1.0 - poisson));
                self.of(delta_ki, delta_kii).hypot(weight.sqrt() * delta_kiii)
            }
            Self::Tanaka => {
                let plane = delta_ki.powi(4) + 8.0 * delta_kii.powi(4);
                (plane + 8.0 * delta_kiii.powi(4) / (1.0 - poisson)).sqrt().sqrt()
            }
            Self::Richard => {
                0.5 * (delta_ki + delta_ki.hypot(2.0 * 1.155 * delta_kii).hypot(2.0 * delta_kiii))
            }
            Self::Bold => self.of(delta_ki, delta_kii),
        }
    }

    /// The form that gives it, and its weight of mode II where it has one; none where the range
    /// belongs to a law.
    #[must_use]
    pub fn form(&self) -> Option<(RangeForm, Option<f64>)> {
        match *self {
            Self::HourlierPineau { mode_2_weight } => Some((RangeForm::HourlierPineau, Some(mode_2_weight))),
            Self::Tanaka => Some((RangeForm::Tanaka, None)),
            Self::Richard => Some((RangeForm::Richard, None)),
            Self::Bold => None,
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
}

/// ΔK_eq (MPa√m) of Bold, Brown and Allen for `delta_ki` and `delta_kii` (MPa√m): above the
/// threshold, the mode II term gives the same rate as 6.14e-10 ΔK_II^3.21.
pub(super) fn bold_range(delta_ki: f64, delta_kii: f64) -> f64 {
    let shear = (614.0 / 507.0 * delta_kii.powf(3.21)).powf(3.74f64.recip());
    delta_ki.hypot(shear)
}

/// The equivalent ranges that may be chosen for a law that has none of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RangeForm {
    /// [`EquivalentRange::HourlierPineau`].
    HourlierPineau,
    /// [`EquivalentRange::Tanaka`].
    Tanaka,
    /// [`EquivalentRange::Richard`].
    Richard,
}

impl Choice for RangeForm {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::HourlierPineau, Word::now("hourlier-pineau", "sqrt(dKI^2 + w dKII^2)")),
        (Self::Tanaka, Word::now("tanaka", "(dKI^4 + 8 dKII^4)^(1/4)")),
        (Self::Richard, Word::now("richard", "dKI/2 + sqrt(dKI^2 + 4 (1.155 dKII)^2)/2")),
    ];
}

impl RangeForm {
    /// The range, with the weight of mode II where it has one; none where the weight is missing.
    #[must_use]
    pub fn range(self, mode_2_weight: Option<f64>) -> Option<EquivalentRange> {
        Some(match self {
            Self::HourlierPineau => EquivalentRange::HourlierPineau { mode_2_weight: mode_2_weight? },
            Self::Tanaka => EquivalentRange::Tanaka,
            Self::Richard => EquivalentRange::Richard,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mode_three_counts_by_its_energy_and_vanishes_with_it() {
        let laws = [EquivalentRange::RAIL_STEEL, EquivalentRange::Tanaka, EquivalentRange::Richard];
        for law in laws {
            assert!((law.of_three([9.0, 12.0, 0.0], 0.3, None) - law.of(9.0, 12.0)).abs() < 1e-12);
        }
        // 0.772/0.7 · 5², as for ΔK_II = 5 √0.7⁻¹.
        let by_energy = EquivalentRange::RAIL_STEEL;
        let other = by_energy.of(0.0, 5.0 / 0.7f64.sqrt());
        assert!((by_energy.of_three([0.0, 0.0, 5.0], 0.3, None) - other).abs() < 1e-12);
        assert!((by_energy.of_three([3.0, 0.0, 4.0], 0.3, Some(1.0)) - 5.0).abs() < 1e-12);
        // Richard, Fulland & Sander 2005: α₂ = 1. Pure mode III: ΔK_eq = ΔK_III.
        assert!((EquivalentRange::Richard.of_three([0.0, 0.0, 5.0], 0.3, None) - 5.0).abs() < 1e-12);
        for range in [EquivalentRange::RAIL_STEEL, EquivalentRange::Tanaka, EquivalentRange::Richard] {
            let (form, weight) = range.form().unwrap();
            assert_eq!(form.range(weight), Some(range));
        }
        // Tanaka 1974: (8/0.7)^¼ = 1.838.
        let tanaka = EquivalentRange::Tanaka.of_three([0.0, 0.0, 5.0], 0.3, None);
        assert!((tanaka - 5.0 * (8.0f64 / 0.7).powf(0.25)).abs() < 1e-12);
    }
}
