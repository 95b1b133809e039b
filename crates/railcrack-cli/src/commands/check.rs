//! `railcrack check`.

use super::check_study::{study_json, study_summary};
use super::run::announce_groups;
use crate::display::{stdout_columns, wrapped};
use crate::exit::{Exit, Failure};
use crate::input::{self, Set, default_folder};
use crate::json::Json;
use clap::Args;
use railcrack::words::Choice;
use railcrack_case::{Case, Input};
use railcrack_report::PageEngine;
use railcrack_run::description::{Description, Part, Row, Subject, parts_json};
use railcrack_run::setup::represented;
use railcrack_run::simulation::RunError;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Validate a case or study file and show what would be computed
///
/// Nothing is written, and nothing is computed but one passage over the first crack. The exit code
/// is 0 for a valid case and 2 otherwise; all errors of the file are reported at once.
#[derive(Debug, Args)]
pub struct CheckArguments {
    /// The case file, or a study; `-` is standard input
    #[arg(value_name = "CASE")]
    case: PathBuf,
    #[command(flatten)]
    set: Set,
    #[command(flatten)]
    json: Json,
}

/// Validates the case or study and prints what would be computed.
pub fn check(arguments: &CheckArguments) -> Result<Exit, Failure> {
    arguments.json.with_failures(|| {
        let folder = default_folder(&arguments.case);
        match input::either(&arguments.case, &arguments.set.overrides())? {
            Input::Case(case) => {
                if case.output.explorer {
                    PageEngine::find().map_err(RunError::from)?;
                }
                announce_groups(&case);
                let case = represented(&case);
                let text = || wrapped(&summary(&case, &folder), stdout_columns());
                arguments.json.print(text, || case_json(&case))?
            }
            Input::Study(study) => {
                let text = || wrapped(&study_summary(&study, &folder), stdout_columns());
                arguments.json.print(text, || study_json(&study))?;
            }
        }
        Ok(Exit::Done)
    })
}

/// The case as one object; its description by heading and name, numbers with their units.
fn case_json(case: &Case) -> Value {
    let description = Description::of(case);
    let (size, needs, time) = (description.size(), description.needs(), description.time());
    let warnings = description.warnings().rows.into_iter().filter(|row| row.name.is_empty());
    let warnings: Vec<String> = warnings.map(|row| row.text).collect();
    json!({
        "exit": Exit::Done.code(),
        "kind": "case",
        "title": case.title,
        "engine": case.engine().word(),
        "contact": case.contact_solver().word(),
        "cracks": case.cracks.cracks().len(),
        "tips": size.tips,
        "face_points": size.face_points,
        "displacements": size.displacements,
        "positions": case.first_wheel().passages.passage.positions,
        "increments": case.growth.steps,
        "memory_bytes": needs.memory,
        "disk_bytes": needs.disk,
        "step_seconds": time.step,
        "seconds": time.total(),
        "warnings": warnings,
        "summary": parts_json(&description.parts(&Subject::ALL)),
    })
}

/// The summary of a case.
pub fn summary(case: &Case, folder: &Path) -> String {
    let mut text = format!("{}\n", case.title);
    let description = Description::of(case);
    let mut parts = description.parts(&Subject::ALL);
    parts.extend([description.machine(folder), description.warnings()]);
    for Part { heading, rows } in parts {
        if !rows.is_empty() {
            text.push_str(&format!("\n{heading}\n"));
        }
        for Row { name, text: value, .. } in rows {
            let line = if name.is_empty() { value } else { format!("{name:<20} {value}") };
            text.push_str(&format!("  {line}\n"));
        }
    }
    text
}
