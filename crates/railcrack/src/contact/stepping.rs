//! Adaptive load steps: friction depends on the order of events.

use super::pocket_trace::OutsidePressure;
use super::pressure::{content, total, violation};
use super::trace::{Accuracy, LetsOff, StepLoad, Stop, Trace, follow};
use super::{
    ContactSolver, FaceProblem, FaceResponse, FaceScale, FaceSolution, LoadStep, NotConverged, PocketState,
    PocketStatus, PointStatus, StepSolver,
};
use crate::math::axpy;
use crate::words::{Choice, Word};
use std::ops::Range;
use thiserror::Error;

/// The load of a path: nodal forces as a function of one coordinate.
pub trait LoadPath: Sync {
    /// Nodal forces (N/mm, 2p) at coordinate `at`.
    fn nodal_forces(&self, at: f64) -> Vec<f64>;

    /// The pressure (MPa) at coordinate `at` over the mouth of each pocket of fluid whose pressure
    /// is an unknown; none where there are none.
    fn over_mouths(&self, _at: f64) -> Vec<f64> {
        Vec::new()
    }
}

/// How the load steps of a path are chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum StepControl {
    /// Points touch, stick, slip and open one after the other within a step, along a parabola of
    /// the load; a step is as long as the tolerance lets that be accurate.
    #[default]
    Adaptive,
    /// One step from station to station, as in a code without control: a point that closes and
    /// sticks within a step is held at the slip it had at the start of the step. The error in
    /// locked slip is of first order in the step.
    Fixed,
}

impl Choice for StepControl {
    const WORDS: &'static [(Self, Word)] = &[
        (
            Self::Adaptive,
            Word::now(
                "adaptive",
                "changes of contact status are resolved in their order, and load steps are refined by step_tolerance",
            ),
        ),
        (Self::Fixed, Word::now("fixed", "one load step from output position to output position")),
    ];
}

/// A path that could not be followed.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
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
    /// The observer asked to stop.
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
    /// Largest violation of the contact conditions.
    pub violation_max: f64,
}

/// Follows load paths from station to station, event by event.
///
/// Between changes of status the response to the load has no memory, and a load step has no error.
/// An error arises only in the slip at which a point is held when it closes, or stops slipping,
/// within the step. All changes of status are therefore followed in their order along a parabola of
/// the load; where the difference between parabola and load would change the slip of such a point
/// by more than `tolerance` of the largest jump seen there, the step is cut. The end of a step is
/// solved under the exact load.
pub struct Stepper<'a> {
    pub(super) problem: &'a FaceProblem<'a>,
    solver: Box<dyn StepSolver<'a> + 'a>,
    pub(super) faces: FaceResponse<'a>,
    pub(super) tolerance: f64,
    control: StepControl,
    /// Slip or opening of each point that counts as large, mm.
    scale: Vec<f64>,
    /// The largest jump and force so far.
    pub(super) largest: FaceScale,
    /// The accepted solution.
    pub(super) current: FaceSolution,
    pub(super) at: f64,
    pub(super) load: Vec<f64>,
    /// Pressure over the mouth of each pocket, MPa.
    pub(super) outside: Vec<f64>,
    /// The largest pressure of fluid or over a mouth so far, MPa.
    pub(super) largest_pressure: f64,
    counts: SteppingCounts,
    interrupted: &'a (dyn Fn() -> bool + Sync),
    visited: Option<Visited>,
    /// Memory of a step.
    memory: StepMemory,
}

/// Load and faces on their way through a step.
#[derive(Default)]
struct StepMemory {
    load: StepLoad,
    trace: Trace,
}

/// The jumps of some points on the way: at every accepted solution, and wherever a status changes.
#[derive(Debug, Clone)]
struct Visited {
    points: Range<usize>,
    /// Of each path the coordinates with the jumps, mm.
    paths: Vec<Vec<(f64, Vec<f64>)>>,
}

impl Visited {
    fn add(&mut self, at: f64, solution: &FaceSolution) {
        let jump = solution.jump[2 * self.points.start..2 * self.points.end].to_vec();
        if let Some(path) = self.paths.last_mut() {
            path.push((at, jump));
        }
    }
}

