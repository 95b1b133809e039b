//! From rates to increments, cycles and longer cracks.

use super::joining::{Outcome, grow, spall};
use super::meetings::{Meeting, meetings};
use super::stops::{RailBox, Step, run_stop, spent_ligament, stop_of_one};
use super::{BreakOut, CrackTip, GrowthSettings, Piece, RunStop, TipStop};
use crate::crack::{Crack, Junction};
use crate::math::Vec2;

/// What the passage asks of one tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TipDrive {
    /// Which tip.
    pub tip: CrackTip,
    /// The chosen kink, radians, counter-clockwise; none for a tip that does not load.
    pub kink: Option<f64>,
    /// da/dN of the actual tip, mm per cycle: zero at or below the threshold.
    pub rate: f64,
    /// Why it stopped in an earlier step, if it did.
    pub stopped: Option<TipStop>,
}

/// The state of a run at the start of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepState<'a> {
    /// Step number, from 0.
    pub step: usize,
    /// The cracks.
    pub cracks: &'a [Crack],
    /// Where they have joined each other.
    pub junctions: &'a [Junction],
    /// Tips that broke out in earlier steps.
    pub break_outs: &'a [BreakOut],
    /// All their tips.
    pub tips: &'a [TipDrive],
    /// Load cycles so far.
    pub load_cycles: f64,
    /// The rail.
    pub rail: RailBox,
    /// The length that the engine resolves, mm: its element size.
    pub resolution: f64,
}

/// What one tip does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TipAdvance {
    /// Increment, mm; 0 for a tip that does not grow and in the last step.
    pub increment: f64,
    /// Why it does not grow, or not any more, if so.
    pub stop: Option<TipStop>,
}

/// The way to the next step.
#[derive(Debug, Clone, PartialEq)]
pub struct Advance {
    /// One per tip, in the order given.
    pub tips: Vec<TipAdvance>,
    /// The cracks of the next step.
    pub cracks: Vec<Crack>,
    /// Where they have joined each other then.
    pub junctions: Vec<Junction>,
    /// All tips that have broken out.
    pub break_outs: Vec<BreakOut>,
    /// Pieces that this step encloses.
    pub pieces: Vec<Piece>,
    /// Load cycles until then.
    pub cycles: f64,
    /// Why the run ends with this step, if it does; the cracks are then unchanged and no cycles pass.
    pub stop: Option<RunStop>,
}

/// The increments from one step to the next.
///
/// Δa_i = Δa_max rate_i / rate_max with Δa_max = increment × length of the fastest tip's crack, and
/// ΔN = Δa_max / rate_max (explicit Euler: the rate at the start of the step holds through it). A step that would
/// exceed the cycles to stop after is shortened to end on them.
///
/// A tip that is arrested, or whose increment cannot be made, stops and does not set the pace: the increments of the
/// others are those without it. A tip that comes closer than the resolution to a crack joins it: its increment ends on that
/// crack, and it is a tip no more. A tip that stopped stays stopped. The names of new stops are given in the last step as well.
///
/// A tip that breaks out cuts off a spall where its crack is connected to the running surface. A tip that meets what it is connected
/// with already, by cracks or by the surface, detaches a piece, and the run ends.
///
/// Source: Trollé et al. 2014, eq. 32.
pub fn advance(state: &StepState<'_>, settings: &GrowthSettings) -> Advance {
    let mut stops: Vec<Option<TipStop>> =
        state.tips.iter().map(|tip| tip.stopped.or_else(|| arrest(tip, settings))).collect();
    let mut break_outs = state.break_outs.to_vec();
    let mut pieces = Vec::new();
    // Every round stops at least one tip, or is the last.
    let (pace, steps, met, outcome) = loop {
        let pace = Pace::of(state, settings, &stops);
        let steps = planned_steps(state, &pace, &stops);
        let met = meetings(&steps, state.cracks, state.resolution);
        let blocked = blocked_steps(state, &steps, &met);
        if blocked.is_empty() {
            match grow(state, &steps, &met) {
                Outcome::Impossible(blamed) => {
                    for i in blamed {
                        stops[i] = Some(TipStop::MeetsCrack);
                    }
                }
                outcome => break (pace, steps, met, outcome),
            }
        }
        for (i, stop) in blocked {
            stops[i] = Some(stop);
            if let (TipStop::BreakOut, Some(step)) = (stop, &steps[i]) {
                let new = BreakOut { tip: step.tip.crack_end(), surface: way_out(step) };
                pieces.extend(spall(state, &break_outs, new));
                break_outs.push(new);
            }
        }
    };
    let stop = run_stop(settings, state.cracks, state.step, state.load_cycles)
        .or_else(|| matches!(outcome, Outcome::Detached(_)).then_some(RunStop::Detached))
        .or_else(|| nothing_grows(state, &stops));
    for (stop, meeting) in stops.iter_mut().zip(&met) {
        *stop = stop.or(meeting.map(|_| TipStop::MeetsCrack));
    }
    let increment = |i: usize| match (&steps[i], &met[i]) {
        (Some(step), Some(meeting)) => (meeting.at - step.from).length(),
        (Some(_), None) => pace.increment(state.tips[i].rate),
        (None, _) => 0.0,
    };
    let tips = |increment: &dyn Fn(usize) -> f64| {
        stops.iter().enumerate().map(|(i, &stop)| TipAdvance { increment: increment(i), stop }).collect()
    };
    let standing = Advance {
        tips: tips(&|_| 0.0),
        cracks: state.cracks.to_vec(),
        junctions: state.junctions.to_vec(),
        break_outs,
        pieces,
        cycles: 0.0,
        stop,
    };
    match (stop, outcome) {
        (Some(RunStop::Detached), Outcome::Detached(detached)) => {
            Advance { pieces: [standing.pieces, detached].concat(), ..standing }
        }
        (None, Outcome::Grown { cracks, junctions }) => {
            Advance { tips: tips(&increment), cracks, junctions, cycles: pace.cycles, ..standing }
        }
        _ => standing,
    }
}

