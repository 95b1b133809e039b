//! Results and failures as one JSON object on standard output.

use crate::exit::{Exit, Failure};
use crate::print;
use clap::Args;
use serde_json::{Value, json};

/// Whether the result is printed as JSON.
#[derive(Debug, Clone, Copy, Default, Args)]
pub struct Json {
    /// Print the result as one JSON object, errors included; nothing else goes to standard output
    #[arg(long)]
    pub json: bool,
}

impl Json {
    /// Prints `text`, or in its place `value`.
    pub fn print(self, text: impl FnOnce() -> String, value: impl FnOnce() -> Value) -> Result<(), Failure> {
        if self.json { print::stdout(&format!("{:#}\n", value())) } else { print::stdout(&text()) }
    }

    /// Does `work`; where it fails and JSON is wanted, the failure is an object, too.
    pub fn told(self, work: impl FnOnce() -> Result<Exit, Failure>) -> Result<Exit, Failure> {
        let failure = match work() {
            Err(failure) if self.json => failure,
            other => return other,
        };
        print::stdout(&format!("{:#}\n", of_failure(&failure)))?;
        Ok(failure.exit())
    }
}

/// `exit`, the code, and `errors`: of each `message`, `file`, `line`, `column`, `key`, `help`.
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
