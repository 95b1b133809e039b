//! What a wheel of a case does to the rail, apart from its contact.

use railcrack::field::{StressField, Sum};
use railcrack::math::MPA_SQRT_MM;
use railcrack_case::{Case, GivenWheel};
use std::sync::Arc;

/// The stress that stays between passages of `wheel`: `residual` and that of temperature.
pub(super) fn with_temperature(
    case: &Case,
    wheel: &GivenWheel,
    residual: Option<&Arc<dyn StressField>>,
) -> Option<Box<dyn StressField>> {
    let residual = residual.map(|field| Box::new(Arc::clone(field)) as Box<dyn StressField>);
    match (residual, wheel.thermal_stress(&case.steel)) {
        (residual, None) => residual,
        (None, Some(thermal)) => Some(Box::new(thermal)),
        (Some(residual), Some(thermal)) => Some(Box::new(Sum(vec![residual, Box::new(thermal)]))),
    }
}

/// K_Ic (MPa √mm) at the temperature of the rail under `wheel`; none where the rail does not break.
/// Where that under the first wheel differs from the one that the case gives, that under the others
/// differs by as much.
pub(super) fn toughness_under(case: &Case, wheel: &GivenWheel) -> Option<f64> {
    let rail =
        |wheel: &GivenWheel| wheel.load.temperature.map_or(ROOM_TEMPERATURE, |temperature| temperature.rail);
    let fracture = case.fracture.as_ref()?;
    let at = |rail: f64| MPA_SQRT_MM * fracture.toughness.at(rail);
    let raised = case.growth.toughness.map_or(0.0, |toughness| toughness - MPA_SQRT_MM * fracture.at_rail);
    Some(at(rail(wheel)) + raised)
}

/// Temperature (°C) of a rail if none is given.
const ROOM_TEMPERATURE: f64 = 20.0;
