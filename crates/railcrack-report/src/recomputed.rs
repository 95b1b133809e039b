//! The data of the page of a run, collected while it is computed: in the run itself, or again from
//! the stored case where its files lack some of them.

use crate::built::write_run;
use crate::page_data::{PageData, PageStep};
use crate::pages::RunFolder;
use railcrack::growth::StepRecord;
use railcrack_case::{Case, Output};
use railcrack_run::csv::{SifScale, TipRow};
use railcrack_run::decision::Decision;
use railcrack_run::disk::inner_folder;
use railcrack_run::simulation::{RunEntry, RunError, Simulation};
use railcrack_run::{OutputError, Presentation, RunPresentation};
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

/// Subfolder of the run folder in which its steps are computed again.
const SCRATCH: &str = "again.partial";

/// The part of a run that is computed again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Again {
    /// Its steps, for data that its tables lack.
    StepsAlone,
    /// All that its decision needs, too: other runs and samples.
    WithItsDecision,
}

/// The data of the page of `run`, computed `again`, with the decision block of its summary.
///
/// Errors: it has not ended; what is computed is not what the folder has; it cannot be computed;
/// the system refuses.
pub(crate) fn recomputed(run: &RunFolder, what: Again) -> Result<(PageData, Option<Decision>), OutputError> {
    let folder = &run.path;
    if run.summary.stop.is_none() {
        return Err(not_recomputed(folder, "it has not ended: --resume continues it"));
    }
    let scratch = inner_folder(folder, SCRATCH)?;
    let again = computed(&run.case, &scratch, &run.growth, what);
    // Best effort: the error of the computation is the one to report.
    let removed = std::fs::remove_dir_all(&scratch);
    let again = again.map_err(|reason| not_recomputed(folder, reason))?;
    removed.map_err(OutputError::io("remove", &scratch))?;
    Ok(again)
}

/// The data of the page and the decision block of the run of `case`, computed in `scratch`;
/// `growth` is what it must come to.
fn computed(
    case: &Case,
    scratch: &Path,
    growth: &[TipRow],
    what: Again,
) -> Result<(PageData, Option<Decision>), String> {
    let mut case = case.clone();
    case.output = Output { report: true, ..Output::LEAST };
    let collecting = Collecting::default();
    let simulation = Simulation::new(&case).presented_by(&collecting);
    let simulation = match what {
        Again::WithItsDecision => simulation,
        Again::StepsAlone => simulation.of_a_study().sampled_by_its_study(),
    };
    let finished = simulation.run_in(scratch, RunEntry::Replace);
    let finished = finished.map_err(|error: RunError| error.to_string())?;
    let again = railcrack_run::RunFolder::open(scratch).and_then(|run| run.growth());
    let again = again.map_err(|error| error.to_string())?;
    if let Some((_, row)) = again.iter().zip(growth).find(|(again, stored)| again != stored) {
        return Err(format!(
            "step {} differs when computed again: the run was computed by another version",
            row.step
        ));
    }
    if again.len() != growth.len() {
        return Err(
            "the number of steps differs when computed again: the run was computed by another version"
                .to_owned(),
        );
    }
    let page_data = collecting.collected.lock().unwrap_or_else(PoisonError::into_inner).take();
    Ok((page_data.unwrap_or_default(), finished.summary.decision))
}

fn not_recomputed(folder: &Path, reason: impl Into<String>) -> OutputError {
    OutputError::NotRecomputed { folder: folder.to_path_buf(), reason: reason.into() }
}

/// Collects the data of the page of a run without writing anything.
#[derive(Debug, Default)]
struct Collecting {
    collected: Arc<Mutex<Option<PageData>>>,
}

impl Presentation for Collecting {
    fn run(&self, _: Output) -> Box<dyn RunPresentation> {
        let at_end = AtEnd::Keep(Arc::clone(&self.collected));
        Box::new(Collected::after(PageData::default(), at_end))
    }

    fn resumed_run(
        &self,
        _: &Path,
        _: usize,
        output: Output,
    ) -> Result<Box<dyn RunPresentation>, OutputError> {
        Ok(self.run(output))
    }
}

/// Use of the collected data when a run has ended.
#[derive(Debug, Clone)]
pub(crate) enum AtEnd {
    /// Plots and page are written, as selected.
    Write(Output),
    /// They are kept here.
    Keep(Arc<Mutex<Option<PageData>>>),
}

/// The data of the page of a run in progress.
#[derive(Debug)]
pub(crate) struct Collected {
    page_data: PageData,
    taken: Option<PageStep>,
    at_end: AtEnd,
}

impl Collected {
    /// After the steps whose data are `page_data`.
    pub(crate) fn after(page_data: PageData, at_end: AtEnd) -> Self {
        Self { page_data, taken: None, at_end }
    }
}

impl RunPresentation for Collected {
    fn take(&mut self, record: &StepRecord, scale: &SifScale) -> Result<(), OutputError> {
        self.taken = Some(self.page_data.of_record(record, scale)?);
        Ok(())
    }

    fn keep(&mut self) {
        if let Some(step) = self.taken.take() {
            self.page_data.push(step);
        }
    }

    fn finish(&self, folder: &Path) -> Result<(), OutputError> {
        match &self.at_end {
            AtEnd::Write(output) => write_run(&RunFolder::read(folder)?, &self.page_data, *output),
            AtEnd::Keep(slot) => {
                *slot.lock().unwrap_or_else(PoisonError::into_inner) = Some(self.page_data.clone());
                Ok(())
            }
        }
    }
}
