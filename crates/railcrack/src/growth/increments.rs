//! Increments, load cycles and the longer cracks, from the growth rates of the tips.

use super::coalescence::{Coalescence, coalescences};
use super::cycles::Interval;
use super::deferred::{DeferredGrowth, KEEPS_PACE};
use super::joining::{Outcome, grow, spall};
use super::pace::Pace;
use super::step_state::{Step, StepState, TipDrive};
use super::stops::{breaks, grows, run_stop, spent_ligament, standstill, stop_of_one};
use super::worn::{Removal, reaches_junction};
use super::{BreakOut, GrowthSettings, Piece, RunStop, TipStop};
use crate::crack::{Crack, End, Junction, point_to_segment};
use crate::math::Vec2;

/// The advance of one tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TipAdvance {
    /// Increment, mm; 0 for a tip that does not grow and in the last step. Negative for a tip that
    /// joins a crack which lies across what was deferred.
    pub increment: f64,
    /// Its growth that is not in the crack of the next step.
    pub deferred: DeferredGrowth,
    /// Why it does not grow, or not any more, if so.
    pub stop: Option<TipStop>,
}

/// The transition to the next step.
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
    /// Load cycles until then, by the rate at the start of the step: what the tips are grown by.
    pub cycles: f64,
    /// The increment that set the pace, from which the cycles follow once the rate at its end is
    /// known; none where no cycles pass.
    pub interval: Option<Interval>,
    /// Removed of the running surface until then, mm.
    pub removal: f64,
    /// Whether it is ground then.
    pub ground: bool,
    /// Why the run ends with this step, if it does; the cracks are then unchanged and no cycles
    /// pass.
    pub stop: Option<RunStop>,
}

