//! Fixtures of the tests of growth steps.

use super::increments::{PlaneAdvance, advance};
use super::step_state::{StepState, TipDrive};
use crate::crack::{Crack, CrackTip, End};
use crate::growth::{DeferredGrowth, GrowthSettings, StepStart, TipCourse, Turning, WornSurface};
use crate::math::{RailBox, Vec2};

/// The reference values with a whole kink per increment.
pub(super) const SETTINGS: GrowthSettings =
    GrowthSettings { turning: Turning::Kink, ..GrowthSettings::REFERENCE };

static UNWORN: WornSurface = WornSurface { removed: 0.0, grindings: 0, longest: Vec::new() };

pub(super) fn crack(points: &[(f64, f64)]) -> Crack {
    Crack::polyline(points.iter().map(|&(x, y)| Vec2::new(x, y)).collect()).unwrap()
}

/// Start of `step` after `load_cycles`, with an unworn surface.
pub(super) fn at(step: usize, load_cycles: f64) -> StepStart<'static> {
    StepStart { step, counted: step, load_cycles, share: SETTINGS.increment, ..StepStart::standing(&UNWORN) }
}

/// The advance from `state` by the increment of `settings`.
pub(super) fn advanced(state: &StepState<'_>, settings: &GrowthSettings) -> PlaneAdvance {
    let at = StepStart { share: settings.increment, ..state.at };
    advance(&StepState { at, ..*state }, settings)
}

/// The only lower tip of crack `crack`, which kinks by `kink` (radians) at `rate`.
pub(super) fn tip(crack: usize, kink: f64, rate: f64) -> TipDrive {
    TipDrive {
        tip: CrackTip { crack, tip: 0, end: End::Last },
        kink: Some(kink),
        rate,
        largest_k1: 0.0,
        jump: None,
        kink_slope: 0.0,
        lean: 0.0,
        course: TipCourse::default(),
        deferred: DeferredGrowth::default(),
        stopped: None,
    }
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
