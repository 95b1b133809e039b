//! Semismooth Newton (primal–dual active set) on the law of the faces.

use super::active_inverse::{ActiveInverse, axpy};
use super::{ContactSolver, FaceProblem, FaceSolution, LoadStep, NotConverged, PointStatus, StepSolver};

/// Semismooth Newton: every point that breaks the law of its status changes it, until none does; the law then holds
/// exactly. Starts from the last step's statuses, so that most steps take one or two solutions of small updated
/// systems.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Newton {
    /// Iterations before the step is given up.
    pub max_iterations: usize,
}

impl Default for Newton {
    fn default() -> Self {
        Self { max_iterations: 200 }
    }
}

impl ContactSolver for Newton {
    fn prepare<'a>(&self, problem: &'a FaceProblem<'a>) -> Box<dyn StepSolver + 'a> {
        Box::new(NewtonSteps::new(problem, self.max_iterations))
    }
}

/// Iterations in which all points change at once; after that only the worst one does, which breaks cycles.
const SIMULTANEOUS: usize = 12;
/// Forces and jumps below this fraction of the largest are round-off.
const ROUND_OFF: f64 = 1e-11;
/// Residual of the free equations, relative to the largest force, above which the inverse is made afresh.
const DRIFT: f64 = 1e-10;

struct State<'a> {
    active: ActiveInverse<'a>,
    /// A times the held slips.
    held: Vec<f64>,
    solution: FaceSolution,
}

struct NewtonSteps<'a> {
    problem: &'a FaceProblem<'a>,
    max_iterations: usize,
    state: State<'a>,
    kept: State<'a>,
    /// Whether statuses have changed since `keep`: only then is the inverse worth copying back.
    changed: bool,
    /// A w, work space.
    forces: Vec<f64>,
    /// Largest jump and force seen, for round-off.
    scale: (f64, f64),
}

impl<'a> NewtonSteps<'a> {
    fn new(problem: &'a FaceProblem<'a>, max_iterations: usize) -> Self {
        let points = problem.points();
        let state = || State {
            active: ActiveInverse::new(problem.stiffness()),
            held: vec![0.0; 2 * points],
            solution: FaceSolution::virgin(points),
        };
        Self {
            problem,
            max_iterations,
            state: state(),
            kept: state(),
            changed: false,
            forces: vec![0.0; 2 * points],
            scale: (0.0, 0.0),
        }
    }

    fn hold(&mut self, point: usize, slip: f64) {
        let component = 2 * point;
        let change = slip - self.state.solution.jump[component];
        self.state.solution.jump[component] = slip;
        axpy(change, self.problem.stiffness().row(component), &mut self.state.held);
    }

    fn set_status(&mut self, point: usize, status: PointStatus, reference: f64) -> bool {
        let (t, n) = (2 * point, 2 * point + 1);
        let old = self.state.solution.status[point];
        let mu = self.problem.friction(point);
        self.save_before_change();
        self.state.solution.status[point] = status;
        if old == PointStatus::Stick {
            // The held slip joins the free components.
            let slip = self.state.solution.jump[t];
            axpy(-slip, self.problem.stiffness().row(t), &mut self.state.held);
        }
        let mut sound = true;
        if old != PointStatus::Stick {
            sound &= self.state.active.remove(t);
        }
        if old == PointStatus::Open {
            sound &= self.state.active.remove(n);
        }
        match status {
            PointStatus::Open => {
                sound = sound && self.state.active.add(n, 0.0) && self.state.active.add(t, 0.0);
            }
            PointStatus::Stick => {
                self.state.solution.jump[t] = 0.0;
                self.hold(point, reference);
            }
            PointStatus::SlipForward | PointStatus::SlipBackward => {
                sound = sound && self.state.active.add(t, status.direction() * mu);
            }
        }
        if status.is_closed() {
            self.state.solution.jump[n] = 0.0;
        }
        sound
    }

    fn save_before_change(&mut self) {
        if !self.changed {
            self.changed = true;
            self.kept.active.copy_from(&self.state.active);
        }
    }

    /// Jumps of the free components and forces of all, for the current statuses. Returns the largest residual.
    fn equilibrate(&mut self, load: &[f64]) -> f64 {
        let stiffness = self.problem.stiffness();
        let State { active, held, solution } = &mut self.state;
        let right: Vec<f64> = active
            .free()
            .iter()
            .map(|&i| {
                let coupling = active.coupling(i);
                let own = load[i] - held[i];
                if coupling == 0.0 { own } else { own + coupling * (load[i + 1] - held[i + 1]) }
            })
            .collect();
        self.forces.copy_from_slice(held);
        for (&i, jump) in active.free().iter().zip(active.solve(&right)) {
            solution.jump[i] = jump;
            axpy(jump, stiffness.row(i), &mut self.forces);
        }
        for (contact, (force, load)) in solution.contact.iter_mut().zip(self.forces.iter().zip(load)) {
            *contact = force - load;
        }
        active.free().iter().fold(0.0f64, |worst, &i| {
            let coupling = active.coupling(i);
            let next = if coupling == 0.0 { 0.0 } else { coupling * solution.contact[i + 1] };
            worst.max((solution.contact[i] + next).abs())
        })
    }

