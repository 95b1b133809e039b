//! The tiles of a decision: what somebody who signs it must see first.

use super::stored::RunFolder;
use crate::numbers::{fixed, given, tonnage};
use crate::page::Fact;
use railcrack_run::decision::{Decision, DecisionPath, IntervalBasis, PathLives, Quantiles};

/// Interval, life with its spread, risk, calibration and what fails; none of a run without an
/// inspection.
pub(super) fn tiles(run: &RunFolder) -> Vec<Fact> {
    let Some(decision) = run.summary.decision.as_ref().filter(|_| run.case.inspection.is_some()) else {
        return Vec::new();
    };
    vec![interval(decision), life(decision), missed(decision), calibration(run), failure(decision)]
}

fn fact(name: &str, value: String, note: String) -> Fact {
    Fact { name: name.to_owned(), value, note }
}

/// Traffic with its unit.
fn traffic(mgt: f64) -> String {
    format!("{} MGT", tonnage(mgt))
}

fn interval(decision: &Decision) -> Fact {
    let name = "Inspection interval";
    let Some(of) = decision.risk.act_on else {
        return fact(name, "none".to_owned(), format!("verdict: {}", decision.verdict.level.word()));
    };
    let months = of.interval_months.map(|months| format!("{} months", fixed(months, 1)));
    let basis = match of.basis {
        IntervalBasis::SafetyFactor => "the window divided by the safety factor",
        IntervalBasis::TargetRisk => "the longest that keeps the target risk",
        IntervalBasis::MissedCracks => "the longest that misses no more cracks than the safety factor allows",
    };
    let notes: Vec<String> = months.into_iter().chain([basis.to_owned()]).collect();
    fact(name, traffic(of.interval_mgt), notes.join("; "))
}

/// The shortest life of the paths, with the quantiles of its samples or the spread of the paths.
fn life(decision: &Decision) -> Fact {
    let name = "Life";
    let Some(mgt) = shortest(decision) else {
        return fact(name, "no failure".to_owned(), "within the run".to_owned());
    };
    let path = decision.governed_by.note().unwrap_or("along the path of the run");
    let spread = decision.scatter.as_ref().and_then(|scatter| {
        let Quantiles { p05, p95, .. } = scatter.mgt_to_critical;
        let most = p95.map_or_else(|| "more than computed".to_owned(), tonnage);
        Some(format!("; 5 to 95 % of the samples: {} to {most} MGT", tonnage(p05?)))
    });
    fact(name, traffic(mgt), format!("{path}{}", spread.unwrap_or_default()))
}

/// Million gross tonnes to the failure along the path that governs.
fn shortest(decision: &Decision) -> Option<f64> {
    let paths: Option<PathLives> = decision.paths;
    match decision.governed_by {
        DecisionPath::Nominal => decision.failure.mgt,
        DecisionPath::Straight => paths.and_then(|paths| paths.straight),
        DecisionPath::Limit => paths.and_then(|paths| paths.limit),
    }
}

fn missed(decision: &Decision) -> Fact {
    let name = "Missed cracks";
    let target = decision
        .risk
        .target_risk
        .map_or_else(String::new, |target| format!("; {} is accepted", given(target)));
    match decision.risk.act_on {
        Some(of) => fact(
            name,
            format!("P = {}", given(crate::numbers::rounded(of.probability, 2))),
            format!("fail before inspections at this interval find them{target}"),
        ),
        None => fact(name, "not given".to_owned(), format!("without an interval{target}")),
    }
}

fn calibration(run: &RunFolder) -> Fact {
    let (value, note) = match run.case.calibration.sites {
        Some(1) => ("1 site".to_owned(), "by which the growth law is calibrated"),
        Some(sites) => (format!("{sites} sites"), "by which the growth law is calibrated"),
        None => ("not calibrated".to_owned(), "absolute rates are not known: see the decision"),
    };
    fact("Calibration", value, note.to_owned())
}

fn failure(decision: &Decision) -> Fact {
    let failure = decision.failure;
    let whose = failure.crack.map_or_else(String::new, |crack| format!("of crack {crack}"));
    let value = failure.mode.map_or_else(|| "nothing".to_owned(), |mode| mode.words().to_owned());
    fact("What fails", value, whose)
}
