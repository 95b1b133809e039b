//! Temporary folders.

use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use std::path::Path;
use tempfile::TempDir;

/// A temporary folder, removed when dropped.
///
/// Errors: it cannot be created.
pub fn scratch_folder() -> PyResult<TempDir> {
    let created = tempfile::Builder::new().prefix("railcrack-").tempdir();
    created.map_err(|reason| PyOSError::new_err(format!("cannot create a temporary folder: {reason}")))
}

/// Calls `read` with `folder`, or with a temporary folder containing `files`, by their relative
/// names, if there are any.
///
/// Errors: a file cannot be written.
pub fn reading<T>(
    folder: &Path,
    files: Vec<(String, Vec<u8>)>,
    read: impl FnOnce(&Path) -> T,
) -> PyResult<T> {
    if files.is_empty() {
        return Ok(read(folder));
    }
    let scratch = scratch_folder()?;
    for (name, content) in files {
        let path = scratch.path().join(&name);
        let folder = path.parent().map_or(Ok(()), std::fs::create_dir_all);
        let written = folder.and_then(|()| std::fs::write(&path, content));
        written.map_err(|reason| PyOSError::new_err(format!("cannot write {name}: {reason}")))?;
    }
    Ok(read(scratch.path()))
}
