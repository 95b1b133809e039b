//! Increments, load cycles and extended cracks, from the growth rates of the tips.

use super::coalescence::{Coalescence, coalescences};
use super::joining::{Outcome, grow, spall};
use super::step_state::{
    Step, StepState, TipDrive, Worn, grows, mouth_sine, reaches_junction, spent_ligament, standstill,
    stop_of_one, worn,
};
use super::turned::Turned;
use crate::crack::{Crack, End, Junction, point_to_segment};
use crate::growth::{
    BreakOut, ChangingCrack, DeferredGrowth, Event, GrowthSettings, Jump, LEAST_PART, LOCATED, LargestCracks,
    Mover, Moving, Piece, PieceCause, RunStop, StepProgress, StepSize, TipCourse, TipStop, WearingCrack,
    is_worth_a_step, least_length, nothing_grows, run_stop,
};
use crate::math::Vec2;

/// The advance of one tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TipAdvance {
    /// Increment, mm; 0 for a tip that does not grow and in the last step. Negative for a tip that
    /// joins a crack lying across its deferred growth.
    pub increment: f64,
    /// Its growth that is not yet included in the crack of the next step.
    pub deferred: DeferredGrowth,
    /// Why it does not grow, or no longer grows, if so.
    pub stop: Option<TipStop>,
    /// The turn of its path, radians.
    pub turn: f64,
    /// The part of it that follows from this step and the previous one.
    pub predicted_turn: f64,
    /// Why its path kinks, if it does.
    pub jump: Option<Jump>,
    /// Whether its increment is drawn.
    pub is_drawn: bool,
    /// How its path turned.
    pub course: TipCourse,
}

/// The transition to the next step.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PlaneAdvance {
    /// The advances of the tips, in the given order.
    pub tips: Vec<TipAdvance>,
    /// The cracks of the next step.
    pub cracks: Vec<Crack>,
    /// Their junctions.
    pub junctions: Vec<Junction>,
    /// All tips that have broken out so far.
    pub break_outs: Vec<BreakOut>,
    /// Pieces that this step encloses.
    pub pieces: Vec<Piece>,
    /// Cycles, growth and removal until the next step.
    pub progress: StepProgress,
    /// Why the run ends with this step, if it does; the cracks then stay unchanged and no cycles
    /// pass.
    pub stop: Option<RunStop>,
}

/// The increments from one step to the next.
///
/// Meanwhile, wear and grinding remove the running surface and with it the mouths of the cracks.
/// Where they remove more of a crack than its tip adds, they set the pace
/// ([`super::SurfaceRemoval`]).
///
/// Δa_i = Δa_max rate_i / rate_max with Δa_max = increment × length of the fastest tip's crack,
/// where the rates are those at the start of the step. The load cycles follow from the rates of the
/// fastest tip at both ends ([`Interval`]). A step that would exceed the cycle limit at its initial
/// rate is shortened to end there.
///
/// The growth of a much slower tip is deferred until it amounts to a resolved segment
/// ([`DeferredGrowth`]). Deferred growth counts towards the length of the crack, and in deciding
/// whether the tip reaches the surface, the ends of the rail or another crack.
///
/// A tip that is arrested, or whose increment cannot be made, stops for good and has no effect on
/// the increments of the others. A tip that comes closer than the resolution to a crack coalesces
/// with it: its increment ends on that crack, and it ceases to be a tip. New stops are also
/// reported in the last step.
///
/// A tip that breaks out cuts off a spall if its crack is connected to the running surface. A tip
/// that coalesces with a crack to which it is already connected, through cracks or the surface,
/// detaches a piece, and the run ends.
///
/// Cracks that do not form a valid network at the start (because they meet elsewhere than at
/// junctions, or enclose a piece) are left as they are, and their tips stop.
///
/// Source: Trollé et al. 2014, eq. 32.
#[must_use]
pub(super) fn advance(state: &StepState<'_>, settings: &GrowthSettings) -> PlaneAdvance {
    let Drawn { pace, mut plans, met, mut outcome, mut stops, break_outs, mut pieces } =
        drawn(state, settings);
    let frees =
        pace.removal > 0.0 && reaches_junction(state.cracks, state.junctions, pace.removal, state.resolution);
    if let Outcome::Grown { cracks, .. } = &mut outcome
        && pace.removal > 0.0
        && !frees
    {
        pieces.extend(remove_surface(state, &pace, cracks, &mut plans, &mut stops));
    }
    let is_detached = frees || matches!(outcome, Outcome::Detached(_));
    let stop = stop_of_run(state, settings, &stops, is_detached);
    for (stop, coalescence) in stops.iter_mut().zip(&met) {
        *stop = stop.or(coalescence.map(|_| TipStop::Coalescence));
    }
    if stop == Some(RunStop::Fracture) {
        let broken = |tip: &TipDrive| tip.demand().breaks(settings).then_some(TipStop::Fracture);
        stops.iter_mut().zip(state.tips).for_each(|(stop, tip)| *stop = broken(tip).or(*stop));
    }
    let standing = PlaneAdvance {
        tips: standing_tips(state, &stops),
        cracks: state.cracks.to_vec(),
        junctions: state.junctions.to_vec(),
        break_outs,
        pieces,
        progress: StepProgress::default(),
        stop,
    };
    match (stop, outcome) {
        (Some(RunStop::Detached), Outcome::Detached(detached)) => {
            PlaneAdvance { pieces: [standing.pieces, detached].concat(), ..standing }
        }
        (None, Outcome::Grown { cracks, junctions }) => {
            let tips = growing_tips(state, &standing.tips, &plans, &met);
            let all: Vec<Mover> = state.tips.iter().map(|tip| state.mover(tip)).collect();
            let progress = pace.progress(&all, |mover| {
                let own = |tip: &TipDrive| (tip.tip.crack, tip.tip.tip) == (mover.crack, mover.index);
                state.tips.iter().position(own).is_some_and(|i| tips[i].jump.is_some())
            });
            PlaneAdvance { cracks, junctions, progress, tips, ..standing }
        }
        _ => standing,
    }
}

