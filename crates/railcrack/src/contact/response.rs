//! The linear response of the faces while no point changes its status.

use super::active_inverse::ActiveInverse;
use super::{FaceProblem, FaceSolution, PointStatus};

/// The faces with their statuses: for given loads the jumps of the free components and the forces of the held ones
/// follow linearly. Newton's method works on it; the step control uses it to foresee events.
pub struct FaceResponse<'a> {
    problem: &'a FaceProblem<'a>,
    active: ActiveInverse<'a>,
    /// A w of the last equilibrium, work space.
    forces: Vec<f64>,
    solution: FaceSolution,
    kept: FaceSolution,
}

/// Residual of the free equations, relative to the largest force, above which the inverse is made afresh.
const DRIFT: f64 = 1e-11;

/// Statuses whose equations have no solution: the pivot of a change vanished.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Degenerate;

impl<'a> FaceResponse<'a> {
    /// Virgin unloaded faces that just touch.
    pub(super) fn virgin(problem: &'a FaceProblem<'a>) -> Self {
        let points = problem.points();
        Self {
            problem,
            active: ActiveInverse::new(problem.stiffness()),
            forces: vec![0.0; 2 * points],
            solution: FaceSolution::virgin(points),
            kept: FaceSolution::virgin(points),
        }
    }

    /// Makes the present statuses and values those to return to.
    pub(super) fn keep(&mut self) {
        self.active.keep();
        self.kept.clone_from(&self.solution);
    }

    /// Returns to what was kept.
    pub(super) fn restore(&mut self) {
        self.active.restore();
        self.solution.clone_from(&self.kept);
    }

    /// The last equilibrium and its statuses.
    pub fn solution(&self) -> &FaceSolution {
        &self.solution
    }

    /// Gives `point` another status; one that sticks is held at slip `reference` (mm).
    pub(super) fn set_status(
        &mut self,
        point: usize,
        status: PointStatus,
        reference: f64,
    ) -> Result<(), Degenerate> {
        let (t, n) = (2 * point, 2 * point + 1);
        let old = self.solution.status[point];
        self.solution.status[point] = status;
        let mut sound = true;
        match (old.is_closed(), status.is_closed()) {
            (true, false) => sound &= self.active.free_with(n, 0.0),
            (false, true) => sound &= self.active.hold_at(n, 0.0),
            _ => {}
        }
        let coupling = status.direction() * self.problem.friction(point);
        if status == PointStatus::Stick {
            sound &= self.active.hold_at(t, reference);
            self.solution.jump[t] = reference;
        } else if !self.active.is_free_with(t, coupling) {
            if old != PointStatus::Stick {
                // Its old equation ends before another one begins.
                sound &= self.active.hold_at(t, 0.0);
            }
            sound &= self.active.free_with(t, coupling);
        }
        if sound || self.active.refresh().is_ok() { Ok(()) } else { Err(Degenerate) }
    }

    /// Holds a sticking `point` at `slip` (mm).
    pub(super) fn hold_at(&mut self, point: usize, slip: f64) -> Result<(), Degenerate> {
        self.solution.jump[2 * point] = slip;
        if self.active.hold_at(2 * point, slip) { Ok(()) } else { Err(Degenerate) }
    }

    /// The jumps under the nodal forces `load`, without the contact forces.
    pub(super) fn move_free(&mut self, load: &[f64]) {
        self.active.solve(load, &mut self.solution.jump);
    }

    /// [`FaceResponse::move_free`] after changes of status, under the same `load`.
    pub(super) fn move_free_again(&mut self, load: &[f64]) {
        self.active.solve_again(load, &mut self.solution.jump);
    }

    /// The contact forces under the nodal forces `load` at the present jumps, which are those of equilibrium.
    pub(super) fn load_faces(&mut self, load: &[f64]) {
        let scale = load.iter().chain(self.active.held()).fold(0.0f64, |m, v| m.max(v.abs()));
        self.sum_forces(load);
        if self.residual() > DRIFT * scale && self.active.refresh().is_ok() {
            self.move_free(load);
            self.sum_forces(load);
        }
    }

    /// Contact forces = A w − load.
    fn sum_forces(&mut self, load: &[f64]) {
        let Self { active, forces, solution, .. } = self;
        active.forces(&solution.jump, forces);
        for (contact, (force, load)) in solution.contact.iter_mut().zip(forces.iter().zip(load)) {
            *contact = force - load;
        }
    }

    /// The largest residual of the equations of the free components, N/mm.
    fn residual(&self) -> f64 {
        let contact = &self.solution.contact;
        self.active.free().fold(0.0f64, |worst, (i, coupling)| {
            let next = if coupling == 0.0 { 0.0 } else { coupling * contact[i + 1] };
            worst.max((contact[i] + next).abs())
        })
    }

    /// Takes over statuses and jumps of `solution`, which is in equilibrium.
    pub(super) fn adopt(&mut self, solution: &FaceSolution) -> Result<(), Degenerate> {
        for (point, &status) in solution.status.iter().enumerate() {
            let slip = solution.jump[2 * point];
            if self.solution.status[point] != status {
                self.set_status(point, status, slip)?;
            } else if status == PointStatus::Stick {
                self.hold_at(point, slip)?;
            }
        }
        self.solution.clone_from(solution);
        Ok(())
    }
}
