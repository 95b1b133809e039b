//! The previous step, as the next one sees it.

use super::Mover;
use serde::{Deserialize, Serialize};

/// The previous step as the next one sees it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EarlierStep {
    /// The movers at its start.
    pub movers: Vec<Mover>,
    /// For each of them, its growth until the start of the step less all its increments up to the
    /// end of it, mm: negative by the growth of the step itself.
    pub balance: Vec<f64>,
    /// For each of them, its predicted growth during the step, mm.
    pub growth: Vec<f64>,
    /// Its cycles as they were predicted.
    pub cycles: f64,
    /// Where its cycles followed from an increment, the mover that made it and its growth, mm.
    pub leader: Option<(Mover, f64)>,
    /// Whether the prediction used the rates of two steps.
    pub is_extrapolated: bool,
    /// Whether the rates vary smoothly from its start to its end: not where a crack kinked at its
    /// start or where it was a grinding.
    pub is_smooth: bool,
}

impl EarlierStep {
    /// The predicted growth (mm) of `mover` during the step.
    pub(super) fn growth_of(&self, mover: &Mover) -> Option<f64> {
        self.movers.iter().position(|own| own.is(mover)).map(|i| self.growth[i])
    }
}
