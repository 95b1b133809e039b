//! Tracing of a load step event by event.

use super::condition::Degenerate;
use super::parabola::Parabola;
use super::pocket_trace::{OutsidePressure, PocketEvent, PocketTrace};
use super::problem::ROUND_OFF;
use super::tableau::FaceRate;
use super::wheel_surface::{SURFACE_ROUND_OFF, SurfaceSystem};
use super::{FaceProblem, FaceResponse, FaceScale, FaceSolution, PointStatus};

/// The load within a step, at share τ of it: start + τ first + τ² second.
#[derive(Default)]
pub(super) struct StepLoad {
    /// Nodal forces at the start of the step, N/mm, 2p.
    pub start: Vec<f64>,
    /// Nodal forces at its end.
    pub end: Vec<f64>,
    /// Coefficient of τ.
    pub first: Vec<f64>,
    /// Coefficient of τ².
    pub second: Vec<f64>,
}

impl StepLoad {
    /// Sets the parabola through the forces at the start, in the middle and at the end.
    pub(super) fn lead_through(&mut self, start: &[f64], middle: &[f64], end: Vec<f64>) {
        let each = |form: fn(f64, f64, f64) -> f64, values: &mut Vec<f64>| {
            values.clear();
            values.extend(start.iter().zip(middle).zip(&end).map(|((&s, &m), &e)| form(s, m, e)));
        };
        each(|s, m, e| 4.0 * m - 3.0 * s - e, &mut self.first);
        each(|s, m, e| 2.0 * (s + e) - 4.0 * m, &mut self.second);
        start.clone_into(&mut self.start);
        self.end = end;
    }

    /// The forces at share `share` of the step.
    pub(super) fn at(&self, share: f64) -> Vec<f64> {
        let forces = self.start.iter().zip(&self.first).zip(&self.second);
        forces.map(|((start, first), second)| start + share * (first + share * second)).collect()
    }
}

/// The faces during a step.
#[derive(Default)]
pub(super) struct Trace {
    /// The slip (mm, p) from which friction is measured at the end of the step.
    pub reference_slip: Vec<f64>,
    /// The faces at the point reached in the step, finally at its end.
    pub now: FaceSolution,
    /// Jumps in the middle of the step under a wheel with an uneven shear; otherwise empty.
    pub middle: Vec<f64>,
    /// Coefficients of τ and τ².
    rates: [FaceRate; 2],
    changes: Vec<Transition>,
    /// Number of transitions of this step; further entries are reusable memory.
    count: usize,
}

impl Trace {
    /// Changes of status; extremes of K lie there, because the rates change.
    pub(super) fn changes(&self) -> &[Transition] {
        &self.changes[..self.count]
    }

    fn begin(&mut self, current: &FaceSolution) {
        self.now.clone_from(current);
        for rate in &mut self.rates {
            rate.jump.resize(current.jump.len(), 0.0);
            rate.contact.resize(current.contact.len(), 0.0);
        }
        self.reference_slip.clear();
        self.reference_slip.extend(current.jump.iter().step_by(2).take(current.status.len()));
        self.count = 0;
    }

    fn note_change(&mut self, share: f64) {
        match self.changes.get_mut(self.count) {
            Some(change) => {
                change.share = share;
                change.solution.clone_from(&self.now);
            }
            None => self.changes.push(Transition { share, solution: self.now.clone() }),
        }
        self.count += 1;
    }
}

/// A change of status: a point touches, opens, begins to slip or ceases to slip.
pub(super) struct Transition {
    /// Share of the step at which it occurs.
    pub share: f64,
    /// The faces at that moment.
    pub solution: FaceSolution,
}

/// Accuracy requirements of a step.
pub(super) struct Accuracy<'s> {
    /// Difference between the load and its parabola (N/mm, 2p) where it is largest.
    pub missed: &'s dyn Fn() -> Vec<f64>,
    /// Admissible error (mm) of the slip at which a point is held.
    pub allowed: &'s dyn Fn(usize) -> f64,
    /// The pressure over the mouths of pockets.
    pub outside: OutsidePressure,
    /// Excess (MPa) of the pressure on open faces over that at the mouth at which fluid is
    /// released.
    pub release_excess: f64,
    /// Whether the step ends at a release of fluid.
    pub at_release: AtRelease,
}

/// Treatment of a release of fluid within a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum AtRelease {
    /// The step ends there.
    EndStep,
    /// The step continues, and fluid is released at its end.
    Continue,
}

