//! The folder of a command whose results are whole or unfinished, never continued: grinding plans,
//! a plastic state, a comparison, a calibration, contact patches, a validation. From the first
//! change to the last one it holds [`UNFINISHED_FILE`]; the next command takes such a folder for
//! one without results.

use super::begin::{Existing, refuse_file_in_place_of, refuse_results_of_run};
use super::clear::{clear_results, clear_rolled, is_unfinished};
use crate::disk::files::{
    CASE_FILE, CHECKPOINT_FILE, COMPARE_FILE, PLAN_FILE, PLANS_FILE, RUN_LOG_FILE, SHAKEDOWN_FILE,
    SUMMARY_FILE, SUMS_FILE, UNFINISHED_FILE,
};
use crate::disk::{
    Checksum, Durability, FolderLock, inner_folder, own_folder, partial_of, put_in_place, read_sums, remove,
    replace_file, stage_file, sums_text, write_sums,
};
use crate::error::OutputError;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The files of a command in its folder.
#[derive(Debug)]
pub struct ResultKind {
    /// Files in the folder itself.
    pub files: &'static [&'static str],
    /// Folders in it, and whether a name in one of them is that of a file of the command.
    pub folders: &'static [OwnFolder],
    /// Whether the files of a run are among the results, too.
    pub run: WithRun,
}

/// A folder of a command, and whether a name in it is that of one of its files.
pub type OwnFolder = (&'static str, fn(&str) -> bool);

/// Whether the folder of a command is also that of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WithRun {
    /// The results share the folder of a run, or are some of a run's files.
    Yes,
    /// The folder of a run is that of something else.
    No,
}

/// Results that are files of a run: grinding plans, a plastic state.
pub static OF_A_RUN: ResultKind = ResultKind { files: &[], folders: &[], run: WithRun::Yes };

impl ResultKind {
    /// Whether `name`, with `/`, is that of a file of the command.
    #[must_use]
    pub fn owns(&self, name: &str) -> bool {
        let within = |(folder, is_ours): &(&str, fn(&str) -> bool)| {
            name.strip_prefix(folder).and_then(|rest| rest.strip_prefix('/')).is_some_and(is_ours)
        };
        self.files.contains(&name) || self.folders.iter().any(within)
    }

    /// The files of the command in `folder`, with those that were being written.
    fn there(&self, folder: &Path) -> Result<Vec<String>, OutputError> {
        let mut there: Vec<String> = self.files.iter().map(|file| (*file).to_owned()).collect();
        for (inner, _) in self.folders {
            let Ok(entries) = fs::read_dir(own_folder(folder, inner)?) else { continue };
            let names = entries.flatten().filter_map(|entry| entry.file_name().into_string().ok());
            there.extend(names.map(|name| format!("{inner}/{}", name.trim_end_matches(".partial"))));
        }
        let is_there = |path: &Path| path.symlink_metadata().is_ok();
        there.retain(|name| {
            let path = folder.join(name);
            self.owns(name) && (is_there(&path) || is_there(&partial_of(&path)))
        });
        Ok(there)
    }
}

/// Files by which the folders of runs, studies and other commands are known.
const KNOWN_BY: [&str; 7] =
    [CHECKPOINT_FILE, RUN_LOG_FILE, SUMMARY_FILE, SHAKEDOWN_FILE, PLANS_FILE, PLAN_FILE, COMPARE_FILE];

/// A folder that a command has entered, with its lock.
#[derive(Debug)]
pub struct ResultFolder {
    path: PathBuf,
    kind: &'static ResultKind,
    existing: Existing,
    /// None once it is given back.
    lock: Option<FolderLock>,
    is_new: bool,
}

impl ResultFolder {
    /// Enters `path`, which is created where it does not exist, for results of `kind`. Nothing in
    /// it is changed.
    ///
    /// Errors: it holds results and `existing` says to leave these alone; it holds others; one of
    /// its folders is a link; another process has it; the system refuses to write.
    pub fn enter(path: &Path, kind: &'static ResultKind, existing: Existing) -> Result<Self, OutputError> {
        let is_new = !path.exists();
        refuse_file_in_place_of(path)?;
        fs::create_dir_all(path).map_err(OutputError::io("create the folder", path))?;
        let lock = Some(FolderLock::take(path)?);
        let existing = if is_unfinished(path) { Existing::Replace } else { existing };
        let entered = Self { path: path.to_path_buf(), kind, existing, lock, is_new };
        for (inner, _) in kind.folders {
            own_folder(path, inner)?;
        }
        entered.refuse_others()?;
        if existing == Existing::Refuse {
            entered.refuse_results()?;
        }
        Ok(entered)
    }

