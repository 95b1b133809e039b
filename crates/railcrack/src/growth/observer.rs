//! Observers of a step that is being computed.

/// An observer of a step that is being computed, which may interrupt it.
pub trait Observer: Sync {
    /// Receives the completed fraction (0 to 1) of the current passage.
    fn progress(&self, fraction: f64);
    /// Whether to abandon the current step now.
    fn interrupted(&self) -> bool;
}

/// No observer: the step runs to its end without reporting progress.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Unobserved;

impl Observer for Unobserved {
    fn progress(&self, _: f64) {}

    fn interrupted(&self) -> bool {
        false
    }
}
