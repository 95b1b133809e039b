//! `railcrack schema`.

use crate::exit::{Exit, Failure};
use crate::print;
use clap::Args;
use railcrack_case::{entry_schema, json_schema, study_schema};

/// Print the JSON Schema of the case file
///
/// Editors with a TOML language server use it to complete keys, to show their descriptions and to
/// mark errors.
#[derive(Debug, Args)]
pub struct SchemaArguments {
    /// Print the schema of a study file: lists of values, and [study]
    #[arg(long)]
    study: bool,
    /// Print the schema of an entry of `railcrack validate`: a measured number and its source
    #[arg(long, conflicts_with = "study")]
    entry: bool,
}

/// Prints the JSON Schema of the case file, of a study or of an entry.
pub fn schema(arguments: &SchemaArguments) -> Result<Exit, Failure> {
    let schema = match (arguments.study, arguments.entry) {
        (true, _) => study_schema(),
        (_, true) => entry_schema(),
        _ => json_schema(),
    };
    print::stdout(&format!("{schema:#}\n"))?;
    Ok(Exit::Done)
}
