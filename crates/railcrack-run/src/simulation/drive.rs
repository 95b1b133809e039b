//! The loop of a run: compute a step, write it, notify the observer.

use super::error::RunError;
use super::observer::RunObserver;
use super::recorder::Recorder;
use crate::error::OutputError;
use crate::summary::Summary;
use railcrack::growth::{GrowthError, GrowthState, Observer, StepRecord, StepSource};
use std::sync::mpsc::{SyncSender, sync_channel};

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// By itself: all steps done, or a physical stop.
    Ended,
    /// By the user; `--resume` continues it.
    Interrupted,
}

/// Passes the observer of a run to the computation of a step.
pub(super) struct OfSteps<'a>(pub(super) &'a dyn RunObserver);

impl Observer for OfSteps<'_> {
    fn progress(&self, fraction: f64) {
        self.0.fraction(fraction);
    }

    fn interrupted(&self) -> bool {
        self.0.interrupted()
    }
}

/// Computes the steps of `source` into `recorder` until the run ends or is interrupted, and writes
/// summary and plots. What the computation held is free before `accompany` adds what the decision
/// needs, and these are built.
///
/// Errors: a step cannot be computed (the steps before it are kept, with summary and plots); the
/// system refuses to write.
pub(super) fn drive(
    source: impl StepSource,
    recorder: &mut Recorder,
    observer: &dyn RunObserver,
    accompany: impl FnOnce(&mut Recorder, &GrowthState) -> Result<(), RunError>,
) -> Result<(Ending, Summary), RunError> {
    let mut last = None;
    let computed = compute(source, observer, |record, state| {
        recorder.record(&record, &state)?;
        observer.finished(&record);
        last = Some(state);
        Ok(())
    });
    let accompanied = match (&computed, last.filter(|state| state.ended.is_some())) {
        (Ok(Ending::Ended), Some(state)) => accompany(recorder, &state),
        _ => Ok(()),
    };
    observer.close();
    match computed {
        Ok(Ending::Ended) => ended(accompanied, recorder),
        Ok(ending) => Ok((ending, recorder.finish()?)),
        // After a refusal to write, another attempt would hide it.
        Err(RunError::Output(error @ OutputError::Io { .. })) => Err(error.into()),
        Err(error) => {
            recorder.finish()?;
            Err(error)
        }
    }
}

/// The summary of a run that ended, unless its companions were interrupted.
///
/// Errors: that of its companions; the system refuses to write.
pub(super) fn ended(
    accompanied: Result<(), RunError>,
    recorder: &mut Recorder,
) -> Result<(Ending, Summary), RunError> {
    let summary = recorder.finish()?;
    match accompanied {
        Ok(()) => Ok((Ending::Ended, summary)),
        Err(error) if error.is_interruption() => Ok((Ending::Interrupted, summary)),
        Err(error) => Err(error),
    }
}

/// Steps that may wait to be written while the next one is computed.
const WAITING: usize = 1;

/// Computes step after step while another thread stores the previous one with `keep`.
///
/// Errors: a step cannot be computed, or not be kept.
pub(super) fn compute(
    source: impl StepSource,
    observer: &dyn RunObserver,
    mut keep: impl FnMut(StepRecord, GrowthState) -> Result<(), OutputError> + Send,
) -> Result<Ending, RunError> {
    std::thread::scope(|scope| {
        let (finished, to_keep) = sync_channel::<(StepRecord, GrowthState)>(WAITING);
        let keeper = scope.spawn(move || -> Result<(), OutputError> {
            to_keep.into_iter().try_for_each(|(record, state)| keep(record, state))
        });
        let ending = compute_into(source, observer, finished);
        // What was computed is stored before anything else is reported about the run.
        match keeper.join() {
            Ok(kept) => kept?,
            Err(panic) => std::panic::resume_unwind(panic),
        }
        ending
    })
}

/// Computes steps into `finished` until the run ends, is interrupted or fails, or until the
/// receiver is gone.
fn compute_into(
    mut source: impl StepSource,
    observer: &dyn RunObserver,
    finished: SyncSender<(StepRecord, GrowthState)>,
) -> Result<Ending, RunError> {
    while source.state().ended.is_none() {
        if observer.interrupted() {
            return Ok(Ending::Interrupted);
        }
        let record = match source.next_step(&OfSteps(observer)) {
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
