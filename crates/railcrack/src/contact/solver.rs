//! Contact solvers for implicit load steps on the crack faces.

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
