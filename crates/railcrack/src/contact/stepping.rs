//! Adaptive load steps: friction remembers the order of events.

use super::forecast::{Forecast, Motion, Turn, shorter_than};
use super::span::{Combination, LoadSpan};
use super::{
    ContactSolver, FaceProblem, FaceResponse, FaceScale, FaceSolution, LoadStep, NotConverged, PointStatus,
    StepSolver,
};
use thiserror::Error;

/// The load of a path: nodal forces as a function of one coordinate.
pub trait LoadPath: Sync {
    /// Nodal forces (N/mm, 2p) at coordinate `at`.
    fn nodal_forces(&self, at: f64) -> Vec<f64>;
}

/// How the load steps of a path are chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum StepControl {
    /// Steps end where points touch or turn back, as finely as the tolerance asks for.
    #[default]
    Adaptive,
    /// One step from station to station, as in a code without control: a point that closes and sticks within a step is
    /// held at the slip it had at the start of the step. The error in locked slip is of first order in the step.
    Fixed,
}

/// A path that could not be followed.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum SteppingError {
    /// The contact did not converge at the smallest step.
    #[error("at path coordinate {at}: {failure}")]
    NotConverged {
        /// Where.
        at: f64,
        /// How.
        failure: NotConverged,
    },
    /// No end of the steps between two stations.
    #[error(
        "at path coordinate {at}: {attempts} load steps were tried between {from} and {to}, and as many are allowed"
    )]
    TooManySteps {
        /// Where.
        at: f64,
        /// How many steps were tried.
        attempts: usize,
        /// Where the way began.
        from: f64,
        /// Where it should have ended.
        to: f64,
    },
    /// Whoever watches asked to stop.
    #[error("interrupted at path coordinate {at}")]
    Interrupted {
        /// Where.
        at: f64,
    },
}

/// Effort of following a path.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SteppingCounts {
    /// Accepted steps that end between stations.
    pub substeps: usize,
    /// Contact solutions, rejected ones included.
    pub solves: usize,
    /// Contact iterations of all solutions.
    pub iterations: usize,
    /// The most iterations of one solution.
    pub iterations_max: usize,
    /// Largest violation of the law of the faces.
    pub violation_max: f64,
}

/// Follows load paths with steps that end where points touch.
///
/// Between changes of status the response to the load has no memory, so a step has no error of its own. What a step can
/// get wrong is the slip at which a point is held when it closes, or stops slipping, within the step. Before each step
/// the linear response of the unchanged statuses at its end foresees such events and the slip at their moment; a step in
/// which a point with an event would slip by more than `tolerance` of the largest jump seen there is cut so that it ends
/// shortly before the event.
pub struct Stepper<'a> {
    problem: &'a FaceProblem<'a>,
    solver: Box<dyn StepSolver<'a> + 'a>,
    faces: FaceResponse<'a>,
    tolerance: f64,
    control: StepControl,
    /// Slip or opening of each point that counts as large, mm.
    scale: Vec<f64>,
    /// The largest jump and force so far.
    largest: FaceScale,
    /// The accepted solution.
    current: FaceSolution,
    /// The last step.
    last: Option<LastStep>,
    at: f64,
    load: Vec<f64>,
    counts: SteppingCounts,
    interrupted: &'a (dyn Fn() -> bool + Sync),
}

/// Steps that are tried between two stations at most. Passages need some hundreds for all of their stations together; thousands between two
/// of them are a solver that goes in circles.
const MOST_ATTEMPTS: usize = 3000;
/// Steps between two stations at most in which the contact does not converge, each of hundreds of iterations. Halving a step down to the
/// smallest takes 24 of them.
const MOST_FAILURES: usize = 48;
/// Steps that are tried between two stations before their loads are combined of a few, and components from which on that saves more than it
/// costs.
const PLAIN_ATTEMPTS: usize = 1;
const MANY_COMPONENTS: usize = 300;
/// Slip of a point in a step in which it touches or turns back, over the tolerance times the largest jump seen there.
/// Measured in `docs/step-control.md`.
const FREE_SLIP: f64 = 0.7;
/// Slip that counts as large before any has been seen, as a share of the slip without contact.
const EXPECTED_SHARE: f64 = 1e-3;
/// Smallest step as a fraction of the distance between stations.
const SMALLEST: f64 = 1e-7;

/// What the step before the current solution tells of the next one.
struct LastStep {
    length: f64,
    /// Slip of each point per unit of path.
    slip_rates: Vec<f64>,
    /// Change of each point's margin against slipping (N/mm) per unit of path.
    margin_rates: Vec<f64>,
}

/// Whether a step may be cut for accuracy.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Cutting {
    Allowed,
    Over,
}

