//! Packing of finished runs, and run folders made of packed ones.

use super::csv_text::stabilised;
use super::folder::StudyFolder;
use super::packed::{PackWriter, PackedRuns};
use super::plan::PlannedRun;
use crate::csv::{SifRow, Table};
use crate::disk::files::{
    CASE_FILE, CHECKPOINT_FILE, REPORT_FILE, RUN_LOG_FILE, RUNS_FOLDER, SUMMARY_FILE, WHEEL_GROUPS_FILE,
    input_files, run_files,
};
use crate::disk::{Checksum, check_stored_name, json_text, read_if_there, read_json};
use crate::error::OutputError;
use crate::run_folder::{CaseFiles, RunFiles, RunFolder, clear_run};
use crate::summary::{Outcome, Summary};
use std::path::PathBuf;
use std::sync::PoisonError;

impl StudyFolder {
    /// The folder of `run`, made of what is packed of it where it has none.
    ///
    /// Errors: the run is not there; the system refuses.
    pub fn unpacked(&self, run: &PlannedRun) -> Result<PathBuf, OutputError> {
        let folder = self.own_run_folder(run)?;
        let Some(files) = self.packed()?.read(run.number)? else { return Ok(folder) };
        for (name, text) in &files {
            if !run_files().any(|file| file == name) {
                check_stored_name(self.path(), name)?;
            }
            self.put(&format!("{RUNS_FOLDER}/{}/{name}", run.folder), text.as_bytes())?;
        }
        Ok(folder)
    }

    fn planned(&self, number: usize) -> Option<&PlannedRun> {
        self.plan().runs.iter().find(|run| run.number == number)
    }

    /// Checks the packed `run`: its files are read, and the case among them is its own.
    ///
    /// Errors: it is damaged; the system refuses.
    pub(crate) fn check_packed(&self, run: &PlannedRun, packed: &PackedRuns) -> Result<(), OutputError> {
        let Some(files) = packed.read(run.number)? else { return Ok(()) };
        let is_own =
            run.case.as_ref().is_none_or(|case| CaseFiles::packed(&files).checksum().to_string() == *case);
        let folder = self.run_folder(run);
        RunFolder::of_packed(&folder, files)?;
        match is_own {
            true => Ok(()),
            false => Err(OutputError::damaged(&folder, "is packed with another case than it says")),
        }
    }

    /// Appends the files of run `number` to the file of this process; without any, revokes what is
    /// packed of it.
    pub(super) fn append(&self, number: usize, files: Option<&RunFiles>) -> Result<(), OutputError> {
        let mut pack = self.pack.lock().unwrap_or_else(PoisonError::into_inner);
        if pack.is_none() {
            *pack = Some(PackWriter::open(self.path(), &self.plan().runs)?);
        }
        let case = match files {
            Some(files) => Some(CaseFiles::packed(files).checksum()),
            None => self.planned(number).and_then(|run| Checksum::of_text(run.case.as_deref()?)),
        };
        match pack.as_mut() {
            Some(pack) => pack.append(number, case.unwrap_or(Checksum::NONE), files),
            None => Ok(()),
        }
    }

    /// Packs `run`, which is done, and removes its folder.
    pub(super) fn pack(&self, run: &PlannedRun, outcome: &Outcome) -> Result<(), OutputError> {
        let folder = self.run_folder(run);
        let mut files = RunFiles::new();
        let tables = run_files().filter(|file| file.ends_with(".csv") && !file.contains('/'));
        for file in [CASE_FILE].into_iter().chain(tables).chain(input_files()).chain([WHEEL_GROUPS_FILE]) {
            let Some(bytes) = read_if_there(&folder.join(file))? else { continue };
            let text = String::from_utf8(bytes)
                .map_err(|_| OutputError::damaged(&folder.join(file), "is not UTF-8 text"))?;
            let text = if file == SifRow::FILE { stabilised(&text) } else { text };
            files.insert(file.to_owned(), text);
        }
        let mut summary: Summary = read_json(&folder, SUMMARY_FILE)?;
        summary.outcome = Some(outcome.clone());
        // Checksums of the folder, which is removed; the record has its own.
        summary.checksums.clear();
        files.insert(SUMMARY_FILE.to_owned(), json_text(&folder.join(SUMMARY_FILE), &summary)?);
        self.append(run.number, Some(&files))?;
        self.clear_packed(run)
    }

    /// Removes what is left of the folder of a packed run that was being computed, or whose removal
    /// was cut short: a folder that was made for its page has one.
    pub(crate) fn clear_packed(&self, run: &PlannedRun) -> Result<(), OutputError> {
        // What a link leads to is somebody else's.
        let Ok(folder) = self.own_run_folder(run) else { return Ok(()) };
        let has = |file: &str| folder.join(file).is_file();
        if folder.is_dir() && (has(CHECKPOINT_FILE) || has(RUN_LOG_FILE) || !has(REPORT_FILE)) {
            clear_run(&folder)?;
            // One without any file of a run is removed, too; the user's files stay.
            let _ = std::fs::remove_dir(&folder);
        }
        Ok(())
    }
}
