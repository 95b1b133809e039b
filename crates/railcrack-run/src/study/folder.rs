//! The folder of a study: entered by one process or by several at once.

use super::difference::{other_case, other_text};
use super::packed::{PackWriter, PackedRuns, packed_files, void_damages};
use super::plan::{PlannedRun, StudyPlan};
use crate::disk::files::{
    CASE_FILE, CHECKPOINT_FILE, OUTCOME_FILE, PLAN_FILE, PLOTS_FOLDER, REPORT_FILE, RUN_LOG_FILE,
    RUNS_FOLDER, STUDY_FILE, STUDY_PLOTS, STUDY_TABLES,
};
use crate::disk::{
    Checksum, FolderLock, LOCK_FILE, VERSION, check_stored_name, inner_folder, json_text, own_folder,
    partial_of, read_if_there, read_json_if_there, remove, replace_shared,
};
use crate::error::OutputError;
use crate::run_folder::{CaseFiles, RunFolder, check_case, clear_run, run_file_in, run_file_in_study};
use crate::summary::{Outcome, RunEnd};
use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

/// How a process enters the folder of a study.
#[derive(Debug, Clone)]
pub struct Entry {
    /// Numbers of the runs that it computes, where others may compute the rest; none where it
    /// computes the whole study.
    pub part: Option<HashSet<usize>>,
    /// The fate of runs that the folder holds already.
    pub existing: ExistingRuns,
}

/// The fate of those runs in the folder of a study that a process is to compute.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExistingRuns {
    /// They stay, and entering is an error.
    Refuse,
    /// They are resumed.
    Resume,
    /// They are removed.
    Replace,
}

impl Entry {
    fn replaces_study(&self) -> bool {
        self.part.is_none() && self.existing == ExistingRuns::Replace
    }
}

/// The folder of a study. Each run folder in it belongs to one process at a time; common files are
/// written as a whole, and identically by every process.
#[derive(Debug, Clone)]
pub struct StudyFolder {
    path: PathBuf,
    plan: StudyPlan,
    /// The file to which finished runs are appended, once there is one.
    pub(super) pack: Arc<Mutex<Option<PackWriter>>>,
    /// Damage found on entering, a sentence for each.
    damages: Vec<String>,
}

impl StudyFolder {
    /// Enters `path`, which is created where it does not exist, with the study `plan` from the file
    /// with `text`; `cases` are those of all runs.
    ///
    /// Errors: the folder holds another study, a single run, or runs of this one that `entry` does
    /// not allow to touch; one of the runs to go on with computes another case; the system refuses.
    pub fn enter(
        path: &Path,
        plan: StudyPlan,
        text: &str,
        entry: &Entry,
        cases: &[CaseFiles],
    ) -> Result<Self, OutputError> {
        let mut folder = Self { path: path.to_path_buf(), plan, pack: Arc::default(), damages: Vec::new() };
        for (run, case) in folder.plan.runs.iter_mut().zip(cases) {
            run.case = Some(case.checksum().to_string());
        }
        folder.plan.text = Some(Checksum::of(text.as_bytes()).to_string());
        // Before the plan is read: another process may be about to begin the same study, whose plan
        // comes first of all files.
        let in_the_way = folder.file_in_the_way(text)?;
        let stored = match stored_plan(path) {
            // A damaged plan is replaced with all the rest.
            Err(OutputError::Damaged { .. } | OutputError::OtherVersion { .. }) if entry.replaces_study() => {
                None
            }
            stored => stored?,
        };
        folder.may_enter(stored.as_ref(), entry)?;
        if let (None, Some(file)) = (&stored, in_the_way)
            && entry.existing != ExistingRuns::Replace
        {
            return Err(OutputError::InTheWay { folder: path.to_path_buf(), file });
        }
        let packed = if entry.replaces_study() { PackedRuns::default() } else { folder.packed()? };
        folder.may_compute(stored.as_ref(), &packed, entry, cases)?;
        if let Some(stored) = stored.as_ref().filter(|_| !entry.replaces_study())
            && let Some(run) = folder.plan.runs.iter().find(|run| !stored.has_case_of(run))
        {
            let difference = other_text(run.number, &folder.study_text()?, text);
            return Err(OutputError::StudyChanged { folder: path.to_path_buf(), difference });
        }
        std::fs::create_dir_all(path).map_err(OutputError::io("create the folder of the study", path))?;
        match entry.existing {
            ExistingRuns::Refuse => {}
            ExistingRuns::Resume => folder.damages = void_damages(path)?,
            ExistingRuns::Replace => folder.clear(stored.as_ref(), &packed, entry)?,
        }
        let plan = json_text(&path.join(PLAN_FILE), &folder.plan)?;
        folder.put(PLAN_FILE, plan.as_bytes())?;
        folder.put(STUDY_FILE, text.as_bytes())?;
        Ok(folder)
    }

