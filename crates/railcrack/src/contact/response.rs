//! The linear response of the faces while no point changes its status.

use super::condition::{Condition, Degenerate};
use super::span::Combination;
use super::tableau::Tableau;
use super::{FaceProblem, FaceSolution, PointStatus};
use crate::math::Matrix;

/// The faces with their statuses: for given loads the jumps of the free components and the forces of the held ones
/// follow linearly. Newton's method works on it; the step control uses it to foresee events.
pub struct FaceResponse<'a> {
    problem: &'a FaceProblem<'a>,
    tableau: Tableau<'a>,
    solution: FaceSolution,
    kept: FaceSolution,
}

impl<'a> FaceResponse<'a> {
    /// Virgin unloaded faces that just touch.
    pub(super) fn virgin(problem: &'a FaceProblem<'a>) -> Self {
        let points = problem.points();
        Self {
            problem,
            tableau: Tableau::new(problem.stiffness()),
            solution: FaceSolution::virgin(points),
            kept: FaceSolution::virgin(points),
        }
    }

    /// Makes the present statuses and values those to return to.
    pub(super) fn keep(&mut self) {
        self.tableau.keep();
        self.kept.clone_from(&self.solution);
    }

    /// Returns to what was kept.
    pub(super) fn restore(&mut self) {
        self.tableau.restore();
        self.solution.clone_from(&self.kept);
    }

    /// The last equilibrium and its statuses.
    pub fn solution(&self) -> &FaceSolution {
        &self.solution
    }

    /// Gives `point` another status, from the next equilibrium on; one that sticks is held at slip `reference` (mm).
    pub(super) fn set_status(&mut self, point: usize, status: PointStatus, reference: f64) {
        self.solution.status[point] = status;
        let coupling = status.direction() * self.problem.friction(point);
        let (shear, normal) = match status {
            PointStatus::Open => (Condition::Free(0.0), Condition::Free(0.0)),
            PointStatus::Stick => (Condition::Held(reference), Condition::Held(0.0)),
            PointStatus::SlipForward | PointStatus::SlipBackward => {
                (Condition::Free(coupling), Condition::Held(0.0))
            }
        };
        self.tableau.set(2 * point, shear);
        self.tableau.set(2 * point + 1, normal);
    }

    /// Remembers `loads` (N/mm, each a row), of which others will be combined.
    pub(super) fn remember(&mut self, loads: Matrix) {
        self.tableau.remember(loads);
    }

    /// Jumps and contact forces under the nodal forces `load` with the present statuses; `combination` is how the load is combined of those
    /// remembered, if it is.
    pub(super) fn equilibrate(
        &mut self,
        load: &[f64],
        combination: Option<&Combination>,
    ) -> Result<(), Degenerate> {
        let FaceSolution { jump, contact, .. } = &mut self.solution;
        self.tableau.solve(load, combination, jump, contact)
    }

    /// [`FaceResponse::equilibrate`] after changes of status, under the same `load`.
    pub(super) fn equilibrate_again(&mut self, load: &[f64]) -> Result<(), Degenerate> {
        let FaceSolution { jump, contact, .. } = &mut self.solution;
        self.tableau.solve_again(load, jump, contact)
    }

    /// Takes over statuses and values of `solution`, which is in equilibrium.
    pub(super) fn adopt(&mut self, solution: &FaceSolution) {
        for (point, &status) in solution.status.iter().enumerate() {
            self.set_status(point, status, solution.jump[2 * point]);
        }
        self.solution.clone_from(solution);
    }
}
