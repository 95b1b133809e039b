//! The case of the run in a folder, and whether it is a given one.

use super::case_files::{CaseFiles, same_text};
use crate::disk::files::CASE_FILE;
use crate::disk::{check_inputs, partial_of, read_if_there};
use crate::error::OutputError;
use railcrack_case::Case;
use std::path::Path;

/// Whether a run in `folder` was killed before its case was written.
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

/// Whether the run in `folder`, if there is one, computes `case`.
///
/// Errors: it computes a different case; the system refuses.
pub(crate) fn check_case(folder: &Path, case: &CaseFiles) -> Result<(), OutputError> {
    let Some(stored) = stored_case(folder)? else { return Ok(()) };
    same_text(folder, CASE_FILE, &stored, &case.toml)?;
    for (name, text) in &case.companions {
        if let Some(before) = read_if_there(&folder.join(name))? {
            same_text(folder, name, &String::from_utf8_lossy(&before), text)?;
        }
    }
    Ok(())
}
