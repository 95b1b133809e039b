//! The rail with cracks in space.

use super::fields::field_settings;
use super::wheel::{toughness_under, with_temperature};
use super::wheel_patch::wheel_patches;
use railcrack::field::StressField;
use railcrack::space::{SpaceRail, SpaceWheel, StandingStress};
use railcrack_case::{Case, SpaceCase};
use std::sync::Arc;

/// The rail of `case` with its cracks and wheels in `space`, and the `residual` stress, to which
/// `standing` adds what varies across the rail.
pub(super) fn space_rail(
    case: &Case,
    space: &SpaceCase,
    residual: Option<&Arc<dyn StressField>>,
    standing: Option<&Arc<dyn StandingStress>>,
) -> SpaceRail {
    let patches = wheel_patches(case);
    let wheels = case.wheels.iter().zip(patches).map(|(wheel, patch)| SpaceWheel {
        wheel: patch,
        share: wheel.share,
        bending: wheel.wheel.bending(&case.steel),
        residual: with_temperature(case, &wheel.wheel, residual),
        fluid: wheel.fluid.clone(),
        passages: wheel.passages,
        toughness: toughness_under(case, &wheel.wheel),
    });
    SpaceRail {
        network: case.network,
        steel: case.steel,
        wheels: wheels.collect(),
        standing: standing.cloned(),
        friction: case.crack_friction.clone(),
        resolution: space.resolution,
        growth: case.growth.clone(),
        mode_3_weight: space.mode_3_weight,
        fields: field_settings(case),
        rail: case.rail,
        kernel: None,
    }
}
