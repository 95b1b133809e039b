//! Adaptive load steps along a load path, since friction depends on the order of events.

use super::pocket_trace::OutsidePressure;
use super::pressure::{content, total, violation};
use super::trace::{Accuracy, AtRelease, StepLoad, Stop, Trace, follow};
use super::uneven_path::{Agreement, CORRECTIONS, REPETITIONS, ShearAlongPath, WithShear};
use super::wheel_surface::SurfaceSystem;
use super::{
    ContactSolver, FaceProblem, FaceResponse, FaceScale, FaceSolution, LoadPath, LoadStep, NotConverged,
    PocketState, PocketStatus, PointStatus, StepSolver,
};
use crate::math::axpy;
use crate::words::{Choice, Word};
use std::ops::Range;
use thiserror::Error;

/// Control of the load steps along a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum StepControl {
    /// Points touch, stick, slip and open one after the other within a step, along a parabola of
    /// the load; the tolerance limits the length of a step.
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
                "changes of contact status are resolved one after another, and load steps are refined to step_tolerance",
            ),
        ),
        (Self::Fixed, Word::now("fixed", "one load step between successive output positions")),
    ];
}

/// Failures to follow a load path.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum SteppingError {
    /// The contact did not converge at the smallest step.
    #[error("at path coordinate {at}: {failure}")]
    NotConverged {
        /// Path coordinate.
        at: f64,
        /// The failure.
        failure: NotConverged,
    },
    /// Too many steps between two stations.
    #[error(
        "at path coordinate {at}: the limit of {attempts} load steps between {from} and {to} was reached"
    )]
    TooManySteps {
        /// Path coordinate.
        at: f64,
        /// Number of steps tried.
        attempts: usize,
        /// Path coordinate of the previous station.
        from: f64,
        /// Path coordinate of the next station.
        to: f64,
    },
    /// An interruption on request.
    #[error("interrupted at path coordinate {at}")]
    Interrupted {
        /// Path coordinate.
        at: f64,
    },
}

/// Whether a wheel feels the cracks at its present position.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Coupling {
    /// Its contact is part of the contact problem.
    Coupled,
    /// Its contact is that on the uncracked rail.
    Uncoupled,
}

/// Computational effort along a path.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SteppingCounts {
    /// Accepted steps that end between stations.
    pub substeps: usize,
    /// Contact solutions, rejected ones included.
    pub solves: usize,
    /// Contact iterations of all solutions.
    pub iterations: usize,
    /// Largest number of iterations of one solution.
    pub iterations_max: usize,
    /// Largest violation of the contact conditions.
    pub violation_max: f64,
}

/// Follows load paths from station to station, event by event.
///
/// Between changes of status the response to the load has no memory, and a load step has no error.
/// The only error is that of the slip at which a point is held after it closes, or stops slipping,
/// within the step. All changes of status are therefore followed in their order along a parabola of
/// the load; where the difference between parabola and load would change the slip of such a point
/// by more than `tolerance` of the largest jump seen there, the step is shortened. The end of a
/// step is solved under the exact load.
pub struct Stepper<'a> {
    pub(super) problem: &'a FaceProblem<'a>,
    solver: Box<dyn StepSolver<'a> + 'a>,
    pub(super) faces: FaceResponse<'a>,
    pub(super) tolerance: f64,
    control: StepControl,
    /// Reference size of slip and opening of each point, mm.
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
    shear: ShearAlongPath,
    /// Work arrays of a step.
    memory: StepMemory,
}

/// Load and faces during a step.
#[derive(Default)]
struct StepMemory {
    load: StepLoad,
    trace: Trace,
}

/// Jumps of selected points at every accepted solution and at every change of status.
#[derive(Debug, Clone)]
struct Visited {
    points: Range<usize>,
    /// For each path, coordinates and jumps (mm).
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

/// State of the faces that is carried from one part of their path to the next.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FaceHistory {
    /// The accepted solution.
    pub solution: FaceSolution,
    /// Reference size of slip and opening of each point, mm.
    pub scale: Vec<f64>,
    /// The largest jump and force so far.
    pub largest: FaceScale,
    /// Nodal forces, N/mm.
    pub load: Vec<f64>,
}

impl FaceHistory {
    /// Virgin faces of `problem` without load; `expected` as in [`Stepper::new`].
    pub(crate) fn virgin(problem: &FaceProblem, expected: &[f64]) -> Self {
        Self {
            solution: FaceSolution::virgin_of(problem),
            scale: expected.iter().map(|slip| EXPECTED_SHARE * slip.abs()).collect(),
            largest: FaceScale::NONE,
            load: vec![0.0; problem.components()],
        }
    }
}

