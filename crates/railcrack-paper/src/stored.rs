//! Finished runs in the folder, reused by `--resume`.

use crate::case_run::CaseRun;
use crate::files::RUNS;
use railcrack_case::Case;
use railcrack_run::disk::{Durability, replace_file};
use railcrack_run::{OutputError, VERSION};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Version of the program, and of the layout of [`CaseRun`].
fn writer() -> String {
    format!("{VERSION}, layout 3")
}

/// A run with everything it depends on.
#[derive(Serialize, Deserialize)]
struct Stored {
    /// Its [`writer`].
    program: String,
    /// The case with its defaults, and the tables that it names.
    case: Vec<String>,
    run: CaseRun,
}

fn path(folder: &Path, name: &str) -> PathBuf {
    folder.join(RUNS).join(format!("{name}.run"))
}

/// Everything that determines the results of `case`.
fn identity(case: &Case) -> Vec<String> {
    let tables = case.companions();
    std::iter::once(case.to_toml()).chain(tables.iter().map(|table| table.text.to_owned())).collect()
}

/// The run called `name`, if the folder has one of this `case` by this version; any other is
/// computed again.
pub(super) fn stored(folder: &Path, name: &str, case: &Case) -> Option<CaseRun> {
    let bytes = std::fs::read(path(folder, name)).ok()?;
    let stored: Stored = postcard::from_bytes(&bytes).ok()?;
    (stored.program == writer() && stored.case == identity(case)).then_some(stored.run)
}

/// Stores `run`.
///
/// Errors: the system refuses.
pub(super) fn store(folder: &Path, name: &str, case: &Case, run: &CaseRun) -> Result<(), OutputError> {
    let path = path(folder, name);
    let stored = Stored { program: writer(), case: identity(case), run: run.clone() };
    let bytes = postcard::to_stdvec(&stored)
        .map_err(|reason| OutputError::io("encode", &path)(std::io::Error::other(reason)))?;
    replace_file(&path, &bytes, Durability::Cached)
}
