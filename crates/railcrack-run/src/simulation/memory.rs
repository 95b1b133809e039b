//! Runs in memory: no file is written unless asked for. A caller may also ask for one step after
//! another.

use super::drive::{Ending, OfSteps, compute};
use super::error::RunError;
use super::job::{Job, Stage};
use super::recorder::Recorder;
use super::residual_stress::Residual;
use super::run::Simulation;
use crate::csv::{FaceRow, ResidualRow, SifRow, SifScale, TipRow, table_text};
use crate::disk::files::ROLLED_FOLDER;
use crate::disk::{FolderLock, inner_folder};
use crate::error::OutputError;
use crate::log::{Companion, RunInfo, RunLog};
use crate::machine::peak_memory_mb;
use crate::presentation::Presentation;
use crate::run_folder::Existing;
use crate::setup::represented;
use crate::summary::Summary;
use railcrack::growth::{GrowthState, StepRecord, StepSource};
use railcrack::stopwatch::Stopwatch;
use railcrack_case::Output;
use std::path::{Path, PathBuf};

/// The finished steps of a run, kept in memory.
#[derive(Debug, Clone)]
pub struct RunInMemory {
    pub(super) job: Job,
    pub(super) residual: Option<Residual>,
    /// Each step, and the state after it.
    pub(super) steps: Vec<(StepRecord, GrowthState)>,
    /// Folder of the plastic state of the rolled rail, if the case requires it.
    pub(super) rolled: Option<PathBuf>,
    pub(super) companions: Option<Vec<Companion>>,
    pub(super) wall_s: f64,
}

impl Simulation<'_> {
    /// Computes the run in memory, step by step, until it ends or is interrupted: after the steps
    /// of `before`, which must be a run of the same case. Only the plastic state of a rolled rail
    /// is written, to `scratch`, if the case requires it.
    ///
    /// What was computed is returned in any case, together with the error: the plastic state or a
    /// step cannot be computed.
    pub fn run_in_memory(
        &self,
        scratch: &Path,
        before: Option<RunInMemory>,
    ) -> (RunInMemory, Result<Ending, RunError>) {
        let started = Stopwatch::start();
        let case = represented(self.case);
        let simulation = Simulation { case: &case, ..*self };
        let mut run = before.unwrap_or_else(|| RunInMemory::begun(simulation.job()));
        let ending = simulation.go_on(&mut run, scratch);
        self.observer.close();
        run.wall_s += started.seconds();
        (run, ending)
    }

    /// The step from `state` on alone, or that from the beginning; none where the run has ended.
    ///
    /// Errors: the plastic state or the step cannot be computed.
    pub fn one_step(
        &self,
        scratch: &Path,
        state: Option<GrowthState>,
    ) -> Result<Option<StepRecord>, RunError> {
        let Self { observer, presentation, shared, .. } = *self;
        let case = represented(self.case);
        let (mut growth, _) = Simulation { case: &case, ..*self }.growth(Stage {
            folder: scratch,
            observer,
            presentation,
            shared,
            state,
        })?;
        Ok(growth.next_step(&OfSteps(observer))?)
    }

    fn go_on(&self, run: &mut RunInMemory, scratch: &Path) -> Result<Ending, RunError> {
        let state = run.steps.last().map(|(_, state)| state.clone());
        self.observer.begins(state.as_ref().map_or(0, |state| state.step));
        let Self { observer, presentation, shared, .. } = *self;
        let stage = Stage { folder: scratch, observer, presentation, shared, state };
        let (growth, residual) = self.growth(stage)?;
        if let Some(residual) = &residual {
            residual.announce(observer);
        }
        run.residual = residual;
        run.rolled = Some(scratch.join(ROLLED_FOLDER)).filter(|folder| folder.is_dir());
        let steps = &mut run.steps;
        let ending = compute(growth, observer, |record, state| {
            observer.finished(&record);
            steps.push((record, state));
            Ok(())
        })?;
        match self.accompany(run, scratch) {
            Ok(()) => Ok(ending),
            Err(error) if error.is_interruption() => Ok(Ending::Interrupted),
            Err(error) => Err(error),
        }
    }

    /// Adds the other runs that the decision needs to a `run` that has ended and lacks them.
    pub(super) fn accompany(&self, run: &mut RunInMemory, scratch: &Path) -> Result<(), RunError> {
        if let Some((_, state)) = run.steps.last().filter(|(_, state)| state.ended.is_some())
            && run.companions.is_none()
        {
            run.companions = self.companions(&run.job.info, &run.log(), state, scratch)?;
        }
        Ok(())
    }
}

