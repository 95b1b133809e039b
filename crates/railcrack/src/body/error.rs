//! Cracks that an engine cannot represent.

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
