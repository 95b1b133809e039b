//! Recorder of a run: its folder, written step by step.

use crate::csv::{
    ContactRow, CsvFile, FaceRow, ResidualRow, Rows, SifRow, SifScale, Table, TipRow, header, whole,
};
use crate::disk::files::{CASE_FILE, FIELDS_FILE, SUMMARY_FILE, SUMS_FILE};
use crate::disk::{Durability, Seal, remove, replace_file, write_json, write_sums};
use crate::error::OutputError;
use crate::fields::{write_collection, write_fields};
use crate::log::{Companion, ResidualSummary, RunInfo, RunLog};
use crate::machine::peak_memory_mb;
use crate::presentation::{Presentation, RunPresentation};
use crate::run_folder::{
    AfterStep, CaseFiles, Checkpoint, Existing, LogFile, Seals, begin, case_checksums, has_more_steps,
    restore_case, same_text, stored_case, was_about_to_begin,
};
use crate::summary::{Summary, finite_summary};
use railcrack::growth::{GrowthState, RunStop, StepRecord};
use railcrack_case::Kept;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Steps faster than this do not each wait for the disk: a kill loses nothing by that, a power
/// failure at most a run that is quickly computed again.
const SYNC_INTERVAL: Duration = Duration::from_millis(500);

/// Rows are written in pieces of about so many bytes: a step may have millions of them.
const PIECE: usize = 1 << 16;

/// A run being written. Each finished step is appended to the tables and then sealed by a
/// checkpoint: a run killed at any moment resumes after its last checkpoint, and its files end up
/// the same.
#[derive(Debug)]
pub struct Recorder {
    folder: PathBuf,
    info: RunInfo,
    /// The tables; none if the case requests none.
    sif: Option<CsvFile>,
    growth: CsvFile,
    faces: Option<CsvFile>,
    /// The running surface; none where no wheel feels the cracks.
    contact: Option<CsvFile>,
    log_file: LogFile,
    log: RunLog,
    /// The run after its last step that did not end it.
    unended: Option<AfterStep>,
    /// Time up to which `log.now.wall_s` is counted.
    counted: Instant,
    /// Time at which everything was last known to be on the disk.
    synced: Instant,
    rows: Rows,
    /// Gathers what plots and pages show of the finished steps.
    shown: Box<dyn RunPresentation>,
}

impl Recorder {
    /// Starts a run in `folder`, which is created where it does not exist; `case` goes into it.
    ///
    /// Errors: the folder holds a run and `existing` says to leave it alone; the system refuses to
    /// write.
    pub fn start(
        folder: &Path,
        case: CaseFiles,
        info: RunInfo,
        existing: Existing,
        presentation: &dyn Presentation,
    ) -> Result<Self, OutputError> {
        begin(folder, &case, existing)?;
        Self::from_the_beginning(folder, &case, info, presentation)
    }

