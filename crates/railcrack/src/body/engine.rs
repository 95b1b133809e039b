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
    /// may keep what it computed for the next call, but only so that the results are the same bits
    /// without.
    ///
    /// Errors: cracks that the engine cannot represent; an interruption
    /// ([`BodyError::is_interruption`]).
    fn body_unless(
        &mut self,
        interruption: Interruption<'_>,
        network: &CrackNetwork,
    ) -> Result<CrackedBody, BodyError>;

    /// The body with A by groups of neighbouring cracks, for networks whose matrices are too large;
    /// none where the engine does not make such bodies.
    ///
    /// Errors: as [`BodyEngine::body_unless`].
    fn body_by_groups(
        &mut self,
        _interruption: Interruption<'_>,
        _network: &CrackNetwork,
    ) -> Result<Option<CrackedBody>, BodyError> {
        Ok(None)
    }

    /// Forgets what it keeps for the next call alone: where the last body is made, its memory
    /// serves what is done with it.
    fn forget(&mut self) {}
    /// The smallest distance (mm) between a tip and the surface or another crack that is still
    /// resolved.
    fn resolution(&self, network: &CrackNetwork) -> f64;
}
