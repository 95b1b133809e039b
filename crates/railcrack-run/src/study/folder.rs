//! The folder of a study: entered by one process or by several at once.

use super::csv_text::stabilised;
use super::packed::{PackWriter, PackedRuns, packed_files};
use super::plan::{PlannedRun, StudyPlan};
use crate::csv::{SifRow, Table};
use crate::disk::files::{
    CASE_FILE, CHECKPOINT_FILE, OUTCOME_FILE, PLAN_FILE, REPORT_FILE, RUN_FILES, RUN_LOG_FILE, SUMMARY_FILE,
};
use crate::disk::{
    FolderLock, LOCK_FILE, check_stored_name, json_text, read_if_there, read_json, read_json_if_there, remove,
};
use crate::error::OutputError;
use crate::run_folder::{
    CaseFiles, RunFiles, RunFolder, check_case, clear_run, run_file_in, run_file_in_study,
};
use crate::summary::{Outcome, RunEnd, Summary};
use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{SystemTime, UNIX_EPOCH};

const STUDY_FILE: &str = "study.toml";
const RUNS_FOLDER: &str = "runs";

/// How a process enters the folder of a study.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Entry {
    /// It begins the study.
    Begin,
    /// It starts its part of a study that others may have started.
    Join,
    /// It resumes a study.
    Resume,
    /// It resumes its part of a study, or starts it.
    ResumePart,
    /// It replaces a study.
    Replace,
    /// It replaces its part of a study.
    ReplacePart,
}

/// The folder of a study. Each run folder in it belongs to one process at a time; common files are
/// written as a whole, and identically by every process.
#[derive(Debug, Clone)]
pub struct StudyFolder {
    path: PathBuf,
    plan: StudyPlan,
    /// The file to which finished runs are appended, once there is one.
    pack: Arc<Mutex<Option<PackWriter>>>,
}

impl StudyFolder {
    /// Enters `path`, which is created where it does not exist, with the study `plan` from the file
    /// with `text`, to compute the runs with the numbers `own`; `cases` are those of all runs.
    ///
    /// Errors: the folder holds another study, a single run, or runs of this one that `entry` does
    /// not allow to touch; one of the runs to go on with computes another case; the system refuses.
    pub fn enter(
        path: &Path,
        plan: StudyPlan,
        text: &str,
        entry: Entry,
        own: &[usize],
        cases: &[CaseFiles],
    ) -> Result<Self, OutputError> {
        let folder = Self { path: path.to_path_buf(), plan, pack: Arc::default() };
        let stored = stored_plan(path)?;
        folder.may_enter(stored.as_ref(), entry)?;
        let numbers: HashSet<usize> = own.iter().copied().collect();
        let own = || folder.plan.runs.iter().filter(|run| numbers.contains(&run.number));
        let packed = if entry == Entry::Replace { PackedRuns::default() } else { folder.packed()? };
        for run in own().filter(|run| packed.has(run.number)) {
            if matches!(entry, Entry::Begin | Entry::Join) {
                return Err(folder.holds_study(format!("run {}, packed", run.number)));
            }
        }
        for run in own().filter(|run| !packed.has(run.number)) {
            let of_run = folder.run_folder(run);
            match entry {
                Entry::Begin | Entry::Join => {
                    if let Some(file) = run_file_in(&of_run) {
                        return Err(folder.holds_study(format!("{RUNS_FOLDER}/{}/{file}", run.folder)));
                    }
                }
                Entry::Resume | Entry::ResumePart => {
                    if let Some(case) = cases.get(run.number - 1) {
                        check_case(&of_run, case)?;
                    }
                }
                Entry::Replace | Entry::ReplacePart => {}
            }
        }
        std::fs::create_dir_all(path).map_err(OutputError::io("create the folder of the study", path))?;
        let replaced: Vec<PathBuf> = match entry {
            // A study with other runs leaves none of its own behind.
            Entry::Replace => {
                stored.iter().flat_map(|plan| &plan.runs).map(|run| folder.run_folder(run)).collect()
            }
            Entry::ReplacePart => own().map(|run| folder.run_folder(run)).collect(),
            _ => Vec::new(),
        };
        // Before anything is removed.
        for run in replaced.iter().filter(|run| run.join(LOCK_FILE).exists()) {
            drop(FolderLock::take(run)?);
        }
        replaced.iter().try_for_each(|run| clear_run(run))?;
        match entry {
            Entry::Replace => packed_files(path)?.iter().try_for_each(|file| remove(file))?,
            Entry::ReplacePart => {
                for run in own().filter(|run| packed.has(run.number)) {
                    folder.append(run.number, None)?;
                }
            }
            _ => {}
        }
        folder.put(STUDY_FILE, text.as_bytes())?;
        let text = json_text(&path.join(PLAN_FILE), &folder.plan)?;
        folder.put(PLAN_FILE, text.as_bytes())?;
        Ok(folder)
    }