/// State that faces carry from one part of their path to another.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FaceHistory {
    /// The accepted solution.
    pub solution: FaceSolution,
    /// Slip or opening of each point that counts as large, mm.
    pub scale: Vec<f64>,
    /// The largest jump and force so far.
    pub largest: FaceScale,
    /// Nodal forces, N/mm.
    pub load: Vec<f64>,
}

impl FaceHistory {
    /// Virgin faces of `points` points without load; `expected` as in [`Stepper::new`].
    pub(crate) fn virgin(points: usize, expected: &[f64]) -> Self {
        Self {
            solution: FaceSolution::virgin(points),
            scale: expected.iter().map(|slip| EXPECTED_SHARE * slip.abs()).collect(),
            largest: FaceScale::NONE,
            load: vec![0.0; 2 * points],
        }
    }
}

/// Steps that are tried between two stations at most. Passages need some hundreds for all of their
/// stations together; thousands between two of them are a solver that goes in circles.
const MOST_ATTEMPTS: usize = 3000;
/// Steps between two stations at most in which the contact does not converge, each of hundreds of
/// iterations. Halving a step down to the smallest takes 24 of them.
const MOST_FAILURES: usize = 48;
/// Error of the slip at which a point is held, over the tolerance times the largest jump seen
/// there. Measured in `docs/step-control.md`.
const HELD_SLIP: f64 = 0.2;
/// Slip that counts as large before any has been seen, as a share of the slip without contact.
const EXPECTED_SHARE: f64 = 2e-2;
/// Difference of two jumps, over the error that a step may make, that is none.
const ALIKE: f64 = 1e-3;
/// Steps that are shorter than this share of the way between stations do not look for the place
/// within them at which fluid is let off.
const PLACED: f64 = 1e-3;
/// Share of itself by which a step that ends where fluid is let off goes beyond that place, so that
/// the way out is open at its end.
const BEYOND: f64 = 1e-3;
/// Smallest step as a fraction of the distance between stations.
const SMALLEST: f64 = 1e-7;

/// How a step went.
enum Attempt {
    Accepted,
    /// To be tried with this share of its length.
    Shorter(f64),
    /// The same, without tracing.
    Untraced(f64),
    /// To be tried again, the fluid to be let off at its end.
    ThenLetOff,
}

/// A step that can be followed to less than this share of it is made untraced, with a share
/// [`UNTRACED`] of its length; others end at this share of what could be followed.
const EARLY: f64 = 0.05;
const UNTRACED: f64 = 1.0 / 16.0;
const BEFORE: f64 = 0.95;

