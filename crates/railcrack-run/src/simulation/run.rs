//! One run: from a case to its folder.

use super::drive::{Ending, drive};
use super::error::RunError;
use super::job::{Job, Stage};
use super::observer::{RunObserver, Silent};
use super::recorder::Recorder;
use super::residual_stress::{Residual, prepare};
use crate::disk::FolderLock;
use crate::error::OutputError;
use crate::presentation::{Presentation, TablesOnly};
use crate::run_folder::Existing;
use crate::summary::Summary;
use railcrack::growth::{GrowthState, StepSource, TipJudge};
use railcrack_case::{Case, SharedRail};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// How a run enters its folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RunEntry {
    /// Starts a run; a folder that already holds one is left unchanged and causes an error.
    Begin,
    /// Starts a run that replaces the one in the folder.
    Replace,
    /// Resumes the run in the folder; an error if there is none.
    Resume,
    /// Resumes the run in the folder, or starts one if there is none.
    ResumeOrBegin,
}

/// The run of a case.
#[derive(Clone, Copy)]
pub struct Simulation<'a> {
    pub(super) case: &'a Case,
    pub(super) observer: &'a dyn RunObserver,
    pub(super) presentation: &'a dyn Presentation,
    pub(super) shared: Option<&'a SharedRail>,
    pub(super) judge: Option<&'a Arc<dyn TipJudge>>,
    is_sampled: bool,
}

impl<'a> Simulation<'a> {
    /// The run of `case`, without progress output, with tables and summary only.
    pub fn new(case: &'a Case) -> Self {
        Self {
            case,
            observer: &Silent,
            presentation: &TablesOnly,
            shared: None,
            judge: None,
            is_sampled: true,
        }
    }

    /// Reports progress to `observer`.
    #[must_use]
    pub fn observed_by(self, observer: &'a dyn RunObserver) -> Self {
        Self { observer, ..self }
    }

    /// Makes plots and pages with `presentation`.
    #[must_use]
    pub fn presented_by(self, presentation: &'a dyn Presentation) -> Self {
        Self { presentation, ..self }
    }

    /// Reuses the mesh and factors of another run of the same rail: the results are bitwise
    /// identical and computed sooner.
    #[must_use]
    pub fn sharing(self, shared: Option<&'a SharedRail>) -> Self {
        Self { shared, ..self }
    }

    /// Takes the direction and the rate of every tip from `judge`.
    #[must_use]
    pub fn judged_by(self, judge: &'a Arc<dyn TipJudge>) -> Self {
        Self { judge: Some(judge), ..self }
    }

    /// Makes no samples of `[scatter]`: the study of the run makes them between its runs.
    #[must_use]
    pub fn sampled_by_its_study(self) -> Self {
        Self { is_sampled: false, ..self }
    }

    /// Computes the run into `folder`, step by step, until it ends or is interrupted.
    ///
    /// Errors: the folder may not be written, holds another run or is damaged; the plastic state or
    /// a step cannot be computed (the steps before it are kept).
    pub fn run_in(&self, folder: &Path, entry: RunEntry) -> Result<Finished, RunError> {
        run_steps(folder, entry, self.job(), self.observer, self.presentation, |stage| {
            let stage = Stage { shared: self.shared, ..stage };
            self.growth(stage)
        })
    }
}

impl Simulation<'_> {
    /// The run before anything is computed.
    pub(super) fn job(&self) -> Job {
        let mut job = Job::of(self.case);
        job.info.scatter = job.info.scatter.filter(|_| self.is_sampled);
        job
    }

    /// The growth loop from `stage` on, and the residual stress that the rail carries.
    ///
    /// Errors: the plastic state cannot be computed, or the residual stress cannot be computed.
    pub(super) fn growth(&self, stage: Stage) -> Result<(Box<dyn StepSource>, Option<Residual>), RunError> {
        let (prepared, residual) = prepare(self.case, &stage)?;
        Ok((prepared.growth_judged(stage.state, self.judge.cloned()), residual))
    }
}

/// A run that ended or was interrupted.
#[derive(Debug)]
pub struct Finished {
    /// How it ended.
    pub ending: Ending,
    /// The run in numbers.
    pub summary: Summary,
    /// The run folder.
    pub folder: PathBuf,
}

/// Runs `job` in `folder`: checks and prepares the folder, then has `start` build what computes the
/// steps with the residual stress that the rail carries, and writes step by step.
///
/// Errors: see [`Simulation::run_in`].
pub fn run_steps<S: StepSource>(
    folder: &Path,
    entry: RunEntry,
    job: Job,
    observer: &dyn RunObserver,
    presentation: &dyn Presentation,
    start: impl FnOnce(Stage) -> Result<(S, Option<Residual>), RunError>,
) -> Result<Finished, RunError> {
    let _lock = lock(folder, entry)?;
    let (mut recorder, state) = open(folder, entry, job, presentation)?;
    observer.begins(state.as_ref().map_or(0, |state| state.step));
    let finished = |(ending, summary)| Finished { ending, summary, folder: folder.to_path_buf() };
    if state.as_ref().is_some_and(|state| state.ended.is_some()) {
        observer.close();
        return Ok(finished((Ending::Ended, recorder.finish()?)));
    }
    let (source, residual) = match start(Stage { folder, observer, presentation, shared: None, state }) {
        Err(error) if error.is_interruption() => {
            observer.close();
            return Ok(finished((Ending::Interrupted, recorder.finish()?)));
        }
        started => started?,
    };
    if let Some(residual) = residual {
        residual.record(&mut recorder, observer)?;
    }
    Ok(finished(drive(source, &mut recorder, observer)?))
}

/// The lock of `folder`, which is created where the run may begin in it; none if it cannot be
/// entered anyway, which the recorder reports.
fn lock(folder: &Path, entry: RunEntry) -> Result<Option<FolderLock>, OutputError> {
    if entry != RunEntry::Resume && !folder.exists() {
        std::fs::create_dir_all(folder).map_err(OutputError::io("create the run folder", folder))?;
    }
    folder.is_dir().then(|| FolderLock::take(folder)).transpose()
}

fn open(
    folder: &Path,
    entry: RunEntry,
    job: Job,
    presentation: &dyn Presentation,
) -> Result<(Recorder, Option<GrowthState>), RunError> {
    let begin = |job: Job, existing| Recorder::start(folder, job.case, job.info, existing, presentation);
    Ok(match entry {
        RunEntry::Begin => (begin(job, Existing::Refuse)?, None),
        RunEntry::Replace => (begin(job, Existing::Replace)?, None),
        RunEntry::Resume => Recorder::resume(folder, job.case, job.info, presentation)?,
        RunEntry::ResumeOrBegin => {
            match Recorder::resume(folder, job.case.clone(), job.info.clone(), presentation) {
                Err(OutputError::NoRun { .. }) => (begin(job, Existing::Refuse)?, None),
                resumed => resumed?,
            }
        }
    })
}
