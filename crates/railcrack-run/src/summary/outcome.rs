//! How a run of a study ended.

use crate::disk::VERSION;
use serde::{Deserialize, Serialize};

/// How a run of a study ended. Written last of all files of the run.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Outcome {
    /// Version of the program.
    pub version: String,
    /// How it ended.
    pub end: RunEnd,
    /// Why it failed, where it did.
    pub reason: Option<String>,
}

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RunEnd {
    /// All steps, or a physical stop.
    Done,
    /// A step could not be computed, and never will be by this version.
    NotConverged,
    /// The system refused to read or write.
    CannotReadOrWrite,
}

impl Outcome {
    /// A run that ended.
    pub fn done() -> Self {
        Self { version: VERSION.into(), end: RunEnd::Done, reason: None }
    }

    /// A run that failed for `reason`.
    pub fn failed(end: RunEnd, reason: &str) -> Self {
        Self { version: VERSION.into(), end, reason: Some(reason.into()) }
    }

    /// Whether to compute the run again would lead to the same: it is done, or this version cannot
    /// do it.
    pub fn is_settled(&self) -> bool {
        match self.end {
            RunEnd::Done => true,
            RunEnd::NotConverged => self.version == VERSION,
            RunEnd::CannotReadOrWrite => false,
        }
    }
}
