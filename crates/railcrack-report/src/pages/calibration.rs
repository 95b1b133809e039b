//! `calibration.html`: what was fitted, by which measurements, and what it does not say.

use crate::chart::{Chart, ChartAxis, Curve};
use crate::numbers::significant;
use crate::page::{Block, Fact, Page, Section};
use crate::table::Table;
use railcrack_run::calibration::{
    Calibration, CalibrationResult, Fitted, NewRail, ParameterFit, Posterior, number,
};

/// The page of `result` with the `charts` of sizes over traffic.
pub fn calibration_page(result: &CalibrationResult, charts: Vec<Chart>) -> Page {
    let text = result.text();
    let mut lines = text.lines().map(str::to_owned);
    let verdict = lines.next().unwrap_or_default();
    let (facts, section) = match &result.fitted {
        Fitted::Coefficient { calibration, new } => {
            (coefficient_facts(result, &calibration.posterior, *new), sites(result, calibration))
        }
        Fitted::Parameter { fit, coefficient, .. } => {
            let mut values = vec![deviance(&result.key, fit)];
            values.extend(coefficient.is_some().then(|| separation(&result.key, fit)));
            (parameter_facts(result), Section::new("values", "Values", values))
        }
    };
    let assumed = Block::List(ASSUMED.map(str::to_owned).to_vec());
    Page {
        title: result.title.to_owned(),
        kind: "Calibration".into(),
        decision: None,
        verdict,
        facts,
        lead: vec![Block::List(lines.collect())],
        sections: vec![
            Section::new("sizes", "Measured and computed", vec![Block::charts(charts)]),
            section,
            Section::new("assumed", "Assumptions", vec![assumed]),
        ],
    }
}

/// The prior of the coefficient.
fn prior(result: &CalibrationResult) -> Fact {
    Fact::new(
        "ln(C/C_{0}) before the measurements",
        format!("{} ± {}", significant(result.prior.mean), significant(result.prior.log_std)),
        "[calibration]: mean and standard deviation",
    )
}

fn coefficient_facts(result: &CalibrationResult, posterior: &Posterior, new: NewRail) -> Vec<Fact> {
    vec![
        Fact::new("Coefficient over that of the case", significant(posterior.mean.exp()), ""),
        Fact::new("sd of ln C, of these rails", significant(posterior.std), ""),
        Fact::new("sd of ln C, of another rail", significant(new.std), "as [scatter] paris_c_log_std"),
        prior(result),
    ]
}

fn parameter_facts(result: &CalibrationResult) -> Vec<Fact> {
    let Fitted::Parameter { fit, runs, new, .. } = &result.fitted else { return Vec::new() };
    let of_case = format!("{} in the case", number(result.value));
    let mut facts =
        vec![Fact::new(&result.key, number(fit.value), of_case), Fact::new("Runs", runs.to_string(), "")];
    facts.extend(new.map(|_| prior(result)));
    facts
}

/// The coefficient by site.
fn sites(result: &CalibrationResult, calibration: &Calibration) -> Section {
    let mut table = Table::new([
        "site",
        "measurements used",
        "ln(C/C_{0}) read",
        "its sd",
        "ln(C/C_{0}), all sites",
        "its sd",
    ]);
    for (site, fit) in result.sites.iter().zip(&calibration.sites) {
        let used = fit.observations.iter().flatten().count();
        let [mean, std] = fit.readings.map_or(["classes alone".to_owned(), String::new()], |(mean, std)| {
            [significant(mean), significant(std)]
        });
        table.row([
            site.name.clone(),
            format!("{used} of {}", site.measured.len()),
            mean,
            std,
            significant(fit.posterior.mean),
            significant(fit.posterior.std),
        ]);
    }
    Section::new("sites", "Sites", vec![Block::Table(table), Block::Text(MODEL.to_owned())])
}

/// The deviance of the number `key` by value.
fn deviance(key: &str, fit: &ParameterFit) -> Block {
    let points = fit.profile.iter().map(|(value, deviance)| [*value, *deviance]).collect();
    Block::Chart(Chart {
        id: "deviance".into(),
        caption: "Deviance by value, less the smallest one. Values above 3.84 are excluded with 95 %.".into(),
        x: ChartAxis::linear(key, ""),
        y: ChartAxis::linear("Deviance", ""),
        curves: vec![Curve::line("deviance", points)],
        ..Chart::default()
    })
}

/// How the measurements tell the number `key` from a coefficient that is fitted too.
fn separation(key: &str, fit: &ParameterFit) -> Block {
    Block::Text(match fit.is_indistinct() {
        true => format!(
            "{key} and the coefficient of the growth law explain these measurements equally well: only their joint effect on the rate is known. Measurements over a wider range of sizes, or the parameter measured by itself, would separate them."
        ),
        false => "The coefficient is fitted at every value, with a prior that says nothing; what is left distinguishes the values by the shape of growth alone.".into(),
    })
}

const MODEL: &str = "Each reading gives y = ln(N computed / N measured) with the standard deviation of the size times |d ln N / d size|. A site differs from the line by a discrepancy, and the line from the case by ln(C/C_{0}), both normal; classes enter by their probability.";

const ASSUMED: [&str; 4] = [
    "The fit lumps together all that makes a rail grow faster or slower: steel, loads, frictions, water. It holds for the line on which the sites lie.",
    "The exponent of the law and the shape of growth over depth are those of the case. Rates at other depths than those measured rest on them.",
    "Depths are those of rail that was neither ground nor worn between the measurements, unless the case has [maintenance].",
    "Errors of reading at one site are independent of each other. A probe that reads all cracks too deep is not recognised.",
];
