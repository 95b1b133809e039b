//! `railcrack calibrate --parameter`: a number on which the path depends, by runs with several
//! values of it.

use super::arguments::{CalibrateArguments, refuse};
use super::finish::{Written, finish};
use super::found::{Fitted, Found, New, calibrated_by};
use super::plot::Drawn;
use super::rows::deepest;
use super::table::table_of_trials;
use super::text::number;
use crate::commands::run::{is_same_file, listen};
use crate::display::Verbosity;
use crate::exit::{Exit, Failure};
use crate::input::default_folder;
use crate::interruption::Interruption;
use crate::progress::Progress;
use railcrack_case::{Case, NumberRange, Overrides, RangeEnd};
use railcrack_report::Pages;
use railcrack_run::calibration::{
    Bracket, CalibrationError, Coefficient, Next, ParameterFit, Prior, Site, SizeCurve, Trial,
    coefficient_at, fit_parameter, observe,
};
use railcrack_run::csv::TipRow;
use railcrack_run::simulation::{Ending, RunEntry, Simulation};
use std::path::{Path, PathBuf};

/// Fits the number `--parameter` of the case, writes the folder and prints the result.
pub(super) fn calibrate_parameter(
    arguments: &CalibrateArguments,
    case: &Case,
    sites: &[Site],
) -> Result<Exit, Failure> {
    let (key, coefficient) = keys(arguments, case)?;
    let value = case.number(&key).map_err(|error| refuse(format!("--parameter {error}")))?;
    let mut bracket = bracket(arguments, case, &key, value)?;
    let folder = arguments.out.clone().unwrap_or_else(|| default_folder(&arguments.case));
    if is_same_file(&arguments.case, &folder.join("case.toml")) {
        return Err(Failure::CaseInRunFolder { path: arguments.case.clone() });
    }
    let prior = Prior::from(case.calibration);
    let is_coefficient = case.coefficient().is_ok_and(|of| key == format!("growth.{}", of.key));
    let with = match (&coefficient, is_coefficient) {
        (Some(_), _) => Coefficient::Fitted,
        (None, true) => Coefficient::Searched(value),
        (None, false) => Coefficient::OfCase,
    };
    let runs = Runs {
        arguments,
        key: &key,
        tonnes: case.axle_load.unwrap_or(1.0),
        sites,
        folder: &folder,
        interruption: listen()?,
    };
    let entry = if arguments.force { RunEntry::Replace } else { RunEntry::Begin };
    let mut trials: Vec<(Trial, Vec<TipRow>)> = Vec::new();
    let mut waiting = bracket.values(value);
    let mut fit = loop {
        for value in std::mem::take(&mut waiting) {
            match runs.trial(value, trials.len() + 1)? {
                Some(trial) => trials.push(trial),
                None => return Ok(Exit::Interrupted),
            }
        }
        let known: Vec<Trial> = trials.iter().map(|(trial, _)| trial.clone()).collect();
        let fit = fit_parameter(&key, &known, prior, with)
            .map_err(|error| refuse(explained(&error, &key, &bracket)))?;
        // Runs at more values would not help to tell it from the coefficient.
        if coefficient.is_some() && fit.is_indistinct() {
            break fit;
        }
        let tried: Vec<f64> = known.iter().map(|trial| trial.value).collect();
        match bracket.next(&fit, &tried) {
            Next::Try(value) => waiting.push(value),
            // Its scatter follows from the interval.
            Next::Settled if is_coefficient => match bracket.closing(&fit, &tried) {
                Some(value) => waiting.push(value),
                None => break fit,
            },
            Next::Settled => break fit,
            Next::AtEnd(_) => return Err(refuse(at_end(&fit, &key, &bracket, tried.len()))),
        }
    };
    if coefficient.is_some() && fit.is_indistinct() {
        // The number stays that of the case: the coefficient is the one that belongs to it.
        if !trials.iter().any(|(trial, _)| trial.value == value) {
            match runs.trial(value, trials.len() + 1)? {
                Some(trial) => trials.push(trial),
                None => return Ok(Exit::Interrupted),
            }
        }
        let own = trials
            .iter()
            .map(|(trial, _)| trial)
            .find(|trial| trial.value == value && trial.sites.iter().flatten().any(Option::is_some));
        let nothing = || {
            refuse(format!(
                "no measurement is within the sizes that the run of the case, with {key} = {}, reaches",
                number(value)
            ))
        };
        fit.posterior = coefficient_at(own.ok_or_else(nothing)?, prior);
    }
    let best = if fit.is_indistinct() { value } else { fit.value };
    let mut overrides = Overrides::default();
    if let Some((_, own)) = &coefficient {
        let of = case.coefficient().map_err(|error| refuse(error.to_string()))?;
        overrides = of.overrides(own * fit.posterior.mean.exp());
    }
    let is_known = !fit.is_indistinct() && matches!(fit.interval, (Some(_), Some(_)));
    let new = (coefficient.is_some() || is_coefficient && is_known)
        .then(|| New::of(&fit.posterior, prior, sites.len(), case));
    overrides.settings.extend(new.map(New::setting));
    if new.is_some() && prior.mean != 0.0 {
        // The prior was relative to the coefficient of the case, which is now the fitted one.
        overrides.settings.push("calibration.prior_log_mean=0.0".to_owned());
    }
    overrides.settings.push(format!("{key}={best:?}"));
    if coefficient.is_some() || !fit.is_indistinct() {
        overrides.settings.push(calibrated_by(sites));
    }
    let fitted = Case::read_with(&arguments.case, &overrides)?;
    let progress = runs.progress(&fitted);
    let finished =
        Simulation::new(&fitted).observed_by(&progress).presented_by(&Pages).run_in(&folder, entry)?;
    if finished.ending == Ending::Interrupted {
        return Ok(Exit::Interrupted);
    }
    let rows = deepest(&folder)?;
    let of_case = trials.iter().find(|(trial, _)| trial.value == value).map(|(_, rows)| &rows[..]);
    let drawn: Vec<Drawn> =
        of_case.map(|rows| ("case", rows, 1.0)).into_iter().chain([("fitted", &rows[..], 1.0)]).collect();
    let known: Vec<Trial> = trials.iter().map(|(trial, _)| trial.clone()).collect();
    let found = Found {
        title: &case.title,
        key: key.clone(),
        value,
        prior,
        sites,
        fitted: Fitted::Parameter { fit: &fit, runs: trials.len() + 1, coefficient, new },
    };
    let table = table_of_trials(sites, &known);
    finish(&folder, &found, &Written { table, drawn: &drawn, tonnes: runs.tonnes, case: &fitted })
}

