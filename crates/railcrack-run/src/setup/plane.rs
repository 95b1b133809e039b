//! The rail with cracks in the plane.

use super::fields::field_settings;
use super::wheel::{plane_field, toughness_under, with_temperature};
use railcrack::body::BodyEngine;
use railcrack::contact::{self, Latin, Newton};
use railcrack::fatigue::RailSteel;
use railcrack::field::StressField;
use railcrack::growth::GrowthSettings;
use railcrack::math::MPA_SQRT_MM;
use railcrack::plane::{PlaneRail, PlaneWheel};
use railcrack_case::{Case, ContactSolver, PlaneCase, TrafficWheel};
use std::sync::Arc;

/// The rail of `case`, which is `plane` and whose cracks the `engine` makes bodies of, with the
/// `residual` stress.
pub(super) fn plane_rail(
    case: &Case,
    plane: &PlaneCase,
    engine: Box<dyn BodyEngine>,
    residual: Option<&Arc<dyn StressField>>,
) -> PlaneRail {
    let newton: Box<dyn contact::ContactSolver> = Box::new(Newton::default());
    let latin: Box<dyn contact::ContactSolver> = Box::new(Latin::default());
    let (solver, fallback) = match plane.contact_solver {
        ContactSolver::Newton => (newton, latin),
        ContactSolver::Latin => (latin, newton),
    };
    let numbered = case.wheels.iter().enumerate();
    let wheels = numbered.map(|(number, wheel)| plane_wheel(case, (number, wheel), residual)).collect();
    let usual = MPA_SQRT_MM * case.growth_steel.unwrap_or(RailSteel::USUAL).mean_toughness;
    PlaneRail {
        widths: case.plane().map_or_else(Vec::new, |plane| plane.widths.clone()),
        solver,
        fallback,
        network: case.network,
        fields: field_settings(case),
        growth: GrowthSettings { usual_toughness: Some(usual), ..case.growth.clone() },
        rail: case.rail,
        ..PlaneRail::under(engine, wheels, case.crack_friction.clone())
    }
}

fn plane_wheel(
    case: &Case,
    (number, wheel): (usize, &TrafficWheel),
    residual: Option<&Arc<dyn StressField>>,
) -> PlaneWheel {
    PlaneWheel {
        share: wheel.share,
        fluid: wheel.fluid.clone(),
        coupling: wheel.wheel.coupling().cloned(),
        residual: with_temperature(case, &wheel.wheel, residual),
        passages: wheel.passages,
        toughness: toughness_under(case, &wheel.wheel),
        ..PlaneWheel::new(plane_field(case, number).expect("the case is checked"))
    }
}