impl<'a> Stepper<'a> {
    /// Virgin faces without load. `tolerance` is that on K relative to its peak; `expected` (mm, p)
    /// is the slip that each point would show without contact, for the scale of first events.
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
            current: FaceSolution::virgin_of(problem),
            at: 0.0,
            load: vec![0.0; 2 * problem.points()],
            outside: vec![0.0; problem.pockets().len()],
            largest_pressure: 0.0,
            counts: SteppingCounts::default(),
            interrupted: &|| false,
            visited: None,
            memory: StepMemory::default(),
        }
    }

    /// Faces that go on from `history`.
    pub(crate) fn from_history(
        problem: &'a FaceProblem<'a>,
        solver: &dyn ContactSolver,
        tolerance: f64,
        history: FaceHistory,
    ) -> Self {
        let mut stepper = Self::new(problem, solver, tolerance, &[]);
        stepper.faces.adopt(&history.solution);
        stepper.scale = history.scale;
        stepper.largest = history.largest;
        stepper.current = history.solution;
        stepper.load = history.load;
        stepper
    }

    /// All that is to be known to go on from here.
    pub(crate) fn history(&self) -> FaceHistory {
        FaceHistory {
            solution: self.current.clone(),
            scale: self.scale.clone(),
            largest: self.largest,
            load: self.load.clone(),
        }
    }

    /// The same with another control of the steps.
    pub(crate) fn with_control(self, control: StepControl) -> Self {
        Self { control, ..self }
    }

    /// The same, given up as soon as `interrupted` says so: it is asked before each step.
    pub(crate) fn with_interruption(self, interrupted: &'a (dyn Fn() -> bool + Sync)) -> Self {
        Self { interrupted, ..self }
    }

    /// The same, to keep the jumps of `points` on the way.
    pub(crate) fn with_visits(self, points: Range<usize>) -> Self {
        Self { visited: Some(Visited { points, paths: Vec::new() }), ..self }
    }

    /// The jumps (mm) of the points of [`Stepper::with_visits`] along each path since, with their
    /// coordinates: from its beginning on, at every accepted solution and wherever a status
    /// changes.
    pub(crate) fn take_visits(&mut self) -> Vec<Vec<(f64, Vec<f64>)>> {
        self.visited.as_mut().map_or(Vec::new(), |visited| std::mem::take(&mut visited.paths))
    }

    /// The current solution.
    pub fn solution(&self) -> &FaceSolution {
        &self.current
    }

    /// Whether the current solution is `other`, as far as what comes after it can tell: the same
    /// statuses, and jumps that differ by less than a thousandth of the error that a step may make.
    pub(crate) fn is_like(&self, other: &FaceSolution) -> bool {
        let near = |i: usize| (self.current.jump[i] - other.jump[i]).abs() <= ALIKE * self.allowed(i / 2);
        let filled = |(one, other): (&PocketState, &PocketState)| {
            let near = (one.content - other.content).abs() <= ALIKE * self.tolerance * other.content.abs();
            one.status == other.status && near
        };
        let fluid = self.current.fluid.iter().zip(&other.fluid);
        self.current.status == other.status && fluid.clone().all(filled) && (0..other.jump.len()).all(near)
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
        if let Some(visited) = &mut self.visited {
            visited.paths.push(Vec::new());
            visited.add(start, &self.current);
        }
    }

    /// Follows `path` to `station`, in as many steps as the tolerance asks for. `accepted` sees
    /// every accepted solution, and the faces wherever a status changes on the way to it, with
    /// their forces.
    ///
    /// Errors: contact does not converge in the smallest step, or in too many; the steps find no
    /// end; an interruption.
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
        let mut control = self.control;
        let mut lets_off = LetsOff::There;
        while self.at != station {
            if (self.interrupted)() {
                return Err(SteppingError::Interrupted { at: self.at });
            }
            if attempts == MOST_ATTEMPTS {
                return Err(SteppingError::TooManySteps { at: self.at, attempts, from, to: station });
            }
            attempts += 1;
            let target = if step.abs() >= (station - self.at).abs() { station } else { self.at + step };
            let smallest = (target - self.at).abs() <= SMALLEST * whole.abs();
            if (target - self.at).abs() <= PLACED * whole.abs() {
                lets_off = LetsOff::AtItsEnd;
            }
            let manner = (if smallest { StepControl::Fixed } else { control }, lets_off);
            match self.attempt(path, target, manner, accepted) {
                Ok(Attempt::Accepted) => {
                    if target != station {
                        self.counts.substeps += 1;
                    }
                    self.let_off_all(accepted)?;
                    step = station - self.at;
                    control = self.control;
                    lets_off = LetsOff::There;
                }
                Ok(Attempt::Shorter(share)) => step = share * (target - self.at),
                Ok(Attempt::ThenLetOff) => lets_off = LetsOff::AtItsEnd,
                Ok(Attempt::Untraced(share)) => {
                    step = share * (target - self.at);
                    control = StepControl::Fixed;
                }
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

    /// Tries a step to `target`. If it is not accepted, the solution is as before.
    fn attempt(
        &mut self,
        path: &dyn LoadPath,
        target: f64,
        (control, lets_off): (StepControl, LetsOff),
        accepted: &mut dyn FnMut(&FaceSolution, &[f64]),
    ) -> Result<Attempt, NotConverged> {
        let (end, outside) = (path.nodal_forces(target), path.over_mouths(target));
        self.largest_pressure = outside.iter().fold(self.largest_pressure, |most, p| most.max(*p));
        self.faces.keep();
        let has_memory = self.problem.has_friction() || !self.problem.pockets().is_empty();
        let result = if control == StepControl::Adaptive && has_memory {
            self.traced(path, target, (end, outside), lets_off, accepted)
        } else {
            self.untraced(target, (end, outside), accepted)
        };
        if !matches!(result, Ok(Attempt::Accepted)) {
            self.solver.restore();
            self.faces.restore();
        }
        result
    }

    /// A step in which all events are met in their order.
    fn traced(
        &mut self,
        path: &dyn LoadPath,
        target: f64,
        (end, outside): (Vec<f64>, Vec<f64>),
        lets_off: LetsOff,
        accepted: &mut dyn FnMut(&FaceSolution, &[f64]),
    ) -> Result<Attempt, NotConverged> {
        let mut memory = std::mem::take(&mut self.memory);
        memory.load.lead_through(&self.load, &path.nodal_forces(0.5 * (self.at + target)), end);
        let result = self.traced_on(&mut memory, path, target, (outside, lets_off), accepted);
        self.memory = memory;
        result
    }

    /// [`Stepper::traced`] along the load in the memory.
    fn traced_on(
        &mut self,
        StepMemory { load, trace }: &mut StepMemory,
        path: &dyn LoadPath,
        target: f64,
        (outside_end, lets_off): (Vec<f64>, LetsOff),
        accepted: &mut dyn FnMut(&FaceSolution, &[f64]),
    ) -> Result<Attempt, NotConverged> {
        let along = |share: f64| self.at + share * (target - self.at);
        let outside = OutsidePressure::through(&self.outside, &path.over_mouths(along(0.5)), &outside_end);
        let (problem, current) = (self.problem, &self.current);
        self.faces.load_on(&load.start, &load.end, [&load.first, &load.second]);
        self.solver.keep();
        let scale = self.largest.including(&self.current, &load.end);
        let (tolerance, scale_of) = (self.tolerance, &self.scale);
        let accuracy = Accuracy {
            missed: &|| {
                let exact = path.nodal_forces(along(0.75));
                let mut missed: Vec<f64> =
                    exact.iter().zip(load.at(0.75)).map(|(exact, assumed)| exact - assumed).collect();
                let pressures = path.over_mouths(along(0.75));
                for (k, (pocket, assumed)) in problem.pockets().iter().zip(outside.at(0.75)).enumerate() {
                    let follows =
                        matches!(current.fluid[k].status, PocketStatus::Leaking | PocketStatus::Vented);
                    let by = if follows { pressures[k] - assumed } else { 0.0 };
                    axpy(by, &pocket.unit, &mut missed);
                }
                missed
            },
            allowed: &|j| allowed(tolerance, scale_of[j]),
            outside: outside.clone(),
            loud: self.loud(),
            lets_off,
        };
        match follow(self.problem, &mut self.faces, &self.current, scale, accuracy, trace) {
            Ok(()) => {}
            Err(Stop::Inaccurate { excess }) => return Ok(Attempt::Shorter((0.9 / excess.cbrt()).max(0.2))),
            Err(Stop::Lost { share }) if share > EARLY => return Ok(Attempt::Shorter(BEFORE * share)),
            Err(Stop::Lost { .. }) => return Ok(Attempt::Untraced(UNTRACED)),
            // The step ends where fluid finds its way out.
            Err(Stop::LetsOff { share }) if share > 1.0 - 2.0 * BEYOND => return Ok(Attempt::ThenLetOff),
            Err(Stop::LetsOff { share }) => return Ok(Attempt::Shorter((share * (1.0 + BEYOND)).max(EARLY))),
        }
        self.solve(&load.end, &trace.reference_slip, &outside_end)?;
        let after = self.faces.solution();
        let astray = |j: usize| {
            let (traced, solved) = (trace.now.status[j], after.status[j]);
            let holds = traced != solved && solved.is_closed() && traced != PointStatus::Stick;
            let slip = (after.jump[2 * j] - self.current.jump[2 * j]).abs();
            holds && self.problem.friction(j) > 0.0 && slip > self.allowed(j)
        };
        if (0..self.problem.points()).any(astray) {
            return Ok(Attempt::Shorter(0.5));
        }
        let leaks = |state: &PocketState| state.status == PocketStatus::Leaking;
        let closes =
            trace.now.fluid.iter().zip(&after.fluid).any(|(traced, solved)| leaks(traced) != leaks(solved));
        if closes && lets_off == LetsOff::There {
            return Ok(Attempt::Shorter(0.5));
        }
        let from = self.at;
        for change in trace.changes() {
            if let Some(visited) = &mut self.visited {
                visited.add(from + change.share * (target - from), &change.solution);
            }
            accepted(&change.solution, &total(self.problem, &change.solution, load.at(change.share)));
        }
        Ok(self.accept(target, (std::mem::take(&mut load.end), outside_end), accepted))
    }

    /// A step whose events all count as at its start.
    fn untraced(
        &mut self,
        target: f64,
        (end, outside): (Vec<f64>, Vec<f64>),
        accepted: &mut dyn FnMut(&FaceSolution, &[f64]),
    ) -> Result<Attempt, NotConverged> {
        self.faces.load(&end);
        let reference_slip: Vec<f64> = self.current.jump.iter().step_by(2).copied().collect();
        self.solver.keep();
        self.solve(&end, &reference_slip, &outside)?;
        Ok(self.accept(target, (end, outside), accepted))
    }

    /// Solves contact under `forces` from the statuses in `faces`.
    fn solve(&mut self, forces: &[f64], reference_slip: &[f64], outside: &[f64]) -> Result<(), NotConverged> {
        self.faces.set_outside(outside);
        if self.faces.equilibrate().is_err() {
            return Err(NotConverged { iterations: 0, indicator: f64::INFINITY, tolerance: self.tolerance });
        }
        let solved = self.solver.solve(LoadStep { forces, reference_slip, outside }, &mut self.faces);
        self.counts.solves += 1;
        let iterations = match &solved {
            Ok(iterations) => *iterations,
            Err(failure) => failure.iterations,
        };
        self.counts.iterations += iterations;
        self.counts.iterations_max = self.counts.iterations_max.max(iterations);
        solved.map(|_| ())
    }

    /// Makes the solution in `faces` the current one.
    fn accept(
        &mut self,
        target: f64,
        (load, outside): (Vec<f64>, Vec<f64>),
        accepted: &mut dyn FnMut(&FaceSolution, &[f64]),
    ) -> Attempt {
        let after = self.faces.solution();
        self.largest = self.largest.including(after, &load);
        self.counts.violation_max =
            self.counts.violation_max.max(after.violation(self.problem, self.largest));
        let of_fluid = violation(self.problem, after, self.largest);
        self.counts.violation_max = self.counts.violation_max.max(of_fluid);
        for (j, scale) in self.scale.iter_mut().enumerate() {
            *scale = scale.max(after.jump[2 * j].abs()).max(after.jump[2 * j + 1].abs());
        }
        self.current.clone_from(after);
        self.at = target;
        if let Some(visited) = &mut self.visited {
            visited.add(target, &self.current);
        }
        self.load = load;
        self.outside = outside;
        for k in 0..self.current.fluid.len() {
            let state = self.current.fluid[k];
            self.largest_pressure = self.largest_pressure.max(state.pressure);
            if state.status == PocketStatus::Leaking {
                let content = content(self.problem, &self.current, k);
                self.set_pocket(k, PocketState { content, ..state });
            }
        }
        accepted(&self.current, &total(self.problem, &self.current, &self.load));
        Attempt::Accepted
    }

    /// Error (mm) of the slip at which point `j` is held that leaves K within the tolerance.
    fn allowed(&self, j: usize) -> f64 {
        allowed(self.tolerance, self.scale[j])
    }
}

/// The same for a point whose jumps go up to `scale`, mm.
fn allowed(tolerance: f64, scale: f64) -> f64 {
    HELD_SLIP * tolerance * scale
}
