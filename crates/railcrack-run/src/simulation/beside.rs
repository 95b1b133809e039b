//! The run to which companions belong.

use super::observer::RunObserver;
use railcrack::growth::GrowthState;
use std::path::Path;

/// The run to which companions belong.
pub(super) struct Beside<'a> {
    /// Its state after its last step.
    pub state: &'a GrowthState,
    /// Holds the plastic state of a rolled rail.
    pub folder: &'a Path,
    pub observer: &'a dyn RunObserver,
}
