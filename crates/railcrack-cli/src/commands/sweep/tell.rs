//! Result of a study on standard output.

use railcrack_run::StudyFolder;
use railcrack_run::simulation::{Ending, FailedRun};
use railcrack_run::study::{RunState, StudyResults};

/// Failed runs that are told one by one.
const MOST_TOLD: usize = 20;

/// The result as a few lines for standard output.
pub fn result_text(
    folder: &StudyFolder,
    results: &StudyResults,
    failed: &[FailedRun],
    ending: Ending,
) -> String {
    let counted: Vec<String> = [
        ("done", results.count(|state| *state == RunState::Done)),
        ("failed", results.count(|state| matches!(state, RunState::Failed { .. }))),
        ("unfinished", results.count(|state| *state == RunState::Unfinished)),
        ("missing", results.count(|state| *state == RunState::Missing)),
    ]
    .into_iter()
    .filter(|(_, count)| *count > 0)
    .map(|(name, count)| format!("{count} {name}"))
    .collect();
    let mut text = format!("{} runs: {}\n", results.rows.len(), counted.join(", "));
    for run in failed.iter().take(MOST_TOLD) {
        text.push_str(&format!("run {} ({}) failed: {}\n", run.number, run.label, run.reason));
    }
    if failed.len() > MOST_TOLD {
        text.push_str(&format!("{} more failed, see summary.csv\n", failed.len() - MOST_TOLD));
    }
    text.push_str(&format!("results in {}\n", folder.path().display()));
    if ending == Ending::Interrupted {
        text.push_str("the same command with --resume goes on from here\n");
    }
    text
}
