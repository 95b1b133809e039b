//! The loop of a run: compute a step, write it, say so.

use crate::exit::Exit;
use crate::interruption::Interruption;
use crate::progress::Tell;
use railcrack::case::CarriedStressError;
use railcrack::growth::{Growth, GrowthError, GrowthState, Observer, StepRecord};
use railcrack::output::{OutputError, Recorder, Summary};
use railcrack::shakedown::ShakedownError;
use std::path::PathBuf;
use std::sync::mpsc::{SyncSender, sync_channel};
use thiserror::Error;

/// What computes steps: [`Growth`], and synthetic runs in tests.
pub trait StepSource {
    /// The next step; none when the run has ended. On an error the state is that before the step.
    fn next_step(&mut self, watch: &dyn Observer) -> Result<Option<StepRecord>, GrowthError>;
    /// The state after the last computed step.
    fn state(&self) -> &GrowthState;
}

impl StepSource for Growth {
    fn next_step(&mut self, watch: &dyn Observer) -> Result<Option<StepRecord>, GrowthError> {
        Growth::next_step(self, watch)
    }

    fn state(&self) -> &GrowthState {
        Growth::state(self)
    }
}

/// How a run came to its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// By itself: all steps done, or a physical stop.
    Ended,
    /// By the user; `--resume` goes on.
    Interrupted,
}

/// Why a run failed. What was computed is kept.
#[derive(Debug, Error)]
pub enum RunError {
    /// The run folder.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The computation.
    #[error(transparent)]
    Growth(#[from] GrowthError),
    /// The plastic state.
    #[error(transparent)]
    Shakedown(#[from] ShakedownError),
    /// The residual stress.
    #[error(transparent)]
    Residual(#[from] CarriedStressError),
    /// The plastic stress that the first stage wrote cannot be read back.
    #[error("the plastic stress of the rolled rail: {0}")]
    Rolled(String),
    /// A rail without layers has no state.
    #[error("the rail has no layers to judge")]
    NoLayers,
    /// The run would overwrite its own case file.
    #[error(
        "{} is the case file and would be overwritten by the run: choose another folder with --out",
        path.display()
    )]
    CaseInRunFolder {
        /// The case file.
        path: PathBuf,
    },
    /// The system refuses threads or signal handlers.
    #[error("cannot {action}: {reason}")]
    System {
        /// What was tried.
        action: String,
        /// The system's reason.
        reason: String,
    },
}

impl RunError {
    /// The exit code of the program.
    pub fn exit(&self) -> Exit {
        match self {
            Self::CaseInRunFolder { .. } => Exit::BadInput,
            Self::Output(error) => match error {
                OutputError::HoldsRun { .. }
                | OutputError::NoRun { .. }
                | OutputError::NotARun { .. }
                | OutputError::NothingToReport { .. }
                | OutputError::HoldsComparison { .. }
                | OutputError::HoldsStudy { .. }
                | OutputError::NoStudy { .. }
                | OutputError::StudyChanged { .. }
                | OutputError::CaseChanged { .. }
                | OutputError::OtherVersion { .. } => Exit::BadInput,
                OutputError::NotFinite { .. } | OutputError::Field(_) => Exit::NotConverged,
                OutputError::Damaged { .. } | OutputError::Io { .. } => Exit::CannotReadOrWrite,
            },
            Self::Rolled(_) => Exit::CannotReadOrWrite,
            Self::Residual(CarriedStressError::Field(_)) => Exit::BadInput,
            Self::Residual(_)
            | Self::Growth(_)
            | Self::NoLayers
            | Self::Shakedown(ShakedownError::NotConverged { .. }) => Exit::NotConverged,
            Self::Shakedown(_) => Exit::BadInput,
            Self::System { .. } => Exit::CannotReadOrWrite,
        }
    }
}

/// Lets the computation tell how far it is and learn that it should stop.
struct Watcher<'a> {
    progress: &'a dyn Tell,
    interruption: &'a Interruption,
}

impl Observer for Watcher<'_> {
    fn progress(&self, fraction: f64) {
        self.progress.fraction(fraction);
    }

    fn interrupted(&self) -> bool {
        self.interruption.asked()
    }
}

/// Computes the steps of `source` into `recorder` until the run ends or is interrupted, and writes summary and plots. What the
/// computation held is free before these are built.
///
/// Errors: a step cannot be computed (the steps before it are kept, with summary and plots); the system refuses to
/// write.
pub fn drive(
    source: impl StepSource,
    recorder: &mut Recorder,
    progress: &dyn Tell,
    interruption: &Interruption,
) -> Result<(Ending, Summary), RunError> {
    let watcher = Watcher { progress, interruption };
    let computed = compute(source, recorder, &watcher);
    progress.close();
    match computed {
        Ok(ending) => Ok((ending, recorder.finish()?)),
        // After a refusal to write, another attempt would hide it.
        Err(RunError::Output(error @ OutputError::Io { .. })) => Err(error.into()),
        Err(error) => {
            recorder.finish()?;
            Err(error)
        }
    }
}

/// Steps that may wait to be written while the next one is computed.
const WAITING: usize = 1;

/// Computes step after step while another thread writes the one before.
fn compute(source: impl StepSource, recorder: &mut Recorder, watcher: &Watcher) -> Result<Ending, RunError> {
    let progress = watcher.progress;
    std::thread::scope(|scope| {
        let (finished, to_write) = sync_channel::<(StepRecord, GrowthState)>(WAITING);
        let writer = scope.spawn(move || -> Result<(), OutputError> {
            for (record, state) in to_write {
                recorder.record(&record, &state)?;
                progress.finished(&record);
            }
            Ok(())
        });
        let ending = compute_into(source, watcher, finished);
        // What was computed is written before anything else is said of the run.
        match writer.join() {
            Ok(written) => written?,
            Err(panic) => std::panic::resume_unwind(panic),
        }
        ending
    })
}

/// Computes steps into `finished` until the run ends, is interrupted or fails, or nobody takes them any more.
fn compute_into(
    mut source: impl StepSource,
    watcher: &Watcher,
    finished: SyncSender<(StepRecord, GrowthState)>,
) -> Result<Ending, RunError> {
    while source.state().ended.is_none() {
        if watcher.interrupted() {
            return Ok(Ending::Interrupted);
        }
        let record = match source.next_step(watcher) {
            Ok(Some(record)) => record,
            Ok(None) => break,
            Err(GrowthError::Interrupted { .. }) => return Ok(Ending::Interrupted),
            Err(error) => return Err(error.into()),
        };
        if finished.send((record, source.state().clone())).is_err() {
            break;
        }
    }
    Ok(Ending::Ended)
}
