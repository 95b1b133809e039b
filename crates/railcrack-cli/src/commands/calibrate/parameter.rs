//! `railcrack calibrate --parameter`: a number on which the path depends, by runs with several
//! values of it.

use super::arguments::{CalibrateArguments, refuse};
use super::finish::{Written, finish, interrupted};
use super::growth::deepest_tip;
use crate::commands::run::listen;
use crate::exit::{Exit, Failure};
use crate::interruption::{Interruption, Remains};
use railcrack_case::{Case, NumberRange, Overrides, RangeEnd};
use railcrack_report::{CalibratedRun, Pages};
use railcrack_run::calibration::{
    Bracket, CalibrationError, CalibrationResult, Coefficient, Fitted, NewRail, Next, ParameterFit, Prior,
    Site, SizeCurve, Trial, calibrated_by, coefficient_at, fit_parameter, number, observe, trials_table,
};
use railcrack_run::csv::TipRow;
use railcrack_run::simulation::{Ending, RunEntry, RunError, Simulation};
use railcrack_run::{ResultFolder, clear_run};
use std::path::{Path, PathBuf};

/// Fits the number `--parameter` of the case, writes the folder and prints the result.
pub(super) fn calibrate_parameter(
    arguments: &CalibrateArguments,
    case: &Case,
    sites: &[Site],
) -> Result<Exit, Failure> {
    let mut search = Search::new(arguments, case, sites)?;
    let Some(fit) = search.fit()? else { return search.interrupted() };
    let new = search.new_rail(&fit);
    let fitted = Case::read_with(&arguments.case, &search.overrides(&fit, new)?)?;
    let progress = arguments.progress(&fitted, &search.interruption);
    let simulation = Simulation::new(&fitted).observed_by(&progress).presented_by(&Pages);
    let Some(rows) = deepest_tip(&simulation, search.folder.path(), RunEntry::Entered)? else {
        return search.interrupted();
    };
    search.finish(fit, new, &fitted, &rows)
}

/// A search for the value of a number, by runs.
struct Search<'a> {
    arguments: &'a CalibrateArguments,
    case: &'a Case,
    sites: &'a [Site],
    /// Key of the number, and its value in the case.
    key: String,
    value: f64,
    /// Key and value of the coefficient of the growth law, where it is fitted as well.
    coefficient: Option<(String, f64)>,
    /// Whether the number is that coefficient.
    is_coefficient: bool,
    prior: Prior,
    /// Mean load of an axle, t.
    tonnes: f64,
    /// Of the run with the fitted value, entered.
    folder: ResultFolder,
    interruption: Interruption,
    trials: Vec<Trial>,
    /// The rows of each trial.
    rows: Vec<Vec<TipRow>>,
}

impl<'a> Search<'a> {
    fn new(arguments: &'a CalibrateArguments, case: &'a Case, sites: &'a [Site]) -> Result<Self, Failure> {
        let (key, coefficient) = keys(arguments, case)?;
        let value = case.number(&key).map_err(|error| refuse(format!("--parameter {error}")))?;
        // What is refused leaves the folder as it is.
        bracket(arguments, case, &key, value)?;
        let folder = arguments.enter(case)?;
        let trials = trial_folders(folder.path());
        trials.iter().try_for_each(|trial| folder.refuse_run(trial)).map_err(RunError::from)?;
        folder.mark().map_err(RunError::from)?;
        Ok(Self {
            value,
            is_coefficient: case.coefficient().is_ok_and(|of| key == format!("growth.{}", of.key)),
            prior: Prior::from(case.calibration),
            tonnes: case.axle_load.unwrap_or(1.0),
            folder,
            interruption: listen(Remains::Nothing)?,
            trials: Vec::new(),
            rows: Vec::new(),
            arguments,
            case,
            sites,
            key,
            coefficient,
        })
    }

    /// The best value; none where a run is interrupted.
    fn fit(&mut self) -> Result<Option<ParameterFit>, Failure> {
        let mut bracket = bracket(self.arguments, self.case, &self.key, self.value)?;
        let mut waiting = bracket.values(self.value);
        loop {
            for value in std::mem::take(&mut waiting) {
                if self.run(value)? == Ending::Interrupted {
                    return Ok(None);
                }
            }
            let fit = fit_parameter(&self.key, &self.trials, self.prior, self.role())
                .map_err(|error| refuse(explained(&error, &self.key, &bracket)))?;
            // Runs at more values would not help to tell it from the coefficient.
            if self.coefficient.is_some() && fit.is_indistinct() {
                return self.with_coefficient_of_case(fit);
            }
            match self.next(&mut bracket, &fit)? {
                Some(value) => waiting.push(value),
                None => return Ok(Some(fit)),
            }
        }
    }

    fn role(&self) -> Coefficient {
        match (&self.coefficient, self.is_coefficient) {
            (Some(_), _) => Coefficient::Fitted,
            (None, true) => Coefficient::Searched(self.value),
            (None, false) => Coefficient::OfCase,
        }
    }

    /// The value that is tried next; none after the last one.
    fn next(&self, bracket: &mut Bracket, fit: &ParameterFit) -> Result<Option<f64>, Failure> {
        let tried: Vec<f64> = self.trials.iter().map(|trial| trial.value).collect();
        match bracket.next(fit, &tried) {
            Next::Try(value) => Ok(Some(value)),
            // Its scatter follows from the interval.
            Next::Settled if self.is_coefficient => Ok(bracket.closing(fit, &tried)),
            Next::Settled => Ok(None),
            Next::AtEnd(_) => Err(refuse(at_end(fit, &self.key, bracket, tried.len()))),
        }
    }

