//! Interface of contact solvers, and one that is rescued by another.

use super::{FaceProblem, FaceResponse};
use thiserror::Error;

/// An implicit load step: the forces at its end, and the slip from which friction is measured.
#[derive(Debug, Clone, Copy)]
pub struct LoadStep<'a> {
    /// Nodal forces of the removed uncracked stress, N/mm, 2p.
    pub forces: &'a [f64],
    /// Slip (mm, p) of each point at its last contact or, for an open point, at its expected
    /// contact.
    pub reference_slip: &'a [f64],
    /// The pressure (MPa) over the mouth of each pocket of fluid whose pressure is an unknown.
    pub outside: &'a [f64],
}

/// A load step without convergence.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error(
    "contact not converged after {iterations} iterations: indicator {indicator:.3e}, tolerance {tolerance:.1e}"
)]
pub struct NotConverged {
    /// Number of iterations.
    pub iterations: usize,
    /// The indicator reached.
    pub indicator: f64,
    /// The required indicator.
    pub tolerance: f64,
}

/// A method of solving load steps.
pub trait ContactSolver: Sync {
    /// Prepares load steps on the faces of `problem`, from virgin faces.
    fn prepare<'a>(&self, problem: &'a FaceProblem<'a>) -> Box<dyn StepSolver<'a> + 'a>;
}

/// A solver prepared for the faces of one body.
pub trait StepSolver<'a> {
    /// Solves a step from the solution in `faces`, which is in equilibrium under `step.forces` with
    /// the statuses of the last step, and leaves the new solution there; returns the iterations.
    /// After an error `faces` does not hold a solution.
    fn solve(&mut self, step: LoadStep, faces: &mut FaceResponse<'a>) -> Result<usize, NotConverged>;
    /// Saves the data of the solver on the current solution for [`StepSolver::restore`].
    fn keep(&mut self);
    /// Restores the saved data.
    fn restore(&mut self);
}

/// The load of a path: nodal forces as a function of one coordinate.
pub trait LoadPath: Sync {
    /// Nodal forces (N/mm, 2p) at coordinate `at`.
    fn nodal_forces(&self, at: f64) -> Vec<f64>;

    /// The pressure (MPa) at coordinate `at` over the mouth of each pocket of fluid whose pressure
    /// is an unknown; none where there are none.
    fn over_mouths(&self, _at: f64) -> Vec<f64> {
        Vec::new()
    }

    /// Whether the coordinate is the position (mm) of a wheel that feels the cracks.
    fn is_of_coupled_wheel(&self) -> bool {
        false
    }
}

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
