//! Observers of a step that is being computed.

/// An observer of a step that is being computed, who may interrupt it.
pub trait Observer: Sync {
    /// The fraction (0 to 1) of the current passage that is done.
    fn progress(&self, fraction: f64);
    /// Whether to give up the current step now.
    fn interrupted(&self) -> bool;
}

/// No observer: the step is computed in silence and to its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Unobserved;

impl Observer for Unobserved {
    fn progress(&self, _: f64) {}

    fn interrupted(&self) -> bool {
        false
    }
}