    /// The runs that `entry` is to compute.
    fn own<'a>(&'a self, entry: &'a Entry) -> impl Iterator<Item = &'a PlannedRun> {
        let is_own = |run: &&PlannedRun| entry.part.as_ref().is_none_or(|part| part.contains(&run.number));
        self.plan.runs.iter().filter(is_own)
    }

    /// Refuses runs, `packed` or in folders, that `entry` does not allow to touch, and runs to go
    /// on with that compute other `cases`.
    fn may_compute(
        &self,
        stored: Option<&StudyPlan>,
        packed: &PackedRuns,
        entry: &Entry,
        cases: &[CaseFiles],
    ) -> Result<(), OutputError> {
        if entry.existing == ExistingRuns::Replace {
            return Ok(());
        }
        for run in self.own(entry) {
            let (is_packed, of_run) = (packed.has(run.number), self.run_folder(run));
            let held = match is_packed {
                true => Some(format!("run {}, packed", run.number)),
                false => run_file_in(&of_run).map(|file| format!("{RUNS_FOLDER}/{}/{file}", run.folder)),
            };
            if let Some(held) = held.filter(|_| entry.existing == ExistingRuns::Refuse) {
                return Err(self.holds_study(held));
            }
            let Some(case) = cases.get(run.number - 1).filter(|_| !is_packed) else { continue };
            if let Some((file, files)) = packed.read_foreign(run.number)? {
                let is_this_study = stored.is_none_or(|stored| stored.has_case_of(run));
                return Err(other_case(file, run.number, &CaseFiles::packed(&files), case, is_this_study));
            }
            check_case(&of_run, case)?;
        }
        Ok(())
    }

    /// Removes the runs that `entry` replaces, `packed` or in folders; with the whole study those
    /// of the `stored` one.
    fn clear(
        &self,
        stored: Option<&StudyPlan>,
        packed: &PackedRuns,
        entry: &Entry,
    ) -> Result<(), OutputError> {
        // A study with other runs leaves none of its own behind.
        let stored = stored.filter(|_| entry.part.is_none()).into_iter().flat_map(|plan| &plan.runs);
        let replaced = stored.chain(self.own(entry)).map(|run| self.own_run_folder(run));
        let replaced = replaced.collect::<Result<Vec<PathBuf>, OutputError>>()?;
        // Before anything is removed.
        for run in replaced.iter().filter(|run| run.join(LOCK_FILE).exists()) {
            drop(FolderLock::take(run)?);
        }
        // Tables of runs that are about to go.
        STUDY_TABLES.iter().try_for_each(|file| self.take_away(file))?;
        replaced.iter().try_for_each(|run| clear_run(run))?;
        if entry.part.is_none() {
            return packed_files(&self.path)?.iter().try_for_each(|file| remove(file));
        }
        let mut packed = self.own(entry).filter(|run| packed.has(run.number));
        packed.try_for_each(|run| self.append(run.number, None))
    }

