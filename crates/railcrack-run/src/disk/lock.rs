//! The lock of a run folder: one process at a time computes in it.

use super::changes;
use crate::error::OutputError;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

/// The file that is locked. It holds the number of the process, and is gone when the process has
/// ended by itself.
pub const LOCK_FILE: &str = "run.lock";

/// The lock of a folder, held until it is dropped. It is the system's and dies with its process,
/// however that ends: a `run.lock` that a killed process has left locks nothing.
#[derive(Debug)]
pub struct FolderLock {
    path: PathBuf,
    /// None on a file system without locks.
    file: Option<File>,
}

impl FolderLock {
    /// Locks `folder`, which exists.
    ///
    /// Errors: another process has it; the system refuses.
    pub fn take(folder: &Path) -> Result<Self, OutputError> {
        let path = folder.join(LOCK_FILE);
        let refused = || OutputError::io("lock", &path);
        loop {
            let mut options = OpenOptions::new();
            options.read(true).write(true).create(true).truncate(false);
            let mut file = changes::open(&path, &mut options).map_err(refused())?;
            match file.try_lock() {
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => {
                    let mut process = String::new();
                    // Some systems do not allow reading a locked file.
                    let _ = file.take(20).read_to_string(&mut process);
                    let process = process.trim().parse().ok();
                    return Err(OutputError::InUse { folder: folder.to_path_buf(), process });
                }
                // A file system without locks: continue without one.
                Err(TryLockError::Error(_)) => {
                    drop(file);
                    let _ = fs::remove_file(&path);
                    return Ok(Self { path, file: None });
                }
            }
            // The process that had the lock may have removed the file in between: then it has been
            // replaced or is missing.
            if !is_at(&file, &path) {
                continue;
            }
            let number = format!("{}\n", std::process::id());
            file.set_len(0).and_then(|()| file.write_all(number.as_bytes())).map_err(refused())?;
            return Ok(Self { path, file: Some(file) });
        }
    }

    /// Whether another process has the lock of `folder`. Nothing is written.
    pub fn is_taken(folder: &Path) -> bool {
        let file = changes::open(&folder.join(LOCK_FILE), OpenOptions::new().read(true));
        file.is_ok_and(|file| matches!(file.try_lock_shared(), Err(TryLockError::WouldBlock)))
    }
}

impl Drop for FolderLock {
    fn drop(&mut self) {
        if self.file.is_some() {
            // While it is still locked: nobody else's is removed.
            let _ = fs::remove_file(&self.path);
        }
    }
}

/// Whether `file` still stands at `path`.
#[cfg(unix)]
pub(super) fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    match (file.metadata(), fs::metadata(path)) {
        (Ok(own), Ok(there)) => (own.dev(), own.ino()) == (there.dev(), there.ino()),
        _ => false,
    }
}

/// An open file cannot be removed there.
#[cfg(not(unix))]
pub(super) fn is_at(_: &File, path: &Path) -> bool {
    path.exists()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_at_a_time() {
        let folder = std::env::temp_dir().join(format!("railcrack-lock-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let lock = FolderLock::take(&folder).unwrap();
        let refused = FolderLock::take(&folder).unwrap_err();
        let own = std::process::id();
        assert!(matches!(refused, OutputError::InUse { process: Some(id), .. } if id == own), "{refused}");
        assert!(FolderLock::is_taken(&folder));
        drop(lock);
        assert!(!folder.join(LOCK_FILE).exists());
        // A process that was killed.
        fs::write(folder.join(LOCK_FILE), "1\n").unwrap();
        assert!(!FolderLock::is_taken(&folder));
        drop(FolderLock::take(&folder).unwrap());
        fs::remove_dir_all(&folder).unwrap();
    }
}
