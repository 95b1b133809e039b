//! What turns cracks into a body.

use super::CrackedBody;
use crate::crack::CrackNetwork;
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

/// A method of computing cracked bodies.
pub trait BodyEngine {
    /// The body with `network` of cracks. An engine may keep what it computed for the next call, but only so that the results are
    /// the same bits without.
    fn body(&mut self, network: &CrackNetwork) -> Result<CrackedBody, BodyError>;
    /// Forgets what it keeps for the next call alone: where the last body is made, its memory serves what is done with it.
    fn forget(&mut self) {}
    /// The smallest distance (mm) between a tip and the surface or another crack that is still resolved.
    fn resolution(&self, network: &CrackNetwork) -> f64;
}
