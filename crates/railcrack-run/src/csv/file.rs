//! A table that is extended by whole rows and can be truncated to a known length.

use crate::disk::{Seal, Sealing, changes};
use crate::error::OutputError;
use railcrack_case::open_regular;
use std::fs::{File, OpenOptions};
use std::io::{Seek, SeekFrom};
use std::path::{Path, PathBuf};

/// Maximum number of bytes of one write: a kill between two writes leaves whole rows. Within a
/// write it takes effect at the border of two pages of memory only, so a small write is hardly ever
/// cut (3 in 2000 kills of a program that does nothing but write); what is cut,
/// [`CsvFile::cut_back`] removes.
const CHUNK: usize = 4096;

/// An open table of the run folder.
#[derive(Debug)]
pub(crate) struct CsvFile {
    path: PathBuf,
    file: File,
    sealing: Sealing,
}

impl CsvFile {
    /// A new table at `path` that holds `header` only, whatever was there.
    pub(crate) fn create(path: &Path, header: &str) -> Result<Self, OutputError> {
        let mut table = Self::open(path, Sealing::default())?;
        table.append(header.as_bytes())?;
        Ok(table)
    }

    /// The table at `path`, cut back to what `seal` says of the finished steps: what came after was
    /// written by a step that did not finish.
    ///
    /// Errors: less than that is there, or something else; the system refuses.
    pub(crate) fn cut_back(path: &Path, seal: Seal) -> Result<Self, OutputError> {
        Self::open(path, sealed(path, seal)?.0)
    }

    fn open(path: &Path, sealing: Sealing) -> Result<Self, OutputError> {
        let refused = || OutputError::io("write", path);
        let mut options = OpenOptions::new();
        options.write(true).create(true).truncate(false);
        let mut file = changes::open(path, &mut options).map_err(refused())?;
        let length = sealing.seal().length;
        changes::set_length(&file, path, length).map_err(refused())?;
        file.seek(SeekFrom::Start(length)).map_err(refused())?;
        Ok(Self { path: path.to_path_buf(), file, sealing })
    }

    /// Appends whole rows. On an error the table is cut back to what it held before.
    pub(crate) fn append(&mut self, rows: &[u8]) -> Result<(), OutputError> {
        let write = |piece: &[u8]| changes::write(&mut self.file, &self.path, piece);
        if let Err(reason) = write_whole_rows(write, rows) {
            self.take_back(self.seal());
            return Err(OutputError::Io { action: "write", path: self.path.clone(), reason });
        }
        self.sealing.add(rows);
        Ok(())
    }

    /// Takes rows back that should not have been appended: the table held what `seal` says before.
    /// Best effort, since there is another error to report.
    pub(crate) fn take_back(&mut self, seal: Seal) {
        let _ = changes::set_length(&self.file, &self.path, seal.length);
        let _ = self.file.seek(SeekFrom::Start(seal.length));
        if seal != self.seal()
            && let Ok((sealing, _)) = sealed(&self.path, seal)
        {
            self.sealing = sealing;
        }
    }

    /// Waits until the disk has the rows: a checkpoint must not outlive what it counts on.
    pub(crate) fn sync(&self) -> Result<(), OutputError> {
        changes::sync(&self.file, &self.path).map_err(OutputError::io("write", &self.path))
    }

    /// Content of the table.
    pub(crate) fn seal(&self) -> Seal {
        self.sealing.seal()
    }
}

/// Whether the table at `path` begins with what `seal` says of the finished steps. How many bytes
/// it has.
///
/// Errors: it does not; the system refuses.
pub(crate) fn check_sealed(path: &Path, seal: Seal) -> Result<u64, OutputError> {
    sealed(path, seal).map(|(_, length)| length)
}

/// The same with the checksum, to go on from.
fn sealed(path: &Path, seal: Seal) -> Result<(Sealing, u64), OutputError> {
    let refused = || OutputError::io("read", path);
    let file = open_regular(path).map_err(refused())?;
    let length = file.metadata().map_err(refused())?.len();
    if length < seal.length {
        let reason = format!("holds {length} bytes where the finished steps wrote {}", seal.length);
        return Err(OutputError::damaged(path, reason));
    }
    let sealing = Sealing::read(file, seal.length).map_err(refused())?;
    if sealing.seal() != seal {
        return Err(OutputError::damaged(path, "does not hold what the finished steps wrote (checksum)"));
    }
    Ok((sealing, length))
}

/// Writes `rows` by calls of at most [`CHUNK`] bytes that end with a row; a row longer than that
/// goes alone.
fn write_whole_rows(
    mut write: impl FnMut(&[u8]) -> std::io::Result<()>,
    mut rows: &[u8],
) -> std::io::Result<()> {
    while !rows.is_empty() {
        let window = &rows[..rows.len().min(CHUNK)];
        let end = match window.iter().rposition(|&byte| byte == b'\n') {
            Some(last) => last + 1,
            None => rows.iter().position(|&byte| byte == b'\n').map_or(rows.len(), |last| last + 1),
        };
        write(&rows[..end])?;
        rows = &rows[end..];
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every call.
    fn calls(rows: &[u8]) -> Vec<Vec<u8>> {
        let mut calls = Vec::new();
        let write = |piece: &[u8]| {
            calls.push(piece.to_vec());
            Ok(())
        };
        write_whole_rows(write, rows).unwrap();
        calls
    }

    #[test]
    fn every_write_ends_with_a_row_and_stays_small() {
        let rows: String = (0..2000).map(|i| format!("{i},{}\n", "x".repeat(i % 97))).collect();
        let calls = calls(rows.as_bytes());
        assert!(calls.len() > 10);
        assert!(calls.iter().all(|call| call.len() <= CHUNK && call.ends_with(b"\n")));
        assert_eq!(calls.concat(), rows.as_bytes());
    }

    #[test]
    fn a_row_longer_than_a_chunk_is_written_whole() {
        let rows = format!("short\n{}\nend\n", "y".repeat(3 * CHUNK));
        let calls = calls(rows.as_bytes());
        assert!(calls.iter().all(|call| call.ends_with(b"\n")));
        assert_eq!(calls.concat(), rows.as_bytes());
    }
}
