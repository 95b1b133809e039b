//! Simulation: what `railcrack run`, `shakedown` and `sweep` compute, also for users of the
//! library.

mod companions;
mod drive;
mod each;
mod error;
#[cfg(test)]
mod fault_tests;
mod job;
mod memory;
mod observer;
mod plan;
mod plan_outcome;
mod plan_samples;
mod queue;
mod recorder;
mod residual_stress;
mod rolling;
mod run;
mod sweep;
mod variations;

pub(crate) use companions::variants;
pub use drive::Ending;
pub use error::RunError;
pub use job::{Job, Stage, case_files};
pub use memory::{RunByStep, RunInMemory};
pub use observer::{RunObserver, Silent, StudyObserver};
pub use plan::PlanRequest;
pub use queue::{NextRun, RunQueue, WaitingRun};
pub use recorder::Recorder;
pub use residual_stress::{Residual, plastic_stress_left_out};
pub use rolling::{pass_text, roll, rolled_by};
pub use run::{Finished, RunEntry, Simulation, run_steps};
pub use sweep::{FailedRun, StudyComputation, study_plan};
