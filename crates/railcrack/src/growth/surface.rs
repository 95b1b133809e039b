//! The running surface as wear and grinding leave it.

use crate::crack::CrackTip;
use serde::{Deserialize, Serialize};

/// The removal of the running surface so far.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct WornSurface {
    /// Removed from the cracks since the beginning, mm.
    pub removed: f64,
    /// How many times it was ground.
    pub grindings: usize,
    /// The longest that each crack has been, mm.
    pub longest: Vec<f64>,
    /// Rates at the start of the step before, with its cycles; none where the cracks were another
    /// ones then, before they were ground.
    pub before: Option<EarlierRates>,
}

/// Rates of tips at an earlier step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EarlierRates {
    /// The rate of each tip, mm per cycle.
    pub rates: Vec<(CrackTip, f64)>,
    /// Cycles from then to now.
    pub cycles: f64,
}

impl EarlierRates {
    /// The mean rate (mm per cycle) of `tip` over the next `cycles`, where it is `rate` at their
    /// start: the line through both rates, which makes the increment one of second order
    /// (Adams–Bashforth).
    pub(super) fn mean(&self, tip: CrackTip, rate: f64, cycles: f64) -> f64 {
        let same = |of: CrackTip| (of.crack, of.tip) == (tip.crack, tip.tip);
        let Some((_, before)) = self.rates.iter().find(|(of, _)| same(*of)) else { return rate };
        if self.cycles <= 0.0 {
            return rate;
        }
        (rate + 0.5 * (rate - before) * cycles / self.cycles).clamp(0.0, 2.0 * rate)
    }
}
