//! `railcrack shakedown`.

use super::run::{case_files, default_folder, is_same_file};
use crate::drive::RunError;
use crate::exit::{Exit, Failure};
use crate::print;
use clap::Args;
use railcrack::case::Case;
use railcrack::fatigue::Initiation;
use railcrack::output::{Existing, Extent, ShakedownRecorder, ShakedownResults, ShakedownSummary};
use railcrack::shakedown::{
    Method, PassRecord, RailState, RolledRail, Stabilisation, StabilisedRail, bounds_by_depth, check_rail,
    shakedown_map, stabilise,
};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Compute the stabilised plastic state under the repeated passage, and where a crack starts
///
/// The cracks of the case play no part in it. The folder gets the residual state by depth (profile.csv, plastic.vtu), what
/// every passage changed (passes.csv), the state with its bounds and the Dang Van criterion (shakedown.json), stress and
/// strain around the contact (cycle.vtu), plots and a report.
#[derive(Debug, Args)]
pub struct ShakedownArguments {
    /// The case file
    #[arg(value_name = "CASE")]
    pub case: PathBuf,
    /// The folder for the results [default: the name of the case, beside it]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Say nothing while computing
    #[arg(long)]
    pub quiet: bool,
    /// Replace the run in the folder
    #[arg(long)]
    pub force: bool,
}

/// Depths in the bounds by depth, and how deep they go over the half-width of the contact.
const BOUNDS: usize = 61;
const BOUNDS_DEPTH: f64 = 3.0;
/// Frictions on the shakedown map, and how far it goes at least.
const MAP: usize = 21;
const MAP_FRICTION: f64 = 0.5;

/// Computes the state, writes the folder and prints the result.
pub fn shakedown(arguments: &ShakedownArguments) -> Result<Exit, Failure> {
    let case = Case::read(&arguments.case)?;
    let folder = arguments.out.clone().unwrap_or_else(|| default_folder(&arguments.case));
    if is_same_file(&arguments.case, &folder.join("case.toml")) {
        return Err(RunError::CaseInRunFolder { path: arguments.case.clone() }.into());
    }
    let existing = if arguments.force { Existing::Replace } else { Existing::Refuse };
    let summary = compute(&case, &folder, existing, |pass| {
        if !arguments.quiet {
            // Nobody is left to tell when standard error itself is gone.
            let _ = writeln!(std::io::stderr().lock(), "{}", pass_text(pass));
        }
    })?;
    print::stdout(&result_text(&summary))?;
    print::stdout(&format!("results in {}\n", folder.display()))?;
    // An answer of its own, but not the one that was asked for.
    let stabilised = summary.state != RailState::NotStabilised.name();
    Ok(if stabilised { Exit::Done } else { Exit::NotConverged })
}

/// Computes the stabilised state of the rail of `case` into `folder`, telling `watch` of every passage.
///
/// Errors: a rail that has no such state; the folder cannot be written.
pub fn compute(
    case: &Case,
    folder: &Path,
    existing: Existing,
    mut watch: impl FnMut(&PassRecord),
) -> Result<ShakedownSummary, RunError> {
    let (rail, settings) = (case.rolled_rail(), case.stabilisation());
    check_rail(&rail)?;
    let started = Instant::now();
    let mut recorder = ShakedownRecorder::start(folder, &case_files(case), existing)?;
    let mut refused = None;
    let stabilised = stabilise(&rail, &settings, |pass| {
        watch(pass);
        if refused.is_none() {
            refused = recorder.pass(pass).err();
        }
    })?;
    if let Some(error) = refused {
        return Err(error.into());
    }
    let results = results(case, rail, stabilised, &settings, started)?;
    Ok(recorder.finish(&results)?)
}

