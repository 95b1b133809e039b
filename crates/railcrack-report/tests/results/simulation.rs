//! Runs of synthetic steps: interruption, resumption, refusals.

use super::support::{SMALL, Scratch, case, info, step};
use railcrack::growth::{GrowthError, GrowthState, Observer, StepRecord, StepSource};
use railcrack_report::Pages;
use railcrack_run::OutputError;
use railcrack_run::simulation::{Ending, Finished, Job, RunEntry, RunError, RunObserver, Stage, run_steps};
use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

/// Stops the run once it is asked to.
#[derive(Default)]
struct Stopper(AtomicBool);

impl RunObserver for Stopper {
    fn interrupted(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// A synthetic run that is interrupted in the step `interrupted_in`.
struct Synthetic<'a> {
    state: GrowthState,
    interrupted_in: Option<usize>,
    stopper: &'a Stopper,
}

impl StepSource for Synthetic<'_> {
    fn next_step(&mut self, watch: &dyn Observer) -> Result<Option<StepRecord>, GrowthError> {
        let now = self.state.step;
        watch.progress(0.5);
        if self.interrupted_in == Some(now) {
            self.stopper.0.store(true, Ordering::Relaxed);
        }
        if watch.interrupted() {
            return Err(GrowthError::Interrupted { step: now });
        }
        let (record, state) = step(SMALL, now);
        self.state = state;
        Ok(Some(record))
    }

    fn state(&self) -> &GrowthState {
        &self.state
    }
}

/// Runs into `folder`, interrupted in a step or not.
pub(super) fn run(
    folder: &Path,
    entry: RunEntry,
    interrupted_in: Option<usize>,
) -> Result<Finished, RunError> {
    let stopper = Stopper::default();
    let job = Job { case: case(), info: info() };
    let start = |stage: Stage| {
        let mut initial = step(SMALL, 0).1;
        initial.step = 0;
        let state = stage.state.unwrap_or(initial);
        Ok((Synthetic { state, interrupted_in, stopper: &stopper }, None))
    };
    run_steps(folder, entry, job, &stopper, &Pages, start, |_, _| Ok(()))
}

#[test]
fn an_interrupted_run_resumes_to_the_same_tables() {
    let scratch = Scratch::new("simulation-resume");
    let (whole, cut) = (scratch.path().join("whole"), scratch.path().join("cut"));
    run(&whole, RunEntry::Begin, None).unwrap();
    let interrupted = run(&cut, RunEntry::Begin, Some(2)).unwrap();
    assert_eq!(interrupted.ending, Ending::Interrupted);
    assert!(!interrupted.summary.complete);
    // Interrupted again before anything new: nothing is lost.
    assert_eq!(run(&cut, RunEntry::Resume, Some(2)).unwrap().summary.steps_recorded, 2);
    assert_eq!(run(&cut, RunEntry::Resume, None).unwrap().ending, Ending::Ended);
    assert_eq!(run(&cut, RunEntry::Resume, None).unwrap().summary.steps_recorded, SMALL.increments + 1);
    for file in ["case.toml", "sif.csv", "growth.csv", "faces.csv", "plots/ki.svg", "plots/faces-last.svg"] {
        let read = |folder: &Path| fs::read(folder.join(file)).unwrap();
        assert!(read(&whole) == read(&cut), "{file}");
    }
}

#[test]
fn a_folder_is_entered_as_the_entry_says() {
    let scratch = Scratch::new("simulation-entry");
    let folder = scratch.path().join("run");
    let refused = |entry| run(&folder, entry, None).unwrap_err();
    assert!(matches!(refused(RunEntry::Resume), RunError::Output(OutputError::NoRun { .. })));
    run(&folder, RunEntry::ResumeOrBegin, Some(1)).unwrap();
    assert!(matches!(refused(RunEntry::Begin), RunError::Output(OutputError::HoldsRun { .. })));
    assert_eq!(run(&folder, RunEntry::ResumeOrBegin, None).unwrap().ending, Ending::Ended);
    run(&folder, RunEntry::Replace, None).unwrap();
    let file = scratch.path().join("file.txt");
    fs::write(&file, "").unwrap();
    let not_a_folder = run(&file, RunEntry::Begin, None).unwrap_err();
    assert!(matches!(not_a_folder, RunError::Output(OutputError::Io { .. })), "{not_a_folder}");
}