impl RunInMemory {
    /// The run of `job` before its first step.
    pub(super) fn begun(job: Job) -> Self {
        Self { job, residual: None, steps: Vec::new(), rolled: None, companions: None, wall_s: 0.0 }
    }

    /// The finished steps, in order.
    pub fn records(&self) -> impl Iterator<Item = &StepRecord> {
        self.steps.iter().map(|(record, _)| record)
    }

    /// The state before step `step`; none at the beginning, and behind the last finished step.
    pub fn state_before(&self, step: usize) -> Option<&GrowthState> {
        self.steps.get(step.checked_sub(1)?).map(|(_, state)| state)
    }

    /// The residual stress of the rail on its middle line; empty where it carries none.
    pub fn residual(&self) -> &[ResidualRow] {
        self.residual.as_ref().map_or(&[], |residual| &residual.rows)
    }

    /// The sections of the case that bring columns of their own.
    pub fn sections(&self) -> Vec<&'static str> {
        self.job.info.sections()
    }

    /// The rows of `sif.csv`.
    pub fn sif_rows(&self) -> impl Iterator<Item = SifRow> {
        let first = self.steps.first().and_then(|(record, _)| record.cracks().first());
        let origin = first.map_or(0.0, |crack| crack.points()[0].x);
        let scale = SifScale { origin, half_widths: self.job.info.half_widths() };
        self.records().flat_map(move |record| SifRow::of_step(record, &scale).collect::<Vec<SifRow>>())
    }

    /// The rows of `growth.csv`.
    pub fn growth_rows(&self) -> impl Iterator<Item = TipRow> {
        self.records().flat_map(|record| TipRow::of_step(record, self.job.info.axle_load))
    }

    /// The rows of `faces.csv`.
    pub fn face_rows(&self) -> impl Iterator<Item = FaceRow> {
        self.records().flat_map(FaceRow::of_step)
    }

    /// The run in numbers, as far as it was computed.
    pub fn summary(&self) -> Summary {
        Summary::new(&self.job.info, &self.log(), true)
    }

    /// [`RunInMemory::summary`] without the samples of `[scatter]`.
    pub fn summary_without_samples(&self) -> Summary {
        Summary::new(&self.job.info, &self.log(), false)
    }

    /// The text of `growth.csv`.
    ///
    /// Errors: a number that is not finite.
    pub fn growth_table(&self) -> Result<String, OutputError> {
        table_text(&self.sections(), self.growth_rows())
    }

    /// The text of `sif.csv` with all steps.
    ///
    /// Errors: a number that is not finite.
    pub fn sif_table(&self) -> Result<String, OutputError> {
        table_text(&self.sections(), self.sif_rows())
    }

    fn log(&self) -> RunLog {
        let mut log = RunLog::default();
        self.records().for_each(|record| log.add(record, Vec::new()));
        log.now.residual = self.residual.as_ref().map(|residual| residual.summary.clone());
        log.now.companions.clone_from(&self.companions);
        log.now.wall_s = self.wall_s;
        log.now.peak_memory_mb = peak_memory_mb();
        log
    }

    /// The tables, plots and page that the case requests.
    pub fn output(&self) -> Output {
        self.job.info.output
    }

    /// Writes the run folder that the same run would have written with `output`, wall times aside;
    /// a run that was interrupted can be resumed there.
    ///
    /// Errors: the folder holds a run and `existing` says to leave it alone; a number that is not
    /// finite; the system refuses to write.
    pub fn save(
        &self,
        folder: &Path,
        output: Output,
        existing: Existing,
        presentation: &dyn Presentation,
    ) -> Result<Summary, OutputError> {
        std::fs::create_dir_all(folder).map_err(OutputError::io("create the run folder", folder))?;
        let _lock = FolderLock::take(folder)?;
        let Job { case, info } = self.job.clone();
        let info = RunInfo { output, ..info };
        let mut recorder = Recorder::start(folder, case, info, existing, presentation)?;
        if let Some(rolled) = &self.rolled {
            copy_folder(rolled, &inner_folder(folder, ROLLED_FOLDER)?)?;
        }
        if let Some(residual) = &self.residual {
            recorder.residual(&residual.rows, residual.summary.clone())?;
        }
        for (record, state) in &self.steps {
            recorder.record(record, state)?;
        }
        if let (Some(companions), Some((_, state))) = (&self.companions, self.steps.last()) {
            recorder.accompany(companions.clone(), state)?;
        }
        recorder.was_computed_in(self.wall_s);
        recorder.finish()
    }
}

