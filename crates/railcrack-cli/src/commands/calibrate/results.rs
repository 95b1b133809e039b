//! Results of both kinds of calibration: the rows of the deepest tip, measured and computed sizes
//! over traffic, what was found as text and as JSON.

use crate::exit::Failure;
use railcrack_case::Case;
use railcrack_report::{Chart, ChartAxis, ChartSheet, Curve, CurveDots, CurveLook, put};
use railcrack_run::OutputError;
use railcrack_run::calibration::{
    Calibration, Finding, Measure, Observed, ParameterFit, Posterior, Prior, Site, SizeCurve, UsualError,
};
use railcrack_run::csv::TipRow;
use railcrack_run::simulation::RunError;
use serde_json::{Value, json};
use std::path::Path;

pub(super) fn from_output(error: OutputError) -> Failure {
    Failure::Run(error.into())
}

pub(super) fn refuse(reason: String) -> Failure {
    Failure::Calibration { reason }
}

/// The rows of the tip that is deepest in the last step.
pub(super) fn deepest(growth: &[TipRow]) -> Vec<TipRow> {
    let last = growth.last().map_or(0, |row| row.step);
    let tips = growth.iter().filter(|row| row.step == last);
    let Some(deepest) = tips.reduce(|a, b| if b.place[1] < a.place[1] { b } else { a }) else {
        return Vec::new();
    };
    growth.iter().filter(|row| (row.crack, row.tip) == (deepest.crack, deepest.tip)).copied().collect()
}

/// The measured quantity of the tip with these `rows` over traffic.
pub(super) fn curve(rows: &[TipRow], tonnes: f64, measure: Measure) -> SizeCurve {
    SizeCurve::of(rows, tonnes, measure)
}

/// The scatter of a rail that was not measured.
#[derive(Debug, Clone, Copy)]
pub(super) struct New {
    /// Standard deviation of ln C.
    pub std: f64,
    /// Whether it is that of the case from rail to rail, which a single site does not show.
    pub is_of_case: bool,
}

/// The normal quantile of 97.5 %.
const NORMAL: f64 = 1.959_963_984_540_054;
/// Scatter of ln C from rail to rail where the case gives none.
const USUAL: f64 = 0.3;

impl New {
    /// By the `posterior` of `sites` sites.
    pub fn of(posterior: &Posterior, prior: Prior, sites: usize, case: &Case) -> Self {
        if sites < 2 && prior.discrepancy.is_none() {
            let usual = case.scatter.as_ref().map_or(USUAL, |scatter| scatter.c_log_std);
            return Self { std: posterior.std.hypot(usual), is_of_case: true };
        }
        let (low, high) = posterior.new_interval;
        Self { std: (high - low) / (2.0 * NORMAL), is_of_case: false }
    }

    /// The key of the case that carries it.
    pub fn setting(self) -> String {
        format!("scatter.paris_c_log_std={:?}", self.std)
    }
}

/// The key of a calibrated case that says so.
pub(super) fn calibrated_by(sites: &[Site]) -> String {
    format!("calibration.sites={}", sites.len())
}

/// The result of a fit.
pub(super) enum Fitted<'a> {
    /// The coefficient of the growth law.
    Coefficient { calibration: &'a Calibration, new: New },
    /// Another number; `coefficient` is the key and value of the growth law's if it was fitted as
    /// well.
    Parameter { fit: &'a ParameterFit, runs: usize, coefficient: Option<(String, f64)>, new: Option<New> },
}

/// A calibration.
pub(super) struct Found<'a> {
    pub title: &'a str,
    /// The number that was fitted, and its value in the case.
    pub key: String,
    pub value: f64,
    pub prior: Prior,
    pub sites: &'a [Site],
    pub fitted: Fitted<'a>,
}

