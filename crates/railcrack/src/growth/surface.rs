//! The running surface as wear and grinding leave it.

use super::Mover;
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
    /// Rates at the start of the step before, with its cycles; none where the surface was ground
    /// after it, since rates change abruptly then.
    pub before: Option<EarlierRates>,
}

impl WornSurface {
    /// The longest (mm) that crack `crack` (from 0), now of `length` (mm), has been.
    #[must_use]
    pub fn longest_of(&self, crack: usize, length: f64) -> f64 {
        self.longest.get(crack).copied().unwrap_or(0.0).max(length)
    }
}

/// Rates at an earlier step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EarlierRates {
    /// The movers of that step.
    pub movers: Vec<Mover>,
    /// Cycles from then to now.
    pub cycles: f64,
}

impl EarlierRates {
    /// The mean rate (mm per cycle) of `mover` over the next `cycles`: the line through its rates
    /// then and now, which makes the increment one of second order (Adams–Bashforth).
    pub(super) fn mean(&self, mover: &Mover, cycles: f64) -> f64 {
        let rate = mover.rate;
        let Some(before) = self.movers.iter().find(|before| before.is(mover)) else { return rate };
        if self.cycles <= 0.0 {
            return rate;
        }
        (rate + 0.5 * (rate - before.rate) * cycles / self.cycles).clamp(0.0, 2.0 * rate)
    }
}
