//! Interruption of a computation by whoever waits for it.

use thiserror::Error;

/// A question that long computations ask between their parts, some hundred times a second at most:
/// whether to give up. Once answered with yes, it is never answered with no again.
#[derive(Clone, Copy)]
pub struct Interruption<'a>(Option<&'a (dyn Fn() -> bool + Sync)>);

/// A computation that was given up on request.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("interrupted")]
pub struct Interrupted;

impl<'a> Interruption<'a> {
    /// Computes to the end.
    pub const NEVER: Self = Self(None);

    /// Gives up as soon as `asked` says so.
    pub fn when(asked: &'a (dyn Fn() -> bool + Sync)) -> Self {
        Self(Some(asked))
    }

    /// Whether to give up.
    pub(crate) fn asked(self) -> bool {
        self.0.is_some_and(|asked| asked())
    }

    /// Errors: to be given up.
    pub(crate) fn check(self) -> Result<(), Interrupted> {
        if self.asked() { Err(Interrupted) } else { Ok(()) }
    }
}
