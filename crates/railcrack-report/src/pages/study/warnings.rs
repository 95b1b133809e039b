//! Warnings and verdicts on the page of a study, by what they say.

use super::facts::of_all;
use super::runs::verdict;
use crate::figures::StudyRun;
use crate::table::Table;
use railcrack::bulk::Boundary;
use railcrack::growth::WarningKind;
use railcrack_run::decision::{ReasonKind, VerdictLevel};
use railcrack_run::study::RunState;
use railcrack_run::summary::validity::pattern;

/// Maximum number of failed runs listed individually.
const MOST_FAILED: usize = 20;
/// Maximum number of runs listed by number.
const MOST_LISTED: usize = 12;
/// Maximum number of different warnings shown.
const MOST_WARNINGS: usize = 12;

/// A warning that runs share.
struct SharedWarning<'a> {
    kind: WarningKind,
    /// Its text with `#` instead of numbers, which differ from run to run.
    pattern: String,
    /// Its text in the first of the runs.
    text: &'a str,
    /// Whether its numbers differ.
    differs: bool,
    /// The runs, by number, each once.
    runs: Vec<usize>,
}

/// The warnings of the page.
pub(super) fn warnings(all: &[StudyRun]) -> Vec<String> {
    let mut texts = failures(all);
    let mut list = |heading: &str, runs: Vec<usize>| {
        if !runs.is_empty() {
            texts.push(format!("{heading}, {}: {}.", of_all(runs.len(), all.len()), listed(&runs)));
        }
    };
    let numbers = |is_so: &dyn Fn(&StudyRun) -> bool| -> Vec<usize> {
        all.iter().filter(|run| is_so(run)).map(StudyRun::number).collect()
    };
    list("Not computed yet, or stored in another folder", numbers(&|run| run.row.state == RunState::Missing));
    list("Not ended; continue with --resume", numbers(&|run| run.row.state == RunState::Unfinished));
    let block = |run: &StudyRun| run.row.summary.as_ref().is_some_and(|s| s.boundary != Boundary::HalfPlane);
    list("Block on supports: its bending opens cracks that stay closed in a half-plane", numbers(&block));
    let shared = shared(all);
    texts.extend(shared.iter().take(MOST_WARNINGS).map(|warning| shared_text(warning, all.len())));
    if shared.len() > MOST_WARNINGS {
        texts.push(format!("{} other kinds of warnings in few runs.", shared.len() - MOST_WARNINGS));
    }
    texts
}

/// Failed runs with their reasons.
fn failures(all: &[StudyRun]) -> Vec<String> {
    let failed = all.iter().filter_map(|run| match &run.row.state {
        RunState::Failed { reason, .. } => Some((run, reason)),
        _ => None,
    });
    let failed: Vec<_> = failed.collect();
    let mut texts: Vec<String> = failed
        .iter()
        .take(MOST_FAILED)
        .map(|(run, reason)| {
            let dot = if reason.ends_with('.') { "" } else { "." };
            format!("{} failed: {reason}{dot}", run.name.replacen("run", "Run", 1))
        })
        .collect();
    if failed.len() > MOST_FAILED {
        texts
            .push(format!("{} more runs failed; summary.csv gives the reasons.", failed.len() - MOST_FAILED));
    }
    texts
}

/// The warnings of the runs by what they say, those of most runs first.
fn shared<'a>(all: &[StudyRun<'a>]) -> Vec<SharedWarning<'a>> {
    let mut found: Vec<SharedWarning> = Vec::new();
    for run in all {
        for warning in run.row.summary.iter().flat_map(|summary| &summary.warnings) {
            let pattern = pattern(&warning.text);
            let known = found.iter_mut().find(|other| other.kind == warning.kind && other.pattern == pattern);
            match known {
                Some(known) => {
                    known.differs |= known.text != warning.text;
                    if known.runs.last() != Some(&run.number()) {
                        known.runs.push(run.number());
                    }
                }
                None => found.push(SharedWarning {
                    kind: warning.kind,
                    pattern,
                    text: &warning.text,
                    differs: false,
                    runs: vec![run.number()],
                }),
            }
        }
    }
    found.sort_by_key(|warning| std::cmp::Reverse(warning.runs.len()));
    found
}

