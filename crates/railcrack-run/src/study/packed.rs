//! Runs of a study in a few files: what a run folder would hold, a record for each run.

use crate::disk::Checksum;
use crate::error::OutputError;
use crate::run_folder::RunFiles;
use miniz_oxide::deflate::compress_to_vec;
use miniz_oxide::inflate::decompress_to_vec_with_limit;
use std::collections::HashMap;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{BufReader, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

const PREFIX: &str = "packed-";
const ENDING: &str = ".bin";
/// Number of the run, bytes of the record, their checksum.
const HEADER: usize = 24;
/// Level of compression: higher levels do not reduce numbers further.
const LEVEL: u8 = 5;
/// Maximum size of a run, bytes.
const MOST: usize = 1 << 30;
/// How long records may wait for the disk: a kill loses none by that, a power failure those.
const SYNC_INTERVAL: Duration = Duration::from_secs(1);

/// Whether `name` is that of a file of packed runs.
fn is_packed(name: &str) -> bool {
    name.starts_with(PREFIX) && name.ends_with(ENDING)
}

/// The files of packed runs in `folder`, in order.
pub(super) fn packed_files(folder: &Path) -> Result<Vec<PathBuf>, OutputError> {
    let entries = match std::fs::read_dir(folder) {
        Err(reason) if reason.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
        entries => entries.map_err(OutputError::io("read", folder))?,
    };
    let mut files = Vec::new();
    for entry in entries {
        let entry = entry.map_err(OutputError::io("read", folder))?;
        if entry.file_name().to_str().is_some_and(is_packed) {
            files.push(entry.path());
        }
    }
    files.sort();
    Ok(files)
}

/// A record in a file.
#[derive(Debug, Clone, Copy)]
struct Place {
    file: usize,
    offset: u64,
    length: usize,
}

/// The packed runs of a study and their positions. An incomplete record counts as missing.
#[derive(Debug, Default)]
pub(crate) struct PackedRuns {
    files: Vec<PathBuf>,
    places: HashMap<usize, Place>,
}

impl PackedRuns {
    /// Those in `folder`.
    pub(super) fn of(folder: &Path) -> Result<Self, OutputError> {
        let mut runs = Self { files: packed_files(folder)?, places: HashMap::new() };
        for (file, path) in runs.files.iter().enumerate() {
            scan(path, |number, offset, length| {
                // A record without content revokes those before it.
                match length {
                    0 => runs.places.remove(&number),
                    _ => runs.places.insert(number, Place { file, offset, length }),
                };
            })?;
        }
        Ok(runs)
    }

    /// Whether run `number` is among them.
    pub(crate) fn has(&self, number: usize) -> bool {
        self.places.contains_key(&number)
    }

    /// The files of run `number`.
    ///
    /// Errors: the record is damaged; the system refuses.
    pub(super) fn read(&self, number: usize) -> Result<Option<RunFiles>, OutputError> {
        let Some(place) = self.places.get(&number) else { return Ok(None) };
        let path = &self.files[place.file];
        let refused = || OutputError::io("read", path);
        let mut file = File::open(path).map_err(refused())?;
        file.seek(SeekFrom::Start(place.offset)).map_err(refused())?;
        let mut body = vec![0; place.length];
        file.read_exact(&mut body).map_err(refused())?;
        let damaged = |reason: String| OutputError::damaged(path, format!("run {number}: {reason}"));
        let plain =
            decompress_to_vec_with_limit(&body, MOST).map_err(|reason| damaged(reason.to_string()))?;
        postcard::from_bytes(&plain).map(Some).map_err(|reason| damaged(reason.to_string()))
    }
}

/// Passes number, offset and length of every complete record of the file `path` to `found`. Returns
/// the end of the last one.
fn scan(path: &Path, mut found: impl FnMut(usize, u64, usize)) -> Result<u64, OutputError> {
    let refused = || OutputError::io("read", path);
    let file = File::open(path).map_err(refused())?;
    let whole = file.metadata().map_err(refused())?.len();
    let mut reader = BufReader::with_capacity(1 << 18, file);
    let mut end = 0;
    let mut body = Vec::new();
    while end + HEADER as u64 <= whole {
        let mut header = [0; HEADER];
        reader.read_exact(&mut header).map_err(refused())?;
        let number =
            |at: usize| header[at..at + 8].iter().rev().fold(0u64, |sum, &byte| sum << 8 | u64::from(byte));
        let (run, length) = (number(0), number(8));
        let offset = end + HEADER as u64;
        if length > MOST as u64 || offset + length > whole {
            break;
        }
        body.resize(length as usize, 0);
        reader.read_exact(&mut body).map_err(refused())?;
        if header[16..] != checksum(&header[..16], &body).to_bytes() {
            break;
        }
        found(run as usize, offset, length as usize);
        end = offset + length;
    }
    Ok(end)
}

fn checksum(header: &[u8], body: &[u8]) -> Checksum {
    Checksum::of(header).with(body)
}

/// The file to which a process appends the runs that it has done. It belongs to that process alone.
#[derive(Debug)]
pub(super) struct PackWriter {
    path: PathBuf,
    file: File,
    synced: Instant,
}

impl PackWriter {
    /// The first file in `folder` that no other process has, behind its last whole record.
    pub(super) fn open(folder: &Path) -> Result<Self, OutputError> {
        let mut number = 1;
        loop {
            let path = folder.join(format!("{PREFIX}{number}{ENDING}"));
            if let Some(file) = own(&path)? {
                return Self::at_end(path, file);
            }
            number += 1;
        }
    }

    fn at_end(path: PathBuf, mut file: File) -> Result<Self, OutputError> {
        let end = scan(&path, |_, _, _| {})?;
        let refused = || OutputError::io("write", &path);
        file.set_len(end).map_err(refused())?;
        file.seek(SeekFrom::Start(end)).map_err(refused())?;
        Ok(Self { path, file, synced: Instant::now() })
    }

    /// Appends the files of run `number`; without any, revokes what was appended of it before.
    pub(super) fn append(&mut self, number: usize, files: Option<&RunFiles>) -> Result<(), OutputError> {
        let body = match files {
            Some(files) => {
                let plain = postcard::to_stdvec(files);
                let plain = plain.map_err(|reason| OutputError::damaged(&self.path, reason.to_string()))?;
                compress_to_vec(&plain, LEVEL)
            }
            None => Vec::new(),
        };
        let mut record = Vec::with_capacity(HEADER + body.len());
        record.extend_from_slice(&(number as u64).to_le_bytes());
        record.extend_from_slice(&(body.len() as u64).to_le_bytes());
        let sum = checksum(&record, &body);
        record.extend_from_slice(&sum.to_bytes());
        record.extend_from_slice(&body);
        let refused = || OutputError::io("write", &self.path);
        self.file.write_all(&record).map_err(refused())?;
        if self.synced.elapsed() >= SYNC_INTERVAL {
            self.file.sync_data().map_err(refused())?;
            self.synced = Instant::now();
        }
        Ok(())
    }
}

impl Drop for PackWriter {
    fn drop(&mut self) {
        // Best effort: what was written is there unless the power fails.
        let _ = self.file.sync_data();
    }
}

/// The file at `path`, made where it is not there; none where another process has it.
fn own(path: &Path) -> Result<Option<File>, OutputError> {
    let mut options = OpenOptions::new();
    let file = options.read(true).write(true).create(true).truncate(false).open(path);
    let file = file.map_err(OutputError::io("write", path))?;
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Ok(None),
        // A file system without locks: runs of two processes at once need folders of their own.
        Ok(()) | Err(TryLockError::Error(_)) => Ok(Some(file)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn files(text: &str) -> RunFiles {
        [("growth.csv".to_owned(), text.repeat(100))].into()
    }

    #[test]
    fn what_is_appended_is_read_and_what_a_kill_cuts_is_not_there() {
        let folder = std::env::temp_dir().join(format!("railcrack-packed-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).unwrap();
        let mut one = PackWriter::open(&folder).unwrap();
        let mut other = PackWriter::open(&folder).unwrap();
        assert_ne!(one.path, other.path, "a file belongs to one process");
        one.append(1, Some(&files("a"))).unwrap();
        other.append(2, Some(&files("b"))).unwrap();
        one.append(3, Some(&files("c"))).unwrap();
        let path = one.path.clone();
        drop((one, other));
        let whole = std::fs::read(&path).unwrap();
        for cut in [whole.len() - 1, whole.len() - 30, HEADER + 3, 5, 0] {
            std::fs::write(&path, &whole[..cut]).unwrap();
            let runs = PackedRuns::of(&folder).unwrap();
            assert_eq!((runs.has(1), runs.has(2), runs.has(3)), (cut > HEADER + 30, true, false), "{cut}");
            // The next process goes on behind the last whole record.
            PackWriter::open(&folder).unwrap().append(3, Some(&files("d"))).unwrap();
            let runs = PackedRuns::of(&folder).unwrap();
            assert_eq!(runs.read(3).unwrap().unwrap(), files("d"));
        }
        for at in 0..whole.len() {
            let mut turned = whole.clone();
            turned[at] ^= 4;
            std::fs::write(&path, &turned).unwrap();
            let runs = PackedRuns::of(&folder).unwrap();
            let right = |number: usize, text: &str| {
                !runs.has(number) || runs.read(number).unwrap().unwrap() == files(text)
            };
            assert!(right(1, "a") && right(3, "c"), "byte {at}");
        }
        std::fs::write(&path, &whole).unwrap();
        PackWriter::open(&folder).unwrap().append(1, None).unwrap();
        assert!(!PackedRuns::of(&folder).unwrap().has(1));
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
