//! Verdicts on the runs of a study, grouped by their reasons.

use super::facts::of_all;
use super::runs::verdict;
use super::warnings::listed;
use crate::figures::StudyRun;
use crate::table::Table;
use railcrack_run::decision::{ReasonKind, VerdictLevel};

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
pub(super) fn table(all: &[StudyRun]) -> Option<Table> {
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
