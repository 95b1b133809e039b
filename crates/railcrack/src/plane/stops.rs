//! Stops of tips in the plane.

use super::step_state::{Step, TipDrive};
use crate::crack::Crack;
use crate::growth::{self, GrowthSettings, TipStop};
use crate::math::RailBox;

/// The smallest ligament to the running surface (mm) that a tip of `crack` may leave; `resolution`
/// (mm) is the length that the engine resolves.
pub(super) fn spent_ligament(crack: &Crack, resolution: f64) -> f64 {
    growth::spent_ligament(crack.length(), resolution)
}

/// Stop of a tip independent of other cracks: its increment would leave the rail, or use up the
/// ligament to the running surface.
///
/// The ligament is the depth of the new tip below the surface after the removal of `removal` (mm);
/// only a rising tip can use it up.
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

/// Whether a tip is loaded and not slower than the arrest rate.
pub(super) fn grows(tip: &TipDrive, settings: &GrowthSettings) -> bool {
    tip.kink.is_some() && tip.rate > 0.0 && tip.rate >= settings.arrest_rate
}

/// Stop of a tip that runs away or no longer grows.
pub(super) fn standstill(tip: &TipDrive, settings: &GrowthSettings) -> Option<TipStop> {
    growth::standstill(tip.demand().runs_away(), grows(tip, settings), settings)
}
