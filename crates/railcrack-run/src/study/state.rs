//! States of the runs of a study.

use crate::run_folder::RepresentativeTip;
use crate::summary::{Outcome, RunEnd, Summary};

/// State of a run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum RunState {
    /// It ended.
    Done,
    /// It failed, for a reason; what was computed before is kept.
    Failed {
        /// Why it could not go on.
        end: RunEnd,
        /// The reason, a sentence.
        reason: String,
    },
    /// It is being computed, or was interrupted.
    Unfinished,
    /// It has no step yet, here.
    Missing,
}

impl RunState {
    /// Its name in `summary.csv`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Done => "done",
            Self::Failed { end: RunEnd::CannotReadOrWrite, .. } => "cannot-read-or-write",
            Self::Failed { .. } => "not-converged",
            Self::Unfinished => "unfinished",
            Self::Missing => "missing",
        }
    }

    pub(super) fn cannot_read(reason: &str) -> Self {
        Self::Failed { end: RunEnd::CannotReadOrWrite, reason: reason.to_owned() }
    }

    pub(super) fn of(outcome: Option<Outcome>, steps_recorded: usize) -> Self {
        match outcome {
            Some(Outcome { end: RunEnd::Done, .. }) => Self::Done,
            Some(Outcome { end, reason, .. }) => Self::Failed { end, reason: reason.unwrap_or_default() },
            None if steps_recorded > 0 => Self::Unfinished,
            None => Self::Missing,
        }
    }

    /// Whether the run is over.
    pub(super) fn is_over(&self) -> bool {
        matches!(self, Self::Done | Self::Failed { .. })
    }
}

/// A run as listed in `summary.csv`.
#[derive(Debug, Clone)]
pub struct StudyRow {
    /// Number of the run, from 1.
    pub number: usize,
    /// Where it stands.
    pub state: RunState,
    /// The run in numbers; none before its first step.
    pub summary: Option<Summary>,
    /// The representative tip; none before the first step.
    pub representative: Option<RepresentativeTip>,
    /// The fault of its files, where they are damaged.
    pub damage: Option<String>,
}
