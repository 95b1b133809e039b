//! The results of a study, gathered from its run folders.

use super::folder::StudyFolder;
use super::packed::{Flaw, PackedRuns};
use super::plan::PlannedRun;
use super::population::Population;
use super::state::{RunState, StudyRow};
use crate::disk::files::SUMMARY_FILE;
use crate::error::OutputError;
use crate::run_folder::{RepresentativeTip, RunFolder, check_numbers, run_file_in};
use std::io::ErrorKind;

/// The results of a study: a row per run, in the order of the runs.
#[derive(Debug, Clone)]
pub struct StudyResults {
    /// The runs.
    pub rows: Vec<StudyRow>,
    /// Samples between the runs, for each choice of the keys that are not drawn; empty until they
    /// are made.
    pub population: Vec<Population>,
    /// Damaged bytes and runs of other studies in the files of packed runs, a sentence for each,
    /// where no row says so.
    pub flaws: Vec<String>,
}

impl StudyFolder {
    /// The results as the run folders have them now.
    ///
    /// Errors: a file of a run is damaged; the system refuses.
    pub fn read_results(&self) -> Result<StudyResults, OutputError> {
        let packed = self.packed()?;
        let rows: Result<Vec<_>, _> = self.plan().runs.iter().map(|run| self.row(run, &packed)).collect();
        let rows = rows?;
        let is_told = |text: &str| rows.iter().any(|row| row.damage.as_deref() == Some(text));
        let flaws = packed.flaws().iter().map(Flaw::text).filter(|text| !is_told(text)).collect();
        Ok(StudyResults { rows, population: Vec::new(), flaws })
    }

    /// A damaged run is one that has failed: nothing of its numbers goes into the results.
    fn row(&self, run: &PlannedRun, packed: &PackedRuns) -> Result<StudyRow, OutputError> {
        match self.whole_row(run, packed) {
            Err(error @ (OutputError::Damaged { .. } | OutputError::Field(_))) => {
                let reason = error.to_string();
                let state = RunState::cannot_read(&reason);
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
        if let (false, Some(flaw), None) =
            (packed.has(run.number), packed.flaw_of(run.number), run_file_in(&folder))
        {
            let (state, damage) = (RunState::cannot_read(&flaw.text()), Some(flaw.text()));
            return Ok(StudyRow { number: run.number, state, summary: None, representative: None, damage });
        }
        if packed.has(run.number) {
            let open = self.run_in(run, packed)?;
            let representative = RepresentativeTip::of(&open)?;
            let state = RunState::of(open.summary.outcome.clone(), open.summary.steps_recorded);
            let summary = Some(open.summary);
            return Ok(StudyRow { number: run.number, state, summary, representative, damage: None });
        }
        self.check_case_of(run)?;
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
