//! `railcrack contact`: the patches of the wheels, and the growth that each wheel causes.

use crate::exit::{Exit, Failure};
use crate::input::{self, Set, default_folder};
use crate::print;
use clap::Args;
use railcrack_case::Case;
use railcrack_report::{contact_page, patches_picture, put};
use railcrack_run::Existing;
use railcrack_run::contact::{
    GrowthAcross, WheelRow, across_table, by_growth, patch_table, patches_table, sentences, strips_table,
    wheels_table,
};
use railcrack_run::setup::{represented, wheel_demands};
use railcrack_run::simulation::RunError;
use std::fs::DirEntry;
use std::io::ErrorKind;
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
    clear(&folder, if arguments.force { Existing::Replace } else { Existing::Refuse })?;
    let run = represented(&case);
    let demands =
        wheel_demands(&case, &run).map_err(|error| Failure::Calibration { reason: error.to_string() })?;
    let rows = WheelRow::of_case(&run, &demands);
    let across = GrowthAcross::of(&run);
    let plots = folder.join("plots");
    std::fs::create_dir_all(&plots).map_err(|source| Failure::CannotWrite { path: plots.clone(), source })?;
    let mut drawn = by_growth(&rows);
    drawn.truncate(DRAWN);
    write(&folder.join("wheels.csv"), &wheels_table(&rows))?;
    write(&folder.join("patches.csv"), &patches_table(&rows, &drawn))?;
    write(&folder.join("strips.csv"), &strips_table(&rows, &drawn))?;
    if let Some(across) = &across {
        write(&folder.join("across.csv"), &across_table(across))?;
    }
    for &wheel in &drawn {
        if let Some(svg) = patches_picture(&rows[wheel]) {
            write(&plots.join(format!("wheel-{}.svg", rows[wheel].number)), &svg)?;
        }
    }
    if arguments.patches {
        write_patches(&folder.join(PATCHES), &rows)?;
    }
    let page = contact_page(&run, &rows, &drawn, across.as_ref());
    write(&folder.join("contact.html"), &page.html())?;
    if arguments.quiet {
        return Ok(Exit::Done);
    }
    print::stdout(&summary(&run, &rows, across.as_ref()))?;
    print::stdout(&format!("results in {}\n", folder.display()))?;
    Ok(Exit::Done)
}

/// The results by which a folder is known, those beside them, and the folders of the others, whose
/// names begin with [`OF_A_WHEEL`].
const ROWS: &str = "wheels.csv";
const TABLES: [&str; 5] = [ROWS, "patches.csv", "strips.csv", "across.csv", "contact.html"];
const PATCHES: &str = "patches";
const FOLDERS: [&str; 2] = ["plots", PATCHES];
const OF_A_WHEEL: &str = "wheel-";

/// Leaves no earlier results of this command in `folder`, and everything else as it is.
fn clear(folder: &Path, existing: Existing) -> Result<(), Failure> {
    if existing == Existing::Refuse {
        let path = folder.join(ROWS);
        return if path.exists() { Err(Failure::HoldsContact { path }) } else { Ok(()) };
    }
    let of_wheels = FOLDERS.iter().filter_map(|name| std::fs::read_dir(folder.join(name)).ok()).flatten();
    let is_ours = |file: &DirEntry| file.file_name().to_string_lossy().starts_with(OF_A_WHEEL);
    let of_wheels = of_wheels.flatten().filter(is_ours).map(|file| file.path());
    for path in TABLES.iter().map(|name| folder.join(name)).chain(of_wheels) {
        match std::fs::remove_file(&path) {
            Err(source) if source.kind() != ErrorKind::NotFound => {
                return Err(Failure::CannotWrite { path, source });
            }
            _ => (),
        }
    }
    Ok(())
}

/// A table of each patch of all wheels.
fn write_patches(folder: &Path, rows: &[WheelRow]) -> Result<(), Failure> {
    std::fs::create_dir_all(folder)
        .map_err(|source| Failure::CannotWrite { path: folder.to_path_buf(), source })?;
    for row in rows {
        for (i, own) in row.patches.iter().enumerate() {
            let name = match row.place {
                Some(place) => format!("{OF_A_WHEEL}{}-place-{place}-patch-{}.csv", row.number, i + 1),
                None => format!("{OF_A_WHEEL}{}-patch-{}.csv", row.number, i + 1),
            };
            write(&folder.join(name), &patch_table(own))?;
        }
    }
    Ok(())
}

fn beside(case: &Path) -> PathBuf {
    let folder = default_folder(case);
    let name = folder.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    folder.with_file_name(format!("{name}-contact"))
}

fn write(path: &Path, text: &str) -> Result<(), Failure> {
    Ok(put(path, text).map_err(RunError::from)?)
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
