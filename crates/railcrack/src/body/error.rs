//! Cracks that an engine cannot represent.

use crate::interruption::Interrupted;
use std::error::Error;
use thiserror::Error;

/// Cracks that an engine cannot represent, with the engine's reason.
#[derive(Debug, Error)]
#[error("{reason}")]
pub struct BodyError {
    /// The engine's own error.
    #[source]
    pub reason: Box<dyn Error + Send + Sync>,
}

impl BodyError {
    /// Whether the body was given up on request.
    #[must_use]
    pub fn is_interruption(&self) -> bool {
        let mut next: Option<&(dyn Error + 'static)> = Some(self.reason.as_ref());
        while let Some(error) = next {
            if error.is::<Interrupted>() {
                return true;
            }
            next = error.source();
        }
        false
    }
}
