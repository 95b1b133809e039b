//! The beginning of a run on the disk: when the files of another run may be replaced.

use super::case_files::CaseFiles;
use super::clear::{clear_results, clear_rolled, drawn_file_in, is_unfinished, run_file_in};
use crate::disk::files::{
    CASE_FILE, CHECKPOINT_FILE, PLANS_FILE, SHAKEDOWN_FILE, SUMMARY_FILE, UNFINISHED_FILE, WHEEL_GROUPS_FILE,
};
use crate::disk::{Durability, inner_folder, remove, replace_file};
use crate::error::OutputError;
use std::fs;
use std::io::ErrorKind;
use std::path::Path;

/// Treatment of a run that the folder already holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Existing {
    /// Keep it and return an error.
    Refuse,
    /// Remove the files that a run writes, and no others.
    Replace,
    /// The same in a folder that the command has entered, whose results remain unfinished
    /// ([`ResultFolder`](super::ResultFolder)).
    Entered,
}

/// Makes `folder` a run folder with nothing but the case. From `case.toml` on, the folder holds a
/// run that can be resumed.
pub(crate) fn begin(folder: &Path, case: &CaseFiles, existing: Existing) -> Result<(), OutputError> {
    let existing = match existing {
        Existing::Refuse if is_unfinished(folder) => Existing::Replace,
        other => other,
    };
    let replaces = existing != Existing::Refuse;
    if !replaces {
        refuse_results_of_run(folder)?;
    }
    refuse_file_in_place_of(folder)?;
    fs::create_dir_all(folder).map_err(OutputError::io("create the run folder", folder))?;
    if replaces {
        // The order matters if the process is killed in between: first the old checkpoint is
        // removed, then the new case replaces the old one; any remaining files then belong to a run
        // that starts from its beginning.
        remove(&folder.join(CHECKPOINT_FILE))?;
        remove(&folder.join(SUMMARY_FILE))?;
    }
    replace_file(&folder.join(CASE_FILE), case.toml.as_bytes(), Durability::Synced)?;
    if replaces {
        clear_results(folder)?;
        clear_rolled(folder)?;
    }
    if existing == Existing::Replace {
        remove(&folder.join(UNFINISHED_FILE))?;
    }
    write_companions(folder, case)
}

/// Refuses a folder with a file that a run would replace.
///
/// Errors: there is one; the system refuses.
pub(super) fn refuse_results_of_run(folder: &Path) -> Result<(), OutputError> {
    let folder_of = || folder.to_path_buf();
    match run_file_in(folder) {
        Some(file) if [SHAKEDOWN_FILE, PLANS_FILE].iter().any(|known| folder.join(known).exists()) => {
            Err(OutputError::HoldsResults { folder: folder_of(), file: file.to_owned() })
        }
        Some(file) => Err(OutputError::HoldsRun { folder: folder_of(), file }),
        None => match drawn_file_in(folder)? {
            Some(file) => Err(OutputError::InTheWay { folder: folder_of(), file }),
            None => Ok(()),
        },
    }
}

/// Refuses a file where a folder is to be.
pub(super) fn refuse_file_in_place_of(folder: &Path) -> Result<(), OutputError> {
    if folder.exists() && !folder.is_dir() {
        let reason = std::io::Error::new(ErrorKind::NotADirectory, "it is a file, not a folder");
        return Err(OutputError::io("use as a run folder", folder)(reason));
    }
    Ok(())
}

/// Writes the case of a run that goes on: its text and the files that it names.
pub(crate) fn restore_case(folder: &Path, case: &CaseFiles) -> Result<(), OutputError> {
    replace_file(&folder.join(CASE_FILE), case.toml.as_bytes(), Durability::Cached)?;
    write_companions(folder, case)
}

fn write_companions(folder: &Path, case: &CaseFiles) -> Result<(), OutputError> {
    // The groups are those of a companion, in the same folder.
    for (name, text) in &case.companions {
        if let Some((inner, _)) = name.rsplit_once('/') {
            inner_folder(folder, inner)?;
        }
        replace_file(&folder.join(name), text.as_bytes(), Durability::Cached)?;
    }
    match &case.wheel_groups {
        Some(groups) => replace_file(&folder.join(WHEEL_GROUPS_FILE), groups.as_bytes(), Durability::Cached),
        None => Ok(()),
    }
}
