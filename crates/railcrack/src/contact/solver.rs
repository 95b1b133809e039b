//! Contact solvers: one implicit load step on the crack faces.

use super::{FaceProblem, FaceResponse};
use thiserror::Error;

/// One implicit load step: the forces at its end, and the slip from which friction counts.
#[derive(Debug, Clone, Copy)]
pub struct LoadStep<'a> {
    /// Nodal forces of the removed uncracked stress, N/mm, 2p.
    pub forces: &'a [f64],
    /// Slip (mm, p) of each point where it last touched or, if it is open, where it is expected to
    /// touch.
    pub reference_slip: &'a [f64],
    /// The pressure (MPa) over the mouth of each pocket of fluid whose pressure is an unknown.
    pub outside: &'a [f64],
}

/// A step that could not be solved.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error(
    "contact not converged after {iterations} iterations: indicator {indicator:.3e}, tolerance {tolerance:.1e}"
)]
pub struct NotConverged {
    /// Iterations spent.
    pub iterations: usize,
    /// The value reached.
    pub indicator: f64,
    /// The value asked for.
    pub tolerance: f64,
}

/// A method of solving load steps.
pub trait ContactSolver: Sync {
    /// Makes ready for steps on the faces of `problem`, from virgin faces.
    fn prepare<'a>(&self, problem: &'a FaceProblem<'a>) -> Box<dyn StepSolver<'a> + 'a>;
}

/// A solver at work on the faces of one body.
pub trait StepSolver<'a> {
    /// Solves a step from the solution in `faces`, which is in equilibrium under `step.forces` with
    /// the statuses of the last step, and leaves the new solution there; returns the iterations.
    /// After an error `faces` holds no solution.
    fn solve(&mut self, step: LoadStep, faces: &mut FaceResponse<'a>) -> Result<usize, NotConverged>;
    /// Makes what the solver remembers of the current solution the one to return to.
    fn keep(&mut self);
    /// Returns to what was kept.
    fn restore(&mut self);
}
