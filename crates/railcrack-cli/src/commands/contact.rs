//! `railcrack contact`: the patches of the wheels, and the growth that each wheel causes.

use crate::commands::run::{announce_groups, listen};
use crate::exit::{Exit, Failure};
use crate::input::{self, Inputs, Set, default_folder};
use crate::interruption::Remains;
use crate::print;
use clap::Args;
use railcrack_case::Case;
use railcrack_report::{PatchKey, contact_page, patches_picture};
use railcrack_run::contact::{
    GrowthAcross, WheelRow, across_table, by_growth, patch_table, patches_table, sentences, strips_table,
    wheels_table,
};
use railcrack_run::setup::{represented, wheel_demands};
use railcrack_run::simulation::RunError;
use railcrack_run::{Existing, ResultFolder, ResultKind, WithRun};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Draw the contact patches of the wheels and rate the wheels by the growth that they cause
///
/// Every wheel of the case, or of its table of wheels, passes once over the cracks as they are at
/// the beginning. The folder gets wheels.csv (a row per wheel: pressure, forces, slip, Tgamma,
/// dKeq, share of the growth), patches.csv and strips.csv (tractions of the wheels that are drawn),
/// across.csv (growth by the lateral place of the crack), contact.html and plots/; with --patches
/// also patches/, a table per wheel and patch.
#[derive(Debug, Args)]
pub struct ContactArguments {
    /// Case file; `-` is standard input
    #[arg(value_name = "CASE")]
    pub case: PathBuf,
    /// Folder for the results [default: name of the case file with -contact, next to it]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Also write a table of pressure, shear and slip of every patch
    #[arg(long)]
    pub patches: bool,
    /// Replace existing results in the folder
    #[arg(long)]
    pub force: bool,
    #[command(flatten)]
    pub set: Set,
    /// Suppress the summary
    #[arg(long)]
    pub quiet: bool,
}

/// Wheels that are drawn at most: those that grow the cracks most.
const DRAWN: usize = 9;

/// Computes the passages, writes the folder and prints the wheels that grow the cracks most.
pub fn contact(arguments: &ContactArguments) -> Result<Exit, Failure> {
    let case = input::case(&arguments.case, &arguments.set.overrides())?;
    let folder = arguments.out.clone().unwrap_or_else(|| beside(&arguments.case));
    Inputs::of_case(&arguments.case, &case).stay(&folder, |name| CONTACT.owns(name))?;
    let interruption = listen(Remains::Nothing)?;
    let existing = if arguments.force { Existing::Replace } else { Existing::Refuse };
    let entered = ResultFolder::enter(&folder, &CONTACT, existing).map_err(RunError::from)?;
    if !arguments.quiet {
        announce_groups(&case);
    }
    let run = represented(&case);
    let demands = wheel_demands(&case, &run)?;
    let rows = WheelRow::of_case(&run, &demands);
    let across = GrowthAcross::of(&run);
    let files = files(arguments, &run, &rows, across.as_ref());
    if interruption.asked() {
        return Ok(print::interrupted());
    }
    entered.write(&files).map_err(RunError::from)?;
    if arguments.quiet {
        return Ok(Exit::Done);
    }
    print::stdout(&summary(&run, &rows, across.as_ref()))?;
    print::stdout(&format!("results in {}\n", folder.display()))?;
    Ok(Exit::Done)
}

/// The files of the command, by their names in its folder.
fn files(
    arguments: &ContactArguments,
    run: &Case,
    rows: &[WheelRow],
    across: Option<&GrowthAcross>,
) -> BTreeMap<String, String> {
    let mut drawn = by_growth(rows);
    drawn.truncate(DRAWN);
    let mut files = BTreeMap::from([
        ("wheels.csv".to_owned(), wheels_table(rows)),
        ("patches.csv".to_owned(), patches_table(rows, &drawn)),
        ("strips.csv".to_owned(), strips_table(rows, &drawn)),
        ("contact.html".to_owned(), contact_page(run, rows, &drawn, across).html()),
    ]);
    files.extend(across.map(|across| ("across.csv".to_owned(), across_table(across))));
    let picture = |wheel: &usize| {
        let row = &rows[*wheel];
        Some((format!("plots/{OF_A_WHEEL}{}.svg", row.number), patches_picture(row, PatchKey::InPicture)?))
    };
    files.extend(drawn.iter().filter_map(picture));
    if arguments.patches {
        files.extend(rows.iter().flat_map(patch_tables));
    }
    files
}

/// The files of the command.
static CONTACT: ResultKind = ResultKind {
    files: &["wheels.csv", "patches.csv", "strips.csv", "across.csv", "contact.html"],
    folders: &[("plots", is_picture), ("patches", is_patch)],
    run: WithRun::No,
};

/// Beginning of the names of files of one wheel.
const OF_A_WHEEL: &str = "wheel-";

/// Whether `name` is that of the picture of a wheel.
fn is_picture(name: &str) -> bool {
    let number = name.strip_prefix(OF_A_WHEEL).and_then(|name| name.strip_suffix(".svg"));
    number.is_some_and(|number| number.parse::<u64>().is_ok())
}

/// Whether `name` is that of the table of a patch.
fn is_patch(name: &str) -> bool {
    let named = name.strip_prefix(OF_A_WHEEL).and_then(|name| name.strip_suffix(".csv"));
    let Some((wheel, patch)) = named.and_then(|name| name.split_once("-patch-")) else { return false };
    let (number, place) = wheel.split_once("-place-").unwrap_or((wheel, "0"));
    number.parse::<u64>().is_ok() && place.parse::<f64>().is_ok() && patch.parse::<u64>().is_ok()
}

/// A table for each patch of a wheel, with the name of its file.
fn patch_tables(row: &WheelRow) -> impl Iterator<Item = (String, String)> + '_ {
    let wheel = match row.place {
        Some(place) => format!("{OF_A_WHEEL}{}-place-{place}", row.number),
        None => format!("{OF_A_WHEEL}{}", row.number),
    };
    row.patches
        .iter()
        .enumerate()
        .map(move |(i, own)| (format!("patches/{wheel}-patch-{}.csv", i + 1), patch_table(own)))
}

fn beside(case: &Path) -> PathBuf {
    let folder = default_folder(case);
    let name = folder.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    folder.with_file_name(format!("{name}-contact"))
}

/// The summary on the terminal.
fn summary(case: &Case, rows: &[WheelRow], across: Option<&GrowthAcross>) -> String {
    let mut text = String::new();
    for &wheel in by_growth(rows).iter().take(5) {
        let row = &rows[wheel];
        text.push_str(&format!(
            "wheel {}: p0 {:.0} MPa, {} slips {:.0} %, Tgamma {:.1} N, dKeq {:.2} MPa sqrt(m), {:.1} % of the growth\n",
            row.number,
            row.peak_pressure,
            row.force.map_or_else(String::new, |[x, y]| format!("Fx {:.2} kN, Fy {:.2} kN,", 1e-3 * x, 1e-3 * y)),
            100.0 * row.slip_share.unwrap_or(0.0),
            row.t_gamma.unwrap_or(0.0),
            row.delta_keq,
            100.0 * row.growth_share
        ));
    }
    for sentence in sentences(case, rows, across) {
        text.push_str(&sentence);
        text.push('\n');
    }
    text
}