/// Reasons for which a step was not traced to its end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Stop {
    /// No next change could be determined at this share of the step.
    Lost {
        /// Share of the step.
        share: f64,
    },
    /// The load differs too much from a parabola.
    Inaccurate {
        /// Error of the slip at which a point would be held, over the admissible error.
        excess: f64,
    },
    /// Fluid above the pressure over the mouth has an open path to the mouth.
    AtRelease {
        /// Share of the step.
        share: f64,
    },
}

/// Limits of the number of events at one moment, and in a step over the number of points. Beyond
/// them the contact conditions have no solution, or the faces have just begun to touch everywhere.
const MOST_AT_ONCE: usize = 32;
const MOST_PER_POINT: usize = 4;
/// The middle of a step.
const MIDDLE: f64 = 0.5;
/// Difference of two shares of a step below which they are the same moment.
const MOMENT: f64 = 1e-12;

/// State of the tracing of a step.
struct TracedStep<'w, 'a> {
    problem: &'w FaceProblem<'a>,
    faces: &'w mut FaceResponse<'a>,
    /// Jumps and forces below these are round-off.
    round_off: FaceScale,
    share: f64,
    trace: &'w mut Trace,
    /// The fluid, where its pressure is an unknown.
    pockets: PocketTrace,
    accuracy: Accuracy<'w>,
    /// For each crack, a bound of the error of slip due to the difference between load and
    /// parabola, over √C_jj of the point: |C_jk| ≤ √(C_jj C_kk) by Cauchy and Schwarz. None until
    /// it is needed; `faces` then has the difference as load 3.
    error_bounds: Option<Vec<f64>>,
}

/// The next change of status.
#[derive(Debug, Clone, Copy, PartialEq)]
struct TimedChange {
    change: StatusChange,
    /// Share of the step until then.
    after: f64,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum StatusChange {
    Point(usize, PointStatus),
    /// A surface node of a coupled wheel comes into contact, or leaves it.
    Node(usize, bool),
    Pocket(usize, PocketEvent),
}

/// Follows the faces from `current` through a step, for which `faces` has the coefficients of the
/// load as loads 1 and 2. Between two changes of status the response is a parabola like the load,
/// so that the changes can be determined one after the other. On return `faces` has the statuses at
/// the end of the step, and `trace` the transitions.
pub(super) fn follow<'a>(
    problem: &FaceProblem<'a>,
    faces: &mut FaceResponse<'a>,
    current: &FaceSolution,
    scale: FaceScale,
    accuracy: Accuracy<'_>,
    trace: &mut Trace,
) -> Result<(), Stop> {
    trace.begin(current);
    // Fluid that is released at the end of the step stays until then.
    let release_excess =
        if accuracy.at_release == AtRelease::EndStep { accuracy.release_excess } else { f64::INFINITY };
    let pockets = PocketTrace::new(problem, accuracy.outside.clone(), release_excess);
    let mut step = TracedStep {
        problem,
        faces,
        round_off: FaceScale { jump: ROUND_OFF * scale.jump, force: ROUND_OFF * scale.force },
        share: 0.0,
        trace,
        pockets,
        accuracy,
        error_bounds: None,
    };
    let most = MOST_AT_ONCE + MOST_PER_POINT * (problem.points() + current.loaded.len());
    let (mut events, mut at_once) = (0, 0);
    loop {
        let lost = Stop::Lost { share: step.share };
        step.faces.rates(1, &mut step.trace.rates).map_err(|Degenerate| lost)?;
        step.press().map_err(|Degenerate| lost)?;
        let Some(event) = step.next_event() else { break };
        at_once = if event.after > MOMENT { 0 } else { at_once + 1 };
        events += 1;
        if at_once > MOST_AT_ONCE || events > most {
            return Err(lost);
        }
        step.advance(event.after);
        step.change(event)?;
    }
    step.advance(1.0 - step.share);
    for (k, state) in step.trace.now.fluid.iter().enumerate() {
        step.faces.set_pocket(k, *state);
    }
    Ok(())
}

