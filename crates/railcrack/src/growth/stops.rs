//! Why a tip, or the run, goes no further.

use super::{CrackTip, GrowthSettings, RunStop, TipStop};
use crate::crack::{Crack, End, segment_distance};
use crate::math::Vec2;

/// The rail as a rectangle below y = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RailBox {
    /// Width, mm.
    pub width: f64,
    /// Depth, mm.
    pub depth: f64,
    /// Abscissa of its middle, mm.
    pub centre: f64,
}

/// A ligament below this many resolved lengths is spent: fewer cannot carry the gradient across it.
const LIGAMENT_RESOLUTIONS: f64 = 2.0;
/// A ligament below this fraction of the crack length is spent.
const LIGAMENT_FRACTION: f64 = 0.01;
/// Own faces this many resolved lengths behind the tip, along the crack, count as another crack: nearer ones are the
/// neighbourhood of the tip itself, short increments included.
const OWN_FACES_FROM: f64 = 3.0;
/// Cycles that fall short by this fraction are the cycles asked for: rounding of the last, shortened increment.
const CYCLES_ROUNDING: f64 = 1e-12;

/// A straight increment that a tip would make.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Step {
    /// The tip.
    pub tip: CrackTip,
    /// Where it is.
    pub from: Vec2,
    /// Where it would be.
    pub to: Vec2,
}

/// Why the step cannot be made whatever the other cracks do: it would leave the rail, spend the ligament to the
/// running surface, or come back to its own faces. `resolution` (mm) is the length that the engine resolves. Faces
/// crossed right behind the tip are left to [`Crack::extended`].
///
/// The ligament is the depth of the new tip; it is spent only by a tip that rises.
pub(super) fn stop_of_one(step: &Step, crack: &Crack, rail: RailBox, resolution: f64) -> Option<TipStop> {
    let ligament = f64::max(LIGAMENT_RESOLUTIONS * resolution, LIGAMENT_FRACTION * crack.length());
    if step.to.y >= 0.0 || (step.to.y > step.from.y && -step.to.y < ligament) {
        return Some(TipStop::BreakOut);
    }
    let inside = 0.5 * rail.width - (step.to.x - rail.centre).abs() > resolution
        && rail.depth + step.to.y > resolution;
    if !inside {
        return Some(TipStop::LeavesRail);
    }
    let meets_itself = faces_behind(crack, step.tip.end, OWN_FACES_FROM * resolution)
        .any(|(c, d)| segment_distance(step.from, step.to, c, d) < resolution);
    meets_itself.then_some(TipStop::MeetsCrack)
}

/// Whether the step comes closer than `resolution` (mm) to one of `others`.
pub(super) fn meets<'a>(step: &Step, others: impl IntoIterator<Item = &'a Crack>, resolution: f64) -> bool {
    others.into_iter().any(|crack| {
        crack.points().windows(2).any(|p| segment_distance(step.from, step.to, p[0], p[1]) < resolution)
    })
}

/// The segments of `crack` at least `distance` (mm, along the walk) behind the tip at `end`; the nearest is cut.
fn faces_behind(crack: &Crack, end: End, distance: f64) -> impl Iterator<Item = (Vec2, Vec2)> {
    let mut points = crack.points().to_vec();
    if end == End::Last {
        points.reverse();
    }
    let mut left_out = distance;
    let mut segments = Vec::new();
    for p in points.windows(2) {
        let length = (p[1] - p[0]).length();
        if left_out < length {
            let cut = p[0] + (p[1] - p[0]) * (left_out / length);
            segments.push((cut, p[1]));
        }
        left_out = f64::max(0.0, left_out - length);
    }
    segments.into_iter()
}

/// Why the run ends at the start of step `step`, before any increment: the critical length first, then cycles, then
/// steps.
pub(super) fn run_stop(
    settings: &GrowthSettings,
    cracks: &[Crack],
    step: usize,
    load_cycles: f64,
) -> Option<RunStop> {
    let critical = settings.critical_length.unwrap_or(f64::INFINITY);
    if cracks.iter().any(|crack| crack.length() >= critical) {
        return Some(RunStop::CriticalLength);
    }
    let cycles = settings.stop_after_cycles.unwrap_or(f64::INFINITY);
    if load_cycles >= cycles * (1.0 - CYCLES_ROUNDING) {
        return Some(RunStop::Cycles);
    }
    (step >= settings.steps).then_some(RunStop::StepsDone)
}
