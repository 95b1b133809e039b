//! The case of the run in a folder, and whether it is a given one.

use super::case_files::{CaseFiles, same_text};
use crate::disk::files::{CASE_FILE, WHEEL_GROUPS_FILE};
use crate::disk::{check_inputs, partial_of, read_if_there};
use crate::error::OutputError;
use crate::setup::{represented, represented_in};
use railcrack_case::{Case, WheelGroups};
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

/// The case of the run in `folder`, with the representatives of its table of wheels that the run
/// has computed.
///
/// Errors: there is none, or this version does not accept it.
pub(crate) fn read_case(folder: &Path) -> Result<Case, OutputError> {
    let text = stored_case(folder)?
        .ok_or_else(|| OutputError::NotARun { folder: folder.to_path_buf(), file: CASE_FILE })?;
    check_inputs(folder, &text)?;
    let path = folder.join(CASE_FILE);
    let case = Case::parse(&text, &path.display().to_string(), folder);
    let case = case.map_err(|errors| OutputError::damaged(&path, errors.to_string()))?;
    match wheel_groups(folder)? {
        Some(groups) => represented_in(&case, groups).ok_or_else(|| {
            OutputError::damaged(
                &folder.join(WHEEL_GROUPS_FILE),
                "has other wheels than the table of the case",
            )
        }),
        None => Ok(represented(&case).into_owned()),
    }
}

/// The groups of wheels that the run in `folder` has made; none where it has none.
///
/// Errors: they are damaged; the system refuses.
pub(crate) fn wheel_groups(folder: &Path) -> Result<Option<WheelGroups>, OutputError> {
    let path = folder.join(WHEEL_GROUPS_FILE);
    let Some(text) = read_if_there(&path)? else { return Ok(None) };
    serde_json::from_slice(&text).map(Some).map_err(|reason| OutputError::damaged(&path, reason.to_string()))
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