/// The key that is searched, and the coefficient with its value where it is fitted as well.
type Keys = (String, Option<(String, f64)>);

fn keys(arguments: &CalibrateArguments, case: &Case) -> Result<Keys, Failure> {
    match arguments.parameter.as_slice() {
        [key] => Ok((key.clone(), None)),
        [a, b] => {
            let own = case.coefficient().map_err(|error| refuse(error.to_string()))?;
            let name = format!("growth.{}", own.key);
            let other = match (*a == name, *b == name) {
                (true, false) => b,
                (false, true) => a,
                _ => {
                    return Err(refuse(format!(
                        "--parameter {a} --parameter {b}: one of the two must be the coefficient, {name}"
                    )));
                }
            };
            if case.maintenance.is_some() {
                return Err(refuse(format!(
                    "--parameter {name}: with [maintenance] tonnages are not in proportion to 1/C; fit one number at a time"
                )));
            }
            Ok((other.clone(), Some((name, own.value))))
        }
        more => Err(refuse(format!(
            "--parameter is given {} times: at most one number and the coefficient are fitted together",
            more.len()
        ))),
    }
}

fn bracket(arguments: &CalibrateArguments, case: &Case, key: &str, value: f64) -> Result<Bracket, Failure> {
    let everything = NumberRange::closed(f64::NEG_INFINITY, f64::INFINITY);
    let accepted = case.accepted_numbers(key).unwrap_or(everything);
    if let Some((low, high)) = arguments.between {
        if !accepted.contains(low) || !accepted.contains(high) {
            return Err(refuse(format!("--between {low},{high}: `{key}` must be a number in {accepted}")));
        }
        return Ok(Bracket::given(low, high));
    }
    let end = |end: RangeEnd, inwards: f64| match end {
        RangeEnd::Closed(value) => value,
        RangeEnd::Open(value) => value + inwards * f64::EPSILON * value.abs().max(f64::MIN_POSITIVE),
    };
    let bracket = Bracket::about(value, (end(accepted.min, 1.0), end(accepted.max, -1.0)));
    if value == 0.0 || bracket.low >= bracket.high {
        return Err(refuse(format!(
            "`--parameter {key}` is {value} in the case: give its range with --between LOW,HIGH"
        )));
    }
    Ok(bracket)
}

/// The runs of a calibration.
struct Runs<'a> {
    arguments: &'a CalibrateArguments,
    key: &'a str,
    tonnes: f64,
    sites: &'a [Site],
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
        let rows = deepest(&folder)?;
        let sites =
            self.sites.iter().map(|site| observe(site, &SizeCurve::of(&rows, self.tonnes, site.measure)));
        Ok(Some((Trial { value, sites: sites.collect() }, rows)))
    }
}

/// Beside the run folder, which the fitted run takes.
fn trial_folder(folder: &Path, number: usize) -> PathBuf {
    let mut name = folder.file_name().unwrap_or_default().to_owned();
    name.push("-trials");
    folder.with_file_name(name).join(format!("{number:03}"))
}

fn explained(error: &CalibrationError, key: &str, bracket: &Bracket) -> String {
    match error {
        CalibrationError::NothingToCompare { .. } => format!(
            "no measurement is within the sizes that the runs with {key} from {} to {} reach, at more than 0 MGT",
            number(bracket.low),
            number(bracket.high)
        ),
        error => error.to_string(),
    }
}

/// The refusal of a fit at the end of its range.
fn at_end(fit: &ParameterFit, key: &str, bracket: &Bracket, runs: usize) -> String {
    let range = format!("from {} to {}", number(bracket.low), number(bracket.high));
    let remedy = if bracket.widenings == 0 && bracket.accepted == (bracket.low, bracket.high) {
        "give another range with --between LOW,HIGH, or leave it out to have it widened"
    } else {
        "the measurements call for another number, or the runs beyond do not reach the measured sizes"
    };
    format!(
        "the best {key} of {runs} runs {range} is at an end, {}: it is no result; {remedy}",
        number(fit.value)
    )
}
