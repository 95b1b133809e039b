//! Fixtures of the tests of growth steps.

use super::{GrowthSettings, StepState, TipDrive, WornSurface};
use crate::crack::Crack;
use crate::math::{RailBox, Vec2};

pub(super) const SETTINGS: GrowthSettings = GrowthSettings::REFERENCE;

static UNWORN: WornSurface = WornSurface { removed: 0.0, grindings: 0, longest: Vec::new(), before: None };

pub(super) fn crack(points: &[(f64, f64)]) -> Crack {
    Crack::polyline(points.iter().map(|&(x, y)| Vec2::new(x, y)).collect()).unwrap()
}

/// The first step of `cracks` that have joined nowhere, in the rail of the paper, for an engine
/// that resolves `resolution` (mm).
pub(super) fn state<'a>(cracks: &'a [Crack], tips: &'a [TipDrive], resolution: f64) -> StepState<'a> {
    StepState {
        step: 0,
        cracks,
        junctions: &[],
        break_outs: &[],
        tips,
        load_cycles: 0.0,
        worn: &UNWORN,
        rail: RailBox::default(),
        resolution,
    }
}
