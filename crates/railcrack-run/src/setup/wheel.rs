//! Stress in the rail from a wheel of a case.

use super::wheel_patch::patches_in_plane;
use railcrack::field::{PatchWheel, StressField, Sum, Wheel, on_track, wheel_under};
use railcrack::load::{Contact, HertzianContact, WheelLoad};
use railcrack::material::IsotropicElastic;
use railcrack::math::{MPA_SQRT_MM, OutOfRange};
use railcrack_case::{Case, GivenWheel, WheelLoading};
use std::sync::Arc;

/// Peak pressure (MPa) that stands for no contact: the mechanics measure positions and load steps
/// in the half-width of a contact, and this one loads the cracks by nothing that counts.
const NO_PRESSURE: f64 = 1e-3;

/// The field that moves with the wheel `number` (from 0) of `case`: its patches or its line
/// contact, and bending.
///
/// Errors: [`wheel_under`]; the wheel of a checked case has none.
pub fn plane_field(case: &Case, number: usize) -> Result<Box<dyn Wheel>, OutOfRange> {
    let Some(wheel) = case.wheels.get(number) else {
        return wheel_field(&case.first_wheel().wheel, &case.steel);
    };
    let Some(patches) = patches_in_plane(case, number) else { return wheel_field(&wheel.wheel, &case.steel) };
    let contact = Box::new(PatchWheel::new(&patches, &case.steel));
    on_track(contact, wheel.wheel.track.as_ref(), &case.steel)
}

/// The field of the line contact of `wheel` on a rail of `steel`, and of its bending.
///
/// Errors: [`wheel_under`]; the wheel of a checked case has none.
pub fn wheel_field(wheel: &GivenWheel, steel: &IsotropicElastic) -> Result<Box<dyn Wheel>, OutOfRange> {
    let contact = match &wheel.loading {
        WheelLoading::Contact(given) => given.contact.clone(),
        WheelLoading::Misses { half_width } => Contact::Hertz(HertzianContact {
            peak_pressure: NO_PRESSURE,
            half_width: *half_width,
            friction: 0.0,
        }),
    };
    let load = WheelLoad { contact, track: wheel.track.clone(), temperature: wheel.temperature };
    wheel_under(&load, steel)
}

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
    let fracture = case.fracture.as_ref()?;
    let rail = wheel.temperature.map_or(ROOM_TEMPERATURE, |temperature| temperature.rail);
    let at = fracture.toughness.at(rail);
    if at == fracture.at_rail {
        return case.growth.toughness;
    }
    let raised = case.growth.toughness.map_or(0.0, |toughness| toughness - MPA_SQRT_MM * fracture.at_rail);
    Some(MPA_SQRT_MM * at + raised)
}

/// Temperature (°C) of a rail if none is given.
const ROOM_TEMPERATURE: f64 = 20.0;
