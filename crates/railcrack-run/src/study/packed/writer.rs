//! The file to which a process appends the runs that it has done.

use super::record::{HEADER, Header, VOID, body_of};
use super::runs::{PackedRuns, damage_in_words, packed_file, packed_files};
use super::scan::{Damage, Scan};
use crate::disk::{Checksum, Sealing, changes};
use crate::error::OutputError;
use crate::run_folder::RunFiles;
use crate::study::plan::PlannedRun;
use std::collections::HashMap;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// How long records may wait for the disk: a kill loses none by that, a power failure those.
const SYNC_INTERVAL: Duration = Duration::from_secs(1);

/// The file to which a process appends the runs that it has done. It belongs to that process alone.
#[derive(Debug)]
pub(in crate::study) struct PackWriter {
    path: PathBuf,
    file: File,
    synced: Instant,
    /// The packed runs when it was opened.
    before: PackedRuns,
    /// Revocations since.
    revoked: HashMap<usize, u64>,
}

impl PackWriter {
    /// The first file in `folder` that no other process has, for runs of the study `planned`. What
    /// a kill has cut at its end is removed; everything else stays.
    pub(in crate::study) fn open(folder: &Path, planned: &[PlannedRun]) -> Result<Self, OutputError> {
        let before = PackedRuns::of(folder, planned)?;
        let mut number = 1;
        let (path, mut file) = loop {
            let path = packed_file(folder, number);
            if let Some(file) = own(&path)? {
                break (path, file);
            }
            number += 1;
        };
        let scan = Scan::of(&path)?;
        // Damaged bytes at the end get the length of a header at least, so that they can be marked.
        let scrap = scan.damages.last().filter(|damage| damage.to == scan.end);
        let end = scrap.map_or(scan.end, |scrap| scan.end.max(scrap.from + HEADER as u64));
        let refused = || OutputError::io("write", &path);
        file.set_len(end).map_err(refused())?;
        file.seek(SeekFrom::Start(end)).map_err(refused())?;
        Ok(Self { path, file, synced: Instant::now(), before, revoked: HashMap::new() })
    }

    /// Appends the files of run `number`, which computes the case with the checksum `case`; without
    /// any, revokes what was appended of it before, in whichever file.
    pub(in crate::study) fn append(
        &mut self,
        number: usize,
        case: Checksum,
        files: Option<&RunFiles>,
    ) -> Result<(), OutputError> {
        let body = body_of(&self.path, files)?;
        let mut generation =
            self.revoked.get(&number).copied().unwrap_or_else(|| self.before.generation(number));
        if files.is_none() {
            generation += 1;
            self.revoked.insert(number, generation);
        }
        let header = Header::new(number as u64, generation, case, &body);
        let mut record = Vec::with_capacity(HEADER + body.len());
        record.extend_from_slice(&header.to_bytes());
        record.extend_from_slice(&body);
        let refused = || OutputError::io("write", &self.path);
        self.file.write_all(&record).map_err(refused())?;
        if self.synced.elapsed() >= SYNC_INTERVAL {
            self.file.sync_data().map_err(refused())?;
            self.synced = Instant::now();
        }
        Ok(())
    }

    #[cfg(test)]
    pub(super) fn path(&self) -> &Path {
        &self.path
    }
}

impl Drop for PackWriter {
    fn drop(&mut self) {
        // Best effort: what was written is there unless the power fails.
        let _ = self.file.sync_data();
    }
}

/// The file at `path`, made where it is not there; none where another process has it, and where a
/// link leads to a file that may be anybody's.
fn own(path: &Path) -> Result<Option<File>, OutputError> {
    if path.symlink_metadata().is_ok_and(|there| !there.is_file()) {
        return Ok(None);
    }
    let mut options = OpenOptions::new();
    options.read(true).write(true).create(true).truncate(false);
    let file = changes::open(path, &mut options).map_err(OutputError::io("write", path))?;
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Ok(None),
        // A file system without locks: runs of two processes at once need folders of their own.
        Ok(()) | Err(TryLockError::Error(_)) => Ok(Some(file)),
    }
}

/// Marks the damaged bytes of every file in `folder` that no process has as void, so that they
/// count as missing from now on: the runs that they held are computed again. The records before and
/// behind them stay. What was marked, a sentence for each.
pub(in crate::study) fn void_damages(folder: &Path) -> Result<Vec<String>, OutputError> {
    let mut said = Vec::new();
    for path in packed_files(folder)? {
        if Scan::of(&path)?.damages.is_empty() {
            continue;
        }
        let Some(mut file) = own(&path)? else { continue };
        // Once more: the process that had it may have gone on.
        for damage in Scan::of(&path)?.damages {
            void(&mut file, &damage).map_err(OutputError::io("write", &path))?;
            said.push(format!("{}: {}", path.display(), damage_in_words(&damage)));
        }
        file.sync_data().map_err(OutputError::io("write", &path))?;
    }
    Ok(said)
}

/// Writes the header of a void record over the beginning of damaged bytes. Fewer bytes than a
/// header stay as they are: removed bytes leave such a scrap, changed ones never do.
fn void(file: &mut File, damage: &Damage) -> std::io::Result<()> {
    let Some(length) = (damage.to - damage.from).checked_sub(HEADER as u64) else {
        return match damage.to == file.metadata()?.len() {
            true => file.set_len(damage.from),
            false => Ok(()),
        };
    };
    file.seek(SeekFrom::Start(damage.from + HEADER as u64))?;
    let body = Sealing::read(&mut *file, length)?.seal().checksum;
    let header = Header { number: VOID, generation: 0, case: Checksum::NONE, length, body };
    file.seek(SeekFrom::Start(damage.from))?;
    file.write_all(&header.to_bytes())
}