    /// Resumes the run in `folder` after its last finished step; a run that ended because its case
    /// had no more steps, and now has, goes on as if it had had them from the beginning. The state
    /// to continue from is none if no step has finished: then the run starts from its beginning.
    ///
    /// Errors: no run in the folder; its case is not `case`, but for more steps; another version of
    /// the program wrote it; a file of it is damaged; the system refuses.
    pub fn resume(
        folder: &Path,
        case: CaseFiles,
        info: RunInfo,
        presentation: &dyn Presentation,
    ) -> Result<(Self, Option<GrowthState>), OutputError> {
        let Some(mut checkpoint) = Checkpoint::read(folder)? else {
            match stored_case(folder)? {
                Some(stored) => same_text(folder, CASE_FILE, &stored, &case.toml)?,
                None if was_about_to_begin(folder) => {}
                None => return Err(OutputError::NoRun { folder: folder.to_path_buf() }),
            }
            begin(folder, &case, Existing::Replace)?;
            return Ok((Self::from_the_beginning(folder, &case, info, presentation)?, None));
        };
        let (stored, mut log) = LogFile::read(folder, &checkpoint)?;
        if has_more_steps(folder, &stored, &case)? && checkpoint.state.ended == Some(RunStop::StepsDone) {
            // The last step made no increment: the run goes on before it.
            let Some(before) = checkpoint.before_end.take() else {
                begin(folder, &case, Existing::Replace)?;
                return Ok((Self::from_the_beginning(folder, &case, info, presentation)?, None));
            };
            checkpoint = Checkpoint::of(*before, None);
            checkpoint.now.longer_case = Some(case.toml.clone());
            checkpoint.write(folder, Durability::Synced)?;
            log = LogFile::read(folder, &checkpoint)?.1;
        }
        if info.output.is_shown() && !info.output.is_whole() {
            // The tables do not contain all that plots and page show: the run starts again.
            begin(folder, &case, Existing::Replace)?;
            return Ok((Self::from_the_beginning(folder, &case, info, presentation)?, None));
        }
        restore_case(folder, &case)?;
        if log.fields().next().is_some() {
            // A list that is gone, or that has fields of a step that a kill has cut.
            write_collection(&folder.join(FIELDS_FILE), log.fields(), Durability::Cached)?;
        }
        let seals = checkpoint.seals;
        let sections = info.sections();
        let counted = Instant::now();
        let recorder = Self {
            sif: cut_back::<SifRow>(folder, seals.sif)?,
            growth: CsvFile::cut_back(&folder.join(TipRow::FILE), seals.growth)?,
            faces: cut_back::<FaceRow>(folder, seals.faces)?,
            contact: cut_back::<ContactRow>(folder, seals.contact)?,
            // Once the tables end with the last finished step.
            shown: presentation.resumed_run(folder, log.steps.len(), info.output)?,
            log_file: LogFile::cut_back(folder, &checkpoint)?,
            folder: folder.to_path_buf(),
            info,
            log,
            unended: Some(checkpoint.after()).filter(|after| after.state.ended.is_none()),
            counted,
            synced: Instant::now(),
            rows: Rows::with_sections(&sections),
        };
        // They are of the steps so far; a run with a damaged table stays as it is.
        remove(&folder.join(SUMS_FILE))?;
        Ok((recorder, Some(checkpoint.state)))
    }

    fn from_the_beginning(
        folder: &Path,
        case: &CaseFiles,
        info: RunInfo,
        presentation: &dyn Presentation,
    ) -> Result<Self, OutputError> {
        let sections = info.sections();
        Ok(Self {
            sif: new_table_of::<SifRow>(folder, info.output.sif, &sections)?,
            growth: new_table::<TipRow>(folder, &sections)?,
            faces: new_table_of::<FaceRow>(folder, info.output.faces, &sections)?,
            contact: new_table_of::<ContactRow>(folder, contact_kept(&info), &sections)?,
            log_file: LogFile::create(folder, case)?,
            folder: folder.to_path_buf(),
            shown: presentation.run(info.output),
            info,
            log: RunLog::default(),
            unended: None,
            counted: Instant::now(),
            synced: Instant::now(),
            rows: Rows::with_sections(&sections),
        })
    }

    /// The run folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Writes `residual.csv`, the residual stress on the mesh of the cracks, and records its
    /// `summary`.
    pub fn residual(&mut self, profile: &[ResidualRow], summary: ResidualSummary) -> Result<(), OutputError> {
        self.log.now.residual = Some(summary);
        let table = whole(profile.iter().copied())?;
        self.log.now.residual_table = Some(Seal::of(&table));
        replace_file(&self.folder.join(ResidualRow::FILE), &table, Durability::Cached)
    }