impl<'a> Stepper<'a> {
    /// Virgin faces without load. `tolerance` is that on K relative to its peak; `expected` (mm, p) is the slip that
    /// each point would show without contact, for the scale of first events.
    pub fn new(
        problem: &'a FaceProblem<'a>,
        solver: &dyn ContactSolver,
        tolerance: f64,
        expected: &[f64],
    ) -> Self {
        Self {
            problem,
            solver: solver.prepare(problem),
            faces: FaceResponse::virgin(problem),
            tolerance,
            control: StepControl::Adaptive,
            scale: expected.iter().map(|slip| EXPECTED_SHARE * slip.abs()).collect(),
            largest: FaceScale::NONE,
            current: FaceSolution::virgin(problem.points()),
            last: None,
            at: 0.0,
            load: vec![0.0; 2 * problem.points()],
            counts: SteppingCounts::default(),
            interrupted: &|| false,
        }
    }

    /// The same with another control of the steps.
    pub fn with_control(self, control: StepControl) -> Self {
        Self { control, ..self }
    }

    /// The same, given up as soon as `interrupted` says so: it is asked before each step.
    pub fn with_interruption(self, interrupted: &'a (dyn Fn() -> bool + Sync)) -> Self {
        Self { interrupted, ..self }
    }

    /// The current solution.
    pub fn solution(&self) -> &FaceSolution {
        &self.current
    }

    /// The nodal forces of the current solution.
    pub fn load(&self) -> &[f64] {
        &self.load
    }

    /// The effort so far.
    pub fn counts(&self) -> SteppingCounts {
        self.counts
    }

    /// Begins a new path at coordinate `start`: its load there must be the current one.
    pub fn begin(&mut self, start: f64) {
        self.at = start;
        self.last = None;
    }

    /// Follows `path` to `station`, in as many steps as the tolerance asks for. `accepted` sees every accepted solution
    /// with its forces.
    ///
    /// Errors: contact does not converge in the smallest step, or in too many; the steps find no end; an interruption.
    pub fn advance(
        &mut self,
        path: &dyn LoadPath,
        station: f64,
        accepted: &mut dyn FnMut(&FaceSolution, &[f64]),
    ) -> Result<(), SteppingError> {
        let from = self.at;
        let whole = station - from;
        let mut step = whole;
        let (mut attempts, mut failures) = (0, 0);
        let mut span: Option<LoadSpan> = None;
        while self.at != station {
            if (self.interrupted)() {
                return Err(SteppingError::Interrupted { at: self.at });
            }
            if attempts == MOST_ATTEMPTS {
                return Err(SteppingError::TooManySteps { at: self.at, attempts, from, to: station });
            }
            if attempts == PLAIN_ATTEMPTS && self.load.len() >= MANY_COMPONENTS {
                let loads = LoadSpan::new(path, self.at, station);
                self.faces.remember(loads.loads().clone());
                span = Some(loads);
            }
            attempts += 1;
            let target = if step.abs() >= (station - self.at).abs() { station } else { self.at + step };
            let smallest = (target - self.at).abs() <= SMALLEST * whole.abs();
            let cutting =
                if smallest || self.control == StepControl::Fixed { Cutting::Over } else { Cutting::Allowed };
            let (load, combination) = match &span {
                Some(span) => span.load(path, target),
                None => (path.nodal_forces(target), None),
            };
            match self.attempt((load, combination.as_ref()), target, cutting) {
                Ok(None) => {
                    if target != station {
                        self.counts.substeps += 1;
                    }
                    accepted(&self.current, &self.load);
                    step = station - self.at;
                }
                Ok(Some(shorter)) => step = shorter.abs().max(SMALLEST * whole.abs()).copysign(whole),
                Err(failure) => {
                    failures += 1;
                    if smallest || failures == MOST_FAILURES {
                        return Err(SteppingError::NotConverged { at: target, failure });
                    }
                    step = 0.5 * (target - self.at);
                }
            }
        }
        Ok(())
    }

    /// Tries a step to the `load` at `target`. `Some(step)` asks for a shorter one; the solution is then as before.
    fn attempt(
        &mut self,
        (load, combination): (Vec<f64>, Option<&Combination>),
        target: f64,
        cutting: Cutting,
    ) -> Result<Option<f64>, NotConverged> {
        let step = target - self.at;
        self.faces.keep();
        let forecasts = self.foresee(&load, combination, step)?;
        let events = forecasts.iter().enumerate().filter(|(j, _)| self.problem.friction(*j) > 0.0);
        let wishes = events.filter_map(|(j, forecast)| forecast.cut(self.allowed(j), step));
        if let (Some(shorter), Cutting::Allowed) = (wishes.reduce(shortest), cutting) {
            self.faces.restore();
            return Ok(Some(shorter));
        }
        let reference_slip: Vec<f64> = match self.control {
            StepControl::Adaptive => forecasts.iter().map(|f| f.slip).collect(),
            StepControl::Fixed => self.current.jump.iter().step_by(2).copied().collect(),
        };
        self.solver.keep();
        let solved =
            self.solver.solve(LoadStep { forces: &load, reference_slip: &reference_slip }, &mut self.faces);
        self.counts.solves += 1;
        let iterations = solved.inspect_err(|failure| {
            self.counts.iterations += failure.iterations;
            self.solver.restore();
            self.faces.restore();
        })?;
        self.counts.iterations += iterations;
        self.counts.iterations_max = self.counts.iterations_max.max(iterations);
        if cutting == Cutting::Allowed
            && let Some(shorter) = self.unforeseen(&forecasts, step)
        {
            self.solver.restore();
            self.faces.restore();
            return Ok(Some(shorter));
        }
        self.accept(target, load);
        Ok(None)
    }

