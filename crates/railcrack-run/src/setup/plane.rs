//! The rail with cracks in the plane.

use super::fields::field_settings;
use super::wheel::{toughness_under, with_temperature};
use railcrack::body::BodyEngine;
use railcrack::contact::{self, Latin, Newton};
use railcrack::fatigue::RailSteel;
use railcrack::field::StressField;
use railcrack::growth::GrowthSettings;
use railcrack::math::MPA_SQRT_MM;
use railcrack::plane::{PlaneRail, PlaneWheel};
use railcrack_case::{Case, ContactSolver, MixedWheel};
use std::sync::Arc;

/// The rail of `case`, whose cracks the `engine` makes bodies of, with the `residual` stress.
pub(super) fn plane_rail(
    case: &Case,
    engine: Box<dyn BodyEngine>,
    residual: Option<&Arc<dyn StressField>>,
) -> PlaneRail {
    let newton: Box<dyn contact::ContactSolver> = Box::new(Newton::default());
    let latin: Box<dyn contact::ContactSolver> = Box::new(Latin::default());
    let (solver, fallback) = match case.contact_solver {
        ContactSolver::Newton => (newton, latin),
        ContactSolver::Latin => (latin, newton),
    };
    let first = PlaneWheel {
        share: case.mix.first().map_or(1.0, |first| first.share),
        fluid: case.fluid.clone(),
        coupling: case.wheel.coupling.clone(),
        residual: with_temperature(case, &case.wheel, residual),
        passages: case.passages,
        ..PlaneWheel::new(case.wheel.field(&case.steel).expect("the case is checked"))
    };
    let others = case.mix.iter().skip(1).map(|other| other_wheel(case, other, residual));
    let wheels = std::iter::once(first).chain(others).collect();
    let usual = MPA_SQRT_MM * case.growth_steel.unwrap_or(RailSteel::USUAL).mean_toughness;
    PlaneRail {
        solver,
        fallback,
        network: case.network,
        fields: field_settings(case),
        growth: GrowthSettings { usual_toughness: Some(usual), ..case.growth.clone() },
        rail: case.rail.extent,
        ..PlaneRail::under(engine, wheels, case.crack_friction.clone())
    }
}

/// A wheel of a mix other than the first one, in the plane.
fn other_wheel(case: &Case, other: &MixedWheel, residual: Option<&Arc<dyn StressField>>) -> PlaneWheel {
    PlaneWheel {
        share: other.share,
        fluid: other.fluid.clone(),
        coupling: other.wheel.coupling.clone(),
        residual: with_temperature(case, &other.wheel, residual),
        passages: other.passages,
        toughness: toughness_under(case, &other.wheel),
        ..PlaneWheel::new(other.wheel.field(&case.steel).expect("the case is checked"))
    }
}