impl Found<'_> {
    /// `calibration.json`.
    pub fn json(&self) -> String {
        let mut all = json!({ "key": self.key, "of_case": self.value, "prior_log_mean": self.prior.mean, "prior_log_std": self.prior.log_std });
        let Some(object) = all.as_object_mut() else { return String::new() };
        let mut add = |name: &str, value: Value| object.insert(name.to_owned(), value);
        match &self.fitted {
            Fitted::Coefficient { calibration, new } => {
                let posterior = &calibration.posterior;
                add("value", json!(self.value * posterior.mean.exp()));
                of_posterior(&mut add, posterior, self.value);
                add("new_rail", new_rail(posterior.mean, *new, self.value));
                let sites: Vec<Value> = self
                    .sites
                    .iter()
                    .zip(&calibration.sites)
                    .map(|(site, fit)| {
                        json!({
                            "name": site.name,
                            "measurements": site.measured.len(),
                            "used": fit.observations.iter().flatten().count(),
                            "log_mean": fit.readings.map(|readings| readings.0),
                            "log_std": fit.readings.map(|readings| readings.1),
                            "posterior_log_mean": fit.posterior.mean,
                            "posterior_log_std": fit.posterior.std,
                        })
                    })
                    .collect();
                add("sites", sites.into());
            }
            Fitted::Parameter { fit, runs, coefficient, new } => {
                add("value", json!(fit.value));
                add("interval", json!([fit.interval.0, fit.interval.1]));
                add("is_determined", json!(!fit.is_indistinct()));
                add("used", json!(fit.used));
                add("runs", json!(runs));
                let profile: Vec<[f64; 2]> =
                    fit.profile.iter().map(|(value, deviance)| [*value, *deviance]).collect();
                add("deviance", json!(profile));
                if let Some((key, value)) = coefficient {
                    let mut inner = serde_json::Map::new();
                    inner.insert("key".into(), json!(key));
                    inner.insert("value".into(), json!(value * fit.posterior.mean.exp()));
                    let mut insert = |name: &str, value: Value| inner.insert(name.to_owned(), value);
                    of_posterior(&mut insert, &fit.posterior, *value);
                    if let Some(new) = new {
                        insert("new_rail", new_rail(fit.posterior.mean, *new, *value));
                    }
                    add("coefficient", inner.into());
                }
            }
        }
        let mut text = serde_json::to_string_pretty(&all).unwrap_or_default();
        text.push('\n');
        text
    }
}

fn of_posterior(add: &mut impl FnMut(&str, Value) -> Option<Value>, posterior: &Posterior, value: f64) {
    add("factor", json!(posterior.mean.exp()));
    add("log_mean", json!(posterior.mean));
    add("log_std", json!(posterior.std));
    let (low, high) = posterior.interval;
    add("interval", json!([value * low.exp(), value * high.exp()]));
    add("discrepancy_log_std", json!(posterior.discrepancy));
    add("log_evidence", json!(posterior.log_evidence));
}

fn new_rail(mean: f64, new: New, value: f64) -> Value {
    let ends = [-NORMAL, NORMAL].map(|z| value * (mean + z * new.std).exp());
    json!({ "log_std": new.std, "interval": ends })
}

/// The printed text.
pub(super) fn told(found: &Found) -> String {
    let measured: usize = found.sites.iter().map(|site| site.measured.len()).sum();
    match &found.fitted {
        Fitted::Coefficient { calibration, new } => {
            let key = found.key.trim_start_matches("growth.");
            let posterior = &calibration.posterior;
            let mut text = of_coefficient(key, found.value, posterior);
            text.push_str(&of_new_rail(found.value, posterior, *new));
            if found.sites.len() > 1 {
                text.push_str(&of_discrepancy(posterior, found.prior));
            }
            match calibration.usual {
                UsualError::OfLife(sigma) if sigma > 0.0 && has_unknown(found.sites) => text.push_str(&format!(
                    "errors of reading by their scatter: {sigma:.4} in ln N, widened by Student's distribution\n"
                )),
                UsualError::OfSize(std) if has_unknown(found.sites) => text.push_str(&format!(
                    "errors of reading taken as {std} mm: the file gives no std_mm\n"
                )),
                _ => (),
            }
            let used: usize =
                calibration.sites.iter().map(|site| site.observations.iter().flatten().count()).sum();
            text.push_str(&format!("{used} of {measured} measurements used\n"));
            text
        }
        Fitted::Parameter { fit, runs, coefficient, new } => {
            let mut text = String::new();
            if fit.is_indistinct() {
                text.push_str(&format!(
                    "the measurements do not determine {}: no value that was tried is excluded; it stays {}\n",
                    found.key,
                    number(found.value)
                ));
            } else {
                text.push_str(&format!(
                    "{} = {}, {} in the case, 95 % {}\n",
                    found.key,
                    number(fit.value),
                    number(found.value),
                    ends(fit.interval)
                ));
            }
            if let Some((key, value)) = coefficient {
                text.push_str(&of_coefficient(key.trim_start_matches("growth."), *value, &fit.posterior));
                if let Some(new) = new {
                    text.push_str(&of_new_rail(*value, &fit.posterior, *new));
                }
            }
            if found.sites.len() > 1 {
                text.push_str(&of_discrepancy(&fit.posterior, found.prior));
            }
            text.push_str(&format!("{} of {measured} measurements used, {runs} runs\n", fit.used));
            text
        }
    }
}