    /// Refuses a folder of a run or a study where the command does not write that of a run.
    fn refuse_others(&self) -> Result<(), OutputError> {
        if self.kind.run == WithRun::Yes {
            return Ok(());
        }
        let is_other = |file: &&&str| !self.kind.owns(file) && self.path.join(file).is_file();
        let other = KNOWN_BY.iter().find(is_other);
        match other {
            Some(file) => Err(OutputError::OtherResults { folder: self.path.clone(), file }),
            None => Ok(()),
        }
    }

    fn refuse_results(&self) -> Result<(), OutputError> {
        let sums = self.path.join(SUMS_FILE).exists().then(|| SUMS_FILE.to_owned());
        match (self.kind.there(&self.path)?.into_iter().next(), self.kind.run) {
            (Some(file), _) => Err(OutputError::HoldsResults { folder: self.path.clone(), file }),
            (None, WithRun::Yes) => refuse_results_of_run(&self.path),
            (None, WithRun::No) => match sums {
                Some(file) => Err(OutputError::HoldsResults { folder: self.path.clone(), file }),
                None => Ok(()),
            },
        }
    }

    /// The folder.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether results of before, or unfinished ones, are replaced.
    #[must_use]
    pub fn replaces(&self) -> bool {
        self.existing != Existing::Refuse
    }

    /// Checks that a further run of the command may be written to `folder`.
    ///
    /// Errors: it holds one, and nothing is to be replaced; the system refuses.
    pub fn refuse_run(&self, folder: &Path) -> Result<(), OutputError> {
        if self.replaces() { Ok(()) } else { refuse_results_of_run(folder) }
    }

    /// Marks the results as unfinished, before the first of them is changed.
    ///
    /// Errors: the system refuses.
    pub fn mark(&self) -> Result<(), OutputError> {
        self.mark_with(&BTreeMap::new())
    }

    /// The same, with the files that are about to be put in place and their checksums.
    fn mark_with(&self, files: &BTreeMap<String, String>) -> Result<(), OutputError> {
        replace_file(&self.path.join(UNFINISHED_FILE), sums_text(files).as_bytes(), Durability::Synced)
    }

    /// The results are whole.
    ///
    /// Errors: the system refuses.
    pub fn close(self) -> Result<(), OutputError> {
        remove(&self.path.join(UNFINISHED_FILE))
    }

    /// Ends with what the command `computed` and wrote: its results are whole, are removed after an
    /// interruption, or stay unfinished after an error.
    ///
    /// Errors: that of the command; the system refuses.
    pub fn end<T, E: From<OutputError>>(
        self,
        computed: Result<T, E>,
        is_interruption: impl Fn(&E) -> bool,
    ) -> Result<T, E> {
        match &computed {
            Ok(_) => self.close()?,
            Err(error) if is_interruption(error) => self.abandon()?,
            Err(_) => {}
        }
        computed
    }

    /// Removes what the command has written.
    ///
    /// Errors: the system refuses.
    pub fn abandon(self) -> Result<(), OutputError> {
        if !is_unfinished(&self.path) {
            return Ok(());
        }
        if self.kind.run == WithRun::Yes {
            clear_results(&self.path)?;
            clear_rolled(&self.path)?;
            remove(&self.path.join(CASE_FILE))?;
        }
        let files: Vec<String> = self.kind.files.iter().map(|file| (*file).to_owned()).collect();
        self.remove_files(&files)?;
        self.close()
    }

    /// Replaces the results by `files`, by their names with `/`, and writes their checksums. Until
    /// all of them are on the disk, those of before remain.
    ///
    /// Errors: a folder in the folder is a link; the system refuses: then nothing but unfinished
    /// files has been changed, unless it refuses to move these into place.
    pub fn write(self, files: &BTreeMap<String, String>) -> Result<(), OutputError> {
        for name in self.kind.there(&self.path)? {
            // What a kill has left.
            remove(&partial_of(&self.path.join(name)))?;
        }
        if let Err(error) = files.iter().try_for_each(|(name, text)| self.stage(name, text)) {
            for name in files.keys() {
                // Best effort: the first error is the one to report.
                let _ = remove(&partial_of(&self.path.join(name)));
            }
            return Err(error);
        }
        let sum = |text: &String| Checksum::of(text.as_bytes()).to_string();
        let own: BTreeMap<String, String> =
            files.iter().map(|(name, text)| (name.clone(), sum(text))).collect();
        let mut sums = read_sums(&self.path.join(SUMS_FILE))?;
        let before = [sums.clone(), read_sums(&self.path.join(UNFINISHED_FILE))?];
        let is_stale = |name: &&String| self.kind.owns(name) && !files.contains_key(*name);
        let stale: Vec<String> = before.iter().flat_map(BTreeMap::keys).filter(is_stale).cloned().collect();
        self.mark_with(&own)?;
        self.remove_files(&stale)?;
        files.keys().try_for_each(|name| put_in_place(&self.path.join(name)))?;
        // Those of a run share the folder.
        sums.retain(|name, _| self.kind.run == WithRun::Yes && !self.kind.owns(name));
        sums.extend(own);
        write_sums(&self.path, &sums)?;
        self.close()
    }

