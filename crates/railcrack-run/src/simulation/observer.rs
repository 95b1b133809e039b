//! Observers, which receive the progress of a computation and may interrupt it.

use crate::study::PlannedRun;
use railcrack::growth::StepRecord;

/// Observes a run.
pub trait RunObserver: Sync {
    /// The run goes on with growth step `first`, from 0.
    fn begins(&self, _first: usize) {}
    /// The fraction (0 to 1) of the current growth step that is done.
    fn fraction(&self, _fraction: f64) {}
    /// A growth step is finished and written.
    fn finished(&self, _record: &StepRecord) {}
    /// A stage before the first growth step.
    fn stage(&self, _text: &str) {}
    /// A message to the user before the first growth step.
    fn note(&self, _text: &str) {}
    /// No step follows.
    fn close(&self) {}
    /// Whether to stop: the current step is abandoned, those before it are kept.
    fn interrupted(&self) -> bool {
        false
    }
}

/// Observer that reports nothing and never interrupts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Silent;

impl RunObserver for Silent {}

/// Passes on only whether to stop.
pub(super) struct AskedAlone<'a>(pub &'a dyn RunObserver);

impl RunObserver for AskedAlone<'_> {
    fn interrupted(&self) -> bool {
        self.0.interrupted()
    }
}

/// Observes the runs of a study, which may be computed in parallel.
pub trait StudyObserver: Sync {
    /// The observer of a run of `steps` growth steps.
    fn of_run(&self, steps: usize) -> Box<dyn RunObserver + '_>;
    /// A run has ended; `text` describes how.
    fn over(&self, _run: &PlannedRun, _text: &str) {}
    /// A run is left to the process that computes it, as `text` states.
    fn left(&self, run: &PlannedRun, text: &str) {
        self.over(run, text);
    }
    /// Whether to stop: runs that are being computed are interrupted, and no other is begun.
    fn interrupted(&self) -> bool {
        false
    }
}

impl StudyObserver for Silent {
    fn of_run(&self, _: usize) -> Box<dyn RunObserver + '_> {
        Box::new(Self)
    }
}
