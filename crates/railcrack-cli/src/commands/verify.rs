//! `railcrack verify`.

use crate::exit::{Exit, Failure};
use crate::print;
use clap::Args;
use railcrack_run::simulation::RunError;
use std::path::PathBuf;

/// Compare the files of a folder with the checksums that were stored with them
///
/// The folder is that of a run, of a plastic state, of a comparison or of a study with all its
/// runs. Nothing is written. The exit code is 0 where every file holds what was written, and 4
/// where one is damaged. Plots and reports have no checksums: `railcrack report` builds them anew.
#[derive(Debug, Args)]
pub struct VerifyArguments {
    /// The folder
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

/// Verifies the folder and says what is damaged.
pub fn verify(arguments: &VerifyArguments) -> Result<Exit, Failure> {
    let found = railcrack_run::verify(&arguments.folder).map_err(RunError::from)?;
    let mut text: String = found.damages.iter().map(|damage| format!("damaged: {damage}\n")).collect();
    found.notes.iter().for_each(|note| text.push_str(&format!("note: {note}\n")));
    let (files, damaged) = (found.files, found.damages.len());
    text.push_str(&match damaged {
        0 => format!("{files} files hold what was written\n"),
        _ => format!("{damaged} of {files} files are damaged\n"),
    });
    print::stdout(&text)?;
    Ok(if damaged == 0 { Exit::Done } else { Exit::CannotReadOrWrite })
}
