//! `railcrack shakedown`.

use super::run::listen;
use crate::exit::{Exit, Failure};
use crate::input::{Inputs, default_folder};
use crate::interruption::Remains;
use crate::print;
use crate::terminal;
use clap::Args;
use railcrack::interruption::Interruption;
use railcrack::shakedown::RailState;
use railcrack::words::Choice;
use railcrack_case::Case;
use railcrack_report::Pages;
use railcrack_run::simulation::{pass_text, roll};
use railcrack_run::{Existing, ShakedownSummary, is_file_of_run};
use std::path::PathBuf;

/// Compute the stabilised plastic state under repeated passages, and the risk of crack initiation
///
/// The cracks of the case are ignored. Written to the folder: the residual state by depth
/// (profile.csv, plastic.vtu), the change in each passage (passes.csv), the state with its bounds
/// and the Dang Van criterion (shakedown.json), stress and strain around the contact (cycle.vtu),
/// plots and a report.
#[derive(Debug, Args)]
pub struct ShakedownArguments {
    /// Case file
    #[arg(value_name = "CASE")]
    pub case: PathBuf,
    /// Folder for the results [default: name of the case file without its extension, next to it]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Lateral place (mm) of the profile and of the plane of the fields, under a patch
    #[arg(long, value_name = "MM", default_value_t = 0.0, allow_negative_numbers = true)]
    pub lateral: f64,
    /// Suppress progress output
    #[arg(long)]
    pub quiet: bool,
    /// Replace existing results in the folder
    #[arg(long)]
    pub force: bool,
}

/// Computes the state, writes the folder and prints a summary.
pub fn shakedown(arguments: &ShakedownArguments) -> Result<Exit, Failure> {
    let case = Case::read(&arguments.case)?;
    let folder = arguments.out.clone().unwrap_or_else(|| default_folder(&arguments.case));
    Inputs::of_case(&arguments.case, &case).stay(&folder, is_file_of_run)?;
    let interruption = listen(Remains::Nothing)?;
    let asked = || interruption.asked();
    let existing = if arguments.force { Existing::Replace } else { Existing::Refuse };
    let rolled =
        roll(&case, arguments.lateral, (&folder, existing), &Pages, Interruption::when(&asked), |pass| {
            if !arguments.quiet {
                terminal::stderr(&format!("{}\n", pass_text(pass)));
            }
        });
    let summary = match rolled {
        Err(error) if error.is_interruption() => return Ok(print::interrupted()),
        rolled => rolled?,
    };
    print::stdout(&result_text(&summary))?;
    print::stdout(&format!("results in {}\n", folder.display()))?;
    // The result is valid, but it is not the stabilised state that was requested.
    let stabilised = summary.state != RailState::NotStabilised;
    Ok(if stabilised { Exit::Done } else { Exit::NotConverged })
}

fn result_text(summary: &ShakedownSummary) -> String {
    let dang_van = &summary.dang_van;
    let peak = &summary.peak_residual_stress;
    let passages = if summary.passes == 1 { "passage" } else { "passages" };
    let mut text = format!(
        "{} after {} {passages} ({}), p0 / k = {:.4}, shakedown limit {:.4}\n",
        summary.state.word(),
        summary.passes,
        summary.method.word(),
        summary.p0_over_k,
        summary.shakedown_limit.p0_over_k
    );
    text.push_str(&format!(
        "largest residual stress: {} = {:.1} MPa at depth {:.3} mm\n",
        peak.component.name(),
        peak.stress_mpa,
        peak.depth_mm
    ));
    if let Some(zone) = summary.alternating_zone {
        text.push_str(&format!(
            "alternating plastic strain from depth {:.3} to {:.3} mm, up to {:.3e} per passage\n",
            zone.from_depth_mm, zone.to_depth_mm, zone.plastic_strain_per_pass
        ));
    }
    let verdict = if dang_van.margin_mpa < 0.0 { "crack initiation" } else { "no crack initiation" };
    text.push_str(&format!(
        "Dang Van: {:.1} MPa at depth {:.3} mm, margin to b {:.1} MPa: {verdict}\n",
        dang_van.critical_value_mpa, dang_van.critical_depth_mm, dang_van.margin_mpa
    ));
    for warning in &summary.warnings {
        text.push_str(&format!("note: {warning}\n"));
    }
    text
}
