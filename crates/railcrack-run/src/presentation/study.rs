//! Results of a study written to its folder.

use super::interface::Presentation;
use crate::csv::Table;
use crate::disk::files::POPULATION_FILE;
use crate::disk::json_text;
use crate::error::OutputError;
use crate::study::{Population, StudyFolder, StudyResults, StudySummaryRow, TimesRow};

impl StudyFolder {
    /// Builds `summary.csv`, `times.csv`, and plots and pages by `presentation`, from the run
    /// folders alone, whichever process computed them.
    ///
    /// Several processes may do so at once: once the last of them has, the files have every run.
    ///
    /// Errors: a file of a run is damaged; the system refuses.
    pub fn write_results(&self, presentation: &dyn Presentation) -> Result<StudyResults, OutputError> {
        loop {
            let mut results = self.read_results()?;
            self.put(StudySummaryRow::FILE, &results.table(self.plan())?)?;
            self.put(TimesRow::FILE, &results.times()?)?;
            if self.plan().population.is_some() {
                results.population = Population::of(self.plan(), &results);
                let text = json_text(&self.path().join(POPULATION_FILE), &results.population)?;
                self.put(POPULATION_FILE, text.as_bytes())?;
            }
            self.write_tables(&results)?;
            presentation.study(self, &results)?;
            // Another process may have finished the last run, and written all results, while this
            // one was about to: what has just been written would then hide what the other one
            // wrote.
            if results.are_complete() {
                self.close_runs();
            }
            if results.are_complete() || !self.is_over()? {
                return Ok(results);
            }
        }
    }

    fn is_over(&self) -> Result<bool, OutputError> {
        let packed = self.packed()?;
        for run in &self.plan().runs {
            if !packed.has(run.number) && self.outcome(run)?.is_none() {
                return Ok(false);
            }
        }
        Ok(true)
    }
}