fn shared_text(warning: &SharedWarning, count: usize) -> String {
    let heading = match warning.kind {
        WarningKind::NearTie => "Near tie of the direction criterion, to which the path is sensitive",
        WarningKind::PopIn => "Pop-in: a tip extends at once under one load, and arrests",
        WarningKind::Passages => "Passages not stabilised within the limit",
        WarningKind::Groups => "Accuracy of the contact in groups of cracks",
        WarningKind::ContactFallback => "Contact solved by the alternative solver",
        WarningKind::Engine => "Remark of the engine",
        WarningKind::ResidualStress => "Remark on the residual stress",
        WarningKind::Validity => "Outside the validity of the model",
        WarningKind::Input => "A number of the case that is probably not the one that is meant",
    };
    let heading = format!("{heading} ({})", warning.kind.page());
    let text = warning.text.trim_end_matches('.');
    let which = listed(&warning.runs);
    match (warning.runs.first(), warning.differs) {
        (Some(first), true) => {
            let share = of_all(warning.runs.len(), count);
            format!(
                "{heading}, {share}: in run {first}, {text}; with other numbers also in the others ({which})."
            )
        }
        _ if warning.runs.len() == count => format!("{heading}, all {count} runs: {text}."),
        _ => format!("{heading}, {}: {text} ({which}).", of_all(warning.runs.len(), count)),
    }
}

/// `run 3`, `runs 1, 2, 5`.
pub(super) fn listed(runs: &[usize]) -> String {
    if let [run] = runs {
        return format!("run {run}");
    }
    let numbers: Vec<String> = runs.iter().take(MOST_LISTED).map(usize::to_string).collect();
    let more = runs.len().saturating_sub(MOST_LISTED);
    let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
    format!("runs {}{rest}", numbers.join(", "))
}

/// Runs whose verdicts have the same reason.
struct SharedReason<'a> {
    level: VerdictLevel,
    kind: ReasonKind,
    /// Its text in the first of the runs.
    text: &'a str,
    /// The runs, by number.
    runs: Vec<usize>,
}

/// Number of runs by verdict and reason, the gravest first; none where no run has a verdict.
pub(super) fn verdicts(all: &[StudyRun]) -> Option<Table> {
    let mut found: Vec<SharedReason> = Vec::new();
    for run in all {
        let Some(verdict) = verdict(run) else { continue };
        for reason in &verdict.reasons {
            let level = verdict.level;
            match found.iter_mut().find(|shared| (shared.level, shared.kind) == (level, reason.kind)) {
                Some(shared) if shared.runs.last() == Some(&run.number()) => {}
                Some(shared) => shared.runs.push(run.number()),
                None => {
                    let (kind, text) = (reason.kind, reason.text.as_str());
                    found.push(SharedReason { level, kind, text, runs: vec![run.number()] });
                }
            }
        }
    }
    found.sort_by_key(|shared| (std::cmp::Reverse(shared.level), std::cmp::Reverse(shared.runs.len())));
    let mut table = Table::new(["Verdict", "Reason", "Runs", "Which", "In the first of them"]);
    table.caption =
        "Verdicts on the runs by their reasons, the gravest first; summary.csv has the columns verdict, \
         reasons and failure"
            .to_owned();
    for shared in &found {
        table.row([
            shared.level.word().to_owned(),
            shared.kind.words().to_owned(),
            of_all(shared.runs.len(), all.len()),
            listed(&shared.runs),
            format!("{}.", shared.text),
        ]);
    }
    (!found.is_empty()).then_some(table)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_are_listed_with_what_is_left() {
        assert_eq!(listed(&[3]), "run 3");
        assert_eq!(
            listed(&(1..=14).collect::<Vec<_>>()),
            "runs 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12 and 2 more"
        );
    }
}
