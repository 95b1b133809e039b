//! The results of a study, gathered from its run folders.

use super::folder::StudyFolder;
use super::packed::PackedRuns;
use super::plan::PlannedRun;
use super::population::Population;
use super::state::{RunState, StudyRow};
use crate::disk::files::SUMMARY_FILE;
use crate::error::OutputError;
use crate::run_folder::{RepresentativeTip, RunFolder, check_numbers};
use crate::summary::RunEnd;
use std::io::ErrorKind;

/// The results of a study: a row per run, in the order of the runs.
#[derive(Debug, Clone)]
pub struct StudyResults {
    /// The runs.
    pub rows: Vec<StudyRow>,
    /// Samples between the runs, for each choice of the keys that are not drawn; empty until they
    /// are made.
    pub population: Vec<Population>,
}

impl StudyFolder {
    /// The results as the run folders have them now.
    ///
    /// Errors: a file of a run is damaged; the system refuses.
    pub fn read_results(&self) -> Result<StudyResults, OutputError> {
        let packed = self.packed()?;
        let rows: Result<_, _> = self.plan().runs.iter().map(|run| self.row(run, &packed)).collect();
        Ok(StudyResults { rows: rows?, population: Vec::new() })
    }

    /// A damaged run is one that has failed: nothing of its numbers goes into the results.
    fn row(&self, run: &PlannedRun, packed: &PackedRuns) -> Result<StudyRow, OutputError> {
        match self.whole_row(run, packed) {
            Err(error @ (OutputError::Damaged { .. } | OutputError::Field(_))) => {
                let reason = error.to_string();
                let state = RunState::Failed { end: RunEnd::CannotReadOrWrite, reason: reason.clone() };
                let (number, damage) = (run.number, Some(reason));
                Ok(StudyRow { number, state, summary: None, representative: None, damage })
            }
            // Another process has packed the run since.
            Err(error) if !self.plan().run_folders && is_gone(&error) => {
                let packed = self.packed()?;
                if packed.has(run.number) { self.whole_row(run, &packed) } else { Err(error) }
            }
            row => row,
        }
    }

    fn whole_row(&self, run: &PlannedRun, packed: &PackedRuns) -> Result<StudyRow, OutputError> {
        let folder = self.run_folder(run);
        if packed.has(run.number) {
            let open = self.run_in(run, packed)?;
            let representative = RepresentativeTip::of(&open)?;
            let state = RunState::of(open.summary.outcome.clone(), open.summary.steps_recorded);
            let summary = Some(open.summary);
            return Ok(StudyRow { number: run.number, state, summary, representative, damage: None });
        }
        // In this order: a run that ends in between counts as one that has not.
        let outcome = self.outcome(run)?;
        if outcome.is_some() {
            check_numbers(&folder)?;
        }
        let there = folder.join(SUMMARY_FILE).is_file();
        let open = if there { Some(RunFolder::open(&folder)?) } else { None };
        let open = open.filter(|open| open.summary.steps_recorded > 0);
        let steps = open.as_ref().map_or(0, |open| open.summary.steps_recorded);
        let representative = open.as_ref().map(RepresentativeTip::of).transpose()?.flatten();
        let summary = open.map(|open| open.summary);
        let (number, state) = (run.number, RunState::of(outcome, steps));
        Ok(StudyRow { number, state, summary, representative, damage: None })
    }
}

/// Whether a file of a run is no longer there.
fn is_gone(error: &OutputError) -> bool {
    match error {
        OutputError::NotARun { .. } | OutputError::NoRun { .. } => true,
        OutputError::Io { reason, .. } => reason.kind() == ErrorKind::NotFound,
        _ => false,
    }
}

impl StudyResults {
    pub(crate) fn are_complete(&self) -> bool {
        self.rows.iter().all(|row| row.state.is_over())
    }

    /// The damaged runs: their numbers, and what is wrong with them.
    pub fn damaged(&self) -> impl Iterator<Item = (usize, &str)> {
        self.rows.iter().filter_map(|row| Some((row.number, row.damage.as_deref()?)))
    }

    /// Number of runs in a state.
    pub fn count(&self, is_in: impl Fn(&RunState) -> bool) -> usize {
        self.rows.iter().filter(|row| is_in(&row.state)).count()
    }
}
