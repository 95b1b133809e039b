//! The stabilised plastic state of a rolled rail, computed into a folder.

use super::error::RunError;
use super::job::case_files;
use crate::presentation::Presentation;
use crate::run_folder::{Existing, OF_A_RUN, ResultFolder};
use crate::setup::{
    HeaviestWheel, rail_in_space, represented, rolled_rail, rolling_wheels, stabilisation,
    stabilisation_in_space,
};
use crate::shakedown::{SectionResults, ShakedownRecorder, ShakedownResults, ShakedownSummary};
use railcrack::fatigue::{DangVan, DangVanValue, DepthValue, Initiation};
use railcrack::interruption::Interruption;
use railcrack::math::Tensor;
use railcrack::shakedown::space::{RailInSpace, SpaceCycle, StabilisedSpace, stabilise_in_space};
use railcrack::shakedown::{
    FirstYield, Method, PassRecord, RailState, RolledRail, ShakedownLimit, Stabilisation, StabilisedRail,
    check_rail, shakedown_map, stabilise_unless,
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
/// `observe`, unless it is stopped by an `interruption`. Under a patch the profile is that of the
/// lateral place `lateral` (mm) from the cracks.
///
/// Errors: a rail that has no such state; the folder cannot be written; an interruption
/// ([`RunError::is_interruption`]).
pub fn roll(
    case: &Case,
    lateral: f64,
    (folder, existing): (&Path, Existing),
    presentation: &dyn Presentation,
    interruption: Interruption<'_>,
    observe: impl FnMut(&PassRecord),
) -> Result<ShakedownSummary, RunError> {
    let case = &represented(case);
    check_rail(&rolled_rail(case))?;
    let entered = ResultFolder::enter(folder, &OF_A_RUN, existing)?;
    entered.mark()?;
    let computed = rolled_into(&entered, case, lateral, presentation, interruption, observe);
    entered.end(computed, RunError::is_interruption)
}

/// The same into a folder that is entered.
fn rolled_into(
    folder: &ResultFolder,
    case: &Case,
    lateral: f64,
    presentation: &dyn Presentation,
    interruption: Interruption<'_>,
    mut observe: impl FnMut(&PassRecord),
) -> Result<ShakedownSummary, RunError> {
    let folder = folder.path();
    let started = Instant::now();
    let mut recorder = ShakedownRecorder::start(folder, &case_files(case))?;
    let mut refused = None;
    let watch = |pass: &PassRecord| {
        observe(pass);
        if refused.is_none() {
            refused = recorder.pass(pass).err();
        }
    };
    let mut results = match rail_in_space(case) {
        Some(rail) => {
            let state = stabilise_in_space(interruption, &rail, &stabilisation_in_space(case), watch)?;
            results_in_space(case, &rail, state, lateral)?
        }
        None => {
            let (rail, settings) = (rolled_rail(case), stabilisation(case));
            let stabilised = stabilise_unless(interruption, &rail, &settings, watch)?;
            results(case, rail, stabilised, &settings, interruption)?
        }
    };
    if let Some(error) = refused {
        return Err(error.into());
    }
    results.wall_s = started.elapsed().as_secs_f64();
    let summary = recorder.finish(&results)?;
    presentation.shakedown(folder)?;
    Ok(summary)
}

fn results(
    case: &Case,
    rail: RolledRail,
    stabilised: StabilisedRail,
    settings: &Stabilisation,
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
    Ok(ShakedownResults {
        title: case.title.clone(),
        first_yield: rail.first_yield()?,
        limit: rail.shakedown_limit()?,
        bounds: rail.bounds_by_depth(&bound_depths())?,
        map: shakedown_map((1.2 * friction.abs()).max(MAP_FRICTION), MAP, poisson),
        extent: case.rail,
        warnings: rolled_by(case)
            .into_iter()
            .chain(warnings(&stabilised, pass_by_pass.as_ref(), settings.max_passes))
            .collect(),
        wall_s: 0.0,
        rail,
        stabilised,
        pass_by_pass,
        dang_van,
        initiation,
        section: None,
    })
}

/// Depths over the half-width of the contact at which bounds are given.
fn bound_depths() -> Vec<f64> {
    (0..BOUNDS).map(|i| BOUNDS_DEPTH * i as f64 / (BOUNDS - 1) as f64).collect()
}

fn results_in_space(
    case: &Case,
    rail: &RailInSpace,
    state: StabilisedSpace,
    lateral: f64,
) -> Result<ShakedownResults, RunError> {
    let dang_van = case.shakedown.dang_van;
    let by_row = initiation_by_row(&dang_van, rail, &state).ok_or(RunError::NoLayers)?;
    let row = state.computed_row(lateral);
    let initiation = by_row.get(row).ok_or(RunError::NoLayers)?.clone();
    let patch = &rail.patches[0];
    let bounds = patch.bounds();
    let (first, limit) = (bounds.first_yield(), bounds.shakedown_limit());
    let stabilised = state.in_plane(lateral);
    let mut warnings: Vec<String> = rolled_by(case).into_iter().collect();
    if case.shakedown.method == Method::Direct {
        warnings.push(
            "the direct method is one of line contacts: under a patch the passages are followed".into(),
        );
    }
    warnings.extend(self::warnings(&stabilised, None, case.shakedown.max_passes));
    Ok(ShakedownResults {
        title: case.title.clone(),
        first_yield: FirstYield { ratio: first.ratio, x_over_a: 0.0, depth_over_a: first.depth_over_a },
        limit: ShakedownLimit { ratio: limit.ratio, depth_over_a: limit.depth_over_a },
        bounds: bounds.by_depth((lateral - patch.lateral) / patch.lateral_half_width, &bound_depths()),
        map: Vec::new(),
        extent: case.rail,
        warnings,
        wall_s: 0.0,
        rail: rolled_rail(case),
        stabilised,
        pass_by_pass: None,
        dang_van,
        initiation,
        section: Some(SectionResults {
            lateral_half_width: patch.lateral_half_width,
            lateral,
            by_row,
            state,
        }),
    })
}

/// The criterion by depth in every computed row; none without layers.
fn initiation_by_row(
    criterion: &DangVan,
    rail: &RailInSpace,
    state: &StabilisedSpace,
) -> Option<Vec<Initiation>> {
    let depths = state.layers.interfaces().windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
    let depths: Vec<f64> = depths.collect();
    let of_row = |row: usize| {
        let worst = |path: &dyn Fn(&SpaceCycle) -> Vec<Tensor>| {
            let of = |cycle| criterion.value_in_space(&path(cycle));
            let values: Option<Vec<DangVanValue>> = state.cycles.iter().map(of).collect();
            values?.into_iter().reduce(|one, other| if other.value > one.value { other } else { one })
        };
        let surface = worst(&|cycle| state.surface_path(rail, cycle, row))?;
        let mut values = vec![DepthValue { depth: 0.0, worst: surface }];
        for (layer, &depth) in depths.iter().enumerate() {
            let worst = worst(&|cycle| state.stress_path(cycle, row, layer))?;
            values.push(DepthValue { depth, worst });
        }
        Initiation::of(values)
    };
    (0..state.computed_rows().len()).map(of_row).collect()
}

fn warnings(
    stabilised: &StabilisedRail,
    pass_by_pass: Option<&StabilisedRail>,
    max_passes: usize,
) -> Vec<String> {
    let mut warnings = Vec::new();
    if stabilised.state == RailState::NotStabilised {
        warnings.push(format!(
            "not stabilised after {} passages: the last passage still changed the residual stress by {:.3} MPa",
            max_passes,
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
    let in_turn = rolling_wheels(case).len();
    if in_turn > 1 {
        parts.push(format!(
            "under {in_turn} wheels in turn, each at its lateral place and \"{}\" first",
            case.wheels[heaviest.wheel].name
        ));
    } else if case.is_mix() {
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