/// The increments of a step, with the stops and pieces that they cause.
struct Drawn {
    pace: StepSize,
    plans: Vec<Option<PlannedAdvance>>,
    met: Vec<Option<Coalescence>>,
    outcome: Outcome,
    stops: Vec<Option<TipStop>>,
    break_outs: Vec<BreakOut>,
    pieces: Vec<Piece>,
}

/// The increments from `state`, before the surface is removed.
fn drawn(state: &StepState<'_>, settings: &GrowthSettings) -> Drawn {
    let mut stops: Vec<Option<TipStop>> =
        state.tips.iter().map(|tip| tip.stopped.or_else(|| standstill(tip, settings))).collect();
    let mut break_outs = state.break_outs.to_vec();
    let mut pieces = Vec::new();
    let mut part = 1.0;
    // Every round but the last stops at least one tip or shortens the step to end at an event.
    loop {
        let pace = pace(state, settings, &stops, part);
        let plans = planned(state, &pace, settings, &stops);
        let steps: Vec<Option<Step>> = plans.iter().map(|plan| plan.map(|plan| plan.step)).collect();
        let met = coalescences(&steps, state.cracks, state.resolution);
        let plans = adapted_to_coalescences(state, plans, &met);
        let event = first_event(state, &plans, &met, &pace, settings).filter(|_| part > LEAST_PART);
        if let Some(event) = event.filter(|event| is_worth_a_step(*event, &pace, &state.at, settings)) {
            part *= event.part.max(0.5 * LEAST_PART);
            continue;
        }
        let blocked = blocked_steps(state, &steps, &met, pace.removal);
        if blocked.is_empty() {
            let made: Vec<Option<Step>> =
                plans.iter().map(|plan| plan.and_then(PlannedAdvance::made)).collect();
            match grow(state, &made, &met) {
                Outcome::Impossible(blamed) => {
                    for i in blamed {
                        stops[i] = Some(TipStop::Coalescence);
                    }
                }
                outcome => return Drawn { pace, plans, met, outcome, stops, break_outs, pieces },
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
    }
}

/// Why the run ends with this step, with the `stops` of all tips, if a piece `is_detached` in it.
fn stop_of_run(
    state: &StepState<'_>,
    settings: &GrowthSettings,
    stops: &[Option<TipStop>],
    is_detached: bool,
) -> Option<RunStop> {
    let breaks = state.tips.iter().any(|tip| tip.demand().breaks(settings));
    let length = (0..state.cracks.len()).map(|crack| state.length(crack)).fold(0.0, f64::max);
    let depth_of = |tip: &TipDrive| -state.cracks[tip.tip.crack].tip(tip.tip.end).y;
    let depth = state.tips.iter().map(depth_of).fold(0.0, f64::max);
    run_stop(settings, &state.at, LargestCracks { breaks, length, depth })
        .or_else(|| is_detached.then_some(RunStop::Detached))
        .or_else(|| {
            let stops: Vec<_> = state.tips.iter().map(|tip| tip.stopped).zip(stops.iter().copied()).collect();
            nothing_grows(&stops)
        })
}

/// The cracks of `state` with a straight kink of `length` (mm) at each of its tips, by `angles`
/// (radians) from straight ahead: a kink ends before the surface and on a crack that it meets.
/// `None` where no valid network results.
pub(super) fn kinked(
    state: &StepState<'_>,
    angles: &[f64],
    length: f64,
) -> Option<(Vec<Crack>, Vec<Junction>)> {
    let kink = |(drive, angle): (&TipDrive, &f64)| {
        let crack = &state.cracks[drive.tip.crack];
        let (from, ahead) = (crack.tip(drive.tip.end), crack.ahead(drive.tip.end));
        let whole = Vec2::unit(ahead.angle() + angle) * length;
        let ligament = spent_ligament(crack, state.resolution);
        let room = (-from.y - ligament).max(0.1 * -from.y);
        let to = from + whole * f64::min(1.0, room / whole.y.max(f64::MIN_POSITIVE));
        Some(Step { tip: drive.tip, from, via: None, to, deferred: 0.0 })
    };
    let steps: Vec<Option<Step>> = state.tips.iter().zip(angles).map(kink).collect();
    let met = coalescences(&steps, state.cracks, state.resolution);
    match grow(state, &steps, &met) {
        Outcome::Grown { cracks, junctions } => Some((cracks, junctions)),
        Outcome::Detached(_) | Outcome::Impossible(_) => None,
    }
}

/// The pace of the tips that have not stopped, and of the removal of the surface.
fn pace(state: &StepState<'_>, settings: &GrowthSettings, stops: &[Option<TipStop>], part: f64) -> StepSize {
    let all: Vec<Mover> = state.tips.iter().map(|tip| state.mover(tip)).collect();
    let left = || state.tips.iter().zip(&all).zip(stops).filter(|(_, stop)| stop.is_none());
    let growing = left().filter(|((tip, _), _)| grows(tip, settings)).map(|((_, mover), _)| *mover);
    let wearing = (0..state.cracks.len()).filter(|&crack| !state.is_worn_away(crack)).map(|crack| {
        let mouth_sine = mouth_sine(&state.cracks[crack]).unwrap_or(1.0);
        WearingCrack { mouth_sine, longest: state.longest(crack) }
    });
    let moving = Moving {
        all: &all,
        growing: &growing.collect::<Vec<_>>(),
        some_are_left: left().next().is_some(),
        wearing: &wearing.collect::<Vec<_>>(),
    };
    StepSize::of(&moving, &state.at, settings, part)
}

/// Takes the removal of `pace` from the surface above `cracks`: tips of cracks that are worn away,
/// and tips that the surface has reached, stop. The pieces that it cuts off.
fn remove_surface(
    state: &StepState<'_>,
    pace: &StepSize,
    cracks: &mut [Crack],
    plans: &mut [Option<PlannedAdvance>],
    stops: &mut [Option<TipStop>],
) -> Vec<Piece> {
    let (removal, mut pieces) = (pace.removal, Vec::new());
    let cause = if pace.grinds { PieceCause::Grinding } else { PieceCause::Wear };
    let count = cracks.len();
    let mut left_out = vec![0.0; count];
    for (tip, plan) in state.tips.iter().zip(plans.iter()) {
        left_out[tip.tip.crack] += match plan {
            Some(plan) if plan.deferred => plan.growth.length,
            Some(_) => 0.0,
            None => tip.deferred.length,
        };
    }
    for i in (0..count).filter(|&i| !state.is_worn_away(i)) {
        let left = worn(&cracks[i], removal, left_out[i], state.longest(i), state.resolution);
        let (crack, broken_out, is_away) = match left {
            Worn::Left { crack, broken_out } => (crack, broken_out, false),
            Worn::Away(stub) => (stub, [false; 2], true),
        };
        cracks[i] = crack;
        for (t, tip) in state.tips.iter().enumerate().filter(|(_, tip)| tip.tip.crack == i) {
            if is_away {
                stops[t] = Some(TipStop::WornAway);
                plans[t] = None;
            } else if broken_out[usize::from(tip.tip.end == End::Last)] && stops[t].is_none() {
                stops[t] = Some(TipStop::BreakOut);
                let is_open = cracks[i].is_surface_breaking();
                pieces.extend(is_open.then(|| Piece::cut_off(cause, state.at.step, i, &cracks[i])));
            }
        }
    }
    pieces
}

/// The advances of the tips when no increment is made.
fn standing_tips(state: &StepState<'_>, stops: &[Option<TipStop>]) -> Vec<TipAdvance> {
    let standing = |(tip, &stop): (&TipDrive, &Option<TipStop>)| {
        let is_away = stop == Some(TipStop::WornAway);
        let deferred = if is_away { DeferredGrowth::default() } else { tip.deferred };
        TipAdvance {
            increment: 0.0,
            deferred,
            stop,
            turn: 0.0,
            predicted_turn: 0.0,
            jump: None,
            is_drawn: false,
            course: TipCourse { span: 0.0, expected: None, ..tip.course },
        }
    };
    state.tips.iter().zip(stops).map(standing).collect()
}

/// The advances of the tips with their increments, from those without.
fn growing_tips(
    state: &StepState<'_>,
    standing: &[TipAdvance],
    plans: &[Option<PlannedAdvance>],
    met: &[Option<Coalescence>],
) -> Vec<TipAdvance> {
    let growing = |i: usize| {
        let tip = &standing[i];
        let Some(plan) = &plans[i] else { return *tip };
        let increment = match &met[i] {
            Some(coalescence) => (coalescence.at - plan.step.from).length() - state.tips[i].deferred.length,
            None => plan.increment,
        };
        let deferred = if plan.deferred { plan.growth } else { DeferredGrowth::default() };
        let Turned { angle, predicted, jump, course } = plan.turned;
        TipAdvance {
            increment,
            deferred,
            stop: tip.stop,
            turn: angle,
            predicted_turn: predicted,
            jump,
            is_drawn: !plan.deferred,
            course,
        }
    };
    (0..standing.len()).map(growing).collect()
}

/// The part of the way to a coalescence that a step goes which would otherwise take too many cycles
/// to be the last one: the rate changes over lengths in proportion to what is left of the way.
const BEFORE_JOINING: f64 = 0.8;

/// The first event during the step that the geometry determines: a crack of critical length, a
/// spent ligament, a coalescence, a crack that is worn away. A step with a coalescence only has the
/// rates at its start, so that it is approached in ever shorter steps.
fn first_event(
    state: &StepState<'_>,
    plans: &[Option<PlannedAdvance>],
    met: &[Option<Coalescence>],
    pace: &StepSize,
    settings: &GrowthSettings,
) -> Option<Event> {
    let mut events: Vec<Event> = Vec::new();
    let removal = pace.removal;
    let during = |part: f64| Event { part, ends_run: false };
    let joining = |coalescence: &Coalescence| {
        let cycles = coalescence.time * pace.cycles;
        if cycles > LOCATED * (state.at.load_cycles + cycles) {
            return Event { part: BEFORE_JOINING * coalescence.time, ends_run: true };
        }
        during(coalescence.time * (1.0 + 1e-3))
    };
    let mut growth = vec![0.0; state.cracks.len()];
    for (plan, coalescence) in plans.iter().zip(met) {
        let Some(plan) = plan else { continue };
        growth[plan.step.tip.crack] += plan.increment;
        events.extend(coalescence.as_ref().map(joining));
        let surfacing = surfacing(plan, &state.cracks[plan.step.tip.crack], state.resolution, removal);
        events.extend(surfacing.map(during));
    }
    for (crack, growth) in growth.into_iter().enumerate() {
        let sine = mouth_sine(&state.cracks[crack]);
        let wears = sine.is_some() && removal > 0.0 && !state.is_worn_away(crack);
        let changing = ChangingCrack {
            length: state.length(crack),
            growth,
            cut: sine.map_or(0.0, |sine| removal / sine),
            least: wears.then(|| least_length(state.longest(crack), state.resolution)),
        };
        events.extend(changing.events(settings));
    }
    Event::first(events)
}

/// The part of its step after which a rising tip has spent its ligament to the surface.
fn surfacing(plan: &PlannedAdvance, crack: &Crack, resolution: f64, removal: f64) -> Option<f64> {
    let Step { from, to, .. } = plan.step;
    let ligament = spent_ligament(crack, resolution);
    let (start, end) = (-from.y, -to.y - removal);
    (to.y > from.y && start > ligament && end < ligament).then(|| (start - ligament) / (start - end))
}

/// The steps that cannot be made, with the reason: break-out before meeting a crack, or leaving the
/// rail.
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
            // A mouth already lies on the surface.
            Some(coalescence) if -coalescence.at.y >= ligament => {
                stop.filter(|stop| *stop != TipStop::BreakOut)
            }
            Some(coalescence) if coalescence.at.y >= 0.0 => Some(TipStop::BreakOut),
            _ => stop,
        }
    };
    (0..steps.len()).filter_map(|i| Some((i, blocked(i)?))).collect()
}

