//! `calibration.html`: what was fitted, by which measurements, and what it does not say.

use super::found::{Fitted, Found};
use super::plot::Plot;
use super::text::{number, told};
use railcrack_report::{Block, Chart, ChartAxis, Curve, Fact, Page, Section, Table, significant};

/// The page of `found` with the chart of sizes over traffic.
pub(super) fn page(found: &Found, plot: &Plot) -> Page {
    let text = told(found);
    let mut lines = text.lines().map(str::to_owned);
    let verdict = lines.next().unwrap_or_default();
    let mut sections = vec![Section {
        id: "sizes".into(),
        heading: "Measured and computed".into(),
        blocks: vec![Block::charts(plot.charts.iter().cloned())],
    }];
    let mut facts = Vec::new();
    let prior = fact(
        "ln(C/C_{0}) before the measurements",
        format!("{} ± {}", significant(found.prior.mean), significant(found.prior.log_std)),
        "[calibration]: mean and standard deviation",
    );
    match &found.fitted {
        Fitted::Coefficient { calibration, new } => {
            let posterior = &calibration.posterior;
            facts.push(fact("Coefficient over that of the case", significant(posterior.mean.exp()), ""));
            facts.push(fact("sd of ln C, of these rails", significant(posterior.std), ""));
            facts.push(fact(
                "sd of ln C, of another rail",
                significant(new.std),
                "as [scatter] paris_c_log_std",
            ));
            facts.push(prior);
            let mut table = Table::new([
                "site",
                "measurements used",
                "ln(C/C_{0}) read",
                "its sd",
                "ln(C/C_{0}), all sites",
                "its sd",
            ]);
            for (site, fit) in found.sites.iter().zip(&calibration.sites) {
                let used = fit.observations.iter().flatten().count();
                let read = fit.readings.map_or(["classes alone".to_owned(), String::new()], |(mean, std)| {
                    [significant(mean), significant(std)]
                });
                let [mean, std] = read;
                table.row([
                    site.name.clone(),
                    format!("{used} of {}", site.measured.len()),
                    mean,
                    std,
                    significant(fit.posterior.mean),
                    significant(fit.posterior.std),
                ]);
            }
            sections.push(Section {
                id: "sites".into(),
                heading: "Sites".into(),
                blocks: vec![Block::Table(table), Block::Text(MODEL.to_owned())],
            });
        }
        Fitted::Parameter { fit, runs, coefficient, new } => {
            facts.push(fact(&found.key, number(fit.value), &format!("{} in the case", number(found.value))));
            facts.push(fact("Runs", runs.to_string(), ""));
            if new.is_some() {
                facts.push(prior);
            }
            let points = fit.profile.iter().map(|(value, deviance)| [*value, *deviance]).collect();
            let chart = Chart {
                id: "deviance".into(),
                caption:
                    "Deviance by value, less the smallest one. Values above 3.84 are excluded with 95 %."
                        .into(),
                x: ChartAxis::linear(&found.key, ""),
                y: ChartAxis::linear("Deviance", ""),
                curves: vec![Curve::line("deviance", points)],
                ..Chart::default()
            };
            let mut blocks = vec![Block::Chart(chart)];
            if coefficient.is_some() {
                blocks.push(Block::Text(if fit.is_indistinct() {
                    format!(
                        "{} and the coefficient of the growth law explain these measurements equally well: only their joint effect on the rate is known. Measurements over a wider range of sizes, or the parameter measured by itself, would separate them.",
                        found.key
                    )
                } else {
                    "The coefficient is fitted at every value, with a prior that says nothing; what is left distinguishes the values by the shape of growth alone.".into()
                }));
            }
            sections.push(Section { id: "values".into(), heading: "Values".into(), blocks });
        }
    }
    sections.push(Section {
        id: "assumed".into(),
        heading: "Assumptions".into(),
        blocks: vec![Block::List(ASSUMED.iter().map(|&line| line.to_owned()).collect())],
    });
    Page {
        title: found.title.to_owned(),
        kind: "Calibration".into(),
        decision: None,
        verdict,
        facts,
        lead: vec![Block::List(lines.collect())],
        sections,
    }
}

fn fact(name: &str, value: String, note: &str) -> Fact {
    Fact { name: name.to_owned(), value, note: note.to_owned() }
}

const MODEL: &str = "Each reading gives y = ln(N computed / N measured) with the standard deviation of the size times |d ln N / d size|. A site differs from the line by a discrepancy, and the line from the case by ln(C/C_{0}), both normal; classes enter by their probability.";

const ASSUMED: [&str; 4] = [
    "The fit lumps together all that makes a rail grow faster or slower: steel, loads, frictions, water. It holds for the line on which the sites lie.",
    "The exponent of the law and the shape of growth over depth are those of the case. Rates at other depths than those measured rest on them.",
    "Depths are those of rail that was neither ground nor worn between the measurements, unless the case has [maintenance].",
    "Errors of reading at one site are independent of each other. A probe that reads all cracks too deep is not recognised.",
];
