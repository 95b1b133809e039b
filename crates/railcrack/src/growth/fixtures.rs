//! Fixtures of the tests of growth steps.

use super::{GrowthSettings, RailBox, StepState, TipDrive};
use crate::crack::Crack;
use crate::fatigue::{DirectionCriterion, ParisLaw};
use crate::math::Vec2;

pub(super) const SETTINGS: GrowthSettings = GrowthSettings {
    steps: 25,
    increment: 0.04,
    law: ParisLaw::RAIL_STEEL,
    arrest_rate: 1e-9,
    criterion: DirectionCriterion::MaxRate,
    critical_length: None,
    stop_after_cycles: None,
};

pub(super) fn crack(points: &[(f64, f64)]) -> Crack {
    Crack::polyline(points.iter().map(|&(x, y)| Vec2::new(x, y)).collect()).unwrap()
}

/// The first step of `cracks` that have joined nowhere, in a block of 300 × 172 mm, for an engine
/// that resolves `resolution` (mm).
pub(super) fn state<'a>(cracks: &'a [Crack], tips: &'a [TipDrive], resolution: f64) -> StepState<'a> {
    StepState {
        step: 0,
        cracks,
        junctions: &[],
        break_outs: &[],
        tips,
        load_cycles: 0.0,
        rail: RailBox { width: 300.0, depth: 172.0, centre: 0.0 },
        resolution,
    }
}