    /// Appends a finished step and seals it: `state` is the state of the run after it. A step with
    /// a number that is not finite is refused whole.
    pub fn record(&mut self, record: &StepRecord, state: &GrowthState) -> Result<(), OutputError> {
        let begun = Instant::now();
        finite_summary(record)?;
        let durability = if record.stop.is_some() || self.synced.elapsed() >= SYNC_INTERVAL {
            Durability::Synced
        } else {
            Durability::Cached
        };
        let fields = write_fields(&self.folder, record, durability)?;
        let scale = self.scale(record);
        self.append(record, &scale)?;
        self.shown.take(record, &scale)?;
        let has_fields = !fields.is_empty();
        self.log.add(record, fields);
        if has_fields {
            write_collection(&self.folder.join(FIELDS_FILE), self.log.fields(), durability)?;
        }
        if let Some(step) = self.log.steps.last() {
            self.log_file.add(&self.folder, step)?;
        }
        if durability == Durability::Synced {
            // Tables and log must be on the disk before the checkpoint that relies on them.
            for table in self.sif.iter().chain([&self.growth]).chain(&self.faces).chain(&self.contact) {
                table.sync()?;
            }
            self.log_file.sync()?;
            self.synced = Instant::now();
        }
        self.count_time(begun);
        self.checkpoint(state, durability)?;
        let summary = Summary::new(&self.info, &self.log, false);
        self.write_summary(summary, Durability::Cached)?;
        self.shown.keep();
        Ok(())
    }

    /// Sets the wall time (seconds) of a computation that this recorder only stores.
    pub(crate) fn was_computed_in(&mut self, wall_s: f64) {
        self.log.now.wall_s = wall_s;
        self.counted = Instant::now();
    }

    /// The facts of the case.
    pub(super) fn info(&self) -> &RunInfo {
        &self.info
    }

    /// The finished steps.
    pub(super) fn log(&self) -> &RunLog {
        &self.log
    }

    /// Whether the companions of the run are known.
    pub(super) fn has_companions(&self) -> bool {
        self.log.now.companions.is_some()
    }

    /// Keeps the `companions` of the run, which has ended in `state`.
    ///
    /// Errors: the system refuses to write.
    pub(super) fn accompany(
        &mut self,
        companions: Vec<Companion>,
        state: &GrowthState,
    ) -> Result<(), OutputError> {
        self.log.now.companions = Some(companions);
        self.count_time(Instant::now());
        self.checkpoint(state, Durability::Synced)
    }

    fn checkpoint(&mut self, state: &GrowthState, durability: Durability) -> Result<(), OutputError> {
        let after = AfterStep { state: state.clone(), seals: self.seals(), now: self.log.now.clone() };
        let has_no_more_steps = state.ended == Some(RunStop::StepsDone);
        let before_end = self.unended.clone().filter(|_| has_no_more_steps);
        if state.ended.is_none() {
            self.unended = Some(after.clone());
        }
        Checkpoint::of(after, before_end).write(&self.folder, durability)
    }

    /// Writes summary, plots and report of the finished steps: at the end of a run, and when it is
    /// interrupted.
    pub fn finish(&mut self) -> Result<Summary, OutputError> {
        let begun = Instant::now();
        // Plots and report repeat the summary, so it must be written first.
        let summary = self.write_summary(Summary::new(&self.info, &self.log, true), Durability::Cached)?;
        self.shown.finish(&self.folder)?;
        self.count_time(begun);
        // The samples are made once, and the verdict rests on them.
        let Summary { decision, verdict, .. } = summary;
        let summary = Summary { decision, verdict, ..Summary::new(&self.info, &self.log, false) };
        let mut sums = case_checksums(&self.folder)?;
        sums.extend(self.seals().checksums(&self.log));
        write_sums(&self.folder, &sums)?;
        self.write_summary(summary, Durability::Synced)
    }

    /// The scale of wheel positions, which the cracks of step 0 give.
    fn scale(&self, record: &StepRecord) -> SifScale {
        let initial = if self.log.steps.is_empty() { record.cracks() } else { &self.log.now.initial_cracks };
        let origin = initial.first().map_or(0.0, |crack| crack.points()[0].x);
        SifScale { origin, half_widths: self.info.half_widths() }
    }

    fn append(&mut self, record: &StepRecord, scale: &SifScale) -> Result<(), OutputError> {
        let before = self.seals();
        let appended = self.append_rows(record, scale);
        if appended.is_err() {
            take_back(&mut self.sif, before.sif);
            self.growth.take_back(before.growth);
            take_back(&mut self.faces, before.faces);
            take_back(&mut self.contact, before.contact);
        }
        appended
    }

