//! Paris' law and the criteria of direction.

use crate::math::MPA_SQRT_MM;
use crate::words::{Choice, Word};
use std::ops::RangeInclusive;

/// Paris' law da/dN = C ΔK_eq^m with ΔK_eq² = ΔK_I² + w ΔK_II² (Trollé et al. 2014, eqs 30 and 31).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ParisLaw {
    /// C, mm per cycle with ΔK_eq in MPa√m.
    pub c: f64,
    /// m.
    pub m: f64,
    /// w, weight of mode II.
    pub mode_2_weight: f64,
    /// Threshold ΔK_eq (MPa√m), at or below which no crack grows.
    pub threshold: f64,
}

/// [`ParisLaw::RAIL_STEEL`].
impl Default for ParisLaw {
    fn default() -> Self {
        Self::RAIL_STEEL
    }
}

impl ParisLaw {
    /// Rail steel as in Trollé et al. 2014, eqs 30 and 31, read in mm per cycle.
    pub const RAIL_STEEL: Self = Self { c: 2e-9, m: 3.33, mode_2_weight: 0.772, threshold: 0.0 };

    /// ΔK_eq = √(ΔK_I² + w ΔK_II²) of the ranges `delta_ki` and `delta_kii`, in their unit
    /// (eq. 31).
    #[must_use]
    pub fn equivalent_range(&self, delta_ki: f64, delta_kii: f64) -> f64 {
        (delta_ki * delta_ki + self.mode_2_weight * delta_kii * delta_kii).sqrt()
    }

    /// da/dN in mm per cycle for the ranges `delta_ki` and `delta_kii` in MPa √mm (eq. 30); zero at
    /// or below the threshold.
    #[must_use]
    pub fn rate(&self, delta_ki: f64, delta_kii: f64) -> f64 {
        let range = self.equivalent_range(delta_ki, delta_kii) / MPA_SQRT_MM;
        if range > self.threshold { self.c * range.powf(self.m) } else { 0.0 }
    }
}

/// The quantity that the direction of growth maximises over the kink angle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DirectionCriterion {
    /// The growth rate of the virtual kink, from the ranges of k1 and k2 (Hourlier & Pineau).
    #[default]
    MaxRate,
    /// The same with negative k1 counted as if a closed kink opened negatively: for comparison,
    /// since not every description of the criterion says that k1 is clipped.
    MaxRateUnclipped,
    /// The range of k1.
    MaxDeltaK1,
    /// The largest k1.
    MaxK1,
}

impl Choice for DirectionCriterion {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::MaxRate, Word::now("max-rate", "the largest growth rate of the kink (Hourlier-Pineau)")),
        (
            Self::MaxRateUnclipped,
            Word::now("max-rate-unclipped", "the same, with negative k1 kept where max-rate takes zero"),
        ),
        (Self::MaxDeltaK1, Word::now("max-delta-k1", "the largest range of k1")),
        (Self::MaxK1, Word::now("max-k1", "the largest k1")),
    ];
}

/// Range of kink angles that is searched, radians: the kink functions are accurate to about ±110°.
pub const KINK_ANGLES: RangeInclusive<f64> =
    -110.0 * std::f64::consts::PI / 180.0..=110.0 * std::f64::consts::PI / 180.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rate_of_ten_mpa_sqrt_m() {
        // 2e-9 · 10^3.33 mm per cycle; the law takes MPa √mm.
        let ten = 10.0 * 1000_f64.sqrt();
        let want = 2e-9 * 10_f64.powf(3.33);
        let law = ParisLaw::RAIL_STEEL;
        assert!((law.rate(ten, 0.0) / want - 1.0).abs() < 1e-14); // round-off
        assert!((law.rate(0.0, ten / 0.772_f64.sqrt()) / want - 1.0).abs() < 1e-14);
        assert_eq!(law.equivalent_range(3.0, 0.0), 3.0);
    }

    #[test]
    fn nothing_grows_at_or_below_the_threshold() {
        let law = ParisLaw { threshold: 4.0, ..ParisLaw::RAIL_STEEL };
        let unit = MPA_SQRT_MM;
        assert_eq!(law.rate(4.0 * unit, 0.0), 0.0);
        assert!(law.rate(4.001 * unit, 0.0) > 0.0);
        assert_eq!(ParisLaw::RAIL_STEEL.rate(0.0, 0.0), 0.0);
    }
}
