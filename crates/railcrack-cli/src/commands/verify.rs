//! `railcrack verify`.

use crate::exit::{Exit, Failure};
use crate::print;
use clap::Args;
use railcrack_run::simulation::RunError;
use std::path::PathBuf;

/// Check the files of a folder against the stored checksums
///
/// The folder is that of a run, a plastic state, a comparison or a study with all its runs. Nothing
/// is written. The exit code is 0 if all files are intact and 4 if one is damaged. Plots and
/// reports have no checksums: `railcrack report` rebuilds them.
#[derive(Debug, Args)]
pub struct VerifyArguments {
    /// Folder of results
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

/// Verifies the folder and lists damaged files.
pub fn verify(arguments: &VerifyArguments) -> Result<Exit, Failure> {
    let found = railcrack_run::verify(&arguments.folder).map_err(RunError::from)?;
    let mut text: String = found.damages.iter().map(|damage| format!("damaged: {damage}\n")).collect();
    found.notes.iter().for_each(|note| text.push_str(&format!("note: {note}\n")));
    let (files, damaged) = (found.files, found.damages.len());
    text.push_str(&match damaged {
        0 => format!("{files} files are intact\n"),
        _ => format!("{damaged} of {files} files are damaged\n"),
    });
    print::stdout(&text)?;
    Ok(if damaged == 0 { Exit::Done } else { Exit::CannotReadOrWrite })
}