    fn may_enter(&self, stored: Option<&StudyPlan>, entry: Entry) -> Result<(), OutputError> {
        let of_run = if stored.is_some() { run_file_in_study(&self.path) } else { run_file_in(&self.path) };
        if let (Some(file), false) = (of_run, entry == Entry::Replace) {
            return Err(OutputError::HoldsRun { folder: self.path.clone(), file });
        }
        if let (Some(stored), false) = (stored, matches!(entry, Entry::Replace | Entry::Begin))
            && stored.version != self.plan.version
        {
            let (written_by, this) = (stored.version.clone(), self.plan.version.clone());
            return Err(OutputError::OtherVersion { folder: self.path.clone(), written_by, this });
        }
        match (stored, entry) {
            (Some(_), Entry::Begin) => Err(self.holds_study(PLAN_FILE.into())),
            (Some(stored), _) if entry != Entry::Replace && !stored.computes_what(&self.plan) => {
                Err(OutputError::StudyChanged {
                    folder: self.path.clone(),
                    difference: stored.first_difference(&self.plan),
                })
            }
            (None, Entry::Resume) if !self.path.join(RUNS_FOLDER).is_dir() => {
                Err(OutputError::NoStudy { folder: self.path.clone() })
            }
            _ => Ok(()),
        }
    }

    fn holds_study(&self, file: String) -> OutputError {
        OutputError::HoldsStudy { folder: self.path.clone(), file }
    }

    /// The study in `path`, to read.
    ///
    /// Errors: no study in the folder; its plan is damaged; the system refuses.
    pub fn open(path: &Path) -> Result<Self, OutputError> {
        let plan = stored_plan(path)?.ok_or_else(|| OutputError::NoStudy { folder: path.to_path_buf() })?;
        Ok(Self { path: path.to_path_buf(), plan, pack: Arc::default() })
    }

    /// The text of the study file.
    pub fn study_text(&self) -> Result<String, OutputError> {
        let text = read_if_there(&self.path.join(STUDY_FILE))?.unwrap_or_default();
        Ok(String::from_utf8_lossy(&text).into_owned())
    }

    /// The folder itself.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The computed runs.
    pub fn plan(&self) -> &StudyPlan {
        &self.plan
    }

    /// The run folder of `run`.
    pub fn run_folder(&self, run: &PlannedRun) -> PathBuf {
        self.path.join(RUNS_FOLDER).join(&run.folder)
    }

    /// The results of `run`, packed or in a folder.
    ///
    /// Errors: it has none yet; a file of it is damaged; the system refuses.
    pub fn run(&self, run: &PlannedRun) -> Result<RunFolder, OutputError> {
        self.run_in(run, &self.packed()?)
    }

    /// The same, where `packed` are the packed runs.
    pub(super) fn run_in(&self, run: &PlannedRun, packed: &PackedRuns) -> Result<RunFolder, OutputError> {
        let folder = self.run_folder(run);
        match packed.read(run.number)? {
            Some(files) => RunFolder::of_packed(&folder, files),
            None => RunFolder::open(&folder),
        }
    }

    /// The packed runs as they are now.
    pub(crate) fn packed(&self) -> Result<PackedRuns, OutputError> {
        PackedRuns::of(&self.path)
    }

    /// The folder of `run`, made of what is packed of it where it has none.
    ///
    /// Errors: the run is not there; the system refuses.
    pub fn unpacked(&self, run: &PlannedRun) -> Result<PathBuf, OutputError> {
        let folder = self.run_folder(run);
        let Some(files) = self.packed()?.read(run.number)? else { return Ok(folder) };
        for (name, text) in &files {
            if !RUN_FILES.contains(&name.as_str()) {
                check_stored_name(&self.path, name)?;
            }
            self.put(&format!("{RUNS_FOLDER}/{}/{name}", run.folder), text.as_bytes())?;
        }
        Ok(folder)
    }

    fn append(&self, number: usize, files: Option<&RunFiles>) -> Result<(), OutputError> {
        let mut pack = self.pack.lock().unwrap_or_else(PoisonError::into_inner);
        if pack.is_none() {
            *pack = Some(PackWriter::open(&self.path)?);
        }
        match pack.as_mut() {
            Some(pack) => pack.append(number, files),
            None => Ok(()),
        }
    }

