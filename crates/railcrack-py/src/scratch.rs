//! Temporary folders.

use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{SystemTime, UNIX_EPOCH};

/// A temporary folder, created at the first write and removed when dropped.
#[derive(Debug)]
pub struct Scratch(PathBuf);

impl Scratch {
    /// A name unique among processes.
    pub fn new() -> Self {
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        let now = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_nanos());
        let name = format!("railcrack-{}-{now}-{count}", std::process::id());
        Self(std::env::temp_dir().join(name))
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        &self.0
    }

    /// Calls `read` with `folder`, or with a temporary folder containing `files` if there are any.
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
        Ok(read(Self::with_files(files)?.path()))
    }

    /// The folder with `files` written to it, by their relative names.
    fn with_files(files: Vec<(String, Vec<u8>)>) -> PyResult<Self> {
        let scratch = Self::new();
        for (name, content) in files {
            let path = scratch.0.join(&name);
            let written = path
                .parent()
                .map_or(Ok(()), std::fs::create_dir_all)
                .and_then(|()| std::fs::write(&path, content));
            written.map_err(|reason| PyOSError::new_err(format!("cannot write {name}: {reason}")))?;
        }
        Ok(scratch)
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // Best effort: the system cleans its directory for temporary files.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}
