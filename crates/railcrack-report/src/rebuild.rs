//! Plots and report of a folder, from what is stored in it.

use crate::figures::{ComparedTip, ShakedownPlot, compared_paths, compared_sifs, run_plots, shakedown_plots};
use crate::figures::{STUDY_PLOTS, study_plots};
use crate::pages::{RunFolder, comparison_page, run_page, shakedown_page, study_page};
use crate::shown::{ShownRun, ShownStep};
use railcrack::growth::StepRecord;
use railcrack_run::ShakedownFolder;
use railcrack_run::compare::{self, stored_comparison};
use railcrack_run::csv::SifScale;
use railcrack_run::files::{
    COMPARE_FILE, PLAN_FILE, PLOTS_FOLDER, REPORT_FILE, SHAKEDOWN_FILE, SUMMARY_FILE,
};
use railcrack_run::folder::{Durability, replace_file};
use railcrack_run::study::{StudyFolder, StudyResults};
use railcrack_run::{Comparison, OutputError, Presentation, RunPresentation};
use std::path::Path;

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
}

impl FolderKind {
    /// What `folder` holds.
    ///
    /// Errors: none of these; no such folder.
    pub fn of(folder: &Path) -> Result<Self, OutputError> {
        let kinds = [
            (Self::Run, SUMMARY_FILE),
            (Self::Shakedown, SHAKEDOWN_FILE),
            (Self::Comparison, COMPARE_FILE),
            (Self::Study, PLAN_FILE),
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
        FolderKind::Shakedown => Pages.shakedown(folder)?,
        FolderKind::Comparison => Pages.comparison(folder)?,
        FolderKind::Study => drop(StudyFolder::open(folder)?.write_results(&Pages)?),
    }
    Ok(kind)
}

/// Plots and report of a run from its folder alone.
fn rebuild_run(folder: &Path) -> Result<(), OutputError> {
    let run = RunFolder::read(folder)?;
    let shown = ShownRun::read(folder, run.summary.steps_recorded)?;
    write_run(&run, &shown)
}

/// Without a finished step there are no plots.
fn write_run(run: &RunFolder, shown: &ShownRun) -> Result<(), OutputError> {
    let plots = run_plots(&run.summary, &run.growth, shown);
    write_plots(&run.path.join(PLOTS_FOLDER), &plots)?;
    put(&run.path.join(REPORT_FILE), &run_page(run, shown, &plots).html())
}

/// Writes `plots` (file name and SVG) into `folder`.
pub fn write_plots(folder: &Path, plots: &[(&'static str, String)]) -> Result<(), OutputError> {
    if plots.is_empty() {
        return Ok(());
    }
    std::fs::create_dir_all(folder).map_err(OutputError::io("create", folder))?;
    plots.iter().try_for_each(|(file, picture)| put(&folder.join(file), picture))
}

/// Writes `text` to `path` in one piece.
pub fn put(path: &Path, text: &str) -> Result<(), OutputError> {
    replace_file(path, text.as_bytes(), Durability::Cached)
}

/// The plots and pages of this crate, for what computes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Pages;

/// What is shown of a run that is being computed.
#[derive(Debug, Default)]
struct Gathered {
    shown: ShownRun,
    taken: Option<ShownStep>,
}

impl RunPresentation for Gathered {
    fn take(&mut self, record: &StepRecord, scale: SifScale) -> Result<(), OutputError> {
        self.taken = Some(self.shown.of_record(record, scale)?);
        Ok(())
    }

    fn keep(&mut self) {
        if let Some(step) = self.taken.take() {
            self.shown.push(step);
        }
    }

    fn finish(&self, folder: &Path) -> Result<(), OutputError> {
        write_run(&RunFolder::read(folder)?, &self.shown)
    }
}

impl Presentation for Pages {
    fn run(&self) -> Box<dyn RunPresentation> {
        Box::new(Gathered::default())
    }

    fn resumed_run(&self, folder: &Path, steps: usize) -> Result<Box<dyn RunPresentation>, OutputError> {
        Ok(Box::new(Gathered { shown: ShownRun::read(folder, steps)?, taken: None }))
    }

    fn shakedown(&self, folder: &Path) -> Result<(), OutputError> {
        let state = ShakedownFolder::open(folder)?;
        let plots = shakedown_plots(&state);
        let pictures: Vec<(&'static str, String)> = plots.iter().map(ShakedownPlot::file).collect();
        write_plots(&folder.join(PLOTS_FOLDER), &pictures)?;
        put(&folder.join(REPORT_FILE), &shakedown_page(&state, &plots).html())
    }

    fn comparison(&self, folder: &Path) -> Result<(), OutputError> {
        let (comparison, tolerance) = stored_comparison(folder)?;
        let plots = comparison_plots(&comparison);
        write_plots(folder, &plots)?;
        put(&folder.join(REPORT_FILE), &comparison_page(&comparison, tolerance, &plots).html())
    }

    fn study(&self, folder: &StudyFolder, results: &StudyResults) -> Result<(), OutputError> {
        let plots = study_plots(folder.plan(), &results.rows);
        for file in STUDY_PLOTS {
            match plots.iter().find(|(name, _)| *name == file) {
                Some((_, picture)) => folder.put(&format!("plots/{file}"), picture.as_bytes())?,
                None => folder.take_away(&format!("plots/{file}"))?,
            }
        }
        let page = study_page(folder.plan(), &results.rows, &folder.study_text()?, &plots);
        folder.put(REPORT_FILE, page.html().as_bytes())
    }
}

/// The plots of a comparison: file name and SVG.
fn comparison_plots(comparison: &Comparison) -> Vec<(&'static str, String)> {
    if comparison.common_steps == 0 {
        return Vec::new();
    }
    let sifs = |step: usize| {
        let tips = comparison.tips.iter().zip(&comparison.aligned).filter(|(tip, _)| tip.step == step);
        let tips = tips.map(|(tip, aligned)| ComparedTip { crack: tip.crack, tip: tip.tip, aligned });
        compared_sifs(step, &comparison.names(), tips.collect())
    };
    let cracks = comparison.cracks.each_ref().map(Vec::as_slice);
    vec![
        (compare::FIRST_STEP, sifs(0)),
        (compare::LAST_STEP, sifs(comparison.common_steps - 1)),
        (compare::PATHS, compared_paths(&comparison.names(), cracks)),
    ]
}
