//! A tip under one wheel, without its direction.

use crate::fatigue::{GrowthLaw, LargestK1, SifRanges};
use crate::fracture::SifHistory;
use crate::growth::WheelDemand;

/// A tip under the stabilised passage of a wheel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TipUnderWheel {
    pub ranges: SifRanges,
    pub largest_k1: Option<LargestK1>,
}

impl TipUnderWheel {
    /// The tip with `history`.
    pub fn of(history: &SifHistory) -> Self {
        Self { ranges: SifRanges::of(history), largest_k1: LargestK1::of(history) }
    }

    /// Its loading by `law`.
    pub fn demand(&self, law: &GrowthLaw) -> WheelDemand {
        let Self { ranges, largest_k1 } = *self;
        let load = ranges.load();
        WheelDemand { ranges, delta_keq: law.driven_by(load), rate: law.rate(load), largest_k1 }
    }

    /// The sum of `all` with these `weights`; what is not a number comes from that which is `near`.
    pub fn between(all: &[Self], weights: &[f64], near: usize) -> Self {
        let sum = |of: &dyn Fn(&Self) -> f64| -> f64 {
            all.iter().zip(weights).map(|(one, weight)| weight * of(one)).sum()
        };
        let ranges = SifRanges {
            ki_max: sum(&|one| one.ranges.ki_max),
            delta_ki: sum(&|one| one.ranges.delta_ki).max(0.0),
            delta_kii: sum(&|one| one.ranges.delta_kii).max(0.0),
        };
        let k1 = |one: &Self| one.largest_k1.map_or(0.0, |largest| largest.k1);
        let largest_k1 = all[near].largest_k1.map(|largest| LargestK1 { k1: sum(&k1).max(0.0), ..largest });
        Self { ranges, largest_k1 }
    }
}
