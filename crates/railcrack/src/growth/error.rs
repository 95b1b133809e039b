//! Errors of a growth step.

use super::PassageError;
use crate::body::BodyError;
use crate::contact::CrackFrictionError;
use crate::crack::NetworkError;
use crate::math::OutOfRange;

/// Why a step could not be computed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GrowthError {
    /// Settings under which nothing can be computed.
    #[error(transparent)]
    Settings(#[from] OutOfRange),
    /// Crack-face friction that does not fit the cracks.
    #[error(transparent)]
    Friction(#[from] CrackFrictionError),
    /// The observer interrupted the step; the state before it is intact.
    #[error("interrupted at step {step}")]
    Interrupted {
        /// The step that was abandoned.
        step: usize,
    },
    /// The engine cannot represent the cracks.
    #[error("step {step}: {source}")]
    Body {
        /// The step.
        step: usize,
        /// The error of the engine.
        source: BodyError,
    },
    /// Contact did not converge.
    #[error("step {step}: {source}")]
    Passage {
        /// The step.
        step: usize,
        /// The position and the failure.
        source: PassageError,
    },
    /// A state with cracks in the plane given to a run in space, or vice versa.
    #[error("step {step}: the state contains cracks {found}, but the engine computes cracks {wanted}")]
    Geometry {
        /// The step.
        step: usize,
        /// The kind of cracks in the state.
        found: &'static str,
        /// The kind of cracks that the engine computes.
        wanted: &'static str,
    },
    /// The cracks have run into each other.
    #[error("step {step}: {source}")]
    Network {
        /// The step.
        step: usize,
        /// The cracks concerned.
        source: NetworkError,
    },
}

impl GrowthError {
    /// Whether the observer interrupted the step.
    #[must_use]
    pub fn is_interruption(&self) -> bool {
        matches!(self, Self::Interrupted { .. })
    }
}
