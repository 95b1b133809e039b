//! The stabilised plastic state of a rolled rail, computed into a folder.

use super::error::RunError;
use super::job::case_files;
use crate::presentation::Presentation;
use crate::run_folder::{Existing, OF_A_RUN, ResultFolder};
use crate::setup::{HeaviestWheel, represented, rolled_rail, stabilisation};
use crate::shakedown::{ShakedownRecorder, ShakedownResults, ShakedownSummary};
use railcrack::fatigue::Initiation;
use railcrack::interruption::Interruption;
use railcrack::shakedown::{
    Method, PassRecord, RailState, RolledRail, Stabilisation, StabilisedRail, check_rail, shakedown_map,
    stabilise_unless,
};
use railcrack_case::Case;
use std::path::Path;
use std::time::Instant;

/// Depths in the bounds by depth, and how deep they go over the half-width of the contact.
const BOUNDS: usize = 61;
const BOUNDS_DEPTH: f64 = 3.0;
/// Number of friction values on the shakedown map, and its minimum extent.
const MAP: usize = 21;
const MAP_FRICTION: f64 = 0.5;

/// Computes the stabilised state of the rail of `case` into `folder`, reporting every passage to
/// `observe`, unless it is stopped by an `interruption`.
///
/// Errors: a rail that has no such state; the folder cannot be written; an interruption
/// ([`RunError::is_interruption`]).
pub fn roll(
    case: &Case,
    folder: &Path,
    existing: Existing,
    presentation: &dyn Presentation,
    interruption: Interruption<'_>,
    observe: impl FnMut(&PassRecord),
) -> Result<ShakedownSummary, RunError> {
    let case = &represented(case);
    check_rail(&rolled_rail(case))?;
    let entered = ResultFolder::enter(folder, &OF_A_RUN, existing)?;
    entered.mark()?;
    let computed = rolled_into(&entered, case, presentation, interruption, observe);
    entered.end(computed, RunError::is_interruption)
}

/// The same into a folder that is entered.
fn rolled_into(
    folder: &ResultFolder,
    case: &Case,
    presentation: &dyn Presentation,
    interruption: Interruption<'_>,
    mut observe: impl FnMut(&PassRecord),
) -> Result<ShakedownSummary, RunError> {
    let folder = folder.path();
    let (rail, settings) = (rolled_rail(case), stabilisation(case));
    let started = Instant::now();
    let mut recorder = ShakedownRecorder::start(folder, &case_files(case))?;
    let mut refused = None;
    let stabilised = stabilise_unless(interruption, &rail, &settings, |pass| {
        observe(pass);
        if refused.is_none() {
            refused = recorder.pass(pass).err();
        }
    })?;
    if let Some(error) = refused {
        return Err(error.into());
    }
    let results = results(case, rail, stabilised, &settings, started, interruption)?;
    let summary = recorder.finish(&results)?;
    presentation.shakedown(folder)?;
    Ok(summary)
}

fn results(
    case: &Case,
    rail: RolledRail,
    stabilised: StabilisedRail,
    settings: &Stabilisation,
    started: Instant,
    interruption: Interruption<'_>,
) -> Result<ShakedownResults, RunError> {
    // The history that the direct method leaves out is shown for comparison.
    let pass_by_pass = match settings.method {
        Method::PassByPass => None,
        Method::Direct => {
            let settings = Stabilisation { method: Method::PassByPass, ..*settings };
            Some(stabilise_unless(interruption, &rail, &settings, |_| ())?)
        }
    };
    let dang_van = case.shakedown.dang_van;
    let layers =
        stabilised.profile.iter().enumerate().map(|(j, layer)| (layer.depth, stabilised.stress_path(j)));
    let surface = (0.0, stabilised.surface_path(&rail));
    let initiation =
        Initiation::by_depth(&dang_van, std::iter::once(surface).chain(layers)).ok_or(RunError::NoLayers)?;
    let (friction, poisson) = (rail.contact.adhesion(), rail.steel.poisson());
    let depths: Vec<f64> = (0..BOUNDS).map(|i| BOUNDS_DEPTH * i as f64 / (BOUNDS - 1) as f64).collect();
    Ok(ShakedownResults {
        title: case.title.clone(),
        first_yield: rail.first_yield()?,
        limit: rail.shakedown_limit()?,
        bounds: rail.bounds_by_depth(&depths)?,
        map: shakedown_map((1.2 * friction.abs()).max(MAP_FRICTION), MAP, poisson),
        extent: case.rail,
        warnings: rolled_by(case)
            .into_iter()
            .chain(warnings(&stabilised, pass_by_pass.as_ref(), settings))
            .collect(),
        wall_s: started.elapsed().as_secs_f64(),
        rail,
        stabilised,
        pass_by_pass,
        dang_van,
        initiation,
    })
}

fn warnings(
    stabilised: &StabilisedRail,
    pass_by_pass: Option<&StabilisedRail>,
    settings: &Stabilisation,
) -> Vec<String> {
    let mut warnings = Vec::new();
    if stabilised.state == RailState::NotStabilised {
        warnings.push(format!(
            "not stabilised after {} passages: the last passage still changed the residual stress by {:.3} MPa",
            settings.max_passes,
            stabilised.passes.last().map_or(0.0, |pass| pass.stress_change)
        ));
    }
    if let Some(other) = pass_by_pass {
        warnings.push(format!(
            "the direct method gives an admissible state, but not the one reached passage by passage: the residual stress differs by up to {:.1} MPa",
            stabilised.stress_difference(other)
        ));
    }
    if stabilised.state == RailState::ElasticShakedown {
        warnings.push(
            "an elastic-shakedown state depends on the load history, here the first passages as computed"
                .into(),
        );
    }
    warnings
}

/// A line of text about a passage.
pub fn pass_text(pass: &PassRecord) -> String {
    format!(
        "passage {}: residual stress changes by {:.3} MPa, plastic strain by {:.2e} ({} redistributions)",
        pass.pass, pass.stress_change, pass.strain_change, pass.iterations
    )
}

/// Which load of the case rolls the rail, and what is added to the state that it leaves; none where
/// there is only one contact and nothing else.
pub fn rolled_by(case: &Case) -> Option<String> {
    let heaviest = HeaviestWheel::of_case(case);
    let mut parts = Vec::new();
    if case.is_mix() {
        parts.push(format!(
            "under the wheel \"{}\" alone, whose pressure is largest relative to its limit of elastic shakedown ({:.2} of it)",
            case.wheels[heaviest.wheel].name, heaviest.of_limit
        ));
    }
    let is_heated = case.wheels.iter().any(|wheel| wheel.wheel.temperature.is_some());
    let added = match (case.has_track(), is_heated) {
        (true, true) => Some("bending and thermal stress are"),
        (true, false) => Some("bending stress is"),
        (false, true) => Some("thermal stress is"),
        (false, false) => None,
    };
    parts.extend(added.map(|added| format!("of the contact stress only; {added} added afterwards")));
    (!parts.is_empty()).then(|| format!("the plastic state is that {}", parts.join(", ")))
}