/// The increments from one step to the next.
///
/// Wear and grinding remove the running surface meanwhile, and with it the mouths of the cracks.
/// Where they take more of a crack than its tip grows, they set the pace ([`super::Maintenance`]).
///
/// Δa_i = Δa_max rate_i / rate_max with Δa_max = increment × length of the fastest tip's crack, by
/// the rates at the start of the step. The load cycles follow from the rates of the fastest tip at
/// both ends ([`Interval`]). A step that would exceed the cycles to stop after, at the rate of its
/// start, is shortened to end on them.
///
/// The growth of a much slower tip is deferred until it amounts to a whole increment
/// ([`DeferredGrowth`]). Deferred growth counts in the length of the crack, and where the tip
/// reaches the surface, the ends of the rail or another crack.
///
/// A tip that is arrested, or whose increment cannot be made, stops for good and has no influence
/// on the increments of the others. A tip that comes closer than the resolution to a crack
/// coalesces with it: its increment ends on that crack, and it ceases to be a tip. New stops are
/// also reported in the last step.
///
/// A tip that breaks out cuts off a spall if its crack is connected to the running surface. A tip
/// that coalesces with a crack to which it is already connected, through cracks or the surface,
/// detaches a piece, and the run ends.
///
/// Cracks that are no network to begin with (they meet elsewhere than at junctions, or enclose a
/// piece) are left as they are, and their tips stop.
///
/// Source: Trollé et al. 2014, eq. 32.
#[must_use]
pub fn advance(state: &StepState<'_>, settings: &GrowthSettings) -> Advance {
    let mut stops: Vec<Option<TipStop>> =
        state.tips.iter().map(|tip| tip.stopped.or_else(|| standstill(tip, settings))).collect();
    let mut break_outs = state.break_outs.to_vec();
    let mut pieces = Vec::new();
    // Every round stops at least one tip, or is the last.
    let (pace, ways, met, outcome) = loop {
        let pace = Pace::of(state, settings, &stops);
        let ways = planned(state, &pace, settings, &stops);
        let steps: Vec<Option<Step>> = ways.iter().map(|way| way.map(|way| way.step)).collect();
        let met = coalescences(&steps, state.cracks, state.resolution);
        let ways = beside_coalescences(state, ways, &met);
        let blocked = blocked_steps(state, &steps, &met, pace.removal);
        if blocked.is_empty() {
            let made: Vec<Option<Step>> = ways.iter().map(|way| way.and_then(Way::made)).collect();
            match grow(state, &made, &met) {
                Outcome::Impossible(blamed) => {
                    for i in blamed {
                        stops[i] = Some(TipStop::Coalescence);
                    }
                }
                outcome => break (pace, ways, met, outcome),
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
    let (mut ways, mut outcome) = (ways, outcome);
    let frees =
        pace.removal > 0.0 && reaches_junction(state.cracks, state.junctions, pace.removal, state.resolution);
    if let Outcome::Grown { cracks, .. } = &mut outcome
        && pace.removal > 0.0
        && !frees
    {
        remove_surface(state, pace.removal, cracks, &mut ways, &mut stops);
    }
    let stop = run_stop(settings, state)
        .or_else(|| (frees || matches!(outcome, Outcome::Detached(_))).then_some(RunStop::Detached))
        .or_else(|| nothing_grows(state, &stops));
    for (stop, coalescence) in stops.iter_mut().zip(&met) {
        *stop = stop.or(coalescence.map(|_| TipStop::Coalescence));
    }
    if stop == Some(RunStop::Fracture) {
        let broken = |tip: &TipDrive| breaks(settings, tip).then_some(TipStop::Fracture);
        stops.iter_mut().zip(state.tips).for_each(|(stop, tip)| *stop = broken(tip).or(*stop));
    }
    let standing = Advance {
        tips: standing_tips(state, &stops),
        cracks: state.cracks.to_vec(),
        junctions: state.junctions.to_vec(),
        break_outs,
        pieces,
        cycles: 0.0,
        interval: None,
        removal: 0.0,
        ground: false,
        stop,
    };
    match (stop, outcome) {
        (Some(RunStop::Detached), Outcome::Detached(detached)) => {
            Advance { pieces: [standing.pieces, detached].concat(), ..standing }
        }
        (None, Outcome::Grown { cracks, junctions }) => {
            let tips = growing_tips(&standing.tips, &ways, &met);
            Advance {
                tips,
                cracks,
                junctions,
                cycles: pace.cycles,
                interval: pace.interval(),
                removal: pace.removal,
                ground: pace.grinds,
                ..standing
            }
        }
        _ => standing,
    }
}

/// Takes `removal` (mm) off the surface of `cracks`: tips of cracks that are worn away, or that the
/// surface has come down to, stop.
fn remove_surface(
    state: &StepState<'_>,
    removal: f64,
    cracks: &mut Vec<Crack>,
    ways: &mut [Option<Way>],
    stops: &mut [Option<TipStop>],
) {
    let count = cracks.len();
    let mut left_out = vec![0.0; count];
    for (tip, way) in state.tips.iter().zip(ways.iter()) {
        left_out[tip.tip.crack] += match way {
            Some(way) if way.deferred => way.growth.length,
            Some(_) => 0.0,
            None => tip.deferred.length,
        };
    }
    let gone: Vec<bool> = (0..count).map(|crack| state.is_worn_away(crack)).collect();
    let longest: Vec<f64> = (0..count).map(|crack| state.longest(crack)).collect();
    let removed =
        Removal::of((std::mem::take(cracks), &gone), removal, &left_out, &longest, state.resolution);
    for (i, tip) in state.tips.iter().enumerate() {
        let [first, last] = removed.broken_out[tip.tip.crack];
        let broken_out = if tip.tip.end == End::First { first } else { last };
        if removed.away[tip.tip.crack] {
            stops[i] = Some(TipStop::WornAway);
            ways[i] = None;
        } else if broken_out && stops[i].is_none() {
            stops[i] = Some(TipStop::BreakOut);
        }
    }
    *cracks = removed.cracks;
}

/// The tips when no increment is made.
fn standing_tips(state: &StepState<'_>, stops: &[Option<TipStop>]) -> Vec<TipAdvance> {
    let standing = |(tip, &stop): (&TipDrive, &Option<TipStop>)| {
        let is_away = stop == Some(TipStop::WornAway);
        let deferred = if is_away { DeferredGrowth::default() } else { tip.deferred };
        TipAdvance { increment: 0.0, deferred, stop }
    };
    state.tips.iter().zip(stops).map(standing).collect()
}

/// The tips when increments are made, from those without.
fn growing_tips(
    standing: &[TipAdvance],
    ways: &[Option<Way>],
    met: &[Option<Coalescence>],
) -> Vec<TipAdvance> {
    let growing = |(tip, (way, coalescence)): (&TipAdvance, (&Option<Way>, &Option<Coalescence>))| {
        let Some(way) = way else { return *tip };
        let increment = match coalescence {
            Some(coalescence) => (coalescence.at - way.step.from).length() - tip.deferred.length,
            None => way.increment,
        };
        let deferred = if way.deferred { way.growth } else { DeferredGrowth::default() };
        TipAdvance { increment, deferred, stop: tip.stop }
    };
    standing.iter().zip(ways.iter().zip(met)).map(growing).collect()
}

/// The steps that cannot be made, with the reason: they break out before they meet a crack, or
/// leave the rail.
fn blocked_steps(
    state: &StepState<'_>,
    steps: &[Option<Step>],
    met: &[Option<Coalescence>],
    removal: f64,
) -> Vec<(usize, TipStop)> {
    let blocked = |i: usize| {
        let step = steps[i].as_ref()?;
        let crack = &state.cracks[step.tip.crack];
        let stop = stop_of_one(step, crack, state.rail, state.resolution, removal);
        let ligament = spent_ligament(crack, state.resolution);
        match met[i] {
            // A mouth is on the surface already.
            Some(coalescence) if -coalescence.at.y >= ligament => {
                stop.filter(|stop| *stop != TipStop::BreakOut)
            }
            Some(coalescence) if coalescence.at.y >= 0.0 => Some(TipStop::BreakOut),
            _ => stop,
        }
    };
    (0..steps.len()).filter_map(|i| Some((i, blocked(i)?))).collect()
}

/// Where the ligament of a tip that breaks out ends on the running surface: where its increment
/// passes it, else above its end.
fn way_out(step: &Step) -> Vec2 {
    let rise = step.to.y - step.from.y;
    let share = if step.to.y > 0.0 && rise > 0.0 { -step.from.y / rise } else { 1.0 };
    Vec2::new(step.from.x + (step.to.x - step.from.x) * share, 0.0)
}

/// The planned advance of a tip that grows.
#[derive(Debug, Clone, Copy)]
struct Way {
    /// Its own increment, mm.
    increment: f64,
    /// All growth that is not in its crack yet, the increment included.
    growth: DeferredGrowth,
    /// The segment that this makes.
    step: Step,
    /// Whether the segment is too short to be made.
    deferred: bool,
}

impl Way {
    fn made(self) -> Option<Step> {
        (!self.deferred).then_some(self.step)
    }
}

/// The way of every tip that grows.
fn planned(
    state: &StepState<'_>,
    pace: &Pace,
    settings: &GrowthSettings,
    stops: &[Option<TipStop>],
) -> Vec<Option<Way>> {
    let way_of = |drive: &TipDrive| {
        let crack = &state.cracks[drive.tip.crack];
        let (from, ahead) = (crack.tip(drive.tip.end), crack.ahead(drive.tip.end));
        let increment = pace.increment(drive);
        let growth = drive.deferred.and(increment, Vec2::unit(ahead.angle() + drive.kink?));
        let to = from + growth.direction * growth.length;
        let length = state.length(drive.tip.crack);
        let keeps_pace = increment >= KEEPS_PACE * pace.share * length;
        let deferred = !keeps_pace && growth.length < settings.increment * length;
        let step = Step { tip: drive.tip, from, to, deferred: growth.share_of(drive.deferred) };
        Some(Way { increment, growth, step, deferred })
    };
    state
        .tips
        .iter()
        .zip(stops)
        .map(|(drive, stop)| if stop.is_some() || !grows(drive, settings) { None } else { way_of(drive) })
        .collect()
}

/// The ways beside `met`: a tip that joins a crack is not deferred, nor is one whose way another
/// tip ends on.
fn beside_coalescences(
    state: &StepState<'_>,
    ways: Vec<Option<Way>>,
    met: &[Option<Coalescence>],
) -> Vec<Option<Way>> {
    let ends_on = |coalescence: &Coalescence, Step { tip, from, to, .. }: Step| {
        coalescence.onto == tip.crack && point_to_segment(coalescence.at, from, to) < state.resolution
    };
    let beside = |way: Way, own: &Option<Coalescence>| {
        let is_met = own.is_some() || met.iter().flatten().any(|coalescence| ends_on(coalescence, way.step));
        Way { deferred: way.deferred && !is_met, ..way }
    };
    ways.into_iter().zip(met).map(|(way, own)| way.map(|way| beside(way, own))).collect()
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
#[path = "deferred_tests.rs"]
mod deferred_tests;

#[cfg(test)]
#[path = "joining_tests.rs"]
mod joining_tests;