    /// The status that the law asks of `point`, and how far it is from it relative to round-off.
    fn demanded(&self, point: usize, reference: f64) -> Option<(PointStatus, f64)> {
        let solution = &self.state.solution;
        let (tangential, normal) = (solution.contact[2 * point], solution.contact[2 * point + 1]);
        let (slip, opening) = (solution.jump[2 * point], solution.jump[2 * point + 1]);
        let mu = self.problem.friction(point);
        let (jump_scale, force_scale) = self.scale;
        let status = solution.status[point];
        if status == PointStatus::Open {
            // The law met from this open state along equal directions in shear and pressure.
            let after = match slip - reference {
                ahead if ahead.abs() <= -mu * opening && mu > 0.0 => PointStatus::Stick,
                ahead if ahead >= 0.0 => PointStatus::SlipForward,
                _ => PointStatus::SlipBackward,
            };
            return (opening < -ROUND_OFF * jump_scale).then(|| (after, -opening / jump_scale));
        }
        if normal < -ROUND_OFF * force_scale {
            return Some((PointStatus::Open, -normal / force_scale));
        }
        if status == PointStatus::Stick {
            let excess = tangential.abs() - mu * normal;
            // Friction opposes slip: a force on the + face towards −x1 means slip towards +x1.
            let slipping =
                if tangential < 0.0 { PointStatus::SlipForward } else { PointStatus::SlipBackward };
            return (excess > ROUND_OFF * force_scale || mu == 0.0).then(|| (slipping, excess / force_scale));
        }
        let against = -(slip - reference) * status.direction();
        (mu > 0.0 && against > ROUND_OFF * jump_scale).then(|| (PointStatus::Stick, against / jump_scale))
    }
}

impl StepSolver for NewtonSteps<'_> {
    fn solve(&mut self, step: LoadStep) -> Result<usize, NotConverged> {
        let points = self.problem.points();
        for (point, &reference) in step.reference_slip.iter().enumerate() {
            if self.state.solution.status[point] == PointStatus::Stick
                && self.state.solution.jump[2 * point] != reference
            {
                self.hold(point, reference);
            }
        }
        let mut worst = 0.0f64;
        for iteration in 1..=self.max_iterations {
            let residual = self.equilibrate(step.forces);
            let largest = |values: &[f64]| values.iter().fold(0.0f64, |m, v| m.max(v.abs()));
            self.scale.0 = self.scale.0.max(largest(&self.state.solution.jump)).max(f64::MIN_POSITIVE);
            self.scale.1 = self.scale.1.max(largest(step.forces)).max(f64::MIN_POSITIVE);
            if residual > DRIFT * self.scale.1 {
                self.save_before_change();
                if self.state.active.refresh().is_ok() {
                    self.equilibrate(step.forces);
                }
            }
            let mut demands: Vec<(usize, PointStatus, f64)> = (0..points)
                .filter_map(|j| self.demanded(j, step.reference_slip[j]).map(|(status, by)| (j, status, by)))
                .collect();
            if demands.is_empty() {
                return Ok(iteration);
            }
            worst = demands.iter().fold(0.0, |w, d| w.max(d.2));
            if iteration > SIMULTANEOUS {
                demands.retain(|d| d.2 == worst);
                demands.truncate(1);
            }
            for (point, status, _) in demands {
                if !self.set_status(point, status, step.reference_slip[point]) {
                    return Err(NotConverged {
                        iterations: iteration,
                        indicator: worst,
                        tolerance: ROUND_OFF,
                    });
                }
            }
        }
        Err(NotConverged { iterations: self.max_iterations, indicator: worst, tolerance: ROUND_OFF })
    }

    fn solution(&self) -> &FaceSolution {
        &self.state.solution
    }

    fn keep(&mut self) {
        self.kept.held.clone_from(&self.state.held);
        self.kept.solution.clone_from(&self.state.solution);
        self.changed = false;
    }

    fn restore(&mut self) {
        if self.changed {
            self.state.active.copy_from(&self.kept.active);
            self.changed = false;
        }
        self.state.held.clone_from(&self.kept.held);
        self.state.solution.clone_from(&self.kept.solution);
    }
}
