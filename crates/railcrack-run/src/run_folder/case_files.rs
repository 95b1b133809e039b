//! The case of a run as files, and whether two runs have the same.

use crate::disk::files::CASE_FILE;
use crate::error::OutputError;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// The text of `case.toml` and the files that it names.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct CaseFiles {
    /// The case, defaults filled in.
    pub toml: String,
    /// Name in the run folder (`inputs/residual-stress.csv`) and text of each file that the case
    /// names.
    pub companions: Vec<(String, String)>,
}

/// Whether the case `stored` of the run in `folder` is `given`.
///
/// Errors: it differs.
pub(crate) fn same_case(folder: &Path, stored: &CaseFiles, given: &CaseFiles) -> Result<(), OutputError> {
    same_text(folder, CASE_FILE, &stored.toml, &given.toml)?;
    for (name, text) in &given.companions {
        let before = stored.companions.iter().find(|companion| companion.0 == *name);
        same_text(folder, name, before.map_or("", |companion| companion.1.as_str()), text)?;
    }
    Ok(())
}

/// The same for one file.
pub(crate) fn same_text(folder: &Path, file: &str, stored: &str, given: &str) -> Result<(), OutputError> {
    if stored == given {
        return Ok(());
    }
    let line_of = |text: &str, line: usize| text.lines().nth(line).unwrap_or("").trim().to_owned();
    let lines = stored.lines().count().max(given.lines().count());
    let line = (0..lines).find(|&line| line_of(stored, line) != line_of(given, line)).unwrap_or(0);
    Err(OutputError::CaseChanged {
        folder: folder.to_path_buf(),
        file: file.to_owned(),
        line: line + 1,
        stored: line_of(stored, line),
        given: line_of(given, line),
    })
}
