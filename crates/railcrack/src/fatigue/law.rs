//! Growth laws, with the ranges of the stress intensity factors of which they are functions.

use super::{Paris, RateLaw};
use crate::fracture::SifHistory;
use crate::math::MPA_SQRT_MM;
use crate::words::{Choice, Word};

/// Growth rate of a crack in mixed mode: da/dN of ΔK_eq(ΔK_I, ΔK_II) and, where the law wants it,
/// the ratio R.
#[derive(Debug, Clone, PartialEq)]
pub struct GrowthLaw {
    /// The rate under an equivalent range.
    pub rate: RateLaw,
    /// The equivalent range.
    pub equivalent: EquivalentRange,
    /// Threshold of ΔK_II, MPa√m; 0 for none of its own.
    pub threshold_2: f64,
}

/// [`GrowthLaw::RAIL_STEEL`].
impl Default for GrowthLaw {
    fn default() -> Self {
        Self::RAIL_STEEL
    }
}

/// Ranges of a passage, of the actual tip or of a virtual kink.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LoadRange {
    /// ΔK_I, K_I clipped at zero, MPa √mm.
    pub delta_ki: f64,
    /// ΔK_II, MPa √mm.
    pub delta_kii: f64,
    /// R, the smallest over the largest K_I, both clipped at zero; 0 for a tip that never opens.
    pub ratio: f64,
}

impl LoadRange {
    /// Of `delta_ki` and `delta_kii` (MPa √mm), with R = 1 − ΔK_I/K_I,max.
    #[must_use]
    pub fn new(delta_ki: f64, delta_kii: f64, ki_max: f64) -> Self {
        let ratio = if ki_max > 0.0 { 1.0 - delta_ki / ki_max } else { 0.0 };
        Self { delta_ki, delta_kii, ratio }
    }
}

impl GrowthLaw {
    /// Paris' law of rail steel as in Trollé et al. 2014, eqs 30 and 31, read in mm per cycle.
    pub const RAIL_STEEL: Self = Self {
        rate: RateLaw::Paris(Paris::RAIL_STEEL),
        equivalent: EquivalentRange::RAIL_STEEL,
        threshold_2: 0.0,
    };

    /// ΔK_eq of the ranges `delta_ki` and `delta_kii`, all MPa √mm.
    #[must_use]
    pub fn equivalent_range(&self, delta_ki: f64, delta_kii: f64) -> f64 {
        self.equivalent.of(delta_ki, delta_kii)
    }

    /// da/dN in mm per cycle under `range`: zero where nothing grows, infinite where the crack runs
    /// away.
    #[must_use]
    pub fn rate(&self, range: LoadRange) -> f64 {
        self.rate_of(self.equivalent_range(range.delta_ki, range.delta_kii), range)
    }

    /// da/dN in mm per cycle under the equivalent range `delta_keq` (MPa √mm) of `range`, whose
    /// ΔK_II is that of all shear: in space √(ΔK_II² + ΔK_III²).
    ///
    /// Without a threshold of ΔK_II, that of the law is compared with ΔK_eq. With both, a crack
    /// grows outside the ellipse
    ///
    /// > (ΔK_I/ΔK_th)² + (ΔK_II/ΔK_II,th)² = 1,
    ///
    /// and the threshold in the law is the ΔK_eq on the ellipse in the same mix of modes. For the
    /// range of Hourlier and Pineau, whose threshold is such an ellipse with ΔK_II,th = ΔK_th/√w,
    /// only the axis of mode II changes. Without a threshold of the law, shear at or below its
    /// threshold adds nothing to ΔK_I.
    #[must_use]
    pub(crate) fn rate_of(&self, delta_keq: f64, range: LoadRange) -> f64 {
        let (delta, ratio) = (self.driving_range(delta_keq, range) / MPA_SQRT_MM, range.ratio);
        if self.threshold_2 <= 0.0 {
            return self.rate.rate(delta, ratio);
        }
        let (opening, shear) = (range.delta_ki / MPA_SQRT_MM, range.delta_kii / MPA_SQRT_MM);
        let sheared = shear / self.threshold_2;
        match self.rate.threshold() {
            Some(threshold) if threshold > 0.0 => {
                let exceeded = (opening / threshold).hypot(sheared);
                if exceeded > 1.0 {
                    self.rate.with_threshold(delta / exceeded).rate(delta, ratio)
                } else {
                    0.0
                }
            }
            _ => self.rate.rate(delta, ratio),
        }
    }

