//! A table that grows by whole rows and can be cut back to a known length.

use crate::OutputError;
use std::fs::{File, OpenOptions};
use std::io::{Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// The most bytes of one write: a kill between two writes leaves whole rows. Within a write it
/// takes effect at the border of two pages of memory only, so a small write is hardly ever cut (3
/// in 2000 kills of a program that does nothing but write); what is cut, [`CsvFile::cut_back`]
/// removes.
const CHUNK: usize = 4096;

/// An open table of the run folder.
#[derive(Debug)]
pub(crate) struct CsvFile {
    path: PathBuf,
    file: File,
    length: u64,
}

impl CsvFile {
    /// A new table at `path` that holds `header` only, whatever was there.
    pub(crate) fn create(path: &Path, header: &str) -> Result<Self, OutputError> {
        let mut table = Self::open(path, 0)?;
        table.append(header.as_bytes())?;
        Ok(table)
    }

    /// The table at `path`, cut back to `length` bytes: what came after was written by a step that
    /// did not finish.
    pub(crate) fn cut_back(path: &Path, length: u64) -> Result<Self, OutputError> {
        let found = std::fs::metadata(path).map_err(OutputError::io("read", path))?.len();
        if found < length {
            let reason = format!("holds {found} bytes where the finished steps wrote {length}");
            return Err(OutputError::damaged(path, reason));
        }
        Self::open(path, length)
    }

    fn open(path: &Path, length: u64) -> Result<Self, OutputError> {
        let refused = || OutputError::io("write", path);
        let mut options = OpenOptions::new();
        let mut file = options.write(true).create(true).truncate(false).open(path).map_err(refused())?;
        file.set_len(length).map_err(refused())?;
        file.seek(SeekFrom::Start(length)).map_err(refused())?;
        Ok(Self { path: path.to_path_buf(), file, length })
    }

    /// Appends whole rows. On an error the table is cut back to what it held before.
    pub(crate) fn append(&mut self, rows: &[u8]) -> Result<(), OutputError> {
        if let Err(reason) = write_whole_rows(&mut self.file, rows) {
            self.take_back(self.length);
            return Err(OutputError::Io { action: "write", path: self.path.clone(), reason });
        }
        self.length += rows.len() as u64;
        Ok(())
    }

    /// Takes rows back that should not have been appended: the table held `length` bytes before.
    /// Best effort, since there is another error to report.
    pub(crate) fn take_back(&mut self, length: u64) {
        let _ = self.file.set_len(length);
        let _ = self.file.seek(SeekFrom::Start(length));
        self.length = length;
    }

    /// Waits until the disk has the rows: a checkpoint must not outlive what it counts on.
    pub(crate) fn sync(&self) -> Result<(), OutputError> {
        self.file.sync_data().map_err(OutputError::io("write", &self.path))
    }

    /// Bytes in the table.
    pub(crate) fn length(&self) -> u64 {
        self.length
    }
}

/// Writes `rows` by calls of at most [`CHUNK`] bytes that end with a row; a row longer than that
/// goes alone.
fn write_whole_rows(out: &mut impl Write, mut rows: &[u8]) -> std::io::Result<()> {
    while !rows.is_empty() {
        let window = &rows[..rows.len().min(CHUNK)];
        let end = match window.iter().rposition(|&byte| byte == b'\n') {
            Some(last) => last + 1,
            None => rows.iter().position(|&byte| byte == b'\n').map_or(rows.len(), |last| last + 1),
        };
        out.write_all(&rows[..end])?;
        rows = &rows[end..];
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Remembers every call.
    struct Calls(Vec<Vec<u8>>);

    impl Write for Calls {
        fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
            self.0.push(bytes.to_vec());
            Ok(bytes.len())
        }
        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn every_write_ends_with_a_row_and_stays_small() {
        let rows: String = (0..2000).map(|i| format!("{i},{}\n", "x".repeat(i % 97))).collect();
        let mut calls = Calls(Vec::new());
        write_whole_rows(&mut calls, rows.as_bytes()).unwrap();
        assert!(calls.0.len() > 10);
        assert!(calls.0.iter().all(|call| call.len() <= CHUNK && call.ends_with(b"\n")));
        assert_eq!(calls.0.concat(), rows.as_bytes());
    }

    #[test]
    fn a_row_longer_than_a_chunk_is_written_whole() {
        let rows = format!("short\n{}\nend\n", "y".repeat(3 * CHUNK));
        let mut calls = Calls(Vec::new());
        write_whole_rows(&mut calls, rows.as_bytes()).unwrap();
        assert!(calls.0.iter().all(|call| call.ends_with(b"\n")));
        assert_eq!(calls.0.concat(), rows.as_bytes());
    }
}