/// Largest number of steps between two stations. Passages need some hundreds for all of their
/// stations together; thousands between two stations indicate a cycling solver.
const MOST_ATTEMPTS: usize = 3000;
/// Largest number of steps between two stations without convergence of the contact, each of
/// hundreds of iterations. Halving a step down to the smallest takes 24 of them.
const MOST_FAILURES: usize = 48;
/// Error of the slip at which a point is held, over the tolerance times the largest jump there so
/// far. Measured in `docs/dev/step-control.md`.
const HELD_SLIP: f64 = 0.2;
/// Initial reference size of the slip, as a share of the slip without contact.
const EXPECTED_SHARE: f64 = 2e-2;
/// Difference of two jumps, over the admissible error of a step, that is negligible.
const ALIKE: f64 = 1e-3;
/// Share of the distance between stations below which a step does not locate the point at which
/// fluid is released.
const PLACED: f64 = 1e-3;
/// Relative amount by which a step that ends at a release of fluid is prolonged, so that the path
/// to the mouth is open at its end.
const BEYOND: f64 = 1e-3;
/// Smallest step as a fraction of the distance between stations.
const SMALLEST: f64 = 1e-7;

/// Outcome of a step.
enum Attempt {
    Accepted,
    /// To be repeated with the shear that follows from its pressures.
    Again,
    /// To be repeated with this share of its length.
    Shorter(f64),
    /// To be repeated with this share of its length, without tracing.
    Untraced(f64),
    /// To be repeated, with fluid to be released at its end.
    ThenRelease,
}

/// A step that can be traced over less than the share [`EARLY`] is repeated untraced with the share
/// [`UNTRACED`] of its length; other steps are shortened to the share [`BEFORE`] of the traced
/// part.
const EARLY: f64 = 0.05;
const UNTRACED: f64 = 1.0 / 16.0;
const BEFORE: f64 = 0.95;

