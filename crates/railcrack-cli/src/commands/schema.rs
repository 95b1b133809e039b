//! `railcrack schema`.

use crate::exit::{Exit, Failure};
use crate::print;
use clap::Args;
use railcrack_case::{json_schema, study_schema};

/// Print the JSON Schema of the case file
///
/// Editors with a TOML language server use it to complete keys, to show their descriptions and to
/// mark errors.
#[derive(Debug, Args)]
pub struct SchemaArguments {
    /// Print the schema of a study file: lists of values, and [study]
    #[arg(long)]
    study: bool,
}

/// Prints the JSON Schema of the case file or of a study.
pub fn schema(arguments: &SchemaArguments) -> Result<Exit, Failure> {
    let schema = if arguments.study { study_schema() } else { json_schema() };
    print::stdout(&format!("{schema:#}\n"))?;
    Ok(Exit::Done)
}
