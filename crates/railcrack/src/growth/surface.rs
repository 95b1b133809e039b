//! The running surface under wear and grinding.

use super::Mover;
use serde::{Deserialize, Serialize};

/// The removal of the running surface so far.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct WornSurface {
    /// Depth removed since the beginning, mm.
    pub removed: f64,
    /// Number of grindings so far.
    pub grindings: usize,
    /// The greatest length that each crack has had, mm.
    pub longest: Vec<f64>,
    /// Rates at the start of the previous step, with its cycles; `None` where the surface was
    /// ground after it, since grinding changes the rates abruptly.
    pub before: Option<EarlierRates>,
}

impl WornSurface {
    /// The greatest length (mm) that crack `crack` (from 0), now `length` (mm) long, has had.
    pub(crate) fn longest_of(&self, crack: usize, length: f64) -> f64 {
        self.longest.get(crack).copied().unwrap_or(0.0).max(length)
    }
}

/// Rates in an earlier step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EarlierRates {
    /// The movers of that step.
    pub movers: Vec<Mover>,
    /// Cycles from then to now.
    pub cycles: f64,
}

impl EarlierRates {
    /// The mean rate (mm per cycle) of `mover` over the next `cycles`: linear extrapolation from
    /// its rates then and now, which makes the increment second-order accurate (Adams–Bashforth).
    pub(super) fn mean(&self, mover: &Mover, cycles: f64) -> f64 {
        let rate = mover.rate;
        let Some(before) = self.movers.iter().find(|before| before.is(mover)) else { return rate };
        if self.cycles <= 0.0 {
            return rate;
        }
        (rate + 0.5 * (rate - before.rate) * cycles / self.cycles).clamp(0.0, 2.0 * rate)
    }
}
