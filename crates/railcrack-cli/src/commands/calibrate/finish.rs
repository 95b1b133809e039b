//! The end of a calibration: its files, the calibrated case, the printed text.

use crate::exit::{Exit, Failure};
use crate::print;
use railcrack_case::Case;
use railcrack_report::{CalibratedRun, ChartSheet, calibration_charts, calibration_page, put};
use railcrack_run::calibration::CalibrationResult;
use railcrack_run::simulation::RunError;
use std::path::Path;

/// Results of a calibration that are written apart from its numbers.
pub(super) struct Written<'a> {
    /// `calibration.csv`.
    pub table: String,
    /// The runs that are drawn with the measurements.
    pub drawn: &'a [CalibratedRun<'a>],
    /// Load of an axle, t.
    pub tonnes: f64,
    /// The calibrated case.
    pub case: &'a Case,
}

/// Writes the results into the run folder and prints them.
pub(super) fn finish(folder: &Path, result: &CalibrationResult, written: &Written) -> Result<Exit, Failure> {
    let charts = calibration_charts(written.tonnes, result.sites, written.drawn);
    let first = charts.first().cloned().unwrap_or_default();
    let sheet = ChartSheet::of(result.title, "measured and computed sizes over traffic", first);
    let write = |name: &str, text: &str| put(&folder.join(name), text).map_err(RunError::from);
    write("calibration.csv", &written.table)?;
    write("calibration.svg", &sheet.svg())?;
    write("calibration.json", &result.json())?;
    write("calibration.html", &calibration_page(result, charts).html())?;
    write("calibrated.toml", &written.case.to_toml())?;
    print::stdout(&result.text())?;
    print::stdout(&format!("results in {}\n", folder.display()))?;
    Ok(Exit::Done)
}
