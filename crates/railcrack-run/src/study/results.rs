//! The results of a study, gathered from its run folders.

use super::folder::StudyFolder;
use super::plan::PlannedRun;
use super::state::{RunState, StudyRow};
use crate::csv::{TipRow, read_growth};
use crate::folder::{SUMMARY_FILE, read_if_there};
use crate::histories::{History, read_histories};
use crate::leader::leading_tip;
use crate::{OutputError, Presentation, Summary};
use std::path::Path;

/// The results of a study: a row per run, in the order of the runs.
#[derive(Debug, Clone)]
pub struct StudyResults {
    /// The runs.
    pub rows: Vec<StudyRow>,
}

/// The tip that stands for a run.
#[derive(Debug, Clone)]
pub struct LeadingTip {
    /// Its row of step 0.
    pub first: TipRow,
    /// Its rows, by step.
    pub rows: Vec<TipRow>,
    /// K of step 0.
    pub history: History,
}

impl LeadingTip {
    /// Its row in the last step.
    pub fn last(&self) -> &TipRow {
        self.rows.last().unwrap_or(&self.first)
    }
}

impl StudyFolder {
    /// Builds `summary.csv`, `times.csv` and what `presentation` makes of them from the run folders alone, whoever computed them.
    ///
    /// Several processes may do so at once: once the last of them has, the files have every run.
    ///
    /// Errors: a file of a run is damaged; the system refuses.
    pub fn write_results(&self, presentation: &dyn Presentation) -> Result<StudyResults, OutputError> {
        loop {
            let results = self.read_results()?;
            self.put("summary.csv", &results.table(self.plan())?)?;
            self.put("times.csv", &results.times()?)?;
            presentation.study(self, &results)?;
            // Another process may have finished the last run, and written all results, while this one was about to: what has just been
            // written would then hide what the other one wrote.
            if results.are_complete() || !self.is_over()? {
                return Ok(results);
            }
        }
    }

    fn read_results(&self) -> Result<StudyResults, OutputError> {
        let rows: Result<_, _> = self.plan().runs.iter().map(|run| self.row(run)).collect();
        Ok(StudyResults { rows: rows? })
    }

    fn row(&self, run: &PlannedRun) -> Result<StudyRow, OutputError> {
        let folder = self.run_folder(run);
        // In this order: a run that ends in between counts as one that has not.
        let outcome = self.outcome(run)?;
        let path = folder.join(SUMMARY_FILE);
        let summary: Option<Summary> = read_if_there(&path)?
            .map(|text| serde_json::from_slice(&text))
            .transpose()
            .map_err(|reason| OutputError::damaged(&path, reason.to_string()))?;
        let summary = summary.filter(|summary| summary.steps_recorded > 0);
        let steps = summary.as_ref().map_or(0, |summary| summary.steps_recorded);
        let leading = if steps > 0 { leading(&folder, steps)? } else { None };
        Ok(StudyRow { number: run.number, state: RunState::of(outcome, steps), summary, leading })
    }

    fn is_over(&self) -> Result<bool, OutputError> {
        for run in &self.plan().runs {
            if self.outcome(run)?.is_none() {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

impl StudyResults {
    fn are_complete(&self) -> bool {
        self.rows.iter().all(|row| row.state.is_over())
    }

    /// Number of runs in a state.
    pub fn count(&self, is_in: impl Fn(&RunState) -> bool) -> usize {
        self.rows.iter().filter(|row| is_in(&row.state)).count()
    }
}

fn leading(folder: &Path, steps: usize) -> Result<Option<LeadingTip>, OutputError> {
    let growth = read_growth(folder, steps)?;
    let Some(rows) = leading_tip(&growth) else { return Ok(None) };
    let rows: Vec<TipRow> = rows.into_iter().cloned().collect();
    let first = rows[0].clone();
    let histories = read_histories(folder, |step| step == 0)?;
    let own = |history: &History| (history.crack, history.tip) == (first.crack, first.tip);
    let history = histories.into_iter().find(own).unwrap_or_default();
    Ok(Some(LeadingTip { first, rows, history }))
}