/// The steps that cannot be made, with the reason: they break out before they meet a crack, or leave the rail.
fn blocked_steps(
    state: &StepState<'_>,
    steps: &[Option<Step>],
    met: &[Option<Meeting>],
) -> Vec<(usize, TipStop)> {
    let blocked = |i: usize| {
        let step = steps[i].as_ref()?;
        let crack = &state.cracks[step.tip.crack];
        let stop = stop_of_one(step, crack, state.rail, state.resolution);
        let ligament = spent_ligament(crack, state.resolution);
        match met[i] {
            // A mouth is on the surface already.
            Some(meeting) if -meeting.at.y >= ligament => stop.filter(|stop| *stop != TipStop::BreakOut),
            Some(meeting) if meeting.at.y >= 0.0 => Some(TipStop::BreakOut),
            _ => stop,
        }
    };
    (0..steps.len()).filter_map(|i| Some((i, blocked(i)?))).collect()
}

/// Where the ligament of a tip that breaks out ends on the running surface: where its increment passes it, else above its end.
fn way_out(step: &Step) -> Vec2 {
    let rise = step.to.y - step.from.y;
    let share = if step.to.y > 0.0 && rise > 0.0 { -step.from.y / rise } else { 1.0 };
    Vec2::new(step.from.x + (step.to.x - step.from.x) * share, 0.0)
}

/// A tip that does not load, or is slower than the arrest rate.
fn arrest(tip: &TipDrive, settings: &GrowthSettings) -> Option<TipStop> {
    let grows = tip.kink.is_some() && tip.rate > 0.0 && tip.rate >= settings.arrest_rate;
    (!grows).then_some(TipStop::Arrest)
}

/// The fastest growing tip sets the pace of a step.
#[derive(Debug, Clone, Copy)]
struct Pace {
    rate: f64,
    increment: f64,
    cycles: f64,
}

impl Pace {
    fn of(state: &StepState<'_>, settings: &GrowthSettings, stops: &[Option<TipStop>]) -> Self {
        let growing = state.tips.iter().zip(stops).filter(|(_, stop)| stop.is_none()).map(|(tip, _)| tip);
        // Of equally fast tips that of the longest crack, so that their order does not matter.
        let length = |tip: &TipDrive| state.cracks[tip.tip.crack].length();
        let faster = |a: &TipDrive, b: &TipDrive| (b.rate, length(b)) > (a.rate, length(a));
        let Some(fastest) = growing.reduce(|a, b| if faster(a, b) { b } else { a }) else {
            return Self { rate: 1.0, increment: 0.0, cycles: 0.0 };
        };
        let increment = settings.increment * length(fastest);
        let left = settings.stop_after_cycles.unwrap_or(f64::INFINITY) - state.load_cycles;
        let cycles = increment / fastest.rate;
        if cycles <= left {
            return Self { rate: fastest.rate, increment, cycles };
        }
        let left = left.max(0.0);
        Self { rate: fastest.rate, increment: left * fastest.rate, cycles: left }
    }

    /// The increment (mm) of a tip that grows at `rate`.
    fn increment(&self, rate: f64) -> f64 {
        self.increment * (rate / self.rate)
    }
}

/// The step of every tip that grows.
fn planned_steps(state: &StepState<'_>, pace: &Pace, stops: &[Option<TipStop>]) -> Vec<Option<Step>> {
    let step_of = |drive: &TipDrive| {
        let crack = &state.cracks[drive.tip.crack];
        let (from, ahead) = (crack.tip(drive.tip.end), crack.ahead(drive.tip.end));
        let direction = Vec2::unit(ahead.angle() + drive.kink?);
        Some(Step { tip: drive.tip, from, to: from + direction * pace.increment(drive.rate) })
    };
    state
        .tips
        .iter()
        .zip(stops)
        .map(|(drive, stop)| if stop.is_some() { None } else { step_of(drive) })
        .collect()
}

/// The end of a run in which every tip has stopped, with the reason of the last one that did.
fn nothing_grows(state: &StepState<'_>, stops: &[Option<TipStop>]) -> Option<RunStop> {
    let all: Vec<TipStop> = stops.iter().copied().collect::<Option<_>>()?;
    let of_this_step =
        state.tips.iter().zip(&all).filter(|(tip, _)| tip.stopped.is_none()).map(|(_, s)| *s).next_back();
    of_this_step.or(all.last().copied()).map(RunStop::NoTipGrows)
}

#[cfg(test)]
#[path = "increments_tests.rs"]
mod tests;

#[cfg(test)]
#[path = "joining_tests.rs"]
mod joining_tests;