    fn stage(&self, name: &str, text: &str) -> Result<(), OutputError> {
        if let Some((inner, _)) = name.rsplit_once('/') {
            inner_folder(&self.path, inner)?;
        }
        stage_file(&self.path.join(name), text.as_bytes(), Durability::Cached)
    }

    /// Removes files of the command, those that were being written, and folders that are then
    /// empty.
    fn remove_files(&self, names: &[String]) -> Result<(), OutputError> {
        for name in names {
            let path = self.path.join(name);
            if let Some((inner, _)) = name.rsplit_once('/') {
                own_folder(&self.path, inner)?;
            }
            remove(&path)?;
            remove(&partial_of(&path))?;
        }
        for (inner, _) in self.kind.folders {
            // Refused if the folder contains files of the user or does not exist: both are fine.
            let _ = fs::remove_dir(own_folder(&self.path, inner)?);
        }
        Ok(())
    }
}

impl Drop for ResultFolder {
    fn drop(&mut self) {
        drop(self.lock.take());
        if self.is_new {
            // Refused where the folder has results.
            let _ = fs::remove_dir(&self.path);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::disk::faults::{FAULTS, Fault, during};

    static KIND: ResultKind =
        ResultKind { files: &["a.csv", "b.csv"], folders: &[("plots", is_plot)], run: WithRun::No };

    fn is_plot(name: &str) -> bool {
        name.starts_with("wheel-") && name.ends_with(".svg")
    }

    fn files(of: &[&str], text: &str) -> BTreeMap<String, String> {
        of.iter().map(|name| ((*name).to_owned(), text.to_owned())).collect()
    }

    fn names(folder: &Path) -> Vec<String> {
        let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
        let mut names = Vec::new();
        for entry in entries {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_str().unwrap().to_owned();
            match path.is_dir() {
                true => names.extend(self::names(&path).iter().map(|inner| format!("{name}/{inner}"))),
                false => names.push(name),
            }
        }
        names.sort();
        names
    }

    /// Whatever change meets a fault, the results are those of before, or new ones, or unfinished;
    /// repeated, they are the new ones alone, and the user's files remain.
    #[test]
    fn results_are_whole_or_unfinished_behind_every_fault() {
        let folder = std::env::temp_dir().join(format!("railcrack-results-{}", std::process::id()));
        let begin = |existing| ResultFolder::enter(&folder, &KIND, existing);
        let old = files(&["a.csv", "b.csv", "plots/wheel-1.svg"], "old");
        let new = files(&["a.csv", "plots/wheel-2.svg"], "new");
        let clean = || {
            let _ = fs::remove_dir_all(&folder);
            begin(Existing::Refuse).unwrap().write(&old).unwrap();
            fs::write(folder.join("plots/wheel-9.svg"), "mine").unwrap();
        };
        clean();
        assert!(matches!(begin(Existing::Refuse), Err(OutputError::HoldsResults { .. })));
        let before = names(&folder);
        let replace = || begin(Existing::Replace)?.write(&new);
        let changes = during(&folder, Fault::Killed, usize::MAX, || replace().unwrap());
        let after = names(&folder);
        assert_eq!(after, ["SHA256SUMS", "a.csv", "plots/wheel-2.svg", "plots/wheel-9.svg"]);
        assert!(changes > 8, "{changes}");
        for fault in FAULTS {
            for at in 0..changes {
                clean();
                during(&folder, fault, at, || drop(replace()));
                if !is_unfinished(&folder) {
                    let there: Vec<String> =
                        names(&folder).into_iter().filter(|name| !name.ends_with(".partial")).collect();
                    let text = fs::read(folder.join("a.csv")).unwrap();
                    let is_whole = (there == before && text == b"old") || (there == after && text == b"new");
                    assert!(is_whole, "{fault:?} at {at}: {there:?}");
                }
                replace().unwrap();
                assert_eq!(names(&folder), after, "{fault:?} at {at}");
                assert_eq!(read_sums(&folder.join(SUMS_FILE)).unwrap().len(), 2);
            }
        }
        fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_folder_without_results_is_left_as_it_was() {
        let folder = std::env::temp_dir().join(format!("railcrack-no-results-{}", std::process::id()));
        drop(ResultFolder::enter(&folder, &KIND, Existing::Refuse).unwrap());
        assert!(!folder.exists());
        let entered = ResultFolder::enter(&folder, &KIND, Existing::Refuse).unwrap();
        entered.mark().unwrap();
        entered.abandon().unwrap();
        assert!(!folder.exists());
    }
}
