//! Ranges of the stress intensity factors of the actual tip.

use crate::fracture::SifHistory;

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
    pub fn of(history: &SifHistory) -> Self {
        let Some(first) = history.samples.first() else { return Self::default() };
        let (mut low, mut high) = (*first, *first);
        for k in &history.samples {
            (low.k1, high.k1) = (low.k1.min(k.k1), high.k1.max(k.k1));
            (low.k2, high.k2) = (low.k2.min(k.k2), high.k2.max(k.k2));
        }
        Self { ki_max: high.k1, delta_ki: high.k1.max(0.0) - low.k1.max(0.0), delta_kii: high.k2 - low.k2 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fracture::Sif;

    #[test]
    fn mode_one_is_clipped_and_mode_two_is_not() {
        let samples = vec![Sif { k1: -3.0, k2: -5.0 }, Sif { k1: 4.0, k2: 1.0 }, Sif { k1: 1.0, k2: 2.0 }];
        let ranges = SifRanges::of(&SifHistory { samples });
        assert_eq!(ranges, SifRanges { ki_max: 4.0, delta_ki: 4.0, delta_kii: 7.0 });
        assert_eq!(SifRanges::of(&SifHistory::default()), SifRanges::default());
    }

    #[test]
    fn a_crack_that_never_closes_keeps_its_smaller_range() {
        let samples = vec![Sif { k1: 2.0, k2: 0.0 }, Sif { k1: 5.0, k2: 0.0 }];
        assert_eq!(SifRanges::of(&SifHistory { samples }).delta_ki, 3.0);
    }
}
