//! The results of a study, gathered from its run folders.

use super::folder::StudyFolder;
use super::plan::PlannedRun;
use super::state::{RunState, StudyRow};
use crate::files::SUMMARY_FILE;
use crate::representative::RepresentativeTip;
use crate::{OutputError, RunFolder};

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
        let there = folder.join(SUMMARY_FILE).is_file();
        let open = if there { Some(RunFolder::open(&folder)?) } else { None };
        let open = open.filter(|open| open.summary.steps_recorded > 0);
        let steps = open.as_ref().map_or(0, |open| open.summary.steps_recorded);
        let representative = open.as_ref().map(RepresentativeTip::of).transpose()?.flatten();
        let summary = open.map(|open| open.summary);
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
