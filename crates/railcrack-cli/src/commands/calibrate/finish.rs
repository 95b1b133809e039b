//! The end of a calibration: its files, the calibrated case, the printed text.

use super::found::Found;
use super::page::page;
use super::plot::{Drawn, plot};
use super::text::told;
use crate::exit::{Exit, Failure};
use crate::print;
use railcrack_case::Case;
use railcrack_report::put;
use railcrack_run::simulation::RunError;
use std::path::Path;

/// Results of a calibration that are written apart from its numbers.
pub(super) struct Written<'a> {
    /// `calibration.csv`.
    pub table: String,
    /// The runs that are drawn with the measurements, and the load of their axles, t.
    pub drawn: &'a [Drawn<'a>],
    pub tonnes: f64,
    /// The calibrated case.
    pub case: &'a Case,
}

/// Writes the results into the run folder and prints them.
pub(super) fn finish(folder: &Path, found: &Found, written: &Written) -> Result<Exit, Failure> {
    let plot = plot(written.tonnes, found.sites, written.drawn);
    let write = |name: &str, text: &str| put(&folder.join(name), text).map_err(RunError::from);
    write("calibration.csv", &written.table)?;
    write("calibration.svg", &plot.sheet(found.title).svg())?;
    write("calibration.json", &found.json())?;
    write("calibration.html", &page(found, &plot).html())?;
    write("calibrated.toml", &written.case.to_toml())?;
    print::stdout(&told(found))?;
    print::stdout(&format!("results in {}\n", folder.display()))?;
    Ok(Exit::Done)
}