    /// Packs `run`, which is done, and removes its folder.
    fn pack(&self, run: &PlannedRun, outcome: &Outcome) -> Result<(), OutputError> {
        let folder = self.run_folder(run);
        let mut files = RunFiles::new();
        let kept = RUN_FILES.into_iter().filter(|file| file.ends_with(".csv") || file.ends_with(".vtu"));
        for file in std::iter::once(CASE_FILE).chain(kept) {
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
        let folder = self.run_folder(run);
        let has = |file: &str| folder.join(file).is_file();
        if folder.is_dir() && (has(CHECKPOINT_FILE) || has(RUN_LOG_FILE) || !has(REPORT_FILE)) {
            clear_run(&folder)?;
            // One without any file of a run is removed, too; the user's files stay.
            let _ = std::fs::remove_dir(&folder);
        }
        Ok(())
    }

    /// How `run` ended; none while it is not over.
    pub fn outcome(&self, run: &PlannedRun) -> Result<Option<Outcome>, OutputError> {
        Outcome::read(&self.run_folder(run))
    }

    /// Records how `run` ended, once all its other files are written.
    pub fn settle(&self, run: &PlannedRun, outcome: &Outcome) -> Result<(), OutputError> {
        let folder = self.run_folder(run);
        if !self.plan.run_folders && outcome.end == RunEnd::Done {
            return self.pack(run, outcome);
        }
        std::fs::create_dir_all(&folder).map_err(OutputError::io("create the run folder", &folder))?;
        outcome.write(&folder)
    }

    /// Removes what remains of a finished run after a kill.
    pub fn tidy(&self, run: &PlannedRun) -> Result<(), OutputError> {
        Outcome::tidy(&self.run_folder(run))
    }

    /// Removes the record of how `run` ended, before it continues.
    pub fn reopen(&self, run: &PlannedRun) -> Result<(), OutputError> {
        remove(&self.run_folder(run).join(OUTCOME_FILE))
    }

    /// Writes `content` to a file that several processes may write at once: readers see the file of
    /// one of them, whole.
    pub fn put(&self, file: &str, content: &[u8]) -> Result<(), OutputError> {
        let path = self.path.join(file);
        if read_if_there(&path)?.as_deref() == Some(content) {
            return Ok(());
        }
        let refused = || OutputError::io("write", &path);
        if let Some(parent) = path.parent() {
            std::fs::create_dir_all(parent).map_err(refused())?;
        }
        let now = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_nanos());
        // No other process, on no other machine, writes under this name.
        let own = self.path.join(format!("{file}.{}-{now}.partial", std::process::id()));
        let written = std::fs::write(&own, content).and_then(|()| std::fs::rename(&own, &path));
        written.map_err(|reason| {
            // Best effort: the error of the write is the one to report.
            let _ = std::fs::remove_file(&own);
            refused()(reason)
        })
    }

    /// Removes the folder of the runs where all are packed and none is in it.
    pub(crate) fn close_runs(&self) {
        let _ = std::fs::remove_dir(self.path.join(RUNS_FOLDER));
    }

    /// Removes a file of the study that it no longer has.
    pub fn take_away(&self, file: &str) -> Result<(), OutputError> {
        remove(&self.path.join(file))
    }
}

/// The plan of the study in `folder`, whose run folders all lie in it; none where it holds no
/// study.
fn stored_plan(folder: &Path) -> Result<Option<StudyPlan>, OutputError> {
    let plan = read_json_if_there::<StudyPlan>(folder, PLAN_FILE)?;
    for run in plan.iter().flat_map(|plan| &plan.runs) {
        check_stored_name(&folder.join(PLAN_FILE), &run.folder)?;
    }
    Ok(plan)
}

impl StudyPlan {
    /// Whether `other` has the same runs. Version, title and colours are not compared.
    fn computes_what(&self, other: &Self) -> bool {
        (&self.axes, &self.runs, &self.options) == (&other.axes, &other.runs, &other.options)
    }

    /// The first thing in which `other` differs, in words.
    fn first_difference(&self, other: &Self) -> String {
        let said = |options: &[String]| match options {
            [] => "no options".to_owned(),
            options => options.join(" "),
        };
        if self.options != other.options {
            return format!("it was started with {}, now {}", said(&self.options), said(&other.options));
        }
        let keys = |plan: &Self| -> Vec<(String, Vec<String>)> {
            let all = plan.axes.iter().flat_map(|axis| &axis.keys);
            all.map(|key| (key.key.clone(), key.values.clone())).collect()
        };
        for pair in keys(self).iter().zip(&keys(other)) {
            let ((before, values), (now, values_now)) = pair;
            if before != now || values != values_now {
                return format!(
                    "{before} = [{}] there, {now} = [{}] now",
                    values.join(", "),
                    values_now.join(", ")
                );
            }
        }
        format!("{} runs there, {} now", self.runs.len(), other.runs.len())
    }
}