fn results(
    case: &Case,
    rail: RolledRail,
    stabilised: StabilisedRail,
    settings: &Stabilisation,
    started: Instant,
) -> Result<ShakedownResults, RunError> {
    // What the direct method leaves out is shown beside it.
    let pass_by_pass = match settings.method {
        Method::PassByPass => None,
        Method::Direct => {
            let settings = Stabilisation { method: Method::PassByPass, ..*settings };
            Some(stabilise(&rail, &settings, |_| ())?)
        }
    };
    let dang_van = case.shakedown.dang_van;
    let layers =
        stabilised.profile.iter().enumerate().map(|(j, layer)| (layer.depth, stabilised.stress_path(j)));
    let surface = (0.0, stabilised.surface_path(&rail));
    let initiation =
        Initiation::by_depth(&dang_van, std::iter::once(surface).chain(layers)).ok_or(RunError::NoLayers)?;
    let (friction, poisson) = (rail.contact.friction, rail.steel.poisson());
    let depths: Vec<f64> = (0..BOUNDS).map(|i| BOUNDS_DEPTH * i as f64 / (BOUNDS - 1) as f64).collect();
    let half_length = 0.5 * case.rail.width;
    Ok(ShakedownResults {
        title: case.title.clone(),
        bounds: bounds_by_depth(friction, poisson, &depths),
        map: shakedown_map((1.2 * friction.abs()).max(MAP_FRICTION), MAP, poisson),
        extent: Extent {
            from: case.rail.centre - half_length,
            to: case.rail.centre + half_length,
            depth: case.rail.depth,
        },
        warnings: warnings(&stabilised, pass_by_pass.as_ref(), settings),
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
            "not stabilised after {} passages: the last one still changed the residual stress by {:.3} MPa",
            settings.max_passes,
            stabilised.passes.last().map_or(0.0, |pass| pass.stress_change)
        ));
    }
    if let Some(other) = pass_by_pass {
        warnings.push(format!(
            "the direct method gives an admissible state, not the one that passages lead to: the residual stress differs \
             by up to {:.1} MPa",
            stabilised.stress_difference(other)
        ));
    }
    if stabilised.state == RailState::ElasticShakedown {
        warnings.push(
            "an elastic-shakedown state depends on the load history: on the first passages as computed"
                .into(),
        );
    }
    warnings
}

/// A line on a passage.
pub fn pass_text(pass: &PassRecord) -> String {
    format!(
        "passage {}: residual stress changes by {:.3} MPa, plastic strain by {:.2e} ({} redistributions)",
        pass.pass, pass.stress_change, pass.strain_change, pass.iterations
    )
}

fn result_text(summary: &ShakedownSummary) -> String {
    let dang_van = &summary.dang_van;
    let peak = &summary.peak_residual_stress;
    let passages = if summary.passes == 1 { "passage" } else { "passages" };
    let mut text = format!(
        "{} after {} {passages} ({}), p0 / k = {:.4}, shakedown limit {:.4}\n",
        summary.state, summary.passes, summary.method, summary.p0_over_k, summary.shakedown_limit.p0_over_k
    );
    text.push_str(&format!(
        "largest residual stress: {} = {:.1} MPa at depth {:.3} mm\n",
        peak.component, peak.stress_mpa, peak.depth_mm
    ));
    if let Some(zone) = summary.alternating_zone {
        text.push_str(&format!(
            "plastic strain alternates from depth {:.3} to {:.3} mm, up to {:.3e} per passage\n",
            zone.from_depth_mm, zone.to_depth_mm, zone.plastic_strain_per_pass
        ));
    }
    let verdict = if dang_van.margin_mpa < 0.0 { "a crack starts" } else { "no crack starts" };
    text.push_str(&format!(
        "Dang Van: {:.1} MPa at depth {:.3} mm, margin to b {:.1} MPa: {verdict}\n",
        dang_van.critical_value_mpa, dang_van.critical_depth_mm, dang_van.margin_mpa
    ));
    for warning in &summary.warnings {
        text.push_str(&format!("note: {warning}\n"));
    }
    text
}
