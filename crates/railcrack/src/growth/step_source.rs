//! Sources of growth steps, whatever they are computed from.

use super::{CrackedRail, Growth, GrowthError, GrowthState, Observer, StepRecord};

/// A source of growth steps: [`Growth`] in the plane or in space, and synthetic runs in tests.
pub trait StepSource {
    /// The next step; none when the run has ended. On an error the state is that before the step.
    ///
    /// Errors: those of [`Growth::next_step`].
    fn next_step(&mut self, observer: &dyn Observer) -> Result<Option<StepRecord>, GrowthError>;

    /// The state after the last computed step.
    fn state(&self) -> &GrowthState;
}

impl<R: CrackedRail> StepSource for Growth<R> {
    fn next_step(&mut self, observer: &dyn Observer) -> Result<Option<StepRecord>, GrowthError> {
        Growth::next_step(self, observer)
    }

    fn state(&self) -> &GrowthState {
        Growth::state(self)
    }
}

impl<S: StepSource + ?Sized> StepSource for Box<S> {
    fn next_step(&mut self, observer: &dyn Observer) -> Result<Option<StepRecord>, GrowthError> {
        (**self).next_step(observer)
    }

    fn state(&self) -> &GrowthState {
        (**self).state()
    }
}
