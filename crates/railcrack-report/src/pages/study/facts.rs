//! The first screen of the report of a study.

use crate::direction::Course;
use crate::figures::{StudyRun, values};
use crate::numbers::{fixed, given, grouped, significant};
use crate::page::Fact;
use railcrack::growth::{RunStop, TipStop};
use railcrack::words::Choice;
use railcrack_run::decision::VerdictLevel;
use railcrack_run::run_folder::cycles_to;
use railcrack_run::study::{RunState, StudyPlan};
use std::collections::BTreeMap;

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

/// Relative difference of two values up to which they are equal, less than a page shows.
const EQUAL: f64 = 1e-6;

impl Span<'_, '_> {
    /// Whether all values are the same.
    fn is_equal(&self) -> bool {
        (self.most.0 - self.least.0).abs() <= EQUAL * self.most.0.abs()
    }

    /// The range of the values, written by `shown`, and the runs of its ends.
    fn range(&self, shown: fn(f64) -> String) -> (String, String) {
        if self.is_equal() {
            return (shown(self.most.0), "the same in every run".to_owned());
        }
        let [least, most] = [&self.least, &self.most];
        let runs = format!("in run {} and run {}", least.1.number(), most.1.number());
        (format!("{} – {}", shown(least.0), shown(most.0)), runs)
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
        (Some(Race { length, runs, cycles }), _) if cycles.is_equal() => format!(
            "The life to a length of {} mm is {} load cycles in {}.",
            fixed(length, 2),
            grouped(cycles.least.0),
            of_all(runs, all.len())
        ),
        (Some(Race { length, runs, cycles }), _) => format!(
            "The life to a length of {} mm, reached in {}, ranges from {} load cycles in {} to {} in {}.",
            fixed(length, 2),
            of_all(runs, all.len()),
            grouped(cycles.least.0),
            run(cycles.least.1),
            grouped(cycles.most.0),
            run(cycles.most.1)
        ),
        (None, Some(rates)) if rates.is_equal() => {
            format!(
                "The initial cracks grow by {} mm per load cycle in every run.",
                significant(rates.most.0)
            )
        }
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
    match least_grinding(all) {
        Some(least) => format!("{least} {text}"),
        None => text,
    }
}

/// The key figures.
pub(super) fn facts(plan: &StudyPlan, all: &[StudyRun]) -> Vec<Fact> {
    let count = |is_in: fn(&RunState) -> bool| all.iter().filter(|run| is_in(&run.row.state)).count();
    let states = [
        ("done", count(|state| *state == RunState::Done)),
        ("failed", count(|state| matches!(state, RunState::Failed { .. }))),
        ("unfinished", count(|state| *state == RunState::Unfinished)),
        ("missing", count(|state| *state == RunState::Missing)),
    ];
    let mut facts = vec![Fact::new("Runs", all.len().to_string(), counted(&states))];
    let names: Vec<String> = plan.axes.iter().map(|axis| axis.name()).collect();
    let values: Vec<String> = plan.axes.iter().map(|axis| axis.len().to_string()).collect();
    facts.push(Fact::new("Parameters", names.join("; "), format!("{} values", values.join(" × "))));
    if let Some(Race { length, runs, cycles }) = Race::of(all) {
        let (range, which) = cycles.range(grouped);
        facts.push(Fact::new(
            format!("Load cycles to {} mm", fixed(length, 2)),
            range,
            if runs == 1 { "in the one run that grows".to_owned() } else { which },
        ));
    }
    if let Some(rates) = rates(all) {
        let (range, which) = rates.range(significant);
        facts.push(Fact::new("Rate of the initial crack", range, format!("mm per load cycle; {which}")));
    }
    let courses: Vec<Course> = all.iter().filter_map(|run| Some(run.heading()?.course())).collect();
    if !courses.is_empty() {
        let of_each: Vec<String> = Course::ALL
            .iter()
            .map(|course| (course, courses.iter().filter(|other| *other == course).count()))
            .filter(|(_, count)| *count > 0)
            .map(|(course, count)| format!("{count} {}", course.word()))
            .collect();
        facts.push(Fact::new(
            "Direction",
            of_each.join(", "),
            "of the last segment at the representative tip",
        ));
    }
    let mut stops: BTreeMap<String, usize> = BTreeMap::new();
    for summary in all.iter().filter_map(|run| run.row.summary.as_ref()) {
        *stops.entry(summary.stop.map_or("not ended", RunStop::word).replace('-', " ")).or_default() += 1;
    }
    let stops: Vec<(&str, usize)> = stops.iter().map(|(stop, count)| (stop.as_str(), *count)).collect();
    facts.push(Fact::new("Ended by", counted(&stops), ""));
    facts
}

/// `3 done, 1 failed`.
fn counted(counts: &[(&str, usize)]) -> String {
    let there = counts.iter().filter(|(_, count)| *count > 0);
    there.map(|(name, count)| format!("{count} {name}")).collect::<Vec<_>>().join(", ")
}

/// `all 12 runs`, `3 of 12 runs`.
pub(super) fn of_all(count: usize, all: usize) -> String {
    if count == all { format!("all {all} runs") } else { format!("{count} of {all} runs") }
}

/// A grinding plan with the runs that have it.
struct GroundRuns {
    /// Depth of each grinding, mm.
    depth: f64,
    /// Million gross tonnes between two of them.
    interval: f64,
    /// Whether each of the runs is finished and ends without a failure.
    holds: bool,
}

impl GroundRuns {
    /// Removal, mm per million gross tonnes.
    fn removal(&self) -> f64 {
        self.depth / self.interval
    }
}

/// The least grinding of a study that varies it with which no run fails, in a sentence; none where
/// all runs have the same grinding.
fn least_grinding(all: &[StudyRun]) -> Option<String> {
    let mut plans: Vec<GroundRuns> = Vec::new();
    for run in all {
        let Some(decision) = run.row.summary.as_ref().and_then(|summary| summary.decision.as_ref()) else {
            continue;
        };
        let Some(plan) = decision.maintenance.as_ref() else { continue };
        let Some((depth, interval)) = plan.grinding_mm.zip(plan.grinding_interval_mgt) else { continue };
        let holds = run.row.state == RunState::Done
            && decision.failure.mgt.is_none()
            && decision.verdict.level == VerdictLevel::Ok;
        match plans.iter_mut().find(|plan| (plan.depth, plan.interval) == (depth, interval)) {
            Some(plan) => plan.holds &= holds,
            None => plans.push(GroundRuns { depth, interval, holds }),
        }
    }
    (plans.len() > 1).then(|| grinding_sentence(&plans))
}

fn grinding_sentence(plans: &[GroundRuns]) -> String {
    let least = plans.iter().filter(|plan| plan.holds).min_by(|one, other| {
        one.removal().total_cmp(&other.removal()).then(one.depth.total_cmp(&other.depth))
    });
    match least {
        Some(plan) => format!(
            "The least of the {} grinding plans with which no run fails within its steps is {} mm every {} MGT, {} mm per MGT.",
            plans.len(),
            given(plan.depth),
            given(plan.interval),
            given(plan.removal())
        ),
        None => format!("With each of the {} grinding plans some run fails.", plans.len()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_is_that_of_the_smallest_removal() {
        let plan = |depth, interval, holds| GroundRuns { depth, interval, holds };
        let plans = [plan(0.2, 10.0, true), plan(0.1, 10.0, true), plan(0.05, 10.0, false)];
        let text = grinding_sentence(&plans);
        assert!(text.contains("0.1 mm every 10 MGT, 0.01 mm per MGT"), "{text}");
        assert!(
            grinding_sentence(&plans[2..]).starts_with("With each of the 1"),
            "{}",
            grinding_sentence(&plans[2..])
        );
    }
}
