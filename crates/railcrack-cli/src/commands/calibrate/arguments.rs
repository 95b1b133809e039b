//! The command line of `railcrack calibrate`.

use crate::display::Verbosity;
use crate::exit::Failure;
use crate::input::{Inputs, default_folder};
use crate::interruption::Interruption;
use crate::progress::Progress;
use clap::Args;
use railcrack_case::Case;
use railcrack_run::simulation::RunError;
use railcrack_run::{Existing, ResultFolder, ResultKind, WithRun, is_file_of_run};
use std::path::PathBuf;

/// Fit the growth law, or another number of the case, to measured depths or lengths over traffic
///
/// The case is computed, and each measurement gives a coefficient of the growth law: cycles are in
/// proportion to 1/C. Several sites are weighed by their errors and by how much they differ
/// ([calibration] of the case). Another number is fitted by runs with several values of it. The run
/// folder gets calibration.html, .json, .csv, .svg and calibrated.toml, the case with the fitted
/// value and its scatter.
#[derive(Debug, Args)]
pub struct CalibrateArguments {
    /// The case file: its crack is the one from which the tonnes of the measurements count
    #[arg(value_name = "CASE")]
    pub case: PathBuf,
    /// CSV with the header mgt,depth_mm or mgt,length_mm, also with at_least_mm, at_most_mm and
    /// std_mm; given again for each further site
    #[arg(long, value_name = "FILE", required = true)]
    pub measured: Vec<PathBuf>,
    /// The number that is fitted in place of the coefficient: crack.friction, wheel[1].share; given
    /// a second time with the coefficient (growth.paris_c), both are fitted together
    #[arg(long, value_name = "SECTION.KEY")]
    pub parameter: Vec<String>,
    /// Its range, which is not widened [default: from half to twice the value of the case, widened
    /// as long as the best value is at an end]
    #[arg(long, value_name = "LOW,HIGH", requires = "parameter", value_parser = range, allow_hyphen_values = true)]
    pub between: Option<(f64, f64)>,
    /// The run folder [default: the case's name beside it]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Say nothing while computing
    #[arg(long)]
    pub quiet: bool,
    /// Replace the run in the folder
    #[arg(long)]
    pub force: bool,
}

impl CalibrateArguments {
    /// The run folder, entered for a calibration of `case`.
    ///
    /// Errors: the results would replace an input; those of [`ResultFolder::enter`].
    pub(super) fn enter(&self, case: &Case) -> Result<ResultFolder, Failure> {
        let folder = self.out.clone().unwrap_or_else(|| default_folder(&self.case));
        let inputs = Inputs::of_case(&self.case, case).with_all(self.measured.iter().cloned());
        inputs.stay(&folder, |name| is_file_of_run(name) || CALIBRATION.owns(name))?;
        let existing = if self.force { Existing::Replace } else { Existing::Refuse };
        Ok(ResultFolder::enter(&folder, &CALIBRATION, existing).map_err(RunError::from)?)
    }

    /// The progress of the run of `case`.
    pub(super) fn progress<'a>(&self, case: &Case, interruption: &'a Interruption) -> Progress<'a> {
        let verbosity = if self.quiet { Verbosity::Quiet } else { Verbosity::Progress };
        Progress::new(verbosity, case.growth.expected_steps(), interruption)
    }
}

/// The files beside those of the run.
static CALIBRATION: ResultKind = ResultKind {
    files: &["calibration.csv", "calibration.svg", "calibration.json", "calibration.html", "calibrated.toml"],
    folders: &[],
    run: WithRun::Yes,
};

/// The refusal of a case, of measurements or of arguments.
pub(super) fn refuse(reason: String) -> Failure {
    Failure::Calibration { reason }
}

/// A range on the command line: `LOW,HIGH`.
fn range(given: &str) -> Result<(f64, f64), String> {
    let ends: Option<Vec<f64>> = given.split(',').map(|end| end.trim().parse().ok()).collect();
    match ends.as_deref() {
        Some(&[low, high]) if low < high && low.is_finite() && high.is_finite() => Ok((low, high)),
        _ => Err("must be two numbers LOW,HIGH, the first one smaller".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges() {
        assert_eq!(range("0.1, 0.5"), Ok((0.1, 0.5)));
        assert_eq!(range("-1,2"), Ok((-1.0, 2.0)));
        for wrong in ["0.5", "2,1", "1,1", "a,b", "1,2,3", "1,inf"] {
            assert!(range(wrong).is_err(), "{wrong}");
        }
    }
}
