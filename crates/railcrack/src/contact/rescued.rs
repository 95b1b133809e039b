//! Load steps by one contact solver, and those in which it fails by another one.

use super::{ContactSolver, FaceProblem, FaceResponse, LoadStep, NotConverged, StepSolver};

/// The first solver, with the second one for the load steps in which the first one fails: where the
/// faces snap from one state to another, one step of a passage.
#[derive(Clone, Copy)]
pub(crate) struct Rescued<'a> {
    /// The solver of all other steps.
    pub first: &'a dyn ContactSolver,
    /// The solver of the steps in which the first one fails.
    pub second: &'a dyn ContactSolver,
}

impl ContactSolver for Rescued<'_> {
    fn prepare<'a>(&self, problem: &'a FaceProblem<'a>) -> Box<dyn StepSolver<'a> + 'a> {
        Box::new(RescuedSteps { first: self.first.prepare(problem), second: self.second.prepare(problem) })
    }
}

struct RescuedSteps<'a> {
    first: Box<dyn StepSolver<'a> + 'a>,
    second: Box<dyn StepSolver<'a> + 'a>,
}

impl<'a> StepSolver<'a> for RescuedSteps<'a> {
    fn solve(&mut self, step: LoadStep, faces: &mut FaceResponse<'a>) -> Result<usize, NotConverged> {
        let failure = match self.first.solve(step, faces) {
            Err(failure) => failure,
            solved => return solved,
        };
        let by_second = self.second.solve(step, faces).map_err(|_| failure)?;
        Ok(failure.iterations + by_second)
    }

    fn keep(&mut self) {
        self.first.keep();
        self.second.keep();
    }

    fn restore(&mut self) {
        self.first.restore();
        self.second.restore();
    }
}