    /// What each point would do in a step to `load` of length `step` if no point changed its status.
    fn foresee(
        &mut self,
        load: &[f64],
        combination: Option<&Combination>,
        step: f64,
    ) -> Result<Vec<Forecast>, NotConverged> {
        if self.faces.equilibrate(load, combination).is_err() {
            self.faces.restore();
            return Err(NotConverged { iterations: 0, indicator: f64::INFINITY, tolerance: self.tolerance });
        }
        let end = self.faces.solution();
        let motion = |j: usize| Motion {
            status: self.current.status[j],
            slip: (self.current.jump[2 * j], end.jump[2 * j]),
            opening: (self.current.jump[2 * j + 1], end.jump[2 * j + 1]),
            last_rate: self.last.as_ref().map(|last| (last.slip_rates[j], last.length)),
        };
        Ok((0..self.problem.points()).map(|j| Forecast::of(&motion(j), step)).collect())
    }

    /// A shorter step for an event that was not foreseen, since another one caused it or since it is over by the end of
    /// the step.
    fn unforeseen(&self, forecasts: &[Forecast], step: f64) -> Option<f64> {
        let after = self.faces.solution();
        let wish = |(j, forecast): (usize, &Forecast)| {
            let change = (self.current.status[j], after.status[j]);
            if change == (PointStatus::Stick, PointStatus::Stick) {
                return self.passing_slip(j, after, step);
            }
            let gone = after.jump[2 * j] - self.current.jump[2 * j];
            let last = self.last.as_ref().map(|last| (last.slip_rates[j], last.length));
            forecast.cut_unforeseen(change, gone, last, self.allowed(j), step)
        };
        let points = forecasts.iter().enumerate().filter(|(j, _)| self.problem.friction(*j) > 0.0);
        points.filter_map(wish).reduce(shortest)
    }

    /// A step to the moment at which point `j`, which sticks before and `after`, slips in between: its margin against
    /// slipping, a parabola through the last steps, falls below zero by a force that moves the point too far.
    fn passing_slip(&self, j: usize, after: &FaceSolution, step: f64) -> Option<f64> {
        let last = self.last.as_ref()?;
        let start = self.margin(&self.current, j);
        let rate = (self.margin(after, j) - start) / step;
        let lowest = Turn::of((last.margin_rates[j], last.length), rate, step)?;
        let moved = -(start + lowest.change) * self.problem.body().compliance()[(2 * j, 2 * j)];
        (moved > self.allowed(j)).then(|| shorter_than(step, lowest.path))
    }

    /// How far (N/mm) the shear force of point `j` is below that at which it slips.
    fn margin(&self, solution: &FaceSolution, j: usize) -> f64 {
        self.problem.friction(j) * solution.contact[2 * j + 1] - solution.contact[2 * j].abs()
    }

    /// Makes the solution in `faces` the current one.
    fn accept(&mut self, target: f64, load: Vec<f64>) {
        let step = target - self.at;
        let after = self.faces.solution();
        self.largest = self.largest.including(after, &load);
        self.counts.violation_max =
            self.counts.violation_max.max(after.violation(self.problem, self.largest));
        let points = 0..self.scale.len();
        let slip_rate = |j: usize| (after.jump[2 * j] - self.current.jump[2 * j]) / step;
        let margin_rate = |j: usize| (self.margin(after, j) - self.margin(&self.current, j)) / step;
        let last = LastStep {
            length: step,
            slip_rates: points.clone().map(slip_rate).collect(),
            margin_rates: points.map(margin_rate).collect(),
        };
        for (j, scale) in self.scale.iter_mut().enumerate() {
            *scale = scale.max(after.jump[2 * j].abs()).max(after.jump[2 * j + 1].abs());
        }
        self.current.clone_from(after);
        self.last = Some(last);
        self.at = target;
        self.load = load;
    }

    /// Slip of point `j` in a step with an event that leaves K within the tolerance, mm.
    fn allowed(&self, j: usize) -> f64 {
        FREE_SLIP * self.tolerance * self.scale[j]
    }
}

fn shortest(one: f64, other: f64) -> f64 {
    if other.abs() < one.abs() { other } else { one }
}
