//! The first screen of the report of a study.

use crate::direction::Course;
use crate::figures::{StudyRun, values};
use crate::numbers::{fixed, grouped, significant};
use crate::page::Fact;
use railcrack::bulk::Boundary;
use railcrack::growth::WarningKind;
use railcrack::growth::{RunStop, TipStop};
use railcrack::words::Choice;
use railcrack_run::run_folder::cycles_to;
use railcrack_run::study::{RunState, StudyPlan};
use std::collections::BTreeMap;

/// Maximum number of failed runs listed individually.
const MOST_TOLD: usize = 20;
/// Maximum number of runs listed by number.
const MOST_LISTED: usize = 12;

/// The runs with the most and the least of a quantity.
struct Span<'a, 'b> {
    least: (f64, &'b StudyRun<'a>),
    most: (f64, &'b StudyRun<'a>),
}

impl<'a, 'b> Span<'a, 'b> {
    fn of(values: impl Iterator<Item = (f64, &'b StudyRun<'a>)>) -> Option<Self> {
        values.fold(None, |span, value| {
            let Some(Self { least, most }) = span else { return Some(Self { least: value, most: value }) };
            Some(Self {
                least: if value.0 < least.0 { value } else { least },
                most: if value.0 > most.0 { value } else { most },
            })
        })
    }
}

/// Load cycles to the largest length that all runs with growth reach; none without a common length.
struct Race<'a, 'b> {
    length: f64,
    /// Runs that reach it.
    runs: usize,
    cycles: Span<'a, 'b>,
}

impl<'a, 'b> Race<'a, 'b> {
    fn of(all: &'b [StudyRun<'a>]) -> Option<Self> {
        let grown = || {
            let tips = all.iter().filter_map(|run| Some((run, run.tip()?)));
            tips.filter(|(_, tip)| tip.last().length > tip.first.length)
        };
        let length = grown().map(|(_, tip)| tip.last().length).reduce(f64::min)?;
        let begun = grown().map(|(_, tip)| tip.first.length).reduce(f64::max)?;
        // Below the initial length there is nothing to compare.
        if length <= begun {
            return None;
        }
        let cycles = Span::of(grown().filter_map(|(run, tip)| Some((cycles_to(&tip.rows, length)?, run))))?;
        Some(Self { length, runs: grown().count(), cycles })
    }
}

/// The runs with the largest and the smallest growth rate of the initial cracks.
fn rates<'a, 'b>(all: &'b [StudyRun<'a>]) -> Option<Span<'a, 'b>> {
    Span::of(all.iter().filter_map(|run| Some((run.tip()?.first.rate, run))))
}

/// The main result.
pub(super) fn verdict(plan: &StudyPlan, all: &[StudyRun]) -> String {
    let run = |run: &StudyRun| format!("run {} ({})", run.number(), values(plan, run.planned));
    let mut text = match (Race::of(all), rates(all)) {
        (Some(Race { length, runs: 1, cycles }), _) => format!(
            "One run grows: {}, to {} mm in {} load cycles.",
            run(cycles.most.1),
            fixed(length, 2),
            grouped(cycles.most.0)
        ),
        (Some(Race { length, runs, cycles }), _) => format!(
            "The life to a length of {} mm, reached in {}, ranges from {} load cycles in {} to {} in {}.",
            fixed(length, 2),
            if runs == all.len() { format!("all {runs} runs") } else { format!("{runs} runs") },
            grouped(cycles.least.0),
            run(cycles.least.1),
            grouped(cycles.most.0),
            run(cycles.most.1)
        ),
        (None, Some(rates)) => format!(
            "The initial cracks grow fastest, by {} mm per load cycle, in {} and slowest, by {} mm, in {}.",
            significant(rates.most.0),
            run(rates.most.1),
            significant(rates.least.0),
            run(rates.least.1)
        ),
        (None, None) => "No run has a finished step yet.".to_owned(),
    };
    let still = all
        .iter()
        .filter(|run| {
            run.tip().is_some_and(|tip| tip.last().stop == Some(RunStop::NoTipGrows(TipStop::Arrest)))
        })
        .count();
    if still > 0 {
        text.push_str(&format!(" Growth ends in arrest in {still} of {} runs.", all.len()));
    }
    text
}

