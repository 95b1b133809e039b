//! Interruption of computations on request.

use thiserror::Error;

/// A check that long computations make between their parts, at most some hundred times a second,
/// whether to stop. Once true, the answer remains true.
#[derive(Clone, Copy)]
pub struct Interruption<'a>(Option<&'a (dyn Fn() -> bool + Sync)>);

/// A computation that was stopped on request.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("interrupted")]
pub struct Interrupted;

impl<'a> Interruption<'a> {
    /// Never stops the computation.
    pub const NEVER: Self = Self(None);

    /// Stops as soon as `asked` returns true.
    pub fn when(asked: &'a (dyn Fn() -> bool + Sync)) -> Self {
        Self(Some(asked))
    }

    /// Whether to stop.
    pub(crate) fn asked(self) -> bool {
        self.0.is_some_and(|asked| asked())
    }

    /// Errors: a request to stop.
    pub(crate) fn check(self) -> Result<(), Interrupted> {
        if self.asked() { Err(Interrupted) } else { Ok(()) }
    }
}
