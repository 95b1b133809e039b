//! From rates to increments, cycles and longer cracks.

use super::stops::{RailBox, Step, meets, run_stop, stop_of_one};
use super::{CrackTip, GrowthSettings, RunStop, TipStop};
use crate::crack::Crack;
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
    /// Why it does not grow, if it does not.
    pub stop: Option<TipStop>,
}

/// The way to the next step.
#[derive(Debug, Clone, PartialEq)]
pub struct Advance {
    /// One per tip, in the order given.
    pub tips: Vec<TipAdvance>,
    /// The cracks of the next step.
    pub cracks: Vec<Crack>,
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
/// others are those without it. Increments of one step must keep clear of each other, too. A tip that stopped stays
/// stopped. The names of new stops are given in the last step as well.
///
/// Source: Trollé et al. 2014, eq. 32.
pub fn advance(state: &StepState<'_>, settings: &GrowthSettings) -> Advance {
    let mut stops: Vec<Option<TipStop>> =
        state.tips.iter().map(|tip| tip.stopped.or_else(|| arrest(tip, settings))).collect();
    // Every round stops at least one tip, or is the last.
    let (increments, cracks, cycles) = loop {
        let pace = Pace::of(state, settings, &stops);
        let steps = planned_steps(state, &pace, &stops);
        let (cracks, blocked) = extended_cracks(state, &pace, &steps);
        let newly_stopped = if blocked.is_empty() { meetings(state, &steps, &cracks) } else { blocked };
        if newly_stopped.is_empty() {
            let increment =
                |(tip, step): (&TipDrive, &Option<Step>)| step.map_or(0.0, |_| pace.increment(tip.rate));
            let increments: Vec<f64> = state.tips.iter().zip(&steps).map(increment).collect();
            break (increments, cracks, pace.cycles);
        }
        for (i, stop) in newly_stopped {
            stops[i] = Some(stop);
        }
    };
    let stop = run_stop(settings, state.cracks, state.step, state.load_cycles)
        .or_else(|| nothing_grows(state, &stops));
    let tips = |increments: Vec<f64>| {
        increments.iter().zip(&stops).map(|(&increment, &stop)| TipAdvance { increment, stop }).collect()
    };
    match stop {
        Some(_) => {
            Advance { tips: tips(vec![0.0; stops.len()]), cracks: state.cracks.to_vec(), cycles: 0.0, stop }
        }
        None => Advance { tips: tips(increments), cracks, cycles, stop },
    }
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
        let Some(fastest) = growing.reduce(|a, b| if b.rate > a.rate { b } else { a }) else {
            return Self { rate: 1.0, increment: 0.0, cycles: 0.0 };
        };
        let increment = settings.increment * state.cracks[fastest.tip.crack].length();
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

/// The cracks longer by all steps, and the tips (index, reason) whose step cannot be made.
fn extended_cracks(
    state: &StepState<'_>,
    pace: &Pace,
    steps: &[Option<Step>],
) -> (Vec<Crack>, Vec<(usize, TipStop)>) {
    let mut cracks = state.cracks.to_vec();
    let mut blocked = Vec::new();
    for (i, (drive, step)) in state.tips.iter().zip(steps).enumerate() {
        let (Some(step), Some(kink)) = (step, drive.kink) else { continue };
        let crack = &cracks[drive.tip.crack];
        let extended = crack.extended(drive.tip.end, pace.increment(drive.rate), kink);
        let stop = stop_of_one(step, crack, state.rail, state.resolution);
        match (stop, extended) {
            (None, Ok(longer)) => cracks[drive.tip.crack] = longer,
            // A polyline that is none any more crossed its own faces.
            (stop, _) => blocked.push((i, stop.unwrap_or(TipStop::MeetsCrack))),
        }
    }
    (cracks, blocked)
}

/// The tips whose step comes too close to another of the longer `cracks`.
fn meetings(state: &StepState<'_>, steps: &[Option<Step>], cracks: &[Crack]) -> Vec<(usize, TipStop)> {
    let meets_another = |step: &Step| {
        let others = cracks.iter().enumerate().filter(|(c, _)| *c != step.tip.crack).map(|(_, crack)| crack);
        meets(step, others, state.resolution)
    };
    let of_tip =
        |(i, step): (usize, &Option<Step>)| step.filter(meets_another).map(|_| (i, TipStop::MeetsCrack));
    steps.iter().enumerate().filter_map(of_tip).collect()
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