impl<'a> Stepper<'a> {
    /// Virgin faces without load. `tolerance` is that on K relative to its peak; `expected` (mm, p)
    /// is the slip that each point would show without contact, which scales the first events.
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
            load: vec![0.0; problem.components()],
            outside: vec![0.0; problem.pockets().len()],
            largest_pressure: 0.0,
            counts: SteppingCounts::default(),
            interrupted: &|| false,
            visited: None,
            shear: ShearAlongPath::default(),
            memory: StepMemory::default(),
        }
    }

    /// Faces that continue from `history`.
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

    /// The data required to continue from the current state.
    pub(crate) fn history(&self) -> FaceHistory {
        FaceHistory {
            solution: self.current.clone(),
            scale: self.scale.clone(),
            largest: self.largest,
            load: self.load.clone(),
        }
    }

    /// This stepper with the step control `control`.
    pub(crate) fn with_control(self, control: StepControl) -> Self {
        Self { control, ..self }
    }

    /// This stepper with an interruption: `interrupted` is called before each step and stops the
    /// path by returning true.
    pub(crate) fn with_interruption(self, interrupted: &'a (dyn Fn() -> bool + Sync)) -> Self {
        Self { interrupted, ..self }
    }

    /// This stepper with a record of the jumps of `points` along the path.
    pub(crate) fn with_visits(self, points: Range<usize>) -> Self {
        Self { visited: Some(Visited { points, paths: Vec::new() }), ..self }
    }

    /// The recorded jumps (mm) of the points of [`Stepper::with_visits`] for each path since the
    /// last call, with path coordinates: at the start, at every accepted solution and at every
    /// change of status.
    pub(crate) fn take_visits(&mut self) -> Vec<Vec<(f64, Vec<f64>)>> {
        self.visited.as_mut().map_or(Vec::new(), |visited| std::mem::take(&mut visited.paths))
    }

    /// The current solution.
    pub fn solution(&self) -> &FaceSolution {
        &self.current
    }

    /// Whether the current solution is equivalent to `other` for all later steps: the same
    /// statuses, and jumps that differ by less than a thousandth of the admissible error of a step.
    pub(crate) fn is_like(&self, other: &FaceSolution) -> bool {
        let near = |i: usize| (self.current.jump[i] - other.jump[i]).abs() <= ALIKE * self.allowed(i / 2);
        let filled = |(one, other): (&PocketState, &PocketState)| {
            let near = (one.content - other.content).abs() <= ALIKE * self.tolerance * other.content.abs();
            one.status == other.status && near
        };
        let fluid = self.current.fluid.iter().zip(&other.fluid);
        self.current.status == other.status
            && self.current.loaded == other.loaded
            && fluid.clone().all(filled)
            && (0..2 * self.problem.points()).all(near)
    }

    /// The current path coordinate.
    pub(crate) fn at(&self) -> f64 {
        self.at
    }

    /// The nodal forces of the current solution.
    pub fn load(&self) -> &[f64] {
        &self.load
    }

    /// The effort so far.
    pub fn counts(&self) -> SteppingCounts {
        self.counts
    }

    /// Begins a new path at coordinate `start`, where its load must equal the current load.
    pub fn begin(&mut self, start: f64) {
        self.at = start;
        if let Some(visited) = &mut self.visited {
            visited.paths.push(Vec::new());
            visited.add(start, &self.current);
        }
    }

    /// Follows `path` to `station`, in as many steps as the tolerance requires. `accepted` receives
    /// every accepted solution, and the faces at every change of status before it, with their
    /// forces.
    ///
    /// Errors: no convergence in the smallest step or in too many steps; too many steps; an
    /// interruption.
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
        let mut at_release = AtRelease::EndStep;
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
                at_release = AtRelease::Continue;
            }
            let manner = (if smallest { StepControl::Fixed } else { control }, at_release);
            match self.attempt(path, target, manner, accepted) {
                Ok(Attempt::Accepted) => {
                    if target != station {
                        self.counts.substeps += 1;
                    }
                    self.release_all(accepted)?;
                    step = station - self.at;
                    control = self.control;
                    at_release = AtRelease::EndStep;
                }
                Ok(Attempt::Again) => step = 0.5 * (target - self.at),
                Ok(Attempt::Shorter(share)) => step = share * (target - self.at),
                Ok(Attempt::ThenRelease) => at_release = AtRelease::Continue,
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

    /// Tries a step to `target`. If it is not accepted, the solution is unchanged.
    fn attempt(
        &mut self,
        path: &dyn LoadPath,
        target: f64,
        manner: (StepControl, AtRelease),
        accepted: &mut dyn FnMut(&FaceSolution, &[f64]),
    ) -> Result<Attempt, NotConverged> {
        let uneven = self.problem.wheel().is_some_and(SurfaceSystem::is_uneven);
        if !(uneven && path.is_of_coupled_wheel()) {
            return self.attempt_along(path, target, manner, accepted);
        }
        let (range, start) = ([self.at, target], self.shear.now.clone());
        let mut step = self.shear.ahead(target - self.at);
        let mut result = Ok(Attempt::Again);
        for _ in 0..REPETITIONS {
            self.shear.assumed = Some(step.clone());
            let with_shear = WithShear { path, range, start: &start, step: &step };
            result = self.attempt_along(&with_shear, target, manner, accepted);
            match result {
                Ok(Attempt::Again) => step = std::mem::take(&mut self.shear.found),
                Ok(Attempt::Accepted) => {
                    self.shear.advance(range[1] - range[0]);
                    return result;
                }
                _ => break,
            }
        }
        self.shear.assumed = None;
        result
    }

    /// [`Stepper::attempt`] with the shear that is part of `path`.
    fn attempt_along(
        &mut self,
        path: &dyn LoadPath,
        target: f64,
        (control, at_release): (StepControl, AtRelease),
        accepted: &mut dyn FnMut(&FaceSolution, &[f64]),
    ) -> Result<Attempt, NotConverged> {
        let (end, outside) = (path.nodal_forces(target), path.over_mouths(target));
        self.largest_pressure = outside.iter().fold(self.largest_pressure, |most, p| most.max(*p));
        self.faces.keep();
        // The pressure of fluid from the mouth rises with the contact that it supports.
        let supports = self.problem.wheel().is_some() && self.problem.fluid().is_some();
        let has_memory = self.problem.has_friction() || !self.problem.pockets().is_empty() || supports;
        let result = if control == StepControl::Adaptive && has_memory {
            self.traced(path, target, (end, outside), at_release, accepted)
        } else {
            self.untraced(target, (end, outside), accepted)
        };
        if !matches!(result, Ok(Attempt::Accepted)) {
            self.solver.restore();
            self.faces.restore();
        }
        result
    }

    /// A step that follows all events in their order.
    fn traced(
        &mut self,
        path: &dyn LoadPath,
        target: f64,
        (end, outside): (Vec<f64>, Vec<f64>),
        at_release: AtRelease,
        accepted: &mut dyn FnMut(&FaceSolution, &[f64]),
    ) -> Result<Attempt, NotConverged> {
        let mut memory = std::mem::take(&mut self.memory);
        memory.load.lead_through(&self.load, &path.nodal_forces(0.5 * (self.at + target)), end);
        let result = self.traced_on(&mut memory, path, target, (outside, at_release), accepted);
        self.memory = memory;
        result
    }

    /// [`Stepper::traced`] along the load in the work arrays.
    fn traced_on(
        &mut self,
        StepMemory { load, trace }: &mut StepMemory,
        path: &dyn LoadPath,
        target: f64,
        (outside_end, at_release): (Vec<f64>, AtRelease),
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
            release_excess: self.release_excess(),
            at_release,
        };
        match follow(self.problem, &mut self.faces, &self.current, scale, accuracy, trace) {
            Ok(()) => {}
            Err(Stop::Inaccurate { excess }) => return Ok(Attempt::Shorter((0.9 / excess.cbrt()).max(0.2))),
            Err(Stop::Lost { share }) if share > EARLY => return Ok(Attempt::Shorter(BEFORE * share)),
            Err(Stop::Lost { .. }) => return Ok(Attempt::Untraced(UNTRACED)),
            // The step ends at a release of fluid.
            Err(Stop::AtRelease { share }) if share > 1.0 - 2.0 * BEYOND => return Ok(Attempt::ThenRelease),
            Err(Stop::AtRelease { share }) => {
                return Ok(Attempt::Shorter((share * (1.0 + BEYOND)).max(EARLY)));
            }
        }
        self.solve(&load.end, &trace.reference_slip, &outside_end)?;
        let ends = (&trace.reference_slip[..], &outside_end[..]);
        if !self.settle_shear(target, Some(&trace.middle), &mut load.end, ends)? {
            return Ok(Attempt::Again);
        }
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
        if closes && at_release == AtRelease::EndStep {
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

    /// A step in which all events are taken to occur at its start.
    fn untraced(
        &mut self,
        target: f64,
        (mut end, outside): (Vec<f64>, Vec<f64>),
        accepted: &mut dyn FnMut(&FaceSolution, &[f64]),
    ) -> Result<Attempt, NotConverged> {
        self.faces.load(&end);
        let points = self.problem.points();
        let reference_slip: Vec<f64> = self.current.jump.iter().step_by(2).take(points).copied().collect();
        self.solver.keep();
        self.solve(&end, &reference_slip, &outside)?;
        if !self.settle_shear(target, None, &mut end, (&reference_slip, &outside))? {
            return Ok(Attempt::Again);
        }
        Ok(self.accept(target, (end, outside), accepted))
    }

    /// Whether the uneven shear assumed in a step to `target` follows from its pressures; `middle`
    /// are the jumps in the middle of it. Where it does so but for its `end`, this is solved again
    /// with the shear that follows.
    ///
    /// Errors: no convergence.
    fn settle_shear(
        &mut self,
        target: f64,
        middle: Option<&[f64]>,
        end: &mut [f64],
        (reference_slip, outside): (&[f64], &[f64]),
    ) -> Result<bool, NotConverged> {
        let (at, scales) = ([0.5 * (self.at + target), target], (self.tolerance, self.largest));
        for _ in 0..=CORRECTIONS {
            let jump = &self.faces.solution().jump;
            match self.shear.agrees(self.problem, (middle, jump), at, scales) {
                Agreement::Full => return Ok(true),
                Agreement::None => return Ok(false),
                Agreement::Within => {
                    axpy(1.0, &self.shear.correct_end(), &mut end[..2 * self.problem.points()]);
                    self.faces.load(end);
                    self.solve(end, reference_slip, outside)?;
                }
            }
        }
        Ok(false)
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

    /// Makes the solution in `faces` the current solution.
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

    /// Couples the wheel to the faces at the current coordinate, or uncouples it, under the load of
    /// `path` there.
    ///
    /// Errors: no convergence.
    pub(crate) fn couple(
        &mut self,
        path: &dyn LoadPath,
        coupling: Coupling,
        accepted: &mut dyn FnMut(&FaceSolution, &[f64]),
    ) -> Result<(), SteppingError> {
        let Some(wheel) = self.problem.wheel() else { return Ok(()) };
        let mut loaded = Vec::new();
        if coupling == Coupling::Coupled {
            loaded.resize(wheel.nodes(), false);
            wheel.uncracked.pressures(self.at).for_each(|(node, pressure)| loaded[node] = pressure > 0.0);
        }
        let points = self.problem.points();
        self.shear = match coupling {
            Coupling::Coupled if wheel.is_uneven() => ShearAlongPath::none(points),
            _ => ShearAlongPath::default(),
        };
        self.faces.couple(&loaded);
        let at = self.at;
        let manner = (StepControl::Fixed, AtRelease::Continue);
        match self.attempt(path, at, manner, accepted) {
            Ok(Attempt::Accepted) => Ok(()),
            Ok(_) => {
                let failure = NotConverged {
                    iterations: REPETITIONS,
                    indicator: f64::INFINITY,
                    tolerance: self.tolerance,
                };
                Err(SteppingError::NotConverged { at, failure })
            }
            Err(failure) => Err(SteppingError::NotConverged { at, failure }),
        }
    }

    /// Admissible error (mm) of the slip at which point `j` is held, for K within the tolerance.
    fn allowed(&self, j: usize) -> f64 {
        allowed(self.tolerance, self.scale[j])
    }
}

/// Admissible error (mm) for a point whose largest jump is `scale` (mm).
fn allowed(tolerance: f64, scale: f64) -> f64 {
    HELD_SLIP * tolerance * scale
}
