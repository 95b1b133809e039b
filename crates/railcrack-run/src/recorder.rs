//! Writes a run to its folder, step by step.

use super::checkpoint::{Checkpoint, TableLengths};
use super::csv::{
    CsvFile, FACES_FILE, FaceRows, GROWTH_FILE, RESIDUAL_FILE, Rows, SIF_FILE, SifScale, faces_header,
    growth_header, growth_rows, residual_table, sif_header, sif_rows,
};
use super::fields::{self, FIELDS_FILE};
use super::folder::{self, CASE_FILE, CaseFiles, Durability, SUMMARY_FILE};
use super::memory::peak_memory_mb;
use super::residual::ResidualSummary;
use super::story::Story;
use super::summary::{Summary, finite_summary};
use super::{Existing, OutputError, Presentation, ResidualRow, RunPresentation, VERSION};
use railcrack::growth::{GrowthState, StepRecord, Warning};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Steps faster than this do not each wait for the disk: a kill loses nothing by that, a power failure at most a run
/// that is quickly computed again.
const SYNC_INTERVAL: Duration = Duration::from_millis(500);

/// The rows of the faces are written in pieces of about so many bytes: a step may have millions of them.
const PIECE: usize = 1 << 16;

/// What the files say of a run that its step records do not.
#[derive(Debug, Clone, PartialEq)]
pub struct RunInfo {
    /// Title of the case.
    pub title: String,
    /// Engine: `xfem` or `dislocation`.
    pub engine: String,
    /// Contact solver: `latin` or `newton`.
    pub contact: String,
    /// Boundary of the rail: `half-plane` or `block`.
    pub boundary: String,
    /// Half-width a of the wheel contact, mm: the unit of `xc_over_a`.
    pub half_width: f64,
    /// Axle load in tonnes, for million gross tonnes.
    pub axle_load: Option<f64>,
    /// Warnings that follow from the case, before any step.
    pub warnings: Vec<Warning>,
}

/// A run being written. Each finished step is appended to the tables and then sealed by a checkpoint: a run killed at
/// any moment resumes after its last checkpoint, and its files end up the same.
#[derive(Debug)]
pub struct Recorder {
    folder: PathBuf,
    case: CaseFiles,
    info: RunInfo,
    sif: CsvFile,
    growth: CsvFile,
    faces: CsvFile,
    story: Story,
    /// Until when `story.wall_s` counts.
    counted: Instant,
    /// When the disk was last known to have everything.
    synced: Instant,
    rows: Rows,
    /// Gathers what plots and pages show of the finished steps.
    shown: Box<dyn RunPresentation>,
}

impl Recorder {
    /// Starts a run in `folder`, which is created where it does not exist; `case` goes into it.
    ///
    /// Errors: the folder holds a run and `existing` says to leave it alone; the system refuses to write.
    pub fn start(
        folder: &Path,
        case: CaseFiles,
        info: RunInfo,
        existing: Existing,
        presentation: &dyn Presentation,
    ) -> Result<Self, OutputError> {
        folder::begin(folder, &case, existing)?;
        Self::from_the_beginning(folder, case, info, presentation)
    }

    /// Takes up the run in `folder` after its last finished step. The state to go on from is none where no step has
    /// finished: then the run starts from its beginning.
    ///
    /// Errors: no run in the folder; its case is not `case`; another version of the program wrote it; a file of it is
    /// damaged; the system refuses.
    pub fn resume(
        folder: &Path,
        case: CaseFiles,
        info: RunInfo,
        presentation: &dyn Presentation,
    ) -> Result<(Self, Option<GrowthState>), OutputError> {
        let Some(checkpoint) = Checkpoint::read(folder)? else {
            match folder::stored_case(folder)? {
                Some(stored) => same_text(folder, CASE_FILE, &stored, &case.toml)?,
                None if folder::was_about_to_begin(folder) => {}
                None => return Err(OutputError::NoRun { folder: folder.to_path_buf() }),
            }
            folder::begin(folder, &case, Existing::Replace)?;
            return Ok((Self::from_the_beginning(folder, case, info, presentation)?, None));
        };
        same_case(folder, &checkpoint.case, &case)?;
        folder::restore_case(folder, &case)?;
        let lengths = checkpoint.lengths;
        let counted = Instant::now();
        let recorder = Self {
            sif: CsvFile::cut_back(&folder.join(SIF_FILE), lengths.sif)?,
            growth: CsvFile::cut_back(&folder.join(GROWTH_FILE), lengths.growth)?,
            faces: CsvFile::cut_back(&folder.join(FACES_FILE), lengths.faces)?,
            // Once the tables end with the last finished step.
            shown: presentation.resumed_run(folder, checkpoint.story.steps.len())?,
            folder: folder.to_path_buf(),
            case,
            info,
            story: checkpoint.story,
            counted,
            synced: Instant::now(),
            rows: Rows::default(),
        };
        Ok((recorder, Some(checkpoint.state)))
    }

