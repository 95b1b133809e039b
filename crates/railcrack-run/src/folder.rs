//! The run folder on the disk: when the files of a run may be replaced, and how a file is
//! replaced whole.

use super::OutputError;
use super::case_files::CaseFiles;
use super::checksum::sign;
use super::disk;
use super::field_names::is_field_file;
use super::files::{
    CASE_FILE, CHECKPOINT_FILE, FIELDS_FOLDER, INPUTS_FOLDER, PLOT_FILES, PLOTS_FOLDER, REPORT_FILE,
    ROLLED_FOLDER, RUN_FILES, SUMMARY_FILE,
};
use super::lock::{FolderLock, LOCK_FILE};
use super::stored_name::check_inputs;
use railcrack_case::Case;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Ending of a file that is being written and not yet in place.
const PARTIAL: &str = "partial";

/// Treatment of a run that the folder already holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Existing {
    /// Leave it alone: an error.
    Refuse,
    /// Remove the files that a run writes, and no others.
    Replace,
}

/// Whether the disk must have a file before it takes its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Durability {
    /// Survives a power failure.
    Synced,
    /// Survives the end of the process.
    Cached,
}

/// Writes `content` beside `path` and moves it into place: readers see the old file or the new one,
/// never a part.
pub fn replace_file(path: &Path, content: &[u8], durability: Durability) -> Result<(), OutputError> {
    let partial = partial_of(path);
    let refused = || OutputError::io("write", path);
    let mut file = disk::create(&partial).map_err(refused())?;
    let written = disk::write(&mut file, &partial, content).and_then(|()| match durability {
        Durability::Synced => disk::sync(&file, &partial),
        Durability::Cached => Ok(()),
    });
    if let Err(reason) = written {
        // Best effort: the error of the write is the one to report.
        let _ = disk::remove(&partial);
        return Err(refused()(reason));
    }
    disk::rename(&partial, path).map_err(refused())
}

fn partial_of(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".");
    name.push(PARTIAL);
    PathBuf::from(name)
}

/// Makes `folder` a run folder with nothing but the case. From `case.toml` on, the folder holds a
/// run that can be resumed.
pub(crate) fn begin(folder: &Path, case: &CaseFiles, existing: Existing) -> Result<(), OutputError> {
    if existing == Existing::Refuse
        && let Some(file) = run_file_in(folder)
    {
        return Err(OutputError::HoldsRun { folder: folder.to_path_buf(), file });
    }
    if folder.exists() && !folder.is_dir() {
        let reason = std::io::Error::new(ErrorKind::NotADirectory, "it is a file, not a folder");
        return Err(OutputError::io("use as a run folder", folder)(reason));
    }
    fs::create_dir_all(folder).map_err(OutputError::io("create the run folder", folder))?;
    if existing == Existing::Replace {
        // The order matters to a kill in between: first the old run loses its checkpoint, then the
        // new case takes the old one's place; whatever is left over then belongs to a run that
        // starts from its beginning.
        remove(&folder.join(CHECKPOINT_FILE))?;
        remove(&folder.join(SUMMARY_FILE))?;
    }
    replace_file(&folder.join(CASE_FILE), case.toml.as_bytes(), Durability::Synced)?;
    if existing == Existing::Replace {
        clear_results(folder)?;
        clear_rolled(&folder.join(ROLLED_FOLDER))?;
    }
    write_companions(folder, case)
}

/// Writes the case of a run that goes on: its text and the files that it names.
pub(crate) fn restore_case(folder: &Path, case: &CaseFiles) -> Result<(), OutputError> {
    replace_file(&folder.join(CASE_FILE), case.toml.as_bytes(), Durability::Cached)?;
    write_companions(folder, case)
}

fn write_companions(folder: &Path, case: &CaseFiles) -> Result<(), OutputError> {
    for (name, text) in &case.companions {
        let path = folder.join(name);
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent).map_err(OutputError::io("create", parent))?;
        }
        replace_file(&path, text.as_bytes(), Durability::Cached)?;
    }
    Ok(())
}

/// Removes every result of a run and its inputs, and their folders where nothing else is in them.
fn clear_results(folder: &Path) -> Result<(), OutputError> {
    for file in RUN_FILES {
        remove(&folder.join(file))?;
        remove(&partial_of(&folder.join(file)))?;
    }
    let plots = folder.join(PLOTS_FOLDER);
    for file in PLOT_FILES.map(|file| plots.join(file)) {
        remove(&file)?;
        remove(&partial_of(&file))?;
        // Drawn from it by `railcrack report --png`.
        remove(&file.with_extension("png"))?;
    }
    let fields = folder.join(FIELDS_FOLDER);
    clear_fields(&fields)?;
    for emptied in [plots, fields, folder.join(INPUTS_FOLDER)] {
        // Refused where the user keeps files of his own in it, or where it does not exist: both are
        // fine.
        let _ = fs::remove_dir(emptied);
    }
    Ok(())
}