impl TracedStep<'_, '_> {
    /// Advances by the share `after` of the step.
    fn advance(&mut self, after: f64) {
        let (one, two) = (after, after * (2.0 * self.share + after));
        let go = |values: &mut [f64], first: &[f64], second: &[f64]| {
            for ((value, first), second) in values.iter_mut().zip(first).zip(second) {
                *value += one * first + two * second;
            }
        };
        let Trace { now, middle, rates: [first, second], .. } = &mut *self.trace;
        if self.problem.wheel().is_some_and(SurfaceSystem::is_uneven)
            && (self.share..self.share + after).contains(&MIDDLE)
        {
            now.jump.clone_into(middle);
            let (after, from) = (MIDDLE - self.share, self.share);
            let (one, two) = (after, after * (2.0 * from + after));
            for ((value, first), second) in middle.iter_mut().zip(&first.jump).zip(&second.jump) {
                *value += one * first + two * second;
            }
        }
        go(&mut now.jump, &first.jump, &second.jump);
        go(&mut now.contact, &first.contact, &second.contact);
        self.share += after;
        if !now.fluid.is_empty() {
            self.pockets.advance(self.problem, now, self.share, one, two);
        }
    }

    /// Adds the contribution of the pocket pressures to the rates of the load.
    fn press(&mut self) -> Result<(), Degenerate> {
        if self.trace.now.fluid.is_empty() {
            return Ok(());
        }
        let Trace { now, rates, .. } = &mut *self.trace;
        self.pockets.press(self.problem, self.faces, now, rates, self.share)
    }

    /// The first change of status within the step.
    fn next_event(&self) -> Option<TimedChange> {
        let mut next: Option<TimedChange> = None;
        let mut span = 1.0 - self.share;
        for point in 0..self.problem.points() {
            if let Some((after, status)) = self.event_of(point, span) {
                span = after;
                next = Some(TimedChange { change: StatusChange::Point(point, status), after });
            }
        }
        if let Some((after, node, loaded)) = self.event_of_nodes(span) {
            span = after;
            next = Some(TimedChange { change: StatusChange::Node(node, loaded), after });
        }
        let scale = PocketTrace::scale_of(self.round_off);
        let pocket = self.pockets.next_event(self.problem, &self.trace.now, scale, self.share, span);
        let of_pocket = |(after, k, event)| TimedChange { change: StatusChange::Pocket(k, event), after };
        pocket.map(of_pocket).or(next)
    }

    /// Time within `span` at which the first surface node of a coupled wheel changes its status,
    /// and whether it is then in contact.
    fn event_of_nodes(&self, mut span: f64) -> Option<(f64, usize, bool)> {
        let wheel = self.problem.wheel()?;
        let (pressure, gap) = wheel.scales();
        let Trace { now, rates: [first, second], .. } = &*self.trace;
        let mut next = None;
        for (node, &loaded) in now.loaded.iter().enumerate() {
            let i = wheel.component(node);
            let after = if loaded {
                Parabola::of(now.jump[i], first.jump[i], second.jump[i], self.share)
                    .first_fall(SURFACE_ROUND_OFF * pressure, span)
            } else {
                Parabola::of(now.contact[i], first.contact[i], second.contact[i], self.share)
                    .first_fall(SURFACE_ROUND_OFF * gap, span)
            };
            if let Some(after) = after {
                span = after;
                next = Some((after, node, !loaded));
            }
        }
        next
    }

    /// Time within `span` at which `point` changes its status, and the new status.
    fn event_of(&self, point: usize, span: f64) -> Option<(f64, PointStatus)> {
        use PointStatus::{Open, SlipBackward, SlipForward, Stick};
        let (t, n) = (2 * point, 2 * point + 1);
        let mu = self.problem.friction(point);
        let [first, second] = &self.trace.rates;
        let force = |i: usize| {
            Parabola::of(self.trace.now.contact[i], first.contact[i], second.contact[i], self.share)
        };
        let jump = |i: usize| Parabola::of(self.trace.now.jump[i], first.jump[i], second.jump[i], self.share);
        let FaceScale { jump: small_jump, force: small_force } = self.round_off;
        let status = self.trace.now.status[point];
        if status == Open {
            let after = jump(n).first_fall(small_jump, span)?;
            let (along, closing) = self.speed(point, self.share + after);
            return Some((after, PointStatus::of_touching(along, closing, mu)));
        }
        let normal = force(n);
        let opens = normal.first_fall(small_force, span).map(|after| (after, Open));
        let span = opens.map_or(span, |(after, _)| after);
        if mu == 0.0 {
            return opens;
        }
        let other = match status {
            Stick => {
                let shear = force(t);
                let forward = normal.times(mu).plus(shear).first_fall(small_force, span);
                let before = forward.unwrap_or(span);
                let backward = normal.times(mu).plus(shear.times(-1.0)).first_fall(small_force, before);
                backward.map(|after| (after, SlipBackward)).or(forward.map(|after| (after, SlipForward)))
            }
            SlipForward | SlipBackward => {
                let slip = jump(t).times(status.direction());
                slip.rate_falls(small_jump, span).map(|after| (after, Stick))
            }
            Open => None,
        };
        other.or(opens)
    }