/// The key figures.
pub(super) fn facts(plan: &StudyPlan, all: &[StudyRun]) -> Vec<Fact> {
    let fact = |name: &str, value: String, note: String| Fact { name: name.to_owned(), value, note };
    let count = |is_in: fn(&RunState) -> bool| all.iter().filter(|run| is_in(&run.row.state)).count();
    let states = [
        ("done", count(|state| *state == RunState::Done)),
        ("failed", count(|state| matches!(state, RunState::Failed { .. }))),
        ("unfinished", count(|state| *state == RunState::Unfinished)),
        ("missing", count(|state| *state == RunState::Missing)),
    ];
    let mut facts = vec![fact("Runs", all.len().to_string(), told(&states))];
    let names: Vec<String> = plan.axes.iter().map(|axis| axis.name()).collect();
    let values: Vec<String> = plan.axes.iter().map(|axis| axis.len().to_string()).collect();
    facts.push(fact("Parameters", names.join("; "), format!("{} values", values.join(" × "))));
    let between = |span: &Span| format!("run {}, run {}", span.least.1.number(), span.most.1.number());
    if let Some(Race { length, cycles, .. }) = Race::of(all) {
        facts.push(fact(
            &format!("Load cycles to {} mm", fixed(length, 2)),
            if cycles.least.0 == cycles.most.0 {
                grouped(cycles.least.0)
            } else {
                format!("{} – {}", grouped(cycles.least.0), grouped(cycles.most.0))
            },
            format!("{}: shortest and longest", between(&cycles)),
        ));
    }
    if let Some(rates) = rates(all) {
        facts.push(fact(
            "Rate of the initial crack",
            format!("{} – {}", significant(rates.least.0), significant(rates.most.0)),
            format!("mm per load cycle; {}", between(&rates)),
        ));
    }
    let courses: Vec<Course> = all.iter().filter_map(|run| Some(run.heading()?.course())).collect();
    if !courses.is_empty() {
        let told: Vec<String> = Course::ALL
            .iter()
            .map(|course| (course, courses.iter().filter(|other| *other == course).count()))
            .filter(|(_, count)| *count > 0)
            .map(|(course, count)| format!("{count} {}", course.word()))
            .collect();
        facts.push(fact(
            "Direction",
            told.join(", "),
            "of the last segment at the representative tip".to_owned(),
        ));
    }
    let mut stops: BTreeMap<String, usize> = BTreeMap::new();
    for summary in all.iter().filter_map(|run| run.row.summary.as_ref()) {
        *stops.entry(summary.stop.map_or("not ended", RunStop::word).replace('-', " ")).or_default() += 1;
    }
    let stops: Vec<(&str, usize)> = stops.iter().map(|(stop, count)| (stop.as_str(), *count)).collect();
    facts.push(fact("Ended by", told(&stops), String::new()));
    facts
}

/// `3 done, 1 failed`.
fn told(counts: &[(&str, usize)]) -> String {
    let there = counts.iter().filter(|(_, count)| *count > 0);
    there.map(|(name, count)| format!("{count} {name}")).collect::<Vec<_>>().join(", ")
}

/// Warnings: failed and missing runs, warnings of the runs by kind.
pub(super) fn warnings(all: &[StudyRun]) -> Vec<String> {
    let mut texts = Vec::new();
    let failed = all.iter().filter_map(|run| match &run.row.state {
        RunState::Failed { reason, .. } => Some((run, reason)),
        _ => None,
    });
    let failed: Vec<_> = failed.collect();
    for (run, reason) in failed.iter().take(MOST_TOLD) {
        let dot = if reason.ends_with('.') { "" } else { "." };
        texts.push(format!("{} failed: {reason}{dot}", run.name.replacen("run", "Run", 1)));
    }
    if failed.len() > MOST_TOLD {
        texts.push(format!("{} more runs failed; summary.csv gives the reasons.", failed.len() - MOST_TOLD));
    }
    let mut list = |heading: &str, runs: Vec<usize>| {
        if !runs.is_empty() {
            texts.push(format!("{heading}: {}.", listed(&runs)));
        }
    };
    let in_state = |state: &RunState| -> Vec<usize> {
        all.iter().filter(|run| run.row.state == *state).map(StudyRun::number).collect()
    };
    list("Not computed yet, or stored in another folder", in_state(&RunState::Missing));
    list("Not ended; continue with --resume", in_state(&RunState::Unfinished));
    let with = |is_so: &dyn Fn(&StudyRun) -> bool| -> Vec<usize> {
        all.iter().filter(|run| is_so(run)).map(StudyRun::number).collect()
    };
    let mut kinds: Vec<WarningKind> = Vec::new();
    for warning in all.iter().filter_map(|run| run.row.summary.as_ref()).flat_map(|s| &s.warnings) {
        if !kinds.contains(&warning.kind) {
            kinds.push(warning.kind);
        }
    }
    for kind in kinds {
        let has = |run: &StudyRun| {
            run.row.summary.as_ref().is_some_and(|s| s.warnings.iter().any(|warning| warning.kind == kind))
        };
        let heading = match kind {
            WarningKind::NearTie => {
                "Near ties of the direction criterion: the path is sensitive to this choice"
            }
            WarningKind::PopIn => "Pop-ins: a tip extends at once under one load, and arrests",
            WarningKind::Passages => "Passages not stabilised within the limit",
            WarningKind::ContactFallback => "Contact solved by the alternative solver",
            WarningKind::Engine => "Remarks of the engine",
            WarningKind::ResidualStress => "Remarks on the residual stress",
            WarningKind::Validity => "Outside the validity of the model",
        };
        list(heading, with(&has));
    }
    let block = |run: &StudyRun| run.row.summary.as_ref().is_some_and(|s| s.boundary != Boundary::HalfPlane);
    list("Block on supports: its bending opens cracks that stay closed in a half-plane", with(&block));
    texts
}

/// `run 3`, `runs 1, 2, 5`.
fn listed(runs: &[usize]) -> String {
    if let [run] = runs {
        return format!("run {run}");
    }
    let numbers: Vec<String> = runs.iter().take(MOST_LISTED).map(usize::to_string).collect();
    let more = runs.len().saturating_sub(MOST_LISTED);
    let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
    format!("runs {}{rest}", numbers.join(", "))
}
