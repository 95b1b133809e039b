//! Runs in memory whose caller asks for one step after another.

use super::drive::OfSteps;
use super::error::RunError;
use super::job::Stage;
use super::memory::RunInMemory;
use super::run::Simulation;
use railcrack::growth::{StepRecord, StepSource};
use std::path::Path;

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
        let (growth, residual) = self.growth(stage)?;
        let mut run = RunInMemory::begun(self.job());
        run.residual = residual;
        Ok(RunByStep { run, growth })
    }

    /// Computes the other runs that the decision on `by_step` needs, once it has ended.
    ///
    /// Errors: an interruption.
    pub fn accompany_by_step(&self, by_step: &mut RunByStep, scratch: &Path) -> Result<(), RunError> {
        self.accompany(&mut by_step.run, scratch)
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