fn has_unknown(sites: &[Site]) -> bool {
    let is_unknown = |measured: &railcrack_run::calibration::Measured| {
        measured.std.is_none() && matches!(measured.finding, Finding::Size(_))
    };
    sites.iter().flat_map(|site| &site.measured).any(is_unknown)
}

fn of_coefficient(key: &str, value: f64, posterior: &Posterior) -> String {
    let factor = posterior.mean.exp();
    let (low, high) = posterior.interval;
    format!(
        "{key} = {:.4e}, {factor:.4} times that of the case, 95 % from {:.4e} to {:.4e}\n",
        value * factor,
        value * low.exp(),
        value * high.exp()
    )
}

fn of_new_rail(value: f64, posterior: &Posterior, new: New) -> String {
    let [low, high] = [-NORMAL, NORMAL].map(|z| value * (posterior.mean + z * new.std).exp());
    let why = if new.is_of_case {
        "; one site does not show how rails differ, so that the scatter of the case is kept"
    } else {
        ""
    };
    format!(
        "a rail that was not measured: 95 % from {low:.4e} to {high:.4e}, sd of ln C {:.4}{why}\n",
        new.std
    )
}

fn of_discrepancy(posterior: &Posterior, prior: Prior) -> String {
    let by = if prior.discrepancy.is_some() { "as given" } else { "by the largest evidence" };
    format!("sites differ by {:.4} in ln C ({by})\n", posterior.discrepancy)
}

fn ends((low, high): (Option<f64>, Option<f64>)) -> String {
    match (low, high) {
        (Some(low), Some(high)) => format!("from {} to {}", number(low), number(high)),
        (Some(low), None) => format!("above {}", number(low)),
        (None, Some(high)) => format!("below {}", number(high)),
        (None, None) => "not bounded".to_owned(),
    }
}

/// Four digits behind the point, or of a number that is small or large.
pub(super) fn number(value: f64) -> String {
    if value == 0.0 || (0.01..1e5).contains(&value.abs()) {
        format!("{value:.4}")
    } else {
        format!("{value:.4e}")
    }
}

/// The columns of a measurement: its size by quantity, and its class.
fn columns(sites: &[Site]) -> Vec<Measure> {
    [Measure::Depth, Measure::Length]
        .into_iter()
        .filter(|measure| sites.iter().any(|site| site.measure == *measure))
        .collect()
}

/// `calibration.csv`.
fn table_of(
    sites: &[Site],
    header: &str,
    cells: impl Fn(usize, usize) -> Option<Vec<(String, Option<f64>)>>,
) -> String {
    let quantities = columns(sites);
    let names: Vec<&str> = quantities.iter().map(|measure| measure.column()).collect();
    let mut text = format!("mgt,{},{header},site,at_least_mm,at_most_mm,std_mm\n", names.join(","));
    for (j, site) in sites.iter().enumerate() {
        for (i, measured) in site.measured.iter().enumerate() {
            let Some(rows) = cells(j, i) else { continue };
            let (size, bounds) = match measured.finding {
                Finding::Size(size) => (Some(size), (None, None)),
                Finding::Within(from, to) => {
                    (None, (Some(from).filter(|x| x.is_finite()), Some(to).filter(|x| x.is_finite())))
                }
            };
            for (middle, computed) in rows {
                let sizes: Vec<String> = quantities
                    .iter()
                    .map(|measure| cell(size.filter(|_| *measure == site.measure)))
                    .collect();
                text.push_str(&format!(
                    "{},{},{}{middle},{},{},{},{}\n",
                    measured.mgt,
                    sizes.join(","),
                    cell(computed),
                    site.name.replace(',', " "),
                    cell(bounds.0),
                    cell(bounds.1),
                    cell(measured.std)
                ));
            }
        }
    }
    text
}