    /// The equivalent range (MPa √mm) of which the rate under `range` is a function: `delta_keq`,
    /// that of all its modes, or ΔK_I where the shear adds nothing.
    #[must_use]
    pub(crate) fn driving_range(&self, delta_keq: f64, range: LoadRange) -> f64 {
        let has_threshold = self.rate.threshold().is_some_and(|threshold| threshold > 0.0);
        let counts = range.delta_kii / MPA_SQRT_MM > self.threshold_2;
        if self.threshold_2 <= 0.0 || has_threshold || counts { delta_keq } else { range.delta_ki }
    }

    /// [`GrowthLaw::driving_range`] of the ranges of two modes.
    #[must_use]
    pub(crate) fn driven_by(&self, range: LoadRange) -> f64 {
        self.driving_range(self.equivalent_range(range.delta_ki, range.delta_kii), range)
    }

    /// The condition that `threshold_2` sets, as a line of text; none without it.
    #[must_use]
    pub fn shear_threshold(&self) -> Option<String> {
        let shear = self.threshold_2;
        match self.rate.threshold() {
            _ if shear <= 0.0 => None,
            Some(threshold) if threshold > 0.0 => {
                Some(format!("growth where (dKI/{threshold})^2 + (dKII/{shear})^2 > 1"))
            }
            _ => Some(format!("dKII counts above {shear}")),
        }
    }

    /// A quantity that grows with the rate and that no threshold flattens: ΔK_eq (MPa √mm) for laws
    /// without a ratio.
    pub(super) fn drive(&self, range: LoadRange) -> f64 {
        let delta = self.equivalent_range(range.delta_ki, range.delta_kii);
        // The law is in MPa√m; a range that drives by itself keeps its unit and its bits.
        self.rate.drive(delta / MPA_SQRT_MM, range.ratio).unwrap_or(delta)
    }
}

/// SIF ranges of the actual tip over one passage, MPa √mm.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SifRanges {
    /// Largest K_I.
    pub ki_max: f64,
    /// ΔK_I, K_I clipped at zero: a closed crack does not open negatively.
    pub delta_ki: f64,
    /// ΔK_II.
    pub delta_kii: f64,
}

impl SifRanges {
    /// The ranges over all samples of `history`; zero for an empty one.
    #[must_use]
    pub fn of(history: &SifHistory) -> Self {
        let Some(first) = history.samples.first() else { return Self::default() };
        let (mut low, mut high) = (*first, *first);
        for k in &history.samples {
            (low.ki, high.ki) = (low.ki.min(k.ki), high.ki.max(k.ki));
            (low.kii, high.kii) = (low.kii.min(k.kii), high.kii.max(k.kii));
        }
        Self { ki_max: high.ki, delta_ki: high.ki.max(0.0) - low.ki.max(0.0), delta_kii: high.kii - low.kii }
    }

    /// The load range of a growth law, with the ratio R of K_I.
    #[must_use]
    pub(crate) fn load(&self) -> LoadRange {
        LoadRange::new(self.delta_ki, self.delta_kii, self.ki_max)
    }
}

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
    use crate::fracture::Sif;

    #[test]
    fn mode_one_is_clipped_and_mode_two_is_not() {
        let samples = vec![Sif { ki: -3.0, kii: -5.0 }, Sif { ki: 4.0, kii: 1.0 }, Sif { ki: 1.0, kii: 2.0 }];
        let ranges = SifRanges::of(&SifHistory { samples });
        assert_eq!(ranges, SifRanges { ki_max: 4.0, delta_ki: 4.0, delta_kii: 7.0 });
        assert_eq!(SifRanges::of(&SifHistory::default()), SifRanges::default());
    }

    #[test]
    fn a_crack_that_never_closes_keeps_its_smaller_range() {
        let samples = vec![Sif { ki: 2.0, kii: 0.0 }, Sif { ki: 5.0, kii: 0.0 }];
        assert_eq!(SifRanges::of(&SifHistory { samples }).delta_ki, 3.0);
    }

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

#[cfg(test)]
#[path = "law_tests.rs"]
mod law_tests;
