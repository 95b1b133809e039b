//! Fixtures of the tests of growth steps.

use super::step_state::{StepState, TipDrive};
use crate::crack::Crack;
use crate::growth::{GrowthSettings, StepStart, WornSurface};
use crate::math::{RailBox, Vec2};

pub(super) const SETTINGS: GrowthSettings = GrowthSettings::REFERENCE;

static UNWORN: WornSurface = WornSurface { removed: 0.0, grindings: 0, longest: Vec::new(), before: None };

pub(super) fn crack(points: &[(f64, f64)]) -> Crack {
    Crack::polyline(points.iter().map(|&(x, y)| Vec2::new(x, y)).collect()).unwrap()
}

/// Start of `step` after `load_cycles`, with an unworn surface.
pub(super) fn at(step: usize, load_cycles: f64) -> StepStart<'static> {
    StepStart { step, load_cycles, worn: &UNWORN }
}

/// The first step of `cracks` without junctions in the rail of the paper, for an engine that
/// resolves `resolution` (mm).
pub(super) fn state<'a>(cracks: &'a [Crack], tips: &'a [TipDrive], resolution: f64) -> StepState<'a> {
    StepState {
        at: at(0, 0.0),
        cracks,
        junctions: &[],
        break_outs: &[],
        tips,
        rail: RailBox::default(),
        resolution,
    }
}