/// Removes the stage that computed the plastic state, unless the user has a run of his own there.
fn clear_rolled(folder: &Path) -> Result<(), OutputError> {
    if !folder.join(CASE_FILE).exists() {
        return Ok(());
    }
    clear_results(folder)?;
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

/// Whether a run in `folder` was killed before its case stood there.
pub(crate) fn was_about_to_begin(folder: &Path) -> bool {
    partial_of(&folder.join(CASE_FILE)).is_file()
}

/// The case of the run in `folder`; none where no `case.toml` stands there.
pub(crate) fn stored_case(folder: &Path) -> Result<Option<String>, OutputError> {
    read_if_there(&folder.join(CASE_FILE))?
        .map(|bytes| {
            String::from_utf8(bytes)
                .map_err(|_| OutputError::damaged(&folder.join(CASE_FILE), "is not UTF-8 text"))
        })
        .transpose()
}

/// The case of the run in `folder`.
///
/// Errors: there is none, or this version does not accept it.
pub(crate) fn read_case(folder: &Path) -> Result<Case, OutputError> {
    let text = stored_case(folder)?
        .ok_or_else(|| OutputError::NotARun { folder: folder.to_path_buf(), file: CASE_FILE })?;
    check_inputs(folder, &text)?;
    let path = folder.join(CASE_FILE);
    let case = Case::parse(&text, &path.display().to_string(), folder);
    case.map_err(|errors| OutputError::damaged(&path, errors.to_string()))
}

/// The JSON file `file` of `folder`; none where it is not there.
pub(crate) fn read_json_if_there<T: DeserializeOwned>(
    folder: &Path,
    file: &str,
) -> Result<Option<T>, OutputError> {
    let path = folder.join(file);
    let Some(text) = read_if_there(&path)? else { return Ok(None) };
    let value = serde_json::from_slice(&text);
    value.map(Some).map_err(|reason| OutputError::damaged(&path, reason.to_string()))
}

/// The JSON file `file`, which makes `folder` what it is.
pub(crate) fn read_json<T: DeserializeOwned>(folder: &Path, file: &'static str) -> Result<T, OutputError> {
    read_json_if_there(folder, file)?
        .ok_or_else(|| OutputError::NotARun { folder: folder.to_path_buf(), file })
}

/// `value` as the text of a JSON file, which ends with the checksum of the others.
pub(crate) fn json_text(path: &Path, value: &impl Serialize) -> Result<String, OutputError> {
    let text = serde_json::to_value(value).and_then(|mut document| {
        sign(&mut document);
        serde_json::to_string_pretty(&document)
    });
    text.map(|text| text + "\n").map_err(|reason| OutputError::damaged(path, reason.to_string()))
}

/// Writes `value` to the JSON file `file` of `folder`.
pub(crate) fn write_json(
    folder: &Path,
    file: &str,
    value: &impl Serialize,
    durability: Durability,
) -> Result<(), OutputError> {
    let path = folder.join(file);
    replace_file(&path, json_text(&path, value)?.as_bytes(), durability)
}

/// The content of a file; none where there is no such file.
pub fn read_if_there(path: &Path) -> Result<Option<Vec<u8>>, OutputError> {
    match fs::read(path) {
        Ok(bytes) => Ok(Some(bytes)),
        Err(reason) if reason.kind() == ErrorKind::NotFound => Ok(None),
        Err(reason) => Err(OutputError::io("read", path)(reason)),
    }
}

/// Removes a run: its case, its results, and its folder where nothing else is in it.
pub(crate) fn clear_run(folder: &Path) -> Result<(), OutputError> {
    // A kill at its very end leaves the lock alone.
    if run_file_in(folder).is_none() && !folder.join(LOCK_FILE).exists() {
        return Ok(());
    }
    let lock = FolderLock::take(folder)?;
    // Of a study, the summary says that the run is done: without it, a run that a kill leaves half
    // removed has not begun.
    remove(&folder.join(SUMMARY_FILE))?;
    remove(&folder.join(CHECKPOINT_FILE))?;
    clear_results(folder)?;
    clear_rolled(&folder.join(ROLLED_FOLDER))?;
    for file in [folder.join(CASE_FILE), partial_of(&folder.join(CASE_FILE))] {
        remove(&file)?;
    }
    drop(lock);
    // Refused where the user keeps files of his own in it: fine.
    let _ = fs::remove_dir(folder);
    Ok(())
}

/// A file of a run that stands in `folder`, where one does.
pub(crate) fn run_file_in(folder: &Path) -> Option<&'static str> {
    std::iter::once(CASE_FILE).chain(RUN_FILES).find(|file| folder.join(file).exists())
}

/// The same in the folder of a study, which has a report of its own.
pub(crate) fn run_file_in_study(folder: &Path) -> Option<&'static str> {
    let of_run = RUN_FILES.into_iter().filter(|file| *file != REPORT_FILE);
    std::iter::once(CASE_FILE).chain(of_run).find(|file| folder.join(file).exists())
}

/// Removes a file where it is there.
pub(crate) fn remove(path: &Path) -> Result<(), OutputError> {
    match disk::remove(path) {
        Err(reason) if reason.kind() != ErrorKind::NotFound => Err(OutputError::io("remove", path)(reason)),
        _ => Ok(()),
    }
}
