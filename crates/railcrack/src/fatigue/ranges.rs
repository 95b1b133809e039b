//! Ranges of the stress intensity factors of the actual tip.

use super::LoadRange;
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
}
