//! The disk: every change that a run makes to its files goes through here, so that tests can make
//! any of them fail.

use std::fs::{self, File};
use std::io::{Result, Write};
use std::path::Path;

#[cfg(test)]
use super::faults;

/// Outside tests, only operations refused by the system fail.
#[cfg(not(test))]
mod faults {
    use super::{Path, Result};

    pub(super) fn at(_: &Path, content: &[u8]) -> (usize, Result<()>) {
        (content.len(), Ok(()))
    }
}

/// An empty file at `path`.
pub(crate) fn create(path: &Path) -> Result<File> {
    faults::at(path, &[]).1?;
    File::create(path)
}

/// Writes all of `content` to `file`, which is that at `path`.
pub(crate) fn write(file: &mut File, path: &Path, content: &[u8]) -> Result<()> {
    let (length, answer) = faults::at(path, content);
    file.write_all(&content[..length])?;
    answer
}

/// Cuts `file`, which is that at `path`, to `length` bytes.
pub(crate) fn set_length(file: &File, path: &Path, length: u64) -> Result<()> {
    faults::at(path, &[]).1?;
    file.set_len(length)
}

/// Waits until the disk has `file`, which is that at `path`.
pub(crate) fn sync(file: &File, path: &Path) -> Result<()> {
    faults::at(path, &[]).1?;
    file.sync_data()
}

/// Moves a file into place.
pub(crate) fn rename(from: &Path, to: &Path) -> Result<()> {
    faults::at(from, &[]).1?;
    fs::rename(from, to)
}

/// Removes a file.
pub(crate) fn remove(path: &Path) -> Result<()> {
    faults::at(path, &[]).1?;
    fs::remove_file(path)
}
