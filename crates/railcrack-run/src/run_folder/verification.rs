//! Verification of one folder of results: whether its files hold what was written to them.

use super::case_files::{CaseFiles, case_checksums};
use super::checkpoint::{Checkpoint, LogFile};
use super::clear::is_file_of_run;
use crate::csv::{ContactRow, FaceRow, ResidualRow, Table, check_sealed};
use crate::disk::files::{
    CASE_FILE, FIELDS_FILE, FIELDS_FOLDER, OUTCOME_FILE, ROLLED_FOLDER, SHAKEDOWN_FILE, SUMMARY_FILE,
    SUMS_FILE, WHEEL_GROUPS_FILE, run_files,
};
use crate::disk::{Seal, check_stored_name, is_signed, read_file, read_if_there, read_sums, sums_text};
use crate::error::OutputError;
use crate::fields::collection;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

/// Verdict on the files of a folder.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Verification {
    /// Files that were compared with their checksums.
    pub files: usize,
    /// The damaged files, a line for each.
    pub damages: Vec<String>,
    /// Files that could not be verified, and why.
    pub notes: Vec<String>,
}

/// Whether the numbers of the run in `folder` that a study shows are what was written. A run whose
/// files have no checksums is taken as it is.
///
/// Errors: they are not; the system refuses.
pub(crate) fn check_numbers(folder: &Path) -> Result<(), OutputError> {
    let mut found = Verification::default();
    found.run(folder, Extent::Numbers)?;
    match found.damages.is_empty() {
        true => Ok(()),
        false => Err(OutputError::damaged(folder, format!("damaged ({})", found.damages.join("; ")))),
    }
}

/// Selection of the files of a run to be verified.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Extent {
    All,
    /// All but faces and fields, which may be large and contribute no numbers to a study.
    Numbers,
}

impl Verification {
    /// Records the result for a file.
    pub(crate) fn answer(&mut self, answer: Result<(), OutputError>) -> Result<(), OutputError> {
        self.files += 1;
        match answer {
            Ok(()) => {}
            Err(OutputError::Damaged { path, reason }) => {
                self.damages.push(format!("{}: {reason}", path.display()));
            }
            Err(OutputError::Io { path, reason, .. }) if reason.kind() == std::io::ErrorKind::NotFound => {
                self.damages.push(format!("{}: is not there", path.display()));
            }
            Err(error @ OutputError::OtherVersion { .. }) => {
                self.files -= 1;
                self.notes.push(error.to_string());
            }
            Err(other) => return Err(other),
        }
        Ok(())
    }

    /// A document and the files whose checksums it has.
    pub(crate) fn documented(&mut self, folder: &Path, file: &str) -> Result<(), OutputError> {
        let Some(document) = self.document(folder, file)? else { return Ok(()) };
        for (name, sum) in document.get("checksums").and_then(Value::as_object).into_iter().flatten() {
            let path = folder.join(name);
            check_stored_name(&folder.join(file), name)?;
            let whole = |seal: Seal| sum.as_str() == Some(&seal.checksum.to_string());
            self.answer(Seal::of_file(&path).and_then(|seal| sealed(&path, whole(seal))))?;
        }
        self.sums(folder, &stored_sums(&document))
    }

    /// The file of the checksums `sums`, and files beside these that it lists.
    fn sums(&mut self, folder: &Path, sums: &BTreeMap<String, String>) -> Result<(), OutputError> {
        let path = folder.join(SUMS_FILE);
        if !path.is_file() {
            return Ok(());
        }
        let mut beside = read_sums(&path)?;
        beside.retain(|name, _| !sums.contains_key(name) && !is_file_of_run(name));
        let all = sums.iter().chain(&beside).map(|(name, sum)| (name.clone(), sum.clone())).collect();
        self.answer(same_bytes(&path, sums_text(&all).as_bytes()))?;
        self.all_of(folder, &beside)
    }

    /// The files in `folder` that its file of checksums lists.
    pub(crate) fn listed(&mut self, folder: &Path) -> Result<(), OutputError> {
        let path = folder.join(SUMS_FILE);
        let sums = read_sums(&path)?;
        self.answer(same_bytes(&path, sums_text(&sums).as_bytes()))?;
        self.all_of(folder, &sums)
    }

    /// The files in `folder` with the checksums `sums`.
    fn all_of(&mut self, folder: &Path, sums: &BTreeMap<String, String>) -> Result<(), OutputError> {
        for (name, sum) in sums {
            let path = folder.join(name);
            let whole = |seal: Seal| *sum == seal.checksum.to_string();
            self.answer(Seal::of_file(&path).and_then(|seal| sealed(&path, whole(seal))))?;
        }
        Ok(())
    }

    /// A JSON document with a checksum of its own; none where it cannot be read.
    pub(crate) fn document(&mut self, folder: &Path, file: &str) -> Result<Option<Value>, OutputError> {
        let path = folder.join(file);
        let text = read_file(&path)?;
        let document: Value = match serde_json::from_slice(&text) {
            Ok(document) => document,
            Err(reason) => {
                self.answer(Err(OutputError::damaged(&path, reason.to_string())))?;
                return Ok(None);
            }
        };
        match is_signed(&document) {
            Some(good) => self.answer(sealed(&path, good))?,
            None => {
                let says = "has no SHA-256 checksum (an older version wrote it)";
                self.notes.push(format!("{}: {says}", path.display()));
                return Ok(None);
            }
        }
        Ok(Some(document))
    }

