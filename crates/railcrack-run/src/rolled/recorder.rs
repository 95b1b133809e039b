//! Writes the folder.

use super::document::ShakedownSummary;
use super::{CYCLE_FILE, PASSES_FILE, PLASTIC_FILE, PROFILE_FILE, SHAKEDOWN_FILE, fields, tables};
use crate::OutputError;
use crate::csv::CsvFile;
use crate::folder::{self, CaseFiles, Durability, Existing};
use railcrack::fatigue::{DangVan, Initiation};
use railcrack::shakedown::{DepthBounds, MapPoint, PassRecord, RolledRail, StabilisedRail};
use railcrack_vtu::{VtuError, write_vtu};
use std::path::{Path, PathBuf};

/// Everything that the folder shows.
#[derive(Debug, Clone, PartialEq)]
pub struct ShakedownResults {
    /// Heading.
    pub title: String,
    /// What was computed.
    pub rail: RolledRail,
    /// The stabilised state.
    pub stabilised: StabilisedRail,
    /// With the direct method: the state that passages lead to, for comparison.
    pub pass_by_pass: Option<StabilisedRail>,
    /// The criterion.
    pub dang_van: DangVan,
    /// The criterion at the surface, then in every layer.
    pub initiation: Initiation,
    /// What every depth bears.
    pub bounds: Vec<DepthBounds>,
    /// First yield and limit of shakedown over friction.
    pub map: Vec<MapPoint>,
    /// Length and depth of the rail in `plastic.vtu`.
    pub extent: Extent,
    /// Wall time, s.
    pub wall_s: f64,
    /// What the reader should know.
    pub warnings: Vec<String>,
}

/// A piece of rail, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// Left end.
    pub from: f64,
    /// Right end.
    pub to: f64,
    /// Depth.
    pub depth: f64,
}

/// Writes a run folder: passages as they finish, the rest at the end.
#[derive(Debug)]
pub struct ShakedownRecorder {
    folder: PathBuf,
    passes: CsvFile,
}

impl ShakedownRecorder {
    /// Begins the folder with the case.
    ///
    /// Errors: the folder holds a run that is not to be replaced; the system refuses.
    pub fn start(folder: &Path, case: &CaseFiles, existing: Existing) -> Result<Self, OutputError> {
        folder::begin(folder, case, existing)?;
        let passes = CsvFile::create(&folder.join(PASSES_FILE), &tables::passes_header())?;
        Ok(Self { folder: folder.to_path_buf(), passes })
    }

    /// Appends a passage. The first one begins the table anew: a computation that needs more layers starts again.
    ///
    /// Errors: a number that is not finite; the system refuses.
    pub fn pass(&mut self, pass: &PassRecord) -> Result<(), OutputError> {
        if pass.pass == 1 {
            self.passes = CsvFile::create(&self.folder.join(PASSES_FILE), &tables::passes_header())?;
        }
        self.passes.append(&tables::pass_row(pass)?)
    }

    /// Writes tables, fields, plots, report and summary.
    ///
    /// Errors: a number that is not finite; the system refuses.
    pub fn finish(&self, results: &ShakedownResults) -> Result<ShakedownSummary, OutputError> {
        let put = |name: &str, content: &[u8]| replace(&self.folder.join(name), content);
        put(PROFILE_FILE, &tables::profile_table(&results.stabilised, &results.initiation)?)?;
        for (name, grid) in
            [(PLASTIC_FILE, fields::plastic_grid(results)), (CYCLE_FILE, fields::cycle_grid(results))]
        {
            let path = self.folder.join(name);
            write_vtu(&path, &grid).map_err(|error| of_vtu(&path, error))?;
        }
        let summary = ShakedownSummary::of(results);
        let mut text = serde_json::to_string_pretty(&summary)
            .map_err(|reason| OutputError::damaged(&self.folder.join(SHAKEDOWN_FILE), reason.to_string()))?;
        text.push('\n');
        put(SHAKEDOWN_FILE, text.as_bytes())?;
        Ok(summary)
    }
}

fn replace(path: &Path, content: &[u8]) -> Result<(), OutputError> {
    folder::replace_file(path, content, Durability::Cached)
}

fn of_vtu(path: &Path, error: VtuError) -> OutputError {
    match error {
        VtuError::Io { action, path, reason } => OutputError::Io { action, path, reason },
        other => OutputError::damaged(path, other.to_string()),
    }
}
