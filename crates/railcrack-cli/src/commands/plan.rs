//! `railcrack plan`.

use super::run::{Execution, announce_groups, listen};
use crate::exit::{Exit, Failure};
use crate::input::{self, Inputs, default_folder};
use crate::interruption::Remains;
use crate::json::Json;
use crate::print;
use crate::progress::Progress;
use clap::Args;
use railcrack_report::Pages;
use railcrack_run::decision::VerdictLevel;
use railcrack_run::simulation::{PlanRequest, Simulation};
use railcrack_run::{Existing, PlanSummary, is_file_of_run};
use serde_json::json;
use std::path::{Path, PathBuf};

/// Find the least grinding that keeps the rail from failing
///
/// The cracks of the case grow under every given depth and interval of grinding. Written to the
/// folder: a table (plan.csv), the plans with the least grinding that holds and the traffic until
/// the rail is worn to its limit (plan.json), a map (plots/plan.svg) and a report to be signed.
#[derive(Debug, Args)]
pub struct PlanArguments {
    /// Case file; `-` is standard input
    #[arg(value_name = "CASE")]
    pub case: PathBuf,
    /// Depths of each grinding, mm, separated by commas [default: about that of the case]
    #[arg(long, value_name = "MM,…", value_delimiter = ',', value_parser = positive)]
    pub grinding: Vec<f64>,
    /// Million gross tonnes between grindings, separated by commas [default: about that of the
    /// case, or of the life without grinding]
    #[arg(long, value_name = "MGT,…", value_delimiter = ',', value_parser = positive)]
    pub interval: Vec<f64>,
    /// Million gross tonnes up to which the rail is followed [default: five times the life without
    /// grinding]
    #[arg(long, value_name = "MGT", value_parser = positive)]
    pub horizon: Option<f64>,
    /// Folder for the results [default: name of the case file without its extension, next to it]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    #[command(flatten)]
    pub execution: Execution,
    /// Replace existing results in the folder
    #[arg(long)]
    pub force: bool,
    #[command(flatten)]
    pub json: Json,
}

/// Depths and intervals of grinding, and horizons: the bounds of the keys of `[maintenance]`.
const BOUNDS: (f64, f64) = (1e-6, 1e6);

fn positive(given: &str) -> Result<f64, String> {
    match given.trim().parse::<f64>() {
        Ok(value) if (BOUNDS.0..=BOUNDS.1).contains(&value) => Ok(value),
        _ => Err(format!("must be a number from {} to {:e}", BOUNDS.0, BOUNDS.1)),
    }
}

/// Million gross tonnes below which more digits are printed.
const SHORT: f64 = 10.0;

/// Computes the plans and prints a summary.
pub fn plan(arguments: &PlanArguments) -> Result<Exit, Failure> {
    arguments.json.with_failures(|| {
        let case = input::case(&arguments.case, &arguments.execution.set.overrides())?;
        let folder = arguments.out.clone().unwrap_or_else(|| default_folder(&arguments.case));
        Inputs::of_case(&arguments.case, &case).stay(&folder, is_file_of_run)?;
        let interruption = listen(Remains::Nothing)?;
        if !arguments.execution.quiet {
            announce_groups(&case);
        }
        let progress = Progress::new(arguments.execution.verbosity(), 0, &interruption);
        let request = PlanRequest {
            depths: arguments.grinding.clone(),
            intervals: arguments.interval.clone(),
            horizon: arguments.horizon,
        };
        let existing = if arguments.force { Existing::Replace } else { Existing::Refuse };
        let simulation = Simulation::new(&case).observed_by(&progress).presented_by(&Pages);
        let summary = match simulation.plan_in(&folder, existing, &request) {
            Err(error) if error.is_interruption() => return Ok(print::interrupted()),
            computed => computed?,
        };
        let value = || json!({ "exit": 0, "folder": folder, "plan": summary });
        arguments.json.print(|| result_text(&summary, &folder), value)?;
        Ok(Exit::Done)
    })
}

fn result_text(summary: &PlanSummary, folder: &Path) -> String {
    let mut text = String::new();
    for (i, reason) in summary.verdict.reasons.iter().enumerate() {
        let head = if i == 0 {
            format!("without grinding: {}: ", summary.verdict.level.word())
        } else {
            "also: ".to_owned()
        };
        text.push_str(&format!("{head}{}\n", reason.text));
    }
    for plan in &summary.plans {
        let interval = tonnage(plan.grinding_interval_mgt.unwrap_or_default());
        let outcome = match plan.level {
            VerdictLevel::Outside => "outside of what the model describes".to_owned(),
            _ => format!("{} after {} million gross tonnes", plan.outcome.words(), tonnage(plan.mgt)),
        };
        let probability = plan
            .probability_of_failure
            .map_or_else(String::new, |probability| format!(", P(failure) {probability:.4}"));
        text.push_str(&format!(
            "{:.3} mm every {interval}: {outcome}, largest depth {:.2} mm{probability}\n",
            plan.grinding_mm, plan.largest_depth_mm
        ));
    }
    if let Some(least) = &summary.least {
        match least.grinding_interval_mgt {
            Some(interval) => text.push_str(&format!(
                "least grinding that holds: {:.3} mm every {} million gross tonnes\n",
                least.grinding_mm,
                tonnage(interval)
            )),
            None => text.push_str("the rail holds without grinding\n"),
        }
        if let Some(mgt) = least.mgt_to_wear_limit {
            let months =
                least.months_to_wear_limit.map_or_else(String::new, |months| format!(", {months:.0} months"));
            let date =
                least.replacement_date.as_ref().map_or_else(String::new, |date| format!(", on {date}"));
            text.push_str(&format!(
                "replaced at its wear limit after {} million gross tonnes{months}{date}\n",
                tonnage(mgt)
            ));
        }
    } else if let Some(next) = summary.next_step() {
        text.push_str(&format!("{next}\n"));
    } else {
        text.push_str("no grinding plan is derived from this case\n");
    }
    text.push_str(&format!("{}\nresults in {}\n", summary.calibration, folder.display()));
    text
}

/// Million gross tonnes; short lives to the digits that they need.
fn tonnage(mgt: f64) -> String {
    if mgt < SHORT { format!("{mgt:.3}") } else { format!("{mgt:.1}") }
}
