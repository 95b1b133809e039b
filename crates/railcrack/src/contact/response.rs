//! The linear response of the faces while no point changes its status.

use super::active_inverse::{ActiveInverse, add_rows};
use super::{FaceProblem, FaceSolution, PointStatus};
use crate::math::axpy;

/// The faces with their statuses: for given loads the jumps of the free components and the forces of the held ones
/// follow linearly. Newton's method works on it; the step control uses it to foresee events.
pub struct FaceResponse<'a> {
    problem: &'a FaceProblem<'a>,
    active: ActiveInverse<'a>,
    /// A times the held slips.
    held: Vec<f64>,
    /// A w of the last equilibrium, work space.
    forces: Vec<f64>,
    solution: FaceSolution,
    kept: Kept<'a>,
}

/// What to return to. The inverse is copied when the first status changes, not before.
struct Kept<'a> {
    active: ActiveInverse<'a>,
    held: Vec<f64>,
    solution: FaceSolution,
    changes: Changes,
}

/// Whether statuses have changed since the last [`FaceResponse::keep`].
#[derive(Clone, Copy, PartialEq, Eq)]
enum Changes {
    None,
    Some,
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
            held: vec![0.0; 2 * points],
            forces: vec![0.0; 2 * points],
            solution: FaceSolution::virgin(points),
            kept: Kept {
                active: ActiveInverse::new(problem.stiffness()),
                held: vec![0.0; 2 * points],
                solution: FaceSolution::virgin(points),
                changes: Changes::None,
            },
        }
    }

    /// Makes the present statuses and values those to return to.
    pub(super) fn keep(&mut self) {
        self.kept.held.clone_from(&self.held);
        self.kept.solution.clone_from(&self.solution);
        self.kept.changes = Changes::None;
    }

    /// Returns to what was kept.
    pub(super) fn restore(&mut self) {
        if self.kept.changes == Changes::Some {
            self.active.copy_from(&self.kept.active);
            self.kept.changes = Changes::None;
        }
        self.held.clone_from(&self.kept.held);
        self.solution.clone_from(&self.kept.solution);
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
        if self.kept.changes == Changes::None {
            self.kept.changes = Changes::Some;
            self.kept.active.copy_from(&self.active);
        }
        let old = self.solution.status[point];
        self.solution.status[point] = status;
        let mut sound = true;
        if old == PointStatus::Stick {
            self.hold_at(point, 0.0);
        } else {
            sound &= self.active.remove(t);
        }
        if old == PointStatus::Open && status != PointStatus::Open {
            sound &= self.active.remove(n);
        }
        match status {
            PointStatus::Open => {
                if old != PointStatus::Open {
                    sound &= self.active.add(n, 0.0);
                }
                sound &= self.active.add(t, 0.0);
            }
            PointStatus::Stick => {
                self.solution.jump[t] = 0.0;
                self.hold_at(point, reference);
            }
            PointStatus::SlipForward | PointStatus::SlipBackward => {
                sound &= self.active.add(t, status.direction() * self.problem.friction(point));
            }
        }
        if status.is_closed() {
            self.solution.jump[n] = 0.0;
        }
        if sound || self.active.refresh().is_ok() { Ok(()) } else { Err(Degenerate) }
    }

    /// Holds a sticking `point` at `slip` (mm).
    pub(super) fn hold_at(&mut self, point: usize, slip: f64) {
        let component = 2 * point;
        let change = slip - self.solution.jump[component];
        if change != 0.0 {
            self.solution.jump[component] = slip;
            axpy(change, self.problem.stiffness().row(component), &mut self.held);
        }
    }

    /// The jumps of the free components under the nodal forces `load`, without the contact forces.
    pub(super) fn move_free(&mut self, load: &[f64]) {
        let Self { active, held, solution, .. } = self;
        let right: Vec<f64> = active
            .free()
            .iter()
            .map(|&i| {
                let coupling = active.coupling(i);
                let own = load[i] - held[i];
                if coupling == 0.0 { own } else { own + coupling * (load[i + 1] - held[i + 1]) }
            })
            .collect();
        for (&i, jump) in active.free().iter().zip(active.solve(&right)) {
            solution.jump[i] = jump;
        }
    }

    /// The contact forces under the nodal forces `load` at the present jumps, which are those of equilibrium.
    pub(super) fn load_faces(&mut self, load: &[f64]) {
        let scale = load.iter().chain(&self.held).fold(0.0f64, |m, v| m.max(v.abs()));
        self.sum_forces(load);
        if self.residual() > DRIFT * scale && self.active.refresh().is_ok() {
            self.move_free(load);
            self.sum_forces(load);
        }
    }

    /// Contact forces = A w − load.
    fn sum_forces(&mut self, load: &[f64]) {
        let Self { problem, active, held, forces, solution, .. } = self;
        let stiffness = problem.stiffness();
        forces.copy_from_slice(held);
        let free = active.free();
        let jumps: Vec<f64> = free.iter().map(|&i| solution.jump[i]).collect();
        add_rows(&jumps, |k| stiffness.row(free[k]), forces);
        for (contact, (force, load)) in solution.contact.iter_mut().zip(forces.iter().zip(load)) {
            *contact = force - load;
        }
    }

    /// The largest residual of the equations of the free components, N/mm.
    fn residual(&self) -> f64 {
        let contact = &self.solution.contact;
        self.active.free().iter().fold(0.0f64, |worst, &i| {
            let coupling = self.active.coupling(i);
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
                self.hold_at(point, slip);
            }
        }
        self.solution.clone_from(solution);
        Ok(())
    }
}
