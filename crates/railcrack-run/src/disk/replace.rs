//! A file is replaced whole: readers see the old one or the new one.

use super::changes;
use super::lock::is_at;
use crate::error::OutputError;
use railcrack_case::open_regular;
use std::fs::OpenOptions;
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
    stage_file(path, content, durability)?;
    put_in_place(path)
}

/// Moves the file that [`stage_file`] has written to `path`.
pub(crate) fn put_in_place(path: &Path) -> Result<(), OutputError> {
    changes::rename(&partial_of(path), path).map_err(OutputError::io("write", path))
}

/// Writes `content` to the temporary file of `path`.
///
/// Errors: the system refuses; then there is no such file.
pub(crate) fn stage_file(path: &Path, content: &[u8], durability: Durability) -> Result<(), OutputError> {
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
    Ok(())
}

/// The same as [`replace_file`] for a file that several processes may write at once, each the same
/// content or a newer one: readers see the file of one of them, whole. The temporary file is
/// locked, so that one that a kill has left is taken over.
///
/// Errors: the system refuses.
pub(crate) fn replace_shared(path: &Path, content: &[u8]) -> Result<(), OutputError> {
    let partial = partial_of(path);
    let refused = || OutputError::io("write", path);
    let is_there = read_if_there(path)?.as_deref() == Some(content);
    if is_there && partial.symlink_metadata().is_err() {
        return Ok(());
    }
    loop {
        let mut options = OpenOptions::new();
        options.write(true).create(true).truncate(false);
        let mut file = changes::open(&partial, &mut options).map_err(refused())?;
        // On a file system without locks, processes may write at once: the same content.
        let _ = file.lock();
        if !is_at(&file, &partial) {
            // The process that had it has moved it into place.
            continue;
        }
        if is_there {
            return remove(&partial);
        }
        let written = changes::set_length(&file, &partial, 0)
            .and_then(|()| changes::write(&mut file, &partial, content))
            .and_then(|()| changes::rename(&partial, path));
        return written.map_err(|reason| {
            // Best effort: the error of the write is the one to report.
            let _ = changes::remove(&partial);
            refused()(reason)
        });
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::disk::faults::{Fault, during};
    use std::fs;

    /// A kill at any change of a file that several processes write leaves one name, which the next
    /// process takes over.
    #[test]
    fn what_a_kill_leaves_of_a_shared_file_is_cleared() {
        let folder = std::env::temp_dir().join(format!("railcrack-shared-{}", std::process::id()));
        let path = folder.join("report.html");
        let names =
            || -> Vec<_> { fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name()).collect() };
        let clean = || {
            let _ = fs::remove_dir_all(&folder);
            fs::create_dir_all(&folder).unwrap();
        };
        clean();
        let put = |text: &str| replace_shared(&path, text.as_bytes());
        let changes = during(&folder, Fault::Killed, usize::MAX, || put("whole").unwrap());
        assert!(changes >= 3, "{changes}");
        for at in 0..changes {
            for fault in [Fault::Killed, Fault::KilledWithin] {
                clean();
                during(&folder, fault, at, || drop(put("whole")));
                assert!(names().iter().all(|name| name == "report.html.partial"), "{at}: {:?}", names());
                put("whole").unwrap();
                assert_eq!(
                    (names(), fs::read(&path).unwrap()),
                    (vec!["report.html".into()], b"whole".to_vec())
                );
            }
        }
        // What another kill has left beside a file that needs no writing.
        fs::write(partial_of(&path), "who").unwrap();
        put("whole").unwrap();
        assert_eq!(names(), ["report.html"]);
        fs::remove_dir_all(&folder).unwrap();
    }
}
