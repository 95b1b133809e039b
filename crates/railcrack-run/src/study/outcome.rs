//! How a run of a study ended, in its run folder.

use crate::disk::files::{CHECKPOINT_FILE, OUTCOME_FILE, RUN_LOG_FILE, SUMMARY_FILE};
use crate::disk::{Durability, read_json, read_json_if_there, remove, write_json};
use crate::error::OutputError;
use crate::run_folder::case_checksums;
use crate::summary::{Outcome, RunEnd, Summary};
use std::path::Path;

impl Outcome {
    /// The outcome of the run in `folder`; none while it is not over.
    pub(super) fn read(folder: &Path) -> Result<Option<Self>, OutputError> {
        if let Some(failed) = read_json_if_there(folder, OUTCOME_FILE)? {
            return Ok(Some(failed));
        }
        let summary: Option<Summary> = read_json_if_there(folder, SUMMARY_FILE)?;
        Ok(summary.and_then(|summary| summary.outcome))
    }

    /// A run that failed has it in a file of its own, whatever else is there; one that is done in
    /// its summary, with which it is complete: it is never resumed from its checkpoint.
    pub(super) fn write(&self, folder: &Path) -> Result<(), OutputError> {
        if self.end != RunEnd::Done {
            return write_json(folder, OUTCOME_FILE, self, Durability::Synced);
        }
        let mut summary: Summary = read_json(folder, SUMMARY_FILE)?;
        summary.checksums.extend(case_checksums(folder)?);
        summary.outcome = Some(self.clone());
        write_json(folder, SUMMARY_FILE, &summary, Durability::Synced)?;
        Self::tidy(folder)
    }

    /// Removes the files that only a resumed run needs from the folder of a finished run.
    pub(super) fn tidy(folder: &Path) -> Result<(), OutputError> {
        [CHECKPOINT_FILE, RUN_LOG_FILE].iter().try_for_each(|file| remove(&folder.join(file)))
    }
}