    fn append_rows(&mut self, record: &StepRecord, scale: &SifScale) -> Result<(), OutputError> {
        if let Some(sif) = self.sif.as_mut().filter(|_| keeps(self.info.output.sif, record)) {
            append_to(sif, &mut self.rows, SifRow::of_step(record, scale))?;
        }
        append_to(&mut self.growth, &mut self.rows, TipRow::of_step(record, self.info.axle_load))?;
        if !keeps(self.info.output.faces, record) {
            return Ok(());
        }
        if let Some(contact) = &mut self.contact {
            append_to(contact, &mut self.rows, ContactRow::of_step(record))?;
        }
        match &mut self.faces {
            Some(faces) => append_to(faces, &mut self.rows, FaceRow::of_step(record)),
            None => Ok(()),
        }
    }

    fn seals(&self) -> Seals {
        Seals {
            sif: self.sif.as_ref().map(CsvFile::seal),
            growth: self.growth.seal(),
            faces: self.faces.as_ref().map(CsvFile::seal),
            contact: self.contact.as_ref().map(CsvFile::seal),
            log: self.log_file.seal(),
        }
    }

    /// Adds the time since the last count to the wall time, and the time since `begun` to that of
    /// writing.
    fn count_time(&mut self, begun: Instant) {
        let now = Instant::now();
        self.log.now.output_s += (now - begun).as_secs_f64();
        self.log.now.wall_s += (now - self.counted).as_secs_f64();
        self.counted = now;
        self.log.now.peak_memory_mb = match (self.log.now.peak_memory_mb, peak_memory_mb()) {
            (Some(before), Some(here)) => Some(before.max(here)),
            (before, here) => here.or(before),
        };
    }

    fn write_summary(&self, summary: Summary, durability: Durability) -> Result<Summary, OutputError> {
        let summary = Summary { checksums: self.seals().checksums(&self.log), ..summary };
        write_json(&self.folder, SUMMARY_FILE, &summary, durability)?;
        Ok(summary)
    }
}

fn new_table<T: Table>(folder: &Path, sections: &[&str]) -> Result<CsvFile, OutputError> {
    CsvFile::create(&folder.join(T::FILE), &header::<T>(sections))
}

/// The same for a table of which `kept` steps are written.
fn new_table_of<T: Table>(
    folder: &Path,
    kept: Kept,
    sections: &[&str],
) -> Result<Option<CsvFile>, OutputError> {
    (kept != Kept::None).then(|| new_table::<T>(folder, sections)).transpose()
}

/// The steps of which the running surface is written: those of the faces.
fn contact_kept(info: &RunInfo) -> Kept {
    if info.coupled { info.output.faces } else { Kept::None }
}

fn cut_back<T: Table>(folder: &Path, seal: Option<Seal>) -> Result<Option<CsvFile>, OutputError> {
    seal.map(|seal| CsvFile::cut_back(&folder.join(T::FILE), seal)).transpose()
}

fn take_back(table: &mut Option<CsvFile>, seal: Option<Seal>) {
    if let (Some(table), Some(seal)) = (table, seal) {
        table.take_back(seal);
    }
}

/// Whether a table of which `kept` steps are written has this one. A run that was interrupted has
/// no last step yet.
fn keeps(kept: Kept, record: &StepRecord) -> bool {
    match kept {
        Kept::All => true,
        Kept::Ends => record.step == 0 || record.stop.is_some(),
        Kept::None => false,
    }
}

/// Appends `content` to `file` in pieces, using `rows` as a buffer.
fn append_to<T: Table>(
    file: &mut CsvFile,
    rows: &mut Rows,
    content: impl Iterator<Item = T>,
) -> Result<(), OutputError> {
    rows.clear();
    for row in content {
        row.put(rows);
        if rows.length() >= PIECE {
            file.append(rows.text(T::FILE)?)?;
            rows.clear();
        }
    }
    file.append(rows.text(T::FILE)?)
}