    /// Whether the run in `folder`, if there is one, computes `case`.
    ///
    /// Errors: it computes another one; the system refuses.
    pub fn check_case(folder: &Path, case: &CaseFiles) -> Result<(), OutputError> {
        let Some(stored) = folder::stored_case(folder)? else { return Ok(()) };
        same_text(folder, CASE_FILE, &stored, &case.toml)?;
        for (name, text) in &case.companions {
            if let Some(before) = folder::read_if_there(&folder.join(name))? {
                same_text(folder, name, &String::from_utf8_lossy(&before), text)?;
            }
        }
        Ok(())
    }

    fn from_the_beginning(
        folder: &Path,
        case: CaseFiles,
        info: RunInfo,
        presentation: &dyn Presentation,
    ) -> Result<Self, OutputError> {
        Ok(Self {
            sif: CsvFile::create(&folder.join(SIF_FILE), &sif_header())?,
            growth: CsvFile::create(&folder.join(GROWTH_FILE), &growth_header())?,
            faces: CsvFile::create(&folder.join(FACES_FILE), &faces_header())?,
            folder: folder.to_path_buf(),
            case,
            info,
            story: Story::default(),
            counted: Instant::now(),
            synced: Instant::now(),
            rows: Rows::default(),
            shown: presentation.run(),
        })
    }

    /// The run folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Writes `residual.csv`, the residual stress that the crack mesh carries, and keeps what the summary says of it.
    pub fn residual(&mut self, profile: &[ResidualRow], summary: ResidualSummary) -> Result<(), OutputError> {
        self.story.residual = Some(summary);
        let table = residual_table(profile)?;
        folder::replace_file(&self.folder.join(RESIDUAL_FILE), &table, Durability::Cached)
    }

    /// Appends a finished step and seals it: `state` is the state of the run after it. A step with a number that is
    /// not finite is refused whole.
    pub fn record(&mut self, record: &StepRecord, state: &GrowthState) -> Result<(), OutputError> {
        let begun = Instant::now();
        finite_summary(record)?;
        let durability = if record.stop.is_some() || self.synced.elapsed() >= SYNC_INTERVAL {
            Durability::Synced
        } else {
            Durability::Cached
        };
        let fields = fields::write_fields(&self.folder, record, durability)?;
        let scale = self.scale(record);
        self.append(record, scale)?;
        self.shown.take(record, scale)?;
        self.story.add(record);
        if !fields.is_empty() {
            self.story.fields.extend(fields);
            fields::write_collection(&self.folder.join(FIELDS_FILE), &self.story.fields, durability)?;
        }
        if durability == Durability::Synced {
            // The tables before the checkpoint that counts on them.
            for table in [&self.sif, &self.growth, &self.faces] {
                table.sync()?;
            }
            self.synced = Instant::now();
        }
        self.count_time(begun);
        let checkpoint = Checkpoint {
            program: VERSION.to_owned(),
            case: self.case.clone(),
            state: state.clone(),
            lengths: self.lengths(),
            story: self.story.clone(),
        };
        checkpoint.write(&self.folder, durability)?;
        self.write_summary(Durability::Cached)?;
        self.shown.keep();
        Ok(())
    }