    pub(crate) fn run(&mut self, folder: &Path, extent: Extent) -> Result<(), OutputError> {
        for file in [SUMMARY_FILE, OUTCOME_FILE] {
            if folder.join(file).is_file() {
                self.document(folder, file)?;
            }
        }
        if extent == Extent::All && folder.join(ROLLED_FOLDER).join(SHAKEDOWN_FILE).is_file() {
            self.documented(&folder.join(ROLLED_FOLDER), SHAKEDOWN_FILE)?;
        }
        if self.is_closed(folder)? {
            return self.closed(folder, extent);
        }
        let checkpoint = match Checkpoint::read(folder) {
            Ok(Some(checkpoint)) => checkpoint,
            Ok(None) => {
                self.notes.push(format!("{}: has no checkpoint: no step was finished", folder.display()));
                return Ok(());
            }
            Err(error) => return self.answer(Err(error)),
        };
        self.answer(Ok(()))?;
        for (file, seal) in checkpoint.seals.tables() {
            if extent == Extent::All || ![FaceRow::FILE, ContactRow::FILE].contains(&file) {
                let path = folder.join(file);
                let ended = checkpoint.state.ended.is_some();
                self.answer(check_sealed(&path, seal).and_then(|length| {
                    // Behind it, a run that goes on has rows of a step that did not finish.
                    if ended && length > seal.length {
                        return Err(OutputError::damaged(&path, "has rows after those of the run"));
                    }
                    Ok(())
                }))?;
            }
        }
        let (case, log) = match LogFile::read(folder, &checkpoint) {
            Ok(read) => read,
            Err(error) => return self.answer(Err(error)),
        };
        self.answer(Ok(()))?;
        self.case(folder, &case)?;
        if let Some(seal) = log.now.residual_table {
            self.whole(&folder.join(ResidualRow::FILE), seal)?;
        }
        if extent == Extent::All {
            for field in log.fields() {
                self.whole(&folder.join(&field.name), field.seal)?;
            }
            let list = folder.join(FIELDS_FILE);
            // A run that was killed may have listed fields of a step that did not finish.
            if checkpoint.state.ended.is_some() && log.fields().next().is_some() {
                let text = collection(&list, log.fields())?;
                self.answer(same_bytes(&list, text.as_bytes()))?;
            }
            let mut sums = case_checksums(folder)?;
            sums.extend(checkpoint.seals.checksums(&log));
            self.sums(folder, &sums)?;
        }
        Ok(())
    }

    /// Whether the run in `folder` is one of a study that is done, whose summary stands for all.
    fn is_closed(&self, folder: &Path) -> Result<bool, OutputError> {
        let Some(text) = read_if_there(&folder.join(SUMMARY_FILE))? else { return Ok(false) };
        let summary: Option<Value> = serde_json::from_slice(&text).ok();
        Ok(summary.is_some_and(|summary| summary.get("outcome").is_some_and(Value::is_object)))
    }

    /// The files of which the summary has the checksums.
    fn closed(&mut self, folder: &Path, extent: Extent) -> Result<(), OutputError> {
        let path = folder.join(SUMMARY_FILE);
        let text = read_file(&path)?;
        let summary: Value = serde_json::from_slice(&text)
            .map_err(|reason| OutputError::damaged(&path, reason.to_string()))?;
        if is_signed(&summary).is_none() {
            // Of an older version, as noted above: there is nothing to compare with.
            return Ok(());
        }
        for (name, sum) in summary.get("checksums").and_then(Value::as_object).into_iter().flatten() {
            let is_large =
                [FaceRow::FILE, ContactRow::FILE].contains(&name.as_str()) || name.starts_with(FIELDS_FOLDER);
            if extent == Extent::All || !is_large {
                let file = folder.join(name);
                if !run_files().any(|file| file == name) {
                    let field = name.strip_prefix(FIELDS_FOLDER).and_then(|name| name.strip_prefix('/'));
                    check_stored_name(&path, field.unwrap_or(name))?;
                }
                let whole = |seal: Seal| sum.as_str() == Some(&seal.checksum.to_string());
                self.answer(Seal::of_file(&file).and_then(|seal| sealed(&file, whole(seal))))?;
            }
        }
        if extent == Extent::All {
            self.sums(folder, &stored_sums(&summary))?;
        }
        Ok(())
    }

    /// The case, which the run log has whole.
    fn case(&mut self, folder: &Path, case: &CaseFiles) -> Result<(), OutputError> {
        self.answer(same_bytes(&folder.join(CASE_FILE), case.toml.as_bytes()))?;
        for (name, text) in &case.companions {
            self.answer(same_bytes(&folder.join(name), text.as_bytes()))?;
        }
        match &case.wheel_groups {
            Some(groups) => self.answer(same_bytes(&folder.join(WHEEL_GROUPS_FILE), groups.as_bytes())),
            None => Ok(()),
        }
    }

    fn whole(&mut self, path: &Path, seal: Seal) -> Result<(), OutputError> {
        self.answer(Seal::of_file(path).and_then(|found| sealed(path, found == seal)))
    }
}

/// The checksums by file that a document has.
fn stored_sums(document: &Value) -> BTreeMap<String, String> {
    let all = document.get("checksums").and_then(Value::as_object).into_iter().flatten();
    all.filter_map(|(name, sum)| Some((name.clone(), sum.as_str()?.to_owned()))).collect()
}

fn sealed(path: &Path, good: bool) -> Result<(), OutputError> {
    if good { Ok(()) } else { Err(OutputError::damaged(path, "does not hold what was written (checksum)")) }
}

pub(crate) fn same_bytes(path: &Path, expected: &[u8]) -> Result<(), OutputError> {
    match read_if_there(path)? {
        Some(found) => sealed(path, found == expected),
        None => Err(OutputError::damaged(path, "is not there")),
    }
}
