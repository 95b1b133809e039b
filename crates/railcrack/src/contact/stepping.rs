//! Adaptive load steps: friction remembers the order of events.

use super::{FaceProblem, FaceSolution, LoadStep, NotConverged, PointStatus, StepSolver};
use thiserror::Error;

/// The load of a path: nodal forces as a function of one coordinate.
pub trait LoadPath: Sync {
    /// Nodal forces (N/mm, 2p) at coordinate `at`.
    fn nodal_forces(&self, at: f64) -> Vec<f64>;
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
/// get wrong is the slip at which a point is held when it closes and sticks, or stops slipping, within the step. That
/// slip is extrapolated from the last steps to the moment of the event, and a step whose extrapolation covers more than
/// `tolerance` of the slip seen at that point is cut so that it ends shortly before the event.
pub struct Stepper<'a> {
    problem: &'a FaceProblem<'a>,
    solver: Box<dyn StepSolver + 'a>,
    tolerance: f64,
    /// Slip or opening of each point that counts as large, mm.
    scale: Vec<f64>,
    /// Coordinate and jumps before the current solution.
    previous: Option<(f64, Vec<f64>)>,
    at: f64,
    load: Vec<f64>,
    counts: SteppingCounts,
}

/// Smallest step as a fraction of the distance between stations.
const SMALLEST: f64 = 1e-7;

impl<'a> Stepper<'a> {
    /// Virgin faces at path coordinate `start` without load. `tolerance` is that on K relative to its peak; `expected`
    /// (mm, p) is the slip that each point would show without friction, for the scale of first events.
    pub fn new(
        problem: &'a FaceProblem<'a>,
        solver: Box<dyn StepSolver + 'a>,
        tolerance: f64,
        expected: &[f64],
    ) -> Self {
        let load = vec![0.0; 2 * problem.points()];
        let scale = expected.iter().map(|slip| EXPECTED_SHARE * slip.abs()).collect();
        Self {
            problem,
            solver,
            tolerance,
            scale,
            previous: None,
            at: 0.0,
            load,
            counts: SteppingCounts::default(),
        }
    }

    /// The current solution.
    pub fn solution(&self) -> &FaceSolution {
        self.solver.solution()
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
        self.previous = None;
    }

    /// Follows `path` to `station`, in as many steps as the tolerance asks for. `accepted` sees every accepted solution
    /// with its forces.
    pub fn advance(
        &mut self,
        path: &dyn LoadPath,
        station: f64,
        accepted: &mut dyn FnMut(&FaceSolution, &[f64]),
    ) -> Result<(), SteppingError> {
        let whole = station - self.at;
        let mut step = whole;
        let mut first = true;
        while first || self.at != station {
            first = false;
            let target = if step.abs() >= (station - self.at).abs() { station } else { self.at + step };
            let smallest = (target - self.at).abs() <= SMALLEST * whole.abs();
            let control = if smallest { StepControl::Accept } else { StepControl::Cut };
            match self.attempt(path, target, control) {
                Ok(None) => {
                    if target != station {
                        self.counts.substeps += 1;
                    }
                    accepted(self.solver.solution(), &self.load);
                    step = station - self.at;
                }
                Ok(Some(shorter)) => step = shorter.abs().max(SMALLEST * whole.abs()).copysign(whole),
                Err(failure) if smallest => return Err(SteppingError::NotConverged { at: target, failure }),
                Err(_) => step = 0.5 * (target - self.at),
            }
        }
        Ok(())
    }

    /// Tries a step to `target`. `Some(step)` asks for a shorter one; the solution is then as before.
    fn attempt(
        &mut self,
        path: &dyn LoadPath,
        target: f64,
        control: StepControl,
    ) -> Result<Option<f64>, NotConverged> {
        let step = target - self.at;
        let load = path.nodal_forces(target);
        let before = self.solver.solution().clone();
        let forecasts: Vec<Forecast> =
            (0..self.problem.points()).map(|j| self.forecast(j, step, &before)).collect();
        let reference: Vec<f64> = forecasts.iter().map(|f| f.slip).collect();
        self.solver.keep();
        let solved = self.solver.solve(LoadStep { forces: &load, reference_slip: &reference });
        self.counts.solves += 1;
        match solved {
            Ok(iterations) => {
                self.counts.iterations += iterations;
                self.counts.iterations_max = self.counts.iterations_max.max(iterations);
            }
            Err(failure) => {
                self.counts.iterations += failure.iterations;
                self.solver.restore();
                return Err(failure);
            }
        }
        let after = self.solver.solution();
        let mut shortest: Option<f64> = None;
        for (j, forecast) in forecasts.iter().enumerate() {
            if control == StepControl::Accept || self.problem.friction(j) == 0.0 {
                continue;
            }
            let gone = after.jump[2 * j] - before.jump[2 * j];
            if let Some(wish) = forecast.cut((before.status[j], after.status[j]), gone, self.allowed(j), step)
            {
                shortest = Some(shortest.map_or(wish, |s: f64| if wish.abs() < s.abs() { wish } else { s }));
            }
        }
        if let Some(shorter) = shortest {
            self.solver.restore();
            return Ok(Some(shorter));
        }
        self.counts.violation_max = self.counts.violation_max.max(after.violation(self.problem, &load));
        for (j, scale) in self.scale.iter_mut().enumerate() {
            *scale = scale.max(after.jump[2 * j].abs()).max(after.jump[2 * j + 1].abs());
        }
        self.previous = Some((self.at, before.jump));
        self.at = target;
        self.load = load;
        Ok(None)
    }

