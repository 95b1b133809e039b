//! Growth laws: an equivalent range of two modes, and the rate under it.

use super::{EquivalentRange, Paris, RateLaw};
use crate::math::MPA_SQRT_MM;

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
        let (delta, ratio) = (delta_keq / MPA_SQRT_MM, range.ratio);
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
            _ if sheared > 1.0 => self.rate.rate(delta, ratio),
            _ => self.rate.rate(opening, ratio),
        }
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

#[cfg(test)]
#[path = "law_tests.rs"]
mod tests;
