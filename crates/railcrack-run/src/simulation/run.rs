//! One run: from a case to its folder.

use super::drive::{Ending, drive, ended};
use super::error::RunError;
use super::job::{Job, Stage};
use super::observer::{RunObserver, Silent};
use super::recorder::Recorder;
use super::residual_stress::{Residual, prepare};
use crate::disk::FolderLock;
use crate::error::OutputError;
use crate::presentation::{Presentation, TablesOnly};
use crate::run_folder::{Existing, wheel_groups};
use crate::setup::{SharedRail, represented, represented_in};
use crate::summary::Summary;
use railcrack::growth::{GrowthState, StepSource, TipJudge};
use railcrack::plane::KnownStraight;
use railcrack_case::Case;
use std::borrow::Cow;
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
    /// Starts a run in a folder that its command has entered
    /// ([`ResultFolder`](crate::ResultFolder)).
    Entered,
}

/// The run of a case.
#[derive(Clone, Copy)]
pub struct Simulation<'a> {
    pub(super) case: &'a Case,
    pub(super) observer: &'a dyn RunObserver,
    pub(super) presentation: &'a dyn Presentation,
    pub(super) shared: Option<&'a SharedRail>,
    pub(super) judge: Option<&'a Arc<dyn TipJudge>>,
    /// The crack as runs of this rail know it together.
    pub(super) known: Option<&'a Arc<KnownStraight>>,
    pub(super) is_sampled: bool,
    /// Whether the decision has lives along other paths and with other friction.
    pub(super) has_variants: bool,
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
            known: None,
            is_sampled: true,
            has_variants: true,
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

    /// Computes no lives along other paths and with other friction for the decision: a study has a
    /// run for each value.
    #[must_use]
    pub fn of_a_study(self) -> Self {
        Self { has_variants: false, ..self }
    }

    /// Computes the run into `folder`, step by step, until it ends or is interrupted.
    ///
    /// Errors: the folder may not be written, holds another run or is damaged; the plastic state or
    /// a step cannot be computed (the steps before it are kept).
    pub fn run_in(&self, folder: &Path, entry: RunEntry) -> Result<Finished, RunError> {
        let goes_on = matches!(entry, RunEntry::Resume | RunEntry::ResumeOrBegin);
        let stored = if goes_on { wheel_groups(folder)? } else { None };
        // A run that goes on keeps its representatives.
        let case = match stored.and_then(|groups| represented_in(self.case, groups)) {
            Some(case) => Cow::Owned(case),
            None => represented(self.case),
        };
        Simulation { case: &case, ..*self }.represented_run_in(folder, entry)
    }

    fn represented_run_in(&self, folder: &Path, entry: RunEntry) -> Result<Finished, RunError> {
        let start = |stage: Stage| {
            let stage = Stage { shared: self.shared, ..stage };
            self.growth(stage)
        };
        let accompany = |recorder: &mut Recorder, state: &GrowthState| {
            if recorder.has_companions() {
                return Ok(());
            }
            match self.companions(recorder.info(), recorder.log(), state, folder)? {
                Some(companions) => Ok(recorder.accompany(companions, state)?),
                None => Ok(()),
            }
        };
        run_steps(folder, entry, self.job(), self.observer, self.presentation, start, accompany)
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
        Ok((prepared.growth_judged(stage.state, self.judge.cloned(), None), residual))
    }

    /// The growth loop from `state` on, on a rail that is prepared from `stage`.
    ///
    /// Errors: those of [`Simulation::growth`].
    pub(super) fn growth_from(
        &self,
        stage: &Stage,
        state: Option<GrowthState>,
    ) -> Result<Box<dyn StepSource>, RunError> {
        let (prepared, _) = prepare(self.case, stage)?;
        Ok(prepared.growth_judged(state, self.judge.cloned(), self.known.cloned()))
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
/// steps with the residual stress that the rail carries, writes step by step, and has `accompany`
/// add what the decision needs once the run has ended.
///
/// Errors: see [`Simulation::run_in`].
pub fn run_steps<S: StepSource>(
    folder: &Path,
    entry: RunEntry,
    job: Job,
    observer: &dyn RunObserver,
    presentation: &dyn Presentation,
    start: impl FnOnce(Stage) -> Result<(S, Option<Residual>), RunError>,
    accompany: impl FnOnce(&mut Recorder, &GrowthState) -> Result<(), RunError>,
) -> Result<Finished, RunError> {
    let _lock = lock(folder, entry)?;
    let (mut recorder, state) = open(folder, entry, job, presentation)?;
    observer.begins(state.as_ref().map_or(0, |state| state.step));
    let finished = |(ending, summary)| Finished { ending, summary, folder: folder.to_path_buf() };
    if let Some(state) = state.as_ref().filter(|state| state.ended.is_some()) {
        let accompanied = accompany(&mut recorder, state);
        observer.close();
        return Ok(finished(ended(accompanied, &mut recorder)?));
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
    Ok(finished(drive(source, &mut recorder, observer, accompany)?))
}

/// The lock of `folder`, which is created where the run may begin in it; none if its command has
/// it, or if it cannot be entered anyway, which the recorder reports.
fn lock(folder: &Path, entry: RunEntry) -> Result<Option<FolderLock>, OutputError> {
    if entry == RunEntry::Entered {
        return Ok(None);
    }
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
        RunEntry::Entered => (begin(job, Existing::Entered)?, None),
        RunEntry::Resume => Recorder::resume(folder, job.case, job.info, presentation)?,
        RunEntry::ResumeOrBegin => {
            match Recorder::resume(folder, job.case.clone(), job.info.clone(), presentation) {
                Err(OutputError::NoRun { .. }) => (begin(job, Existing::Refuse)?, None),
                resumed => resumed?,
            }
        }
    })
}