    /// Speed of slip and of closing (mm over the step) of `point` at share `at` of the step.
    fn speed(&self, point: usize, at: f64) -> (f64, f64) {
        let [first, second] = &self.trace.rates;
        let speed = |i: usize| first.jump[i] + 2.0 * at * second.jump[i];
        (speed(2 * point), -speed(2 * point + 1))
    }

    /// Gives the point or the pocket of `event` its new status.
    fn change(&mut self, event: TimedChange) -> Result<(), Stop> {
        let (point, status) = match event.change {
            StatusChange::Point(point, status) => (point, status),
            StatusChange::Node(node, loaded) => {
                self.trace.note_change(self.share);
                self.trace.now.loaded[node] = loaded;
                self.faces.set_loaded(node, loaded);
                return Ok(());
            }
            StatusChange::Pocket(_, PocketEvent::Releases) => {
                return Err(Stop::AtRelease { share: self.share });
            }
            StatusChange::Pocket(k, PocketEvent::Becomes(status)) => {
                self.trace.note_change(self.share);
                self.trace.now.fluid[k] = PocketTrace::changed(self.problem, &self.trace.now, k, status);
                return Ok(());
            }
        };
        let before = self.trace.now.status[point];
        let slip = self.trace.now.jump[2 * point];
        let held = before == PointStatus::Open || status == PointStatus::Stick;
        if held && self.problem.friction(point) > 0.0 {
            self.check(point)?;
        }
        self.trace.note_change(self.share);
        self.trace.reference_slip[point] = slip;
        self.trace.now.status[point] = status;
        self.faces.set_status(point, status, slip);
        let scale = PocketTrace::scale_of(self.round_off);
        for (k, event) in PocketTrace::closed_by(self.problem, &self.trace.now, scale, point) {
            match event {
                PocketEvent::Becomes(status) => {
                    self.trace.now.fluid[k] = PocketTrace::changed(self.problem, &self.trace.now, k, status);
                }
                PocketEvent::Releases if self.accuracy.at_release == AtRelease::Continue => {}
                PocketEvent::Releases => return Err(Stop::AtRelease { share: self.share }),
            }
        }
        Ok(())
    }

    /// Whether the slip of `point` is accurate enough to be held.
    fn check(&mut self, point: usize) -> Result<(), Stop> {
        let allowed = (self.accuracy.allowed)(point);
        let body = self.problem.body();
        let (points, compliance) = (&body.faces.points, &body.compliance);
        let mobility = |i: usize| compliance[(i, i)].sqrt();
        // An error of the moment of touching is an error of the slip at that moment.
        let slope = match (self.trace.now.status[point], self.speed(point, self.share)) {
            (PointStatus::Open, (along, closing)) => (along / closing).abs(),
            _ => 0.0,
        };
        let bounds = self.error_bounds.get_or_insert_with(|| {
            let forces = (self.accuracy.missed)();
            let mut bounds = vec![0.0; points.iter().map(|point| point.crack + 1).max().unwrap_or(0)];
            for (i, force) in forces.iter().enumerate().take(2 * points.len()) {
                bounds[points[i / 2].crack] += mobility(i) * force.abs();
            }
            self.faces.load_also(forces);
            bounds
        });
        let bound = bounds[points[point].crack] * (mobility(2 * point) + slope * mobility(2 * point + 1));
        if bound <= allowed {
            return Ok(());
        }
        let lost = Stop::Lost { share: self.share };
        let [slip, opening] = if self.trace.now.fluid.is_empty() {
            self.faces.jump_under(3, point).map_err(|Degenerate| lost)?
        } else {
            let mut error = FaceRate::zero(self.trace.now.jump.len());
            self.faces.rates(3, std::slice::from_mut(&mut error)).map_err(|Degenerate| lost)?;
            self.pockets.add_error(self.problem, &self.trace.now, &mut error);
            [error.jump[2 * point], error.jump[2 * point + 1]]
        };
        let excess = (slip.abs() + slope * opening.abs()) / allowed;
        if excess <= 1.0 { Ok(()) } else { Err(Stop::Inaccurate { excess }) }
    }
}

#[cfg(test)]
#[path = "trace_tests.rs"]
mod tests;
