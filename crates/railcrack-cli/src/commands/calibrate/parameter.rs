//! `railcrack calibrate --parameter`: a number on which the path depends, by runs with several
//! values of it.

use super::arguments::CalibrateArguments;
use super::results::{deepest, from_output, plot, write};
use crate::commands::run::{is_same_file, listen};
use crate::display::Verbosity;
use crate::exit::{Exit, Failure};
use crate::input::default_folder;
use crate::interruption::Interruption;
use crate::print;
use crate::progress::Progress;
use railcrack_case::{Case, Overrides};
use railcrack_report::Pages;
use railcrack_run::RunFolder;
use railcrack_run::calibration::{
    CalibrationError, Measure, Measured, ParameterFit, Trial, compared, fit_parameter,
};
use railcrack_run::csv::TipRow;
use railcrack_run::simulation::{Ending, RunEntry, Simulation};
use std::path::{Path, PathBuf};

/// Values over the range at first.
const FIRST: usize = 5;
/// Values that are added at most, each where the fit so far is best.
const ADDED: usize = 6;
/// A fit that is as near to a value as this share of the range is settled.
const SETTLED: f64 = 2e-3;

/// Fits the number `key` of the case, writes the folder and prints the result.
pub(super) fn calibrate_parameter(
    arguments: &CalibrateArguments,
    case: &Case,
    key: &str,
    (measure, measured): (Measure, &[Measured]),
) -> Result<Exit, Failure> {
    let refuse = |reason: String| Failure::Calibration { reason };
    let value = case.number(key).map_err(|error| refuse(format!("--parameter {error}")))?;
    let doubled = if value < 0.0 { (2.0 * value, 0.5 * value) } else { (0.5 * value, 2.0 * value) };
    let (low, high) = arguments.between.unwrap_or(doubled);
    if low >= high {
        return Err(refuse(format!(
            "`--parameter {key}` is 0 in the case: give its range with --between LOW,HIGH"
        )));
    }
    let folder = arguments.out.clone().unwrap_or_else(|| default_folder(&arguments.case));
    if is_same_file(&arguments.case, &folder.join("case.toml")) {
        return Err(Failure::CaseInRunFolder { path: arguments.case.clone() });
    }
    let runs = Runs {
        arguments,
        key,
        tonnes: case.axle_load.unwrap_or(1.0),
        measure,
        measured,
        folder: &folder,
        interruption: listen()?,
    };
    // The main run is that of the fitted value, so that its folder is taken first.
    let entry = if arguments.force { RunEntry::Replace } else { RunEntry::Begin };
    let mut trials: Vec<(Trial, Vec<TipRow>)> = Vec::new();
    let at = |i: usize| low + (high - low) * i as f64 / (FIRST - 1) as f64;
    let mut waiting: Vec<f64> = (0..FIRST).map(at).collect();
    if (low..=high).contains(&value) && !waiting.contains(&value) {
        waiting.push(value);
    }
    let mut added = 0;
    let fit = loop {
        for value in std::mem::take(&mut waiting) {
            match runs.trial(value, trials.len() + 1)? {
                Some(trial) => trials.push(trial),
                None => return Ok(Exit::Interrupted),
            }
        }
        let known: Vec<Trial> = trials.iter().map(|(trial, _)| trial.clone()).collect();
        let fit = fit_parameter(key, &known).map_err(|error| refuse(explained(&error, key, (low, high))))?;
        let near = |trial: &Trial| (trial.value - fit.value).abs() <= SETTLED * (high - low);
        if known.iter().any(near) || added == ADDED {
            break fit;
        }
        added += 1;
        waiting.push(fit.value);
    };
    let fitted = runs.case(fit.value)?;
    let progress = runs.progress(&fitted);
    let finished =
        Simulation::new(&fitted).observed_by(&progress).presented_by(&Pages).run_in(&folder, entry)?;
    if finished.ending == Ending::Interrupted {
        return Ok(Exit::Interrupted);
    }
    let rows = deepest(&RunFolder::open(&folder).and_then(|run| run.growth()).map_err(from_output)?);
    write(&folder, "calibration.csv", &table(&trials, key, measure))?;
    let of_case = trials.iter().find(|(trial, _)| trial.value == value).map(|(_, rows)| &rows[..]);
    let drawn: Vec<(&str, &[TipRow], f64)> =
        of_case.map(|rows| ("case", rows, 1.0)).into_iter().chain([("fitted", &rows[..], 1.0)]).collect();
    write(&folder, "calibration.svg", &plot(&case.title, runs.tonnes, measure, measured, &drawn))?;
    write(&folder, "calibrated.toml", &fitted.to_toml())?;
    print::stdout(&told(&fit, key, value, (measured.len(), trials.len() + 1)))?;
    print::stdout(&format!("results in {}\n", folder.display()))?;
    Ok(Exit::Done)
}