/// The point at which the ligament of a tip that breaks out ends on the running surface: where the
/// increment crosses the surface, otherwise directly above its end.
fn way_out(step: &Step) -> Vec2 {
    let rise = step.to.y - step.from.y;
    let share = if step.to.y > 0.0 && rise > 0.0 { -step.from.y / rise } else { 1.0 };
    Vec2::new(step.from.x + (step.to.x - step.from.x) * share, 0.0)
}

/// The planned advance of a tip that grows.
#[derive(Debug, Clone, Copy)]
struct PlannedAdvance {
    /// Its own increment, mm.
    increment: f64,
    /// All growth that has not been added to its crack yet, including the increment.
    growth: DeferredGrowth,
    /// The turn of its path.
    turned: Turned,
    /// The step formed by this growth.
    step: Step,
    /// Whether the step is too short to be made.
    deferred: bool,
}

impl PlannedAdvance {
    fn made(self) -> Option<Step> {
        (!self.deferred).then_some(self.step)
    }
}

/// The plan of every tip that grows.
fn planned(
    state: &StepState<'_>,
    pace: &StepSize,
    settings: &GrowthSettings,
    stops: &[Option<TipStop>],
) -> Vec<Option<PlannedAdvance>> {
    let plan_of = |drive: &TipDrive| {
        let crack = &state.cracks[drive.tip.crack];
        let (from, ahead) = (crack.tip(drive.tip.end), crack.ahead(drive.tip.end));
        let increment = pace.increment(&state.mover(drive));
        if pace.grinds || increment <= 0.0 {
            return None;
        }
        let turned = Turned::of(drive, increment, &state.at, settings)?;
        let growth = if settings.turning.is_kink() {
            drive.deferred.and(increment, Vec2::unit(ahead.angle() + turned.angle))
        } else {
            drive.deferred.turned(increment, ahead, turned.angle, turned.jump.is_some())
        };
        let half = 0.5 * growth.length;
        let via = (!growth.is_kinked).then(|| from + ahead * half);
        let to = via.map_or(from + growth.direction * growth.length, |via| via + growth.direction * half);
        let length = state.length(drive.tip.crack);
        let keeps_pace = increment >= DeferredGrowth::KEEPS_PACE * pace.share * length;
        let least = if !growth.is_kinked {
            DeferredGrowth::LEAST_SMOOTH
        } else if settings.turning.is_kink() {
            f64::INFINITY
        } else {
            DeferredGrowth::LEAST_KINKED
        };
        let full = state.at.share.min(least);
        let deferred = !keeps_pace && growth.length < full * length;
        let step = Step { tip: drive.tip, from, via, to, deferred: growth.share_of(drive.deferred) };
        Some(PlannedAdvance { increment, growth, turned, step, deferred })
    };
    state
        .tips
        .iter()
        .zip(stops)
        .map(|(drive, stop)| if stop.is_some() || !grows(drive, settings) { None } else { plan_of(drive) })
        .collect()
}

/// The plans adapted to the coalescences `met`: growth is not deferred for a tip that joins a
/// crack, nor for one on whose segment another tip ends.
fn adapted_to_coalescences(
    state: &StepState<'_>,
    plans: Vec<Option<PlannedAdvance>>,
    met: &[Option<Coalescence>],
) -> Vec<Option<PlannedAdvance>> {
    let ends_on = |coalescence: &Coalescence, Step { tip, from, to, .. }: Step| {
        coalescence.onto == tip.crack && point_to_segment(coalescence.at, from, to) < state.resolution
    };
    let compatible = |plan: PlannedAdvance, own: &Option<Coalescence>| {
        let is_met = own.is_some() || met.iter().flatten().any(|coalescence| ends_on(coalescence, plan.step));
        PlannedAdvance { deferred: plan.deferred && !is_met, ..plan }
    };
    plans.into_iter().zip(met).map(|(plan, own)| plan.map(|plan| compatible(plan, own))).collect()
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