fn copy_folder(from: &Path, to: &Path) -> Result<(), OutputError> {
    let refused = || OutputError::io("copy", from);
    std::fs::create_dir_all(to).map_err(refused())?;
    for entry in std::fs::read_dir(from).map_err(refused())? {
        let path = entry.map_err(refused())?.path();
        let Some(name) = path.file_name() else { continue };
        if path.is_dir() {
            copy_folder(&path, &to.join(name))?;
        } else {
            std::fs::copy(&path, to.join(name)).map_err(refused())?;
        }
    }
    Ok(())
}

/// A run in memory and what computes its next step: no thread, clock or file is needed, and between
/// two steps the caller does what it likes.
pub struct RunByStep {
    run: RunInMemory,
    growth: Box<dyn StepSource>,
}

impl Simulation<'_> {
    /// The run before its first step. Only the plastic state of a rolled rail is written, to
    /// `scratch`, if the case requires it.
    ///
    /// Errors: the plastic state or the residual stress cannot be computed.
    pub fn begin_by_step(&self, scratch: &Path) -> Result<RunByStep, RunError> {
        let Self { observer, presentation, shared, .. } = *self;
        let stage = Stage { folder: scratch, observer, presentation, shared, state: None };
        let case = represented(self.case);
        let simulation = Simulation { case: &case, ..*self };
        let (growth, residual) = simulation.growth(stage)?;
        let mut run = RunInMemory::begun(simulation.job());
        run.residual = residual;
        Ok(RunByStep { run, growth })
    }

    /// Computes the other runs that the decision on `by_step` needs, once it has ended.
    ///
    /// Errors: an interruption.
    pub fn accompany_by_step(&self, by_step: &mut RunByStep, scratch: &Path) -> Result<(), RunError> {
        let case = represented(self.case);
        Simulation { case: &case, ..*self }.accompany(&mut by_step.run, scratch)
    }

    /// Computes the next step of `by_step`; none where the run has ended.
    ///
    /// Errors: the step cannot be computed, or is interrupted. The steps before it are kept.
    pub fn next_of<'a>(&self, by_step: &'a mut RunByStep) -> Result<Option<&'a StepRecord>, RunError> {
        let RunByStep { run, growth } = by_step;
        let Some(record) = growth.next_step(&OfSteps(self.observer))? else { return Ok(None) };
        self.observer.finished(&record);
        run.steps.push((record, growth.state().clone()));
        Ok(run.records().last())
    }
}

impl RunByStep {
    /// The steps so far.
    pub fn run(&self) -> &RunInMemory {
        &self.run
    }

    /// Whether no step follows.
    pub fn has_ended(&self) -> bool {
        self.growth.state().ended.is_some()
    }
}
