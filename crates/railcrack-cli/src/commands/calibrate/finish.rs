//! The end of a calibration: its files, the calibrated case, the printed text.

use crate::exit::{Exit, Failure};
use crate::print;
use railcrack_case::Case;
use railcrack_report::{CalibratedRun, ChartSheet, calibration_charts, calibration_page};
use railcrack_run::ResultFolder;
use railcrack_run::calibration::CalibrationResult;
use railcrack_run::simulation::RunError;

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

/// Leaves no results after an interruption.
pub(super) fn interrupted(folder: ResultFolder) -> Result<Exit, Failure> {
    folder.abandon().map_err(RunError::from)?;
    Ok(print::interrupted())
}

/// Writes the results into the run folder, which is entered, and prints them.
pub(super) fn finish(
    folder: ResultFolder,
    result: &CalibrationResult,
    written: &Written,
) -> Result<Exit, Failure> {
    let charts = calibration_charts(written.tonnes, result.sites, written.drawn);
    let first = charts.first().cloned().unwrap_or_default();
    let sheet = ChartSheet::of(result.title, "measured and computed sizes over traffic", first);
    let texts = [
        ("calibration.csv", written.table.clone()),
        ("calibration.svg", sheet.svg()),
        ("calibration.json", result.json()),
        ("calibration.html", calibration_page(result, charts).html()),
        ("calibrated.toml", written.case.to_toml()),
    ];
    let path = folder.path().to_path_buf();
    folder.write(&texts.map(|(name, text)| (name.to_owned(), text)).into()).map_err(RunError::from)?;
    print::stdout(&result.text())?;
    print::stdout(&format!("results in {}\n", path.display()))?;
    Ok(Exit::Done)
}