    /// `fit` where the number stays that of the case: the coefficient is the one that belongs to
    /// it.
    fn with_coefficient_of_case(&mut self, mut fit: ParameterFit) -> Result<Option<ParameterFit>, Failure> {
        let of_case = self.value;
        if self.trials.iter().all(|trial| trial.value != of_case) && self.run(of_case)? == Ending::Interrupted
        {
            return Ok(None);
        }
        let reaches =
            |trial: &&Trial| trial.value == of_case && trial.sites.iter().flatten().any(Option::is_some);
        let Some(trial) = self.trials.iter().find(reaches) else {
            return Err(refuse(format!(
                "no measurement is within the sizes that the run of the case, with {} = {}, reaches",
                self.key,
                number(self.value)
            )));
        };
        fit.posterior = coefficient_at(trial, self.prior);
        Ok(Some(fit))
    }

    /// Runs the case with `value` and compares it with the measurements.
    fn run(&mut self, value: f64) -> Result<Ending, Failure> {
        let settings = vec![format!("{}={value:?}", self.key)];
        let case = Case::read_with(&self.arguments.case, &Overrides { settings, ..Overrides::default() })?;
        let folder = trial_folder(self.folder.path(), self.trials.len() + 1);
        let progress = self.arguments.progress(&case, &self.interruption);
        let simulation = Simulation::new(&case).observed_by(&progress);
        let Some(rows) = deepest_tip(&simulation, &folder, RunEntry::Replace)? else {
            return Ok(Ending::Interrupted);
        };
        let compared = |site: &Site| observe(site, &SizeCurve::of(&rows, self.tonnes, site.measure));
        self.trials.push(Trial { value, sites: self.sites.iter().map(compared).collect() });
        self.rows.push(rows);
        Ok(Ending::Ended)
    }

    /// The scatter of the coefficient on a rail that was not measured, where it is fitted.
    fn new_rail(&self, fit: &ParameterFit) -> Option<NewRail> {
        let is_known = !fit.is_indistinct() && matches!(fit.interval, (Some(_), Some(_)));
        (self.coefficient.is_some() || self.is_coefficient && is_known)
            .then(|| NewRail::of(&fit.posterior, self.prior, self.sites.len(), self.case))
    }

    /// The settings of the calibrated case.
    fn overrides(&self, fit: &ParameterFit, new: Option<NewRail>) -> Result<Overrides, Failure> {
        let mut overrides = Overrides::default();
        if let Some((_, value)) = &self.coefficient {
            let of = self.case.coefficient().map_err(|error| refuse(error.to_string()))?;
            overrides = of.overrides(value * fit.posterior.mean.exp());
        }
        if let Some(new) = new {
            overrides.settings.push(new.setting());
            overrides.settings.extend(self.prior.reset());
        }
        let best = if fit.is_indistinct() { self.value } else { fit.value };
        overrides.settings.push(format!("{}={best:?}", self.key));
        if self.coefficient.is_some() || !fit.is_indistinct() {
            overrides.settings.extend(calibrated_by(self.sites));
        }
        Ok(overrides)
    }

    /// Leaves no results after an interruption.
    fn interrupted(self) -> Result<Exit, Failure> {
        let own = self.folder.path();
        trial_folders(own).iter().try_for_each(|trial| clear_run(trial)).map_err(RunError::from)?;
        // Refused where something else is in it.
        let _ = std::fs::remove_dir(trials(own));
        interrupted(self.folder)
    }

    /// Writes and prints the result with the `rows` of the `fitted` case.
    fn finish(
        self,
        fit: ParameterFit,
        new: Option<NewRail>,
        fitted: &Case,
        rows: &[TipRow],
    ) -> Result<Exit, Failure> {
        let run = |name, rows| CalibratedRun { name, rows, speed: 1.0 };
        let of_case = self.trials.iter().position(|trial| trial.value == self.value);
        let of_case = of_case.map(|place| run("case", &self.rows[place][..]));
        let drawn: Vec<CalibratedRun> = of_case.into_iter().chain([run("fitted", rows)]).collect();
        let table = trials_table(self.sites, &self.trials);
        let runs = self.trials.len() + 1;
        let result = CalibrationResult {
            title: &self.case.title,
            key: self.key,
            value: self.value,
            prior: self.prior,
            sites: self.sites,
            fitted: Fitted::Parameter { fit, runs, coefficient: self.coefficient, new },
        };
        let written = Written { table, drawn: &drawn, tonnes: self.tonnes, case: fitted };
        finish(self.folder, &result, &written)
    }
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

/// The folder of the trials, beside the run folder, which the fitted run takes.
fn trials(folder: &Path) -> PathBuf {
    let mut name = folder.file_name().unwrap_or_default().to_owned();
    name.push("-trials");
    folder.with_file_name(name)
}

fn trial_folder(folder: &Path, number: usize) -> PathBuf {
    trials(folder).join(format!("{number:03}"))
}

/// The folders of trials that are there.
fn trial_folders(folder: &Path) -> Vec<PathBuf> {
    (1..).map(|number| trial_folder(folder, number)).take_while(|trial| trial.exists()).collect()
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
