//! Plots and report of a folder, from what is stored in it.

use super::paper::paper_page;
use super::run::{RunFolder, run_page};
use crate::output::OutputError;
use crate::output::figures::{PLOTS_FOLDER, run_plots};
use crate::output::folder::{Durability, SUMMARY_FILE, replace_file};
use crate::output::shown::ShownRun;
use crate::output::study::StudyFolder;
use std::path::Path;

pub(crate) const REPORT_FILE: &str = "report.html";

/// What a folder holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FolderKind {
    /// A growth run: `summary.json`.
    Run,
    /// A stabilised plastic state: `shakedown.json`.
    Shakedown,
    /// Two runs set against each other: `compare.json`.
    Comparison,
    /// A parametric study: `study.json`.
    Study,
    /// The paper recomputed: `statements.json`.
    Paper,
}

impl FolderKind {
    /// What `folder` holds.
    ///
    /// Errors: none of these; no such folder.
    pub fn of(folder: &Path) -> Result<Self, OutputError> {
        let kinds = [
            (Self::Run, SUMMARY_FILE),
            (Self::Shakedown, crate::output::shakedown::SHAKEDOWN_FILE),
            (Self::Comparison, crate::output::compare::JSON_FILE),
            (Self::Study, crate::output::study::PLAN_FILE),
            (Self::Paper, crate::output::paper::STATEMENTS_FILE),
        ];
        let there = |&(_, file): &(Self, &str)| folder.join(file).is_file();
        match kinds.into_iter().find(there) {
            Some((kind, _)) => Ok(kind),
            None => Err(OutputError::NothingToReport { folder: folder.to_path_buf() }),
        }
    }
}

/// Builds plots and report of `folder` from its tables and summaries alone, in place of those that are there; of a study, also its table
/// of runs, from the run folders in it. What a command wrote is built again bit for bit.
///
/// Errors: the folder holds none of these; a file of it is damaged; the system refuses.
pub fn rebuild_report(folder: &Path) -> Result<FolderKind, OutputError> {
    let kind = FolderKind::of(folder)?;
    match kind {
        FolderKind::Run => rebuild_run(folder)?,
        FolderKind::Shakedown => crate::output::shakedown::rebuild(folder)?,
        FolderKind::Comparison => crate::output::compare::rebuild(folder)?,
        FolderKind::Paper => put(&folder.join(REPORT_FILE), &paper_page(folder)?.html())?,
        FolderKind::Study => drop(StudyFolder::open(folder)?.write_results()?),
    }
    Ok(kind)
}

/// Plots and report of a run from its folder alone.
fn rebuild_run(folder: &Path) -> Result<(), OutputError> {
    let run = RunFolder::read(folder)?;
    let shown = ShownRun::read(folder, run.summary.steps_recorded)?;
    write_run(&run, &shown)
}

/// Plots and report of the run in `folder`, of which `shown` is what is long.
pub(crate) fn finish_run(folder: &Path, shown: &ShownRun) -> Result<(), OutputError> {
    write_run(&RunFolder::read(folder)?, shown)
}

/// Without a finished step there are no plots.
fn write_run(run: &RunFolder, shown: &ShownRun) -> Result<(), OutputError> {
    let plots = run_plots(&run.summary, &run.growth, shown);
    write_plots(&run.path.join(PLOTS_FOLDER), &plots)?;
    put(&run.path.join(REPORT_FILE), &run_page(run, shown, &plots).html())
}

/// Writes `plots` (file name and SVG) into `folder`.
pub(crate) fn write_plots(folder: &Path, plots: &[(&'static str, String)]) -> Result<(), OutputError> {
    if plots.is_empty() {
        return Ok(());
    }
    std::fs::create_dir_all(folder).map_err(OutputError::io("create", folder))?;
    plots.iter().try_for_each(|(file, picture)| put(&folder.join(file), picture))
}

/// Writes `text` to `path` in one piece.
pub(crate) fn put(path: &Path, text: &str) -> Result<(), OutputError> {
    replace_file(path, text.as_bytes(), Durability::Cached)
}