fn cell(value: Option<f64>) -> String {
    value.map_or(String::new(), |value| value.to_string())
}

/// `calibration.csv` of a coefficient `value`.
pub(super) fn table(sites: &[Site], calibration: &Calibration, value: f64) -> String {
    table_of(sites, "computed_mgt,coefficient,ln_n_std", |j, i| {
        let observed = calibration.sites[j].observations[i].as_ref()?;
        let reading = observed.reading(calibration.usual);
        let computed = reading.map(|(y, _)| sites[j].measured[i].mgt * y.exp());
        let of = |cells: (f64, f64)| format!(",{},{}", value * cells.0.exp(), cells.1);
        Some(vec![(reading.map_or(",,".to_owned(), of), computed)])
    })
}

/// `calibration.csv` of the runs with several values of another number.
pub(super) fn table_of_trials(sites: &[Site], trials: &[railcrack_run::calibration::Trial]) -> String {
    table_of(sites, "computed_mgt,value", |j, i| {
        let of = |trial: &railcrack_run::calibration::Trial| {
            let computed = match trial.sites[j][i].as_ref()? {
                Observed::Reading { y, .. } => Some(sites[j].measured[i].mgt * y.exp()),
                Observed::Class(_) => None,
            };
            Some((format!(",{}", trial.value), computed))
        };
        Some(trials.iter().filter_map(of).collect())
    })
}

/// A run: its name, its rows, and how many times as fast it is drawn.
pub(super) type Drawn<'a> = (&'a str, &'a [TipRow], f64);

/// The chart of measured and computed sizes, by quantity.
pub(super) struct Plot {
    pub charts: Vec<Chart>,
}

impl Plot {
    /// All of it on a sheet.
    pub fn sheet(&self, title: &str) -> ChartSheet {
        let first = self.charts.first().cloned().unwrap_or_default();
        ChartSheet::of(title, "measured and computed sizes over traffic", first)
    }
}

/// Measured and computed sizes over traffic.
pub(super) fn plot(tonnes: f64, sites: &[Site], runs: &[Drawn]) -> Plot {
    let chart = |measure: Measure| {
        let (what, id) = match measure {
            Measure::Depth => ("Depth", "calibration-depth"),
            Measure::Length => ("Length", "calibration-length"),
        };
        let size = |row: &TipRow| match measure {
            Measure::Depth => -row.place[1],
            Measure::Length => row.length,
        };
        let curve = |(name, rows, factor): &Drawn| {
            let points = rows.iter().map(|row| [1e-6 * tonnes * row.load_cycles / factor, size(row)]);
            Curve::line(name, points.collect())
        };
        let measured = sites.iter().filter(|site| site.measure == measure).map(|site| {
            let at = |measured: &railcrack_run::calibration::Measured| {
                let size = match measured.finding {
                    Finding::Size(size) => size,
                    Finding::Within(from, to) if from.is_finite() && to.is_finite() => 0.5 * (from + to),
                    Finding::Within(from, to) => {
                        if from.is_finite() {
                            from
                        } else {
                            to
                        }
                    }
                };
                [measured.mgt, size]
            };
            let points = site.measured.iter().map(at).collect();
            Curve { look: CurveLook::Dots, ..Curve::line(&site.name, points) }.with_dots(CurveDots::All)
        });
        Chart {
            id: id.to_owned(),
            caption: format!(
                "{what} over traffic: measured (classes at their middle, open ones at their bound), computed, and computed with the fitted value."
            ),
            x: ChartAxis::linear("Traffic", "million gross tonnes"),
            y: ChartAxis::linear(what, "mm"),
            curves: runs.iter().map(curve).chain(measured).collect(),
            ..Chart::default()
        }
    };
    Plot { charts: columns(sites).into_iter().map(chart).collect() }
}

pub(super) fn write(folder: &Path, name: &str, text: &str) -> Result<(), Failure> {
    Ok(put(&folder.join(name), text).map_err(RunError::from)?)
}
