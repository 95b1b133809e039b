//! Conditions under which a crack or the run stops, common to plane and space.

use super::{Event, GrowthSettings, RunStop, StepStart, TipStop};
use crate::fatigue::RUNAWAY;

/// A ligament shorter than this many resolved lengths is used up: fewer lengths cannot resolve the
/// gradient across it.
const LIGAMENT_RESOLUTIONS: f64 = 2.0;
/// A ligament shorter than this fraction of the crack length is used up.
const LIGAMENT_FRACTION: f64 = 0.01;
/// Relative shortfall of cycles that is attributed to rounding of the last, shortened increment.
const CYCLES_ROUNDING: f64 = 1e-12;
/// Relative shortfall of length that is attributed to rounding of the last increment.
const LENGTH_ROUNDING: f64 = 1e-8;

/// The smallest ligament to the running surface (mm) that a crack of `length` (mm) may leave;
/// `resolution` (mm) is the length that the engine resolves.
pub(crate) fn spent_ligament(length: f64, resolution: f64) -> f64 {
    f64::max(LIGAMENT_RESOLUTIONS * resolution, LIGAMENT_FRACTION * length)
}

/// A crack shorter than this fraction of its greatest length counts as worn away: the steps in
/// which it is cut are no finer.
const WORN_SHARE: f64 = 0.05;

/// The length (mm) below which a crack of greatest length `longest` (mm) counts as worn away.
pub(crate) fn least_length(longest: f64, resolution: f64) -> f64 {
    f64::max(LIGAMENT_RESOLUTIONS * resolution, WORN_SHARE * longest)
}

/// A crack this much longer than one that is worn away, relatively, is about to be.
const NEARLY_WORN: f64 = 1e-3;

/// The length of a crack during a step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ChangingCrack {
    /// At the start, mm.
    pub length: f64,
    /// The increments of its tips, mm.
    pub growth: f64,
    /// Its loss at the mouth by wear and grinding, mm.
    pub cut: f64,
    /// The length (mm) below which it counts as worn away; `None` where it cannot be.
    pub least: Option<f64>,
}

impl ChangingCrack {
    /// The events at which it reaches the critical length or is about to be worn away.
    pub fn events(&self, settings: &GrowthSettings) -> impl Iterator<Item = Event> {
        let Self { length, growth, cut, least } = *self;
        let change = growth - cut;
        let reached = |critical: &f64| length < *critical && length + change > *critical;
        let critical = settings.critical_length.filter(reached).map(|critical| (critical - length) / change);
        let away = least.and_then(|least| self.part_until_worn_away(least));
        critical.into_iter().chain(away).map(|part| Event { part, ends_run: true })
    }

    /// The part of the step after which the crack is about to be worn away: barely longer than
    /// `least` (mm). The step in which it is worn away may be the last one, and then tells the
    /// cycles at its start. `None` where the crack is not worn away, or is about to be from the
    /// start.
    fn part_until_worn_away(&self, least: f64) -> Option<f64> {
        let Self { length, growth, cut, .. } = *self;
        let loss = cut - growth;
        let is_about_to_be = length < least * (1.0 + NEARLY_WORN);
        let room = length - least * (1.0 + 0.5 * NEARLY_WORN);
        (!is_about_to_be && length - loss < least).then(|| room / loss)
    }
}

/// Loading of a tip, as far as stops depend on it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TipDemand {
    /// da/dN, mm per cycle.
    pub rate: f64,
    /// The largest k1 of a virtual kink during the passage, MPa √mm; 0 where none opens.
    pub largest_k1: f64,
    /// Why it stopped in an earlier step, if it did.
    pub stopped: Option<TipStop>,
}

impl TipDemand {
    /// Whether the growth law gives no finite rate.
    pub fn runs_away(&self) -> bool {
        self.rate >= RUNAWAY
    }

    /// Whether K means anything: not for a tip whose ligament is used up, nor for one that has
    /// joined a crack.
    pub fn is_tip(&self) -> bool {
        !matches!(self.stopped, Some(TipStop::BreakOut | TipStop::Coalescence | TipStop::WornAway))
    }

    /// The largest k1 over the toughness; 0 where the tip cannot break the rail.
    pub fn hazard(&self, settings: &GrowthSettings) -> f64 {
        settings.toughness.filter(|_| self.is_tip()).map_or(0.0, |toughness| self.largest_k1 / toughness)
    }

    /// Whether it fractures the rail: its largest k1 reaches the toughness, or K reaches the
    /// toughness of the growth law.
    pub fn breaks(&self, settings: &GrowthSettings) -> bool {
        let is_tip = self.is_tip();
        let reaches = settings.toughness.is_some_and(|toughness| self.largest_k1 >= toughness);
        is_tip && (reaches || self.runs_away())
    }
}

/// Stop of a tip or crack that runs away (fracture) or no longer `grows` (arrest). Where the
/// surface is removed there is no arrest, since a crack at rest may grow again once the surface has
/// come closer.
pub(crate) fn standstill(runs_away: bool, grows: bool, settings: &GrowthSettings) -> Option<TipStop> {
    if runs_away {
        return Some(TipStop::Fracture);
    }
    let waits = settings.maintained().is_some();
    (!waits && !grows).then_some(TipStop::Arrest)
}

/// Steps without an increment of their own, at grindings and events, for each that counts, at most.
const FREE_STEPS: usize = 20;

/// The cracks at the start of a step, as far as the end of the run depends on them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LargestCracks {
    /// Whether a tip breaks the rail.
    pub breaks: bool,
    /// Length of the longest crack, mm.
    pub length: f64,
    /// Depth of the deepest tip, mm.
    pub depth: f64,
}

/// Why the run ends at the start of a step, before any increment, in this order: fracture, critical
/// length, critical depth, wear limit, cycles, steps.
pub(crate) fn run_stop(
    settings: &GrowthSettings,
    at: &StepStart<'_>,
    LargestCracks { breaks, length: longest, depth }: LargestCracks,
) -> Option<RunStop> {
    if breaks {
        return Some(RunStop::Fracture);
    }
    let critical_depth = settings.answer.and_then(|answer| answer.critical_depth);
    if longest >= settings.critical_length.unwrap_or(f64::INFINITY) * (1.0 - LENGTH_ROUNDING) {
        return Some(RunStop::CriticalLength);
    }
    if critical_depth.is_some_and(|critical| depth >= critical) {
        return Some(RunStop::CriticalDepth);
    }
    if settings.maintained().is_some_and(|maintenance| maintenance.is_at_limit(at.worn.removed)) {
        return Some(RunStop::WearLimit);
    }
    let cycles = settings.stop_after_cycles.unwrap_or(f64::INFINITY);
    if at.load_cycles >= cycles * (1.0 - CYCLES_ROUNDING) {
        return Some(RunStop::Cycles);
    }
    let is_done = at.counted >= settings.steps || at.step >= FREE_STEPS * settings.steps;
    is_done.then_some(RunStop::StepsDone)
}

/// The end of a run in which everything has stopped, with the reason for the last stop; `stops`
/// holds, for each tip, the stop of earlier steps and the present one.
pub(crate) fn nothing_grows(stops: &[(Option<TipStop>, Option<TipStop>)]) -> Option<RunStop> {
    let all: Vec<TipStop> = stops.iter().map(|(_, now)| *now).collect::<Option<_>>()?;
    let of_this_step =
        stops.iter().zip(&all).filter(|((before, _), _)| before.is_none()).map(|(_, now)| *now).next_back();
    of_this_step.or(all.last().copied()).map(RunStop::NoTipGrows)
}
