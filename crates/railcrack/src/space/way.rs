//! The way of a crack in space from one step to the next.

use crate::growth::{FrontInterval, FrontShape, RunStop};

/// The way from one step to the next.
pub(super) struct Way {
    /// The shape of the next step.
    pub shape: FrontShape,
    pub interval: Option<FrontInterval>,
    /// Cycles by the speeds at the start of the step: what the front is grown by.
    pub cycles: f64,
    pub stop: Option<RunStop>,
}
