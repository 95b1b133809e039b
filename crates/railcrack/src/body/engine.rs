//! Engines: methods of computing the cracked body of given cracks.

use super::{BodyError, CrackedBody};
use crate::crack::CrackNetwork;
use crate::interruption::Interruption;

/// A method of computing cracked bodies.
pub trait BodyEngine {
    /// The body with `network` of cracks.
    ///
    /// Errors: cracks that the engine cannot represent.
    fn body(&mut self, network: &CrackNetwork) -> Result<CrackedBody, BodyError> {
        self.body_unless(Interruption::NEVER, network)
    }

    /// The body with `network` of cracks, given up within a second of an `interruption`. An engine
    /// may reuse results of earlier calls, provided that the body has the same bits without them.
    ///
    /// Errors: cracks that the engine cannot represent; an interruption
    /// ([`BodyError::is_interruption`]).
    fn body_unless(
        &mut self,
        interruption: Interruption<'_>,
        network: &CrackNetwork,
    ) -> Result<CrackedBody, BodyError>;

    /// The body with A in blocks, for networks whose full matrices are too large; none where the
    /// engine does not support such bodies.
    ///
    /// Errors: as [`BodyEngine::body_unless`].
    fn body_by_groups(
        &mut self,
        _interruption: Interruption<'_>,
        _network: &CrackNetwork,
    ) -> Result<Option<CrackedBody>, BodyError> {
        Ok(None)
    }

    /// Frees the memory that the engine keeps for its next call, once the last body has been made.
    fn forget(&mut self) {}
    /// The smallest distance (mm) between a tip and the surface or another crack that is still
    /// resolved.
    fn resolution(&self, network: &CrackNetwork) -> f64;
}
