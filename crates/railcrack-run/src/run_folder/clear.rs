//! Removal of what a run has written, and of nothing else.

use crate::disk::files::{
    CASE_FILE, CHECKPOINT_FILE, FIELDS_FOLDER, INPUTS_FOLDER, PLOT_FILES, PLOTS_FOLDER, REPORT_FILE,
    ROLLED_FOLDER, SUMMARY_FILE, UNFINISHED_FILE, run_files,
};
use crate::disk::{FolderLock, LOCK_FILE, PARTIAL, own_folder, partial_of, remove};
use crate::error::OutputError;
use crate::fields::is_field_file;
use std::fs;
use std::io::ErrorKind;
use std::path::Path;

/// Removes every result of a run and its inputs, and their folders where nothing else is in them.
pub(super) fn clear_results(folder: &Path) -> Result<(), OutputError> {
    // Nothing is removed through links.
    let [plots, fields, inputs] =
        [PLOTS_FOLDER, FIELDS_FOLDER, INPUTS_FOLDER].map(|inner| own_folder(folder, inner));
    let (plots, fields, inputs) = (plots?, fields?, inputs?);
    for file in run_files() {
        remove(&folder.join(file))?;
        remove(&partial_of(&folder.join(file)))?;
    }
    for file in PLOT_FILES.map(|file| plots.join(file)) {
        remove(&file)?;
        remove(&partial_of(&file))?;
        // Drawn from it by `railcrack report --png`.
        remove(&file.with_extension("png"))?;
    }
    clear_fields(&fields)?;
    for emptied in [plots, fields, inputs] {
        // Refused if the folder contains files of the user or does not exist: both are fine.
        let _ = fs::remove_dir(emptied);
    }
    Ok(())
}

/// Removes the stage that computed the plastic state of the run in `folder`, unless its place holds
/// a run of the user.
pub(super) fn clear_rolled(folder: &Path) -> Result<(), OutputError> {
    let folder = &own_folder(folder, ROLLED_FOLDER)?;
    if !folder.join(CASE_FILE).exists() {
        return Ok(());
    }
    clear_results(folder)?;
    remove(&folder.join(UNFINISHED_FILE))?;
    remove(&folder.join(CASE_FILE))?;
    let _ = fs::remove_dir(folder);
    Ok(())
}

/// Removes the field files of a run, also those that were being written.
fn clear_fields(fields: &Path) -> Result<(), OutputError> {
    let entries = match fs::read_dir(fields) {
        Err(reason) if reason.kind() == ErrorKind::NotFound => return Ok(()),
        entries => entries.map_err(OutputError::io("read", fields))?,
    };
    for entry in entries {
        let name = entry.map_err(OutputError::io("read", fields))?.file_name();
        let name = name.to_string_lossy();
        let written = name.strip_suffix(&format!(".{PARTIAL}")).unwrap_or(&name);
        if is_field_file(written) {
            remove(&fields.join(name.as_ref()))?;
        }
    }
    Ok(())
}

/// Removes a run: its case, its results, and its folder where nothing else is in it.
///
/// Errors: another process computes in the folder; a folder in it is a link; the system refuses.
pub fn clear_run(folder: &Path) -> Result<(), OutputError> {
    // If the process is killed at the very end, only the lock remains.
    if run_file_in(folder).is_none() && !folder.join(LOCK_FILE).exists() {
        return Ok(());
    }
    let lock = FolderLock::take(folder)?;
    // Of a study, the summary says that the run is done: without it, a run that a kill leaves half
    // removed has not begun.
    remove(&folder.join(SUMMARY_FILE))?;
    remove(&folder.join(CHECKPOINT_FILE))?;
    clear_results(folder)?;
    clear_rolled(folder)?;
    for file in [folder.join(CASE_FILE), partial_of(&folder.join(CASE_FILE))] {
        remove(&file)?;
    }
    drop(lock);
    // Refused if the folder contains files of the user, which is fine.
    let _ = fs::remove_dir(folder);
    Ok(())
}

/// A file of a run that stands in `folder`, where one does.
pub(crate) fn run_file_in(folder: &Path) -> Option<&'static str> {
    std::iter::once(CASE_FILE).chain(run_files()).find(|file| folder.join(file).exists())
}

/// A plot or a field of a run that stands in `folder`, where one does.
///
/// Errors: a folder in it is a link; the system refuses.
pub(super) fn drawn_file_in(folder: &Path) -> Result<Option<String>, OutputError> {
    let plots = own_folder(folder, PLOTS_FOLDER)?;
    let mut all = PLOT_FILES.iter().filter(|file| plots.join(file).exists());
    if let Some(file) = all.next() {
        return Ok(Some(format!("{PLOTS_FOLDER}/{file}")));
    }
    let Ok(fields) = fs::read_dir(own_folder(folder, FIELDS_FOLDER)?) else { return Ok(None) };
    let mut names = fields.flatten().filter_map(|entry| entry.file_name().into_string().ok());
    Ok(names.find(|name| is_field_file(name)).map(|name| format!("{FIELDS_FOLDER}/{name}")))
}

/// The same as [`run_file_in`] in the folder of a study, which has a report of its own.
pub(crate) fn run_file_in_study(folder: &Path) -> Option<&'static str> {
    let of_run = run_files().filter(|file| *file != REPORT_FILE);
    std::iter::once(CASE_FILE).chain(of_run).find(|file| folder.join(file).exists())
}

/// Whether the results in `folder` are unfinished.
pub(crate) fn is_unfinished(folder: &Path) -> bool {
    folder.join(UNFINISHED_FILE).symlink_metadata().is_ok_and(|there| there.is_file())
}

/// Whether a run writes, replaces or removes the file `name`, relative to its folder, with `/`.
#[must_use]
pub fn is_file_of_run(name: &str) -> bool {
    let own = name.strip_prefix(ROLLED_FOLDER).and_then(|rest| rest.strip_prefix('/')).unwrap_or(name);
    let within = |folder: &str| own.strip_prefix(folder).and_then(|rest| rest.strip_prefix('/'));
    own == CASE_FILE
        || run_files().any(|file| file == own)
        || within(PLOTS_FOLDER).is_some_and(|plot| PLOT_FILES.contains(&plot))
        || within(FIELDS_FOLDER).is_some_and(is_field_file)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lock_that_is_alone_goes_with_the_run() {
        let folder = std::env::temp_dir().join(format!("railcrack-alone-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        fs::write(folder.join(LOCK_FILE), "1\n").unwrap();
        clear_run(&folder).unwrap();
        assert!(!folder.exists());
    }
}