    /// Free slip of point `j` in one step that leaves K within the tolerance, mm.
    fn allowed(&self, j: usize) -> f64 {
        FREE_SLIP * self.tolerance * self.scale[j]
    }

    /// What point `j` is expected to do within the next `step`.
    fn forecast(&self, j: usize, step: f64, now: &FaceSolution) -> Forecast {
        let (slip, opening) = (now.jump[2 * j], now.jump[2 * j + 1]);
        let mut forecast = Forecast { slip, rate: 0.0, elapsed: 0.0, closing: None };
        let Some((before, jump)) = &self.previous else { return forecast };
        let elapsed = self.at - before;
        if now.status[j] == PointStatus::Stick || elapsed == 0.0 {
            return forecast;
        }
        forecast.rate = (slip - jump[2 * j]) / elapsed;
        forecast.elapsed = elapsed;
        if now.status[j] == PointStatus::Open {
            let time = -opening * elapsed / (opening - jump[2 * j + 1]);
            if time.is_finite() && time * step.signum() >= 0.0 {
                forecast.closing = Some(time);
                let ahead = if time.abs() < step.abs() { time } else { 0.5 * step };
                forecast.slip = slip + forecast.rate * ahead;
            }
        }
        forecast
    }
}

/// Slip of a point in a step in which it touches or turns back, over the tolerance times the largest jump seen there.
/// Measured in `docs/step-control.md`.
const FREE_SLIP: f64 = 0.3;
/// Slip that counts as large before any has been seen, as a share of the slip without contact.
const EXPECTED_SHARE: f64 = 1e-3;

/// Whether a step may be cut for accuracy.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum StepControl {
    Cut,
    Accept,
}

struct Forecast {
    /// Slip at which the point would be held, mm.
    slip: f64,
    /// Slip per unit of path during the last step, and the length of that step.
    rate: f64,
    elapsed: f64,
    /// Path until an open point touches.
    closing: Option<f64>,
}

impl Forecast {
    /// A shorter step, if too much slip is uncertain in one in which the point touches or turns back. `gone` is its
    /// slip in the step.
    fn cut(
        &self,
        (before, after): (PointStatus, PointStatus),
        gone: f64,
        allowed: f64,
        step: f64,
    ) -> Option<f64> {
        let free = (self.rate * step).abs();
        let touches = before == PointStatus::Open && after.is_closed();
        let uncertain = if touches {
            free
        } else if before.direction() != 0.0 && after == before {
            self.overshoot(before.direction(), gone, step)
        } else if before.direction() != 0.0 && after.is_closed() {
            0.25 * free
        } else {
            0.0
        };
        if uncertain <= allowed {
            return None;
        }
        let short = 0.8 * step.abs() * allowed / uncertain;
        let to_closing = self.closing.map_or(0.0, |time| time.abs() - 0.5 * short);
        let wish = if touches && to_closing > short { to_closing } else { short };
        Some(wish.clamp(0.1 * step.abs(), 0.8 * step.abs()).copysign(step))
    }

    /// How far a point that slips on to the end of the step went beyond that end and turned back: the top of the
    /// parabola through its last slips. It should have stuck there.
    fn overshoot(&self, direction: f64, gone: f64, step: f64) -> f64 {
        let rate = gone / step;
        let curvature = 2.0 * (rate - self.rate) / (step + self.elapsed);
        let last_rate = rate + 0.5 * curvature * step;
        if self.elapsed == 0.0 || last_rate * direction * step >= 0.0 {
            return 0.0;
        }
        (0.5 * last_rate * last_rate / curvature).abs()
    }
}
