//! Whether the run in a folder computes a given case.

use super::OutputError;
use super::case_files::{CaseFiles, same_text};
use super::files::CASE_FILE;
use super::folder::{read_if_there, stored_case};
use std::path::Path;

/// Whether the run in `folder`, if there is one, computes `case`.
///
/// Errors: it computes another one; the system refuses.
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
