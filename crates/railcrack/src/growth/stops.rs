//! Conditions under which a tip or the run stops.

use super::step_state::{Step, StepState, TipDrive};
use super::{GrowthSettings, RunStop, TipStop};
use crate::crack::Crack;
use crate::math::RailBox;

/// A ligament shorter than this many resolved lengths is used up: fewer cannot resolve the gradient
/// across it.
const LIGAMENT_RESOLUTIONS: f64 = 2.0;
/// A ligament shorter than this fraction of the crack length is used up.
const LIGAMENT_FRACTION: f64 = 0.01;
/// Cycles that fall short by this fraction are the cycles asked for: rounding of the last,
/// shortened increment.
const CYCLES_ROUNDING: f64 = 1e-12;

/// The ligament to the running surface (mm) that a tip of `crack` may still leave; `resolution`
/// (mm) is the length that the engine resolves.
pub(super) fn spent_ligament(crack: &Crack, resolution: f64) -> f64 {
    f64::max(LIGAMENT_RESOLUTIONS * resolution, LIGAMENT_FRACTION * crack.length())
}

/// Stop of a tip whatever the other cracks do: its increment would leave the rail, or use up the
/// ligament to the running surface.
///
/// The ligament is the depth of the new tip below the surface, of which `removal` (mm) is taken off
/// meanwhile; it is spent only by a tip that rises.
pub(super) fn stop_of_one(
    step: &Step,
    crack: &Crack,
    rail: RailBox,
    resolution: f64,
    removal: f64,
) -> Option<TipStop> {
    let rises = step.to.y > step.from.y;
    let depth = -step.to.y - removal;
    if step.to.y >= 0.0 || (rises && depth < spent_ligament(crack, resolution)) {
        return Some(TipStop::BreakOut);
    }
    let inside = 0.5 * rail.width - (step.to.x - rail.centre).abs() > resolution
        && rail.depth + step.to.y > resolution;
    (!inside).then_some(TipStop::LeavesRail)
}

/// Whether a tip breaks the rail: its largest k1 reaches the toughness, or K that of its growth
/// law.
/// K of a tip behind a spent ligament, or that has joined a crack, is that of no crack any more.
pub(super) fn breaks(settings: &GrowthSettings, tip: &TipDrive) -> bool {
    let is_tip = !matches!(tip.stopped, Some(TipStop::BreakOut | TipStop::Coalescence | TipStop::WornAway));
    let reaches = settings.toughness.is_some_and(|toughness| tip.largest_k1 >= toughness);
    is_tip && (reaches || tip.runs_away())
}

/// A tip that does not load, or is slower than the arrest rate; or one that runs away. Where the
/// surface is removed, a tip that does not grow may grow again when it has come nearer.
pub(super) fn standstill(tip: &TipDrive, settings: &GrowthSettings) -> Option<TipStop> {
    if tip.runs_away() {
        return Some(TipStop::Fracture);
    }
    let waits = settings.maintained().is_some();
    (!waits && !grows(tip, settings)).then_some(TipStop::Arrest)
}

/// Whether a tip loads and is not slower than the arrest rate.
pub(super) fn grows(tip: &TipDrive, settings: &GrowthSettings) -> bool {
    tip.kink.is_some() && tip.rate > 0.0 && tip.rate >= settings.arrest_rate
}

/// Why the run ends at the start of this step, before any increment: fracture first, then the
/// critical length, cycles, steps.
pub(super) fn run_stop(settings: &GrowthSettings, state: &StepState<'_>) -> Option<RunStop> {
    if state.tips.iter().any(|tip| breaks(settings, tip)) {
        return Some(RunStop::Fracture);
    }
    let critical = settings.critical_length.unwrap_or(f64::INFINITY);
    if (0..state.cracks.len()).any(|crack| state.length(crack) >= critical) {
        return Some(RunStop::CriticalLength);
    }
    let cycles = settings.stop_after_cycles.unwrap_or(f64::INFINITY);
    if state.load_cycles >= cycles * (1.0 - CYCLES_ROUNDING) {
        return Some(RunStop::Cycles);
    }
    (state.step >= settings.steps).then_some(RunStop::StepsDone)
}
