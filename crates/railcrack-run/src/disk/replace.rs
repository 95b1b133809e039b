//! A file is replaced whole: readers see the old one or the new one.

use super::changes;
use crate::error::OutputError;
use railcrack_case::open_regular;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

/// Ending of a file that is being written and not yet in place.
pub(crate) const PARTIAL: &str = "partial";

/// Whether a file must be on the disk before it is moved into place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Durability {
    /// Survives a power failure.
    Synced,
    /// Survives the end of the process.
    Cached,
}

/// Writes `content` to a temporary file and moves it to `path`: readers see the old file or the new
/// one, never a part.
pub fn replace_file(path: &Path, content: &[u8], durability: Durability) -> Result<(), OutputError> {
    let partial = partial_of(path);
    let refused = || OutputError::io("write", path);
    let mut file = changes::create(&partial).map_err(refused())?;
    let written = changes::write(&mut file, &partial, content).and_then(|()| match durability {
        Durability::Synced => changes::sync(&file, &partial),
        Durability::Cached => Ok(()),
    });
    if let Err(reason) = written {
        // Best effort: the error of the write is the one to report.
        let _ = changes::remove(&partial);
        return Err(refused()(reason));
    }
    changes::rename(&partial, path).map_err(refused())
}

pub(crate) fn partial_of(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".");
    name.push(PARTIAL);
    PathBuf::from(name)
}

fn read(path: &Path) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open_regular(path)?.read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// The content of a file.
pub(crate) fn read_file(path: &Path) -> Result<Vec<u8>, OutputError> {
    read(path).map_err(OutputError::io("read", path))
}

/// The content of a file; none where there is no such file.
pub fn read_if_there(path: &Path) -> Result<Option<Vec<u8>>, OutputError> {
    match read(path) {
        Ok(bytes) => Ok(Some(bytes)),
        Err(reason) if reason.kind() == ErrorKind::NotFound => Ok(None),
        Err(reason) => Err(OutputError::io("read", path)(reason)),
    }
}

/// Removes a file where it is there.
pub(crate) fn remove(path: &Path) -> Result<(), OutputError> {
    match changes::remove(path) {
        Err(reason) if reason.kind() != ErrorKind::NotFound => Err(OutputError::io("remove", path)(reason)),
        _ => Ok(()),
    }
}
