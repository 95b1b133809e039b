//! One run of a study.

use super::progress::StudyProgress;
use crate::commands::residual;
use crate::commands::run::{Job, Stage, carry_out};
use crate::drive::{Ending, RunError};
use crate::exit::Exit;
use crate::interruption::Interruption;
use railcrack::case::{NextRun, StudyRun};
use railcrack::output::{Existing, Outcome, OutputError, PlannedRun, Recorder, RunEnd, StudyFolder, Summary};

/// Where a run is computed, and who is told.
pub struct Workplace<'a> {
    pub folder: &'a StudyFolder,
    pub progress: &'a StudyProgress,
    pub interruption: &'a Interruption,
}

/// A run that failed.
#[derive(Debug)]
pub struct FailedRun {
    pub number: usize,
    /// Its values.
    pub label: String,
    pub end: RunEnd,
    pub reason: String,
}

impl Workplace<'_> {
    /// Computes `run`, or what is missing of it, into its run folder, and remembers there how it ended. One that is interrupted has no
    /// end yet.
    pub fn compute(&self, run: &StudyRun, planned: &PlannedRun, next: &NextRun) -> Option<FailedRun> {
        let computed = self.steps(run, planned, next);
        let (outcome, told) = match &computed {
            Ok((Ending::Interrupted, _)) => return None,
            Ok((Ending::Ended, summary)) => (Outcome::done(), done(summary)),
            Err(error) => (Outcome::failed(end_of(error), &error.to_string()), format!("failed: {error}")),
        };
        let settled = self.folder.settle(planned, &outcome).map_err(RunError::from);
        self.progress.over(&format!("run {} ({}): {told}", run.number, run.label));
        let error = computed.err().or(settled.err())?;
        let (number, label) = (run.number, run.label.clone());
        Some(FailedRun { number, label, end: end_of(&error), reason: error.to_string() })
    }

    fn steps(
        &self,
        run: &StudyRun,
        planned: &PlannedRun,
        next: &NextRun,
    ) -> Result<(Ending, Summary), RunError> {
        let job = Job::of(&run.case);
        let folder = self.folder.run_folder(planned);
        self.folder.reopen(planned)?;
        let opened = match Recorder::resume(&folder, job.case.clone(), job.info.clone()) {
            Err(OutputError::NoRun { .. }) => {
                (Recorder::start(&folder, job.case, job.info, Existing::Refuse)?, None)
            }
            resumed => resumed?,
        };
        let progress = |first| self.progress.of_run(job.increments + 1, first);
        carry_out(&folder, opened, progress, self.interruption, |stage| {
            let stage = Stage { shared: next.shared_rail(&run.case), ..stage };
            let (prepared, residual) = residual::prepare(&run.case, &stage)?;
            Ok((prepared.growth(stage.state), residual))
        })
    }
}

fn end_of(error: &RunError) -> RunEnd {
    match error.exit() {
        Exit::NotConverged => RunEnd::NotConverged,
        _ => RunEnd::CannotReadOrWrite,
    }
}

fn done(summary: &Summary) -> String {
    let stop = summary.stop.as_deref().unwrap_or("ended");
    format!("{stop} at step {}, {:.1} s", summary.steps, summary.wall_s)
}
