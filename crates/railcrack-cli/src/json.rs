//! Output of results and failures as one JSON object.

use crate::exit::{Exit, Failure};
use crate::print;
use clap::Args;
use serde_json::{Value, json};

/// Whether the result is printed as JSON.
#[derive(Debug, Clone, Copy, Default, Args)]
pub struct Json {
    /// Print the result, including errors, as one JSON object and nothing else on standard output
    #[arg(long)]
    pub json: bool,
}

impl Json {
    /// Prints `value` if JSON is requested, otherwise `text`.
    pub fn print(self, text: impl FnOnce() -> String, value: impl FnOnce() -> Value) -> Result<(), Failure> {
        if self.json { print::json(&format!("{:#}\n", value())) } else { print::stdout(&text()) }
    }

    /// Executes `work`; a failure is printed as an object too if JSON is requested.
    pub fn with_failures(self, work: impl FnOnce() -> Result<Exit, Failure>) -> Result<Exit, Failure> {
        let failure = match work() {
            Err(failure) if self.json => failure,
            other => return other,
        };
        print::json(&format!("{:#}\n", of_failure(&failure)))?;
        Ok(failure.exit())
    }
}

/// The exit code `exit`, and `errors`, each with `message`, `file`, `line`, `column`, `key`,
/// `help`.
fn of_failure(failure: &Failure) -> Value {
    let errors: Vec<Value> = match failure {
        Failure::Case(errors) => errors
            .errors()
            .iter()
            .map(|error| {
                let (line, column) = error.position().unzip();
                json!({
                    "message": error.message(),
                    "file": error.file(),
                    "line": line,
                    "column": column,
                    "key": error.key(),
                    "help": error.help(),
                })
            })
            .collect(),
        other => vec![json!({ "message": other.to_string() })],
    };
    json!({ "exit": failure.exit().code(), "errors": errors })
}