    /// A file in the folder that the study with this `text` would replace, where there is one.
    fn file_in_the_way(&self, text: &str) -> Result<Option<String>, OutputError> {
        let packed = packed_files(&self.path)?;
        let packed = packed.iter().filter_map(|path| path.file_name()?.to_str().map(str::to_owned));
        let plots = STUDY_PLOTS.iter().map(|plot| format!("{PLOTS_FOLDER}/{plot}"));
        let tables = STUDY_TABLES.iter().chain(&[STUDY_FILE]).map(|file| (*file).to_owned());
        let is_there = |file: &String| self.path.join(file).symlink_metadata().is_ok();
        // The study itself, in its own folder.
        let is_same = |file: &String| {
            file == STUDY_FILE
                && read_if_there(&self.path.join(file)).is_ok_and(|there| there == Some(text.into()))
        };
        Ok(tables.chain(plots).filter(is_there).chain(packed).find(|file| !is_same(file)))
    }

    /// Whether a study replaces or removes the file `name`, relative to its folder, with `/`. Its
    /// own text, which it replaces by the same, is not among them.
    #[must_use]
    pub fn owns(name: &str) -> bool {
        let within = |folder: &str| name.strip_prefix(folder).is_some_and(|rest| rest.starts_with('/'));
        STUDY_TABLES.contains(&name)
            || [PLAN_FILE, REPORT_FILE].contains(&name)
            || within(RUNS_FOLDER)
            || STUDY_PLOTS.iter().any(|plot| name == format!("{PLOTS_FOLDER}/{plot}"))
    }