/// The runs of a calibration.
struct Runs<'a> {
    arguments: &'a CalibrateArguments,
    key: &'a str,
    tonnes: f64,
    measure: Measure,
    measured: &'a [Measured],
    folder: &'a Path,
    interruption: Interruption,
}

impl Runs<'_> {
    fn case(&self, value: f64) -> Result<Case, Failure> {
        let settings = vec![format!("{}={value:?}", self.key)];
        let overrides = Overrides { settings, ..Overrides::default() };
        Ok(Case::read_with(&self.arguments.case, &overrides)?)
    }

    fn progress(&self, case: &Case) -> Progress<'_> {
        let verbosity = if self.arguments.quiet { Verbosity::Quiet } else { Verbosity::Progress };
        Progress::new(verbosity, case.growth.steps, &self.interruption)
    }

    /// The run number `number` with `value`, beside the measurements, and its rows; none where it
    /// is interrupted.
    fn trial(&self, value: f64, number: usize) -> Result<Option<(Trial, Vec<TipRow>)>, Failure> {
        let case = self.case(value)?;
        let folder = trial_folder(self.folder, number);
        let progress = self.progress(&case);
        let finished = Simulation::new(&case).observed_by(&progress).run_in(&folder, RunEntry::Replace)?;
        if finished.ending == Ending::Interrupted {
            return Ok(None);
        }
        let rows = deepest(&RunFolder::open(&folder).and_then(|run| run.growth()).map_err(from_output)?);
        let compared = compared(&rows, self.tonnes, self.measure, self.measured);
        Ok(Some((Trial { value, compared }, rows)))
    }
}

/// Beside the run folder, which the fitted run takes.
fn trial_folder(folder: &Path, number: usize) -> PathBuf {
    let mut name = folder.file_name().unwrap_or_default().to_owned();
    name.push("-trials");
    folder.with_file_name(name).join(format!("{number:03}"))
}

fn explained(error: &CalibrationError, key: &str, (low, high): (f64, f64)) -> String {
    match error {
        CalibrationError::NothingToCompare { .. } => format!(
            "no measurement is within the sizes that the runs with {key} from {low} to {high} reach, at more than 0 MGT"
        ),
        error => error.to_string(),
    }
}

fn table(trials: &[(Trial, Vec<TipRow>)], key: &str, measure: Measure) -> String {
    let name = match measure {
        Measure::Depth => "depth_mm",
        Measure::Length => "length_mm",
    };
    let mut text = format!("# {key}: value of the run\nvalue,mgt,{name},computed_mgt\n");
    for (trial, _) in trials {
        for used in trial.compared.iter().flatten() {
            let measured = used.measured;
            text.push_str(&format!(
                "{},{},{},{}\n",
                trial.value, measured.mgt, measured.size, used.computed_mgt
            ));
        }
    }
    text
}

fn told(fit: &ParameterFit, key: &str, value: f64, (measured, runs): (usize, usize)) -> String {
    let mut text = format!("{key} = {}, {} in the case", number(fit.value), number(value));
    if let Some((low, high)) = fit.interval {
        text.push_str(&format!(", 95 % from {} to {}", number(low), number(high)));
    }
    text.push('\n');
    if fit.is_at_end {
        text.push_str("this is an end of the range: the best value may be beyond (--between LOW,HIGH)\n");
    }
    if let Some(std) = fit.log_std {
        text.push_str(&format!("scatter of ln N from measurement to measurement {std:.4}\n"));
    }
    text.push_str(&format!("{} of {measured} measurements used, {runs} runs\n", fit.used));
    text
}

/// Four digits behind the point, or of a number that is small or large.
fn number(value: f64) -> String {
    if value == 0.0 || (0.01..1e5).contains(&value.abs()) {
        format!("{value:.4}")
    } else {
        format!("{value:.4e}")
    }
}
