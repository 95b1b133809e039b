//! The results of a study, gathered from its run folders.

use super::folder::StudyFolder;
use super::plan::PlannedRun;
use super::state::{RunState, StudyRow};
use crate::files::SUMMARY_FILE;
use crate::folder::read_json_if_there;
use crate::representative::RepresentativeTip;
use crate::{OutputError, RunFolder, Summary};

/// The results of a study: a row per run, in the order of the runs.
#[derive(Debug, Clone)]
pub struct StudyResults {
    /// The runs.
    pub rows: Vec<StudyRow>,
}

impl StudyFolder {
    /// The results as the run folders have them now.
    ///
    /// Errors: a file of a run is damaged; the system refuses.
    pub fn read_results(&self) -> Result<StudyResults, OutputError> {
        let rows: Result<_, _> = self.plan().runs.iter().map(|run| self.row(run)).collect();
        Ok(StudyResults { rows: rows? })
    }

    fn row(&self, run: &PlannedRun) -> Result<StudyRow, OutputError> {
        let folder = self.run_folder(run);
        // In this order: a run that ends in between counts as one that has not.
        let outcome = self.outcome(run)?;
        let summary: Option<Summary> = read_json_if_there(&folder, SUMMARY_FILE)?;
        let summary = summary.filter(|summary| summary.steps_recorded > 0);
        let steps = summary.as_ref().map_or(0, |summary| summary.steps_recorded);
        let representative =
            if steps > 0 { RepresentativeTip::of(&RunFolder::open(&folder)?)? } else { None };
        Ok(StudyRow { number: run.number, state: RunState::of(outcome, steps), summary, representative })
    }
}

impl StudyResults {
    pub(super) fn are_complete(&self) -> bool {
        self.rows.iter().all(|row| row.state.is_over())
    }

    /// Number of runs in a state.
    pub fn count(&self, is_in: impl Fn(&RunState) -> bool) -> usize {
        self.rows.iter().filter(|row| is_in(&row.state)).count()
    }
}