    /// Writes summary, plots and report of the finished steps: at the end of a run, and when it is interrupted.
    pub fn finish(&mut self) -> Result<Summary, OutputError> {
        let begun = Instant::now();
        // Plots and report say what the summary says, so it must stand there first.
        self.write_summary(Durability::Cached)?;
        self.shown.finish(&self.folder)?;
        self.count_time(begun);
        self.write_summary(Durability::Synced)
    }

    /// The scale of wheel positions, which the cracks of step 0 give.
    fn scale(&self, record: &StepRecord) -> SifScale {
        let initial = if self.story.steps.is_empty() { &record.cracks } else { &self.story.initial_cracks };
        let origin = initial.first().map_or(0.0, |crack| crack.points()[0].x);
        SifScale { origin, half_width: self.info.half_width }
    }

    fn append(&mut self, record: &StepRecord, scale: SifScale) -> Result<(), OutputError> {
        let before = self.lengths();
        let appended = self.append_rows(record, scale);
        if appended.is_err() {
            self.sif.take_back(before.sif);
            self.growth.take_back(before.growth);
            self.faces.take_back(before.faces);
        }
        appended
    }

    fn append_rows(&mut self, record: &StepRecord, scale: SifScale) -> Result<(), OutputError> {
        let rows = &mut self.rows;
        rows.clear();
        sif_rows(rows, record, scale);
        self.sif.append(rows.text(SIF_FILE)?)?;
        rows.clear();
        growth_rows(rows, record);
        self.growth.append(rows.text(GROWTH_FILE)?)?;
        rows.clear();
        let faces = FaceRows::of(record);
        for position in 0..record.faces.states.len() {
            faces.append(rows, position);
            if rows.length() >= PIECE {
                self.faces.append(rows.text(FACES_FILE)?)?;
                rows.clear();
            }
        }
        self.faces.append(rows.text(FACES_FILE)?)
    }

    fn lengths(&self) -> TableLengths {
        TableLengths { sif: self.sif.length(), growth: self.growth.length(), faces: self.faces.length() }
    }

    /// Adds the time since the last count to the wall time, and the time since `begun` to that of writing.
    fn count_time(&mut self, begun: Instant) {
        let now = Instant::now();
        self.story.output_s += (now - begun).as_secs_f64();
        self.story.wall_s += (now - self.counted).as_secs_f64();
        self.counted = now;
        self.story.peak_memory_mb = match (self.story.peak_memory_mb, peak_memory_mb()) {
            (Some(before), Some(here)) => Some(before.max(here)),
            (before, here) => here.or(before),
        };
    }

    fn write_summary(&self, durability: Durability) -> Result<Summary, OutputError> {
        let path = self.folder.join(SUMMARY_FILE);
        let summary = Summary::new(&self.info, &self.story);
        let mut text = serde_json::to_string_pretty(&summary)
            .map_err(|reason| OutputError::damaged(&path, reason.to_string()))?;
        text.push('\n');
        folder::replace_file(&path, text.as_bytes(), durability)?;
        Ok(summary)
    }
}

fn same_case(folder: &Path, stored: &CaseFiles, given: &CaseFiles) -> Result<(), OutputError> {
    same_text(folder, CASE_FILE, &stored.toml, &given.toml)?;
    for (name, text) in &given.companions {
        let before = stored.companions.iter().find(|companion| companion.0 == *name);
        same_text(folder, name, before.map_or("", |companion| companion.1.as_str()), text)?;
    }
    Ok(())
}

fn same_text(folder: &Path, file: &str, stored: &str, given: &str) -> Result<(), OutputError> {
    if stored == given {
        return Ok(());
    }
    let line_of = |text: &str, line: usize| text.lines().nth(line).unwrap_or("").trim().to_owned();
    let lines = stored.lines().count().max(given.lines().count());
    let line = (0..lines).find(|&line| line_of(stored, line) != line_of(given, line)).unwrap_or(0);
    Err(OutputError::CaseChanged {
        folder: folder.to_path_buf(),
        file: file.to_owned(),
        line: line + 1,
        stored: line_of(stored, line),
        given: line_of(given, line),
    })
}
