//! Result of a study on standard output.

use crate::exit::Exit;
use crate::terminal;
use railcrack_run::StudyFolder;
use railcrack_run::decision::Quantiles;
use railcrack_run::simulation::{Ending, FailedRun};
use railcrack_run::study::Population;
use railcrack_run::study::{RunState, StudyResults};
use serde_json::{Value, json};

/// Maximum number of failed runs listed individually.
const MOST_LISTED: usize = 20;

/// Summary of the result for standard output.
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
    text.push_str(&failed_text(failed));
    text.extend(results.population.iter().filter_map(population));
    text.push_str(&format!("results in {}\n", folder.path().display()));
    if ending == Ending::Interrupted {
        text.push_str("repeat the command with --resume to continue\n");
    }
    text
}

/// Result of the interpolated samples in one or two lines; none for a study without samples.
fn population(of: &Population) -> Option<String> {
    let Some(scatter) = &of.scatter else {
        return Some(format!("no samples interpolated between the runs: {}\n", of.reason.as_deref()?));
    };
    let whose = if of.choice.is_empty() { String::new() } else { format!("{}: ", of.choice) };
    let Quantiles { p05, p50, p95 } = scatter.mgt_detectable_to_critical;
    let shown =
        |mgt: Option<f64>| mgt.map_or_else(|| "beyond the runs".to_owned(), |mgt| format!("{mgt:.3}"));
    let error = of.error.map_or_else(String::new, |error| {
        format!(
            "interpolation between {} runs: error {:.2} % (root mean square), at most {:.2} %\n",
            of.runs, error.rms_percent, error.worst_percent
        )
    });
    Some(format!(
        "{whose}detectable to critical, MGT: {} (5 %), {} (median), {} (95 %) of {} samples\n{error}",
        shown(p05),
        shown(p50),
        shown(p95),
        scatter.samples
    ))
}

/// The result as one JSON object.
pub fn result_json(folder: &StudyFolder, results: &StudyResults, failed: &[FailedRun], exit: Exit) -> Value {
    let failed: Vec<Value> = failed
        .iter()
        .map(|run| json!({ "run": run.number, "values": run.label, "reason": run.reason }))
        .collect();
    json!({
        "exit": exit.code(),
        "folder": folder.path(),
        "ending": if exit == Exit::Interrupted { "interrupted" } else { "ended" },
        "runs": results.rows.len(),
        "done": results.count(|state| *state == RunState::Done),
        "unfinished": results.count(|state| *state == RunState::Unfinished),
        "missing": results.count(|state| *state == RunState::Missing),
        "failed": failed,
        "population": results.population,
        "damaged": folder.damages().iter().chain(&results.flaws).collect::<Vec<_>>(),
    })
}

/// Lists the failed runs on standard error, also with `--quiet` and `--json`.
pub fn print_failed(failed: &[FailedRun]) {
    print(failed_text(failed));
}

/// Reports damage that a resumed study makes good.
pub fn print_damages(damages: &[String]) {
    let line = |damage: &String| format!("damaged: {damage}; what was lost is computed again\n");
    print(damages.iter().map(line).collect());
}

/// Reports files of packed runs that are damaged or of another study.
pub fn print_flaws(flaws: &[String]) {
    print(flaws.iter().map(|flaw| format!("damaged: {flaw}\n")).collect());
}

fn print(text: String) {
    terminal::stderr(&text);
}

fn failed_text(failed: &[FailedRun]) -> String {
    let line = |run: &FailedRun| format!("run {} ({}) failed: {}\n", run.number, run.label, run.reason);
    let mut text: String = failed.iter().take(MOST_LISTED).map(line).collect();
    if failed.len() > MOST_LISTED {
        text.push_str(&format!("{} more failed, see summary.csv\n", failed.len() - MOST_LISTED));
    }
    text
}
