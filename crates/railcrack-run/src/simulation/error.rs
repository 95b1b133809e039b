//! Errors of a run.

use crate::error::OutputError;
use crate::setup::CarriedStressError;
use railcrack::growth::GrowthError;
use railcrack::shakedown::ShakedownError;
use thiserror::Error;

/// Why a run failed. What was computed is kept.
#[derive(Debug, Error)]
pub enum RunError {
    /// The run folder.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The computation.
    #[error(transparent)]
    Growth(#[from] GrowthError),
    /// The plastic state.
    #[error(transparent)]
    Shakedown(#[from] ShakedownError),
    /// The residual stress.
    #[error(transparent)]
    Residual(#[from] CarriedStressError),
    /// The plastic stress that the first stage wrote cannot be read back.
    #[error("the plastic stress of the rolled rail: {0}")]
    Rolled(String),
    /// Grinding plans that cannot be made.
    #[error("{0}")]
    Plan(String),
    /// A rail without layers has no state.
    #[error("the rail has no layers to evaluate")]
    NoLayers,
    /// The system refuses threads or signal handlers.
    #[error("cannot {action}: {reason}")]
    System {
        /// The attempted action.
        action: String,
        /// The system's reason.
        reason: String,
    },
}

impl RunError {
    /// Whether the run was interrupted on request.
    #[must_use]
    pub fn is_interruption(&self) -> bool {
        matches!(
            self,
            Self::Growth(GrowthError::Interrupted { .. }) | Self::Shakedown(ShakedownError::Interrupted(_))
        )
    }
}