    fn may_enter(&self, stored: Option<&StudyPlan>, entry: &Entry) -> Result<(), OutputError> {
        let folder = || self.path.clone();
        let of_run = if stored.is_some() { run_file_in_study(&self.path) } else { run_file_in(&self.path) };
        if let Some(file) = of_run.filter(|_| !entry.replaces_study()) {
            return Err(OutputError::HoldsRun { folder: folder(), file });
        }
        let goes_on = entry.part.is_some() || entry.existing == ExistingRuns::Resume;
        match stored {
            Some(stored) if goes_on && stored.version != self.plan.version => {
                let (written_by, this) = (stored.version.clone(), self.plan.version.clone());
                Err(OutputError::OtherVersion { folder: folder(), written_by, this })
            }
            Some(stored) if goes_on && !stored.computes_what(&self.plan) => {
                let difference = stored.first_difference(&self.plan);
                Err(OutputError::StudyChanged { folder: folder(), difference })
            }
            Some(_) if !goes_on && !entry.replaces_study() => Err(self.holds_study(PLAN_FILE.into())),
            None if goes_on && entry.part.is_none() && !self.path.join(RUNS_FOLDER).is_dir() => {
                Err(OutputError::NoStudy { folder: folder() })
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
        Ok(Self { path: path.to_path_buf(), plan, pack: Arc::default(), damages: Vec::new() })
    }

    /// Checks the text of the study.
    ///
    /// Errors: it is not what was written; the system refuses.
    pub(crate) fn check_text(&self) -> Result<(), OutputError> {
        let path = self.path.join(STUDY_FILE);
        let Some(text) = read_if_there(&path)? else {
            return Err(OutputError::damaged(&path, "is not there"));
        };
        let sum = Checksum::of(&text).to_string();
        match self.plan.text.as_ref().is_none_or(|stored| *stored == sum) {
            true => Ok(()),
            false => Err(OutputError::damaged(&path, "does not hold what was written (checksum)")),
        }
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

    /// Damage that was found on entering, a sentence for each: what was lost is computed again.
    pub fn damages(&self) -> &[String] {
        &self.damages
    }

    /// The computed runs.
    pub fn plan(&self) -> &StudyPlan {
        &self.plan
    }

    /// The run folder of `run`.
    pub fn run_folder(&self, run: &PlannedRun) -> PathBuf {
        self.path.join(RUNS_FOLDER).join(&run.folder)
    }

    /// The run folder of `run`, in which something is written or removed.
    ///
    /// Errors: it is a link, or no folder.
    pub(crate) fn own_run_folder(&self, run: &PlannedRun) -> Result<PathBuf, OutputError> {
        own_folder(&self.path, &format!("{RUNS_FOLDER}/{}", run.folder))
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
        PackedRuns::of(&self.path, &self.plan.runs)
    }

    /// Checks that the files of `run` in its folder are those of its case.
    ///
    /// Errors: they are those of another case; the system refuses.
    pub(crate) fn check_case_of(&self, run: &PlannedRun) -> Result<(), OutputError> {
        let folder = self.run_folder(run);
        let (Some(planned), Some(case)) = (&run.case, CaseFiles::stored(&folder)?) else { return Ok(()) };
        match case.checksum().to_string() == *planned {
            true => Ok(()),
            false => Err(OutputError::damaged(
                &folder.join(CASE_FILE),
                format!("is not the case of run {} of this study", run.number),
            )),
        }
    }

    /// How `run` ended; none while it is not over.
    pub fn outcome(&self, run: &PlannedRun) -> Result<Option<Outcome>, OutputError> {
        Outcome::read(&self.run_folder(run))
    }

    /// Records how `run` ended, once all its other files are written.
    pub fn settle(&self, run: &PlannedRun, outcome: &Outcome) -> Result<(), OutputError> {
        if !self.plan.run_folders && outcome.end == RunEnd::Done {
            return self.pack(run, outcome);
        }
        std::fs::create_dir_all(&self.path).map_err(OutputError::io("create", &self.path))?;
        outcome.write(&inner_folder(&self.path, &format!("{RUNS_FOLDER}/{}", run.folder))?)
    }

    /// Removes what remains of a finished run after a kill.
    pub fn tidy(&self, run: &PlannedRun) -> Result<(), OutputError> {
        let is_left = |file: &str| self.run_folder(run).join(file).exists();
        if !(is_left(CHECKPOINT_FILE) || is_left(RUN_LOG_FILE)) {
            return Ok(());
        }
        // What a link leads to is somebody else's.
        self.own_run_folder(run).map_or(Ok(()), |folder| Outcome::tidy(&folder))
    }

    /// Removes the record of how `run` ended, before it continues.
    pub fn reopen(&self, run: &PlannedRun) -> Result<(), OutputError> {
        remove(&self.own_run_folder(run)?.join(OUTCOME_FILE))
    }

    /// Writes `content` to a file that several processes may write at once: readers see the file of
    /// one of them, whole.
    pub fn put(&self, file: &str, content: &[u8]) -> Result<(), OutputError> {
        if let Some((inner, _)) = file.rsplit_once('/') {
            inner_folder(&self.path, inner)?;
        }
        replace_shared(&self.path.join(file), content)
    }

    /// Removes the folder of the runs where all are packed and none is in it.
    pub(crate) fn close_runs(&self) {
        let _ = std::fs::remove_dir(self.path.join(RUNS_FOLDER));
    }

    /// Removes a file of the study that it no longer has.
    pub fn take_away(&self, file: &str) -> Result<(), OutputError> {
        if let Some((inner, _)) = file.rsplit_once('/') {
            own_folder(&self.path, inner)?;
        }
        let path = self.path.join(file);
        remove(&path)?;
        remove(&partial_of(&path))
    }
}

/// The plan of the study in `folder`, whose run folders all lie in it; none where it holds no
/// study.
fn stored_plan(folder: &Path) -> Result<Option<StudyPlan>, OutputError> {
    let plan = read_json_if_there::<StudyPlan>(folder, PLAN_FILE)?;
    let is_of_before = |text: &String| Checksum::of_text(text).is_none();
    if let Some(plan) = plan.as_ref().filter(|plan| plan.text.as_ref().is_some_and(is_of_before)) {
        return Err(OutputError::OtherVersion {
            folder: folder.to_path_buf(),
            written_by: format!("{} without SHA-256", plan.version),
            this: format!("{VERSION} with it"),
        });
    }
    for run in plan.iter().flat_map(|plan| &plan.runs) {
        check_stored_name(&folder.join(PLAN_FILE), &run.folder)?;
    }
    Ok(plan)
}
