//! The disk: every change that a run makes to its files goes through here, so that tests can make
//! any of them fail.

use super::inner::is_a_link;
use std::fs::{self, File, OpenOptions};
use std::io::{Error, Result, Write};
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
    open(path, OpenOptions::new().write(true).create(true).truncate(true))
}

/// The file at `path`, opened with `options`, none of which follows a link.
///
/// Errors: it is a link, or anything else than a file, such as a pipe, for which a program could
/// wait for ever; the system refuses.
pub(crate) fn open(path: &Path, options: &mut OpenOptions) -> Result<File> {
    #[cfg(unix)]
    {
        use rustix::fs::OFlags;
        use std::os::unix::fs::OpenOptionsExt;
        options.custom_flags((OFlags::NOFOLLOW | OFlags::NONBLOCK).bits().cast_signed());
    }
    let is_link = || path.symlink_metadata().is_ok_and(|there| there.is_symlink());
    if cfg!(not(unix)) && is_link() {
        return Err(is_a_link());
    }
    let file = options.open(path).map_err(|reason| if is_link() { is_a_link() } else { reason })?;
    if !file.metadata()?.is_file() {
        return Err(Error::other("it is no file"));
    }
    Ok(file)
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
