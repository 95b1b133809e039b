//! What a face point will do within a step, and how short the step must be for it.

use super::PointStatus;

/// The motion of a point over a step in which no point changes its status.
#[derive(Debug, Clone, Copy)]
pub(super) struct Motion {
    /// Status at the start.
    pub status: PointStatus,
    /// Slip at start and end, mm.
    pub slip: (f64, f64),
    /// Opening at start and end, mm; negative where the point has passed through the other face.
    pub opening: (f64, f64),
    /// Slip per unit of path during the step before, and the length of that step.
    pub last_rate: Option<(f64, f64)>,
}

/// The event of a point within a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Forecast {
    /// Slip at which the point is held if it sticks within the step, mm.
    pub slip: f64,
    /// Slip (mm) that makes the event uncertain; 0 without event.
    free: f64,
    /// Path until the event: an open point touches, or a slipping one turns back.
    event: Option<f64>,
    /// Whether the point touches.
    touches: bool,
}

impl Forecast {
    pub(super) fn of(motion: &Motion, step: f64) -> Self {
        let (start, end) = motion.slip;
        let mut forecast = Self { slip: start, free: 0.0, event: None, touches: false };
        match motion.status {
            PointStatus::Open if motion.opening.1 < 0.0 => {
                let share = motion.opening.0 / (motion.opening.0 - motion.opening.1);
                let gone = (end - start).abs();
                forecast.slip = start + share * (end - start);
                // What goes on after the event, and the error of linear interpolation up to it.
                forecast.free = gone * (1.0 - share) * (1.0 + INTERPOLATION * share);
                forecast.event = Some(share * step);
                forecast.touches = true;
            }
            PointStatus::SlipForward | PointStatus::SlipBackward => {
                let direction = motion.status.direction();
                let turn = motion.last_rate.and_then(|last| Turn::of(last, (end - start) / step, step));
                let top = turn.map_or(end, |turn| start + turn.change);
                let ahead = |slip: f64| direction * (top - slip);
                // Slip beyond both ends of the step: the point should have stuck there.
                if ahead(start) > 0.0 {
                    forecast.slip = if ahead(end) > 0.0 { top } else { start };
                }
                forecast.free = ahead(if direction * (end - start) > 0.0 { end } else { start }).max(0.0);
                forecast.event = turn.map(|turn| turn.path);
            }
            PointStatus::Open | PointStatus::Stick => {}
        }
        forecast
    }

    /// A shorter step, if more than `allowed` mm of slip is uncertain in this one: it ends shortly after the event.
    pub(super) fn cut(&self, allowed: f64, step: f64) -> Option<f64> {
        if self.free <= allowed {
            return None;
        }
        let short = 0.5 * step.abs() * allowed / self.free;
        Some(shorter_than(step, self.event.map_or(0.0, f64::abs) + short))
    }

    /// A shorter step, if the point had an event that was not foreseen. `change` are its statuses before and after,
    /// `gone` its slip in the step, `last` its slip per unit of path in the step before and the length of that step.
    pub(super) fn cut_unforeseen(
        &self,
        change: (PointStatus, PointStatus),
        gone: f64,
        last: Option<(f64, f64)>,
        allowed: f64,
        step: f64,
    ) -> Option<f64> {
        let (before, after) = change;
        let direction = before.direction();
        if direction != 0.0 && after == before {
            // It went farther than its end and came back: it should have stuck there.
            let turn = Turn::of(last?, gone / step, step)?;
            return (direction * (turn.change - gone) > allowed).then(|| shorter_than(step, turn.path));
        }
        let free = gone.abs().max(last.map_or(0.0, |(rate, _)| (rate * step).abs()));
        let touched = before == PointStatus::Open && after.is_closed() && !self.touches;
        let turned = direction != 0.0 && after.is_closed();
        let free = if touched {
            free
        } else if turned {
            TURNING_SHARE * free
        } else {
            0.0
        };
        (free > allowed).then(|| shorter_than(step, 0.8 * step.abs() * allowed / free))
    }
}

/// Curvature of the slip within a step, as a share of the slip itself.
const INTERPOLATION: f64 = 0.5;
/// Share of its slip in the step before that a point can slip on before it turns back.
const TURNING_SHARE: f64 = 0.25;

/// `length`, but not much shorter and certainly shorter than `step`.
pub(super) fn shorter_than(step: f64, length: f64) -> f64 {
    length.abs().clamp(0.1 * step.abs(), 0.9 * step.abs()).copysign(step)
}

/// The vertex of the parabola through the values of this step and the one before, where it lies within this step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turn {
    /// Path from the start of the step.
    pub path: f64,
    /// Change of the value from the start of the step.
    pub change: f64,
}

impl Turn {
    /// From the mean rate and the length of the step before, and the mean rate of this `step`.
    pub(super) fn of((last_rate, last_step): (f64, f64), rate: f64, step: f64) -> Option<Self> {
        let curvature = 2.0 * (rate - last_rate) / (step + last_step);
        let first_rate = rate - 0.5 * curvature * step;
        let path = -first_rate / curvature;
        let within = path * step.signum() > 0.0 && path.abs() < step.abs();
        within.then_some(Self { path, change: 0.5 * first_rate * path })
    }
}
