//! The tiles of a decision: what somebody who signs it must see first.

use super::stored::RunFolder;
use crate::numbers::{given, rounded};
use crate::page::Fact;
use railcrack_run::decision::{Decision, DecisionPath, IntervalBasis, PathLives, Quantiles};

/// Figures of the run that stand beside those of a decision: the others are of the end of the run.
const BESIDE_DECISION: [&str; 4] = ["Crack length", "Depth", "Direction", "Warnings"];

/// The tiles of the page: those of the decision, with the `facts` of the run that go with them.
pub(super) fn of_page(run: &RunFolder, mut facts: Vec<Fact>) -> Vec<Fact> {
    let mut all = tiles(run);
    if !all.is_empty() {
        facts.retain(|fact| BESIDE_DECISION.contains(&fact.name.as_str()));
    }
    all.extend(facts);
    all
}

/// Interval, life with its spread, risk, calibration and what fails; none of a run without an
/// inspection.
fn tiles(run: &RunFolder) -> Vec<Fact> {
    let Some(decision) = run.summary.decision.as_ref().filter(|_| run.case.inspection.is_some()) else {
        return Vec::new();
    };
    vec![interval(decision), life(decision), missed(decision), calibration(run), failure(decision)]
}

fn fact(name: &str, value: String, note: String) -> Fact {
    Fact { name: name.to_owned(), value, note }
}

/// Two significant digits: rates are not known as well as that.
fn digits(value: f64) -> String {
    given(rounded(value, 2))
}

/// Traffic with its unit.
fn traffic(mgt: f64) -> String {
    format!("{} MGT", digits(mgt))
}

fn interval(decision: &Decision) -> Fact {
    let name = "Inspection interval";
    let Some(of) = decision.risk.act_on else {
        return fact(name, "none".to_owned(), format!("verdict: {}", decision.verdict.level.word()));
    };
    let months = of.interval_months.map(|months| format!("{} months", digits(months)));
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
    let sampled = decision.scatter.as_ref().and_then(|scatter| {
        let Quantiles { p05, p95, .. } = scatter.mgt_to_critical;
        let most = p95.map_or_else(|| "more than computed".to_owned(), digits);
        Some(format!("; 5 to 95 % of the samples: {} to {most} MGT", digits(p05?)))
    });
    let spread = sampled.or_else(|| of_paths(decision.paths?));
    fact(name, traffic(mgt), format!("{path}{}", spread.unwrap_or_default()))
}

/// The spread of the lives along the paths, where there are no samples.
fn of_paths(paths: PathLives) -> Option<String> {
    let lives = [paths.straight, paths.nominal, paths.limit];
    let least = lives.into_iter().flatten().reduce(f64::min)?;
    let most = match lives {
        [Some(straight), Some(nominal), Some(limit)] => traffic(straight.max(nominal).max(limit)),
        _ => "no failure".to_owned(),
    };
    Some(format!("; by path: {} to {most}", digits(least)))
}

/// Million gross tonnes to the failure along the path that governs.
pub(super) fn shortest(decision: &Decision) -> Option<f64> {
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
            format!("P = {}", digits(of.probability)),
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
    // Another path may fail where that of the run does not.
    let along = decision.inspection.as_ref().and_then(|inspection| inspection.critical_by);
    let whose = failure.crack.or(along.map(|_| decision.crack));
    let whose = whose.map_or_else(String::new, |crack| format!("of crack {crack}"));
    let value = along.or(failure.mode).map_or_else(|| "nothing".to_owned(), |mode| mode.words().to_owned());
    fact("What fails", value, whose)
}
