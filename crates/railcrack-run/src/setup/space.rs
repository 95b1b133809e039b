//! The rail with cracks in space.

use super::fields::field_settings;
use super::wheel::{toughness_under, with_temperature};
use railcrack::field::StressField;
use railcrack::space::{SpaceRail, SpaceWheel};
use railcrack_case::{Case, SpaceCase};
use std::sync::Arc;

/// The rail of `case` with its cracks and wheels in `space`, and the `residual` stress.
pub(super) fn space_rail(
    case: &Case,
    space: &SpaceCase,
    residual: Option<&Arc<dyn StressField>>,
) -> SpaceRail {
    let first = space.wheels.iter().take(1).map(|wheel| SpaceWheel {
        wheel: wheel.clone(),
        share: case.mix.first().map_or(1.0, |first| first.share),
        bending: case.wheel.bending(&case.steel),
        residual: with_temperature(case, &case.wheel, residual),
        fluid: case.fluid.clone(),
        passages: case.passages,
        toughness: case.growth.toughness,
    });
    let others = case.mix.iter().zip(&space.wheels).skip(1).map(|(mixed, wheel)| SpaceWheel {
        wheel: wheel.clone(),
        share: mixed.share,
        bending: mixed.wheel.bending(&case.steel),
        residual: with_temperature(case, &mixed.wheel, residual),
        fluid: mixed.fluid.clone(),
        passages: mixed.passages,
        toughness: toughness_under(case, &mixed.wheel),
    });
    SpaceRail {
        network: case.network,
        steel: case.steel,
        wheels: first.chain(others).collect(),
        friction: case.crack_friction.clone(),
        resolution: case.mesh.space,
        growth: case.growth.clone(),
        mode_3_weight: space.mode_3_weight,
        fields: field_settings(case),
        rail: case.rail.extent,
        kernel: None,
    }
}
