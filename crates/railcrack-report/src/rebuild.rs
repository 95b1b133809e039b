//! Plots and report of a results folder, built from its files.

use crate::engine::PageEngine;
use crate::figures::{
    Plot, StudyRun, Styles, comparison_plots, plan_plots, run_plots, shakedown_plots, space_plots,
    study_plots,
};
use crate::pages::{RunFolder, comparison_page, plan_page, run_page, shakedown_page, space_page, study_page};
use crate::recomputed::recomputed;
use crate::shown::{ShownRun, ShownStep};
use railcrack::growth::StepRecord;
use railcrack_case::Output;
use railcrack_run::compare::stored_comparison;
use railcrack_run::csv::SifScale;
use railcrack_run::disk::{Durability, inner_folder, replace_file};
use railcrack_run::files::{
    COMPARE_FILE, PLAN_FILE, PLANS_FILE, PLOTS_FOLDER, REPORT_FILE, SHAKEDOWN_FILE, STUDY_PLOTS, SUMMARY_FILE,
};
use railcrack_run::study::{StudyFolder, StudyResults};
use railcrack_run::{
    FolderLock, OutputError, PlanFolder, Presentation, RunPresentation, ShakedownFolder, TablesOnly,
};
use std::path::Path;

/// Kind of results in a folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FolderKind {
    /// A growth run: `summary.json`.
    Run,
    /// A stabilised plastic state: `shakedown.json`.
    Shakedown,
    /// Grinding plans: `plan.json`.
    Plan,
    /// A comparison of two runs: `compare.json`.
    Comparison,
    /// A parametric study: `study.json`.
    Study,
}

impl FolderKind {
    /// The kind of results in `folder`.
    ///
    /// Errors: none of these; no such folder.
    pub fn of(folder: &Path) -> Result<Self, OutputError> {
        let kinds = [
            (Self::Run, SUMMARY_FILE),
            (Self::Shakedown, SHAKEDOWN_FILE),
            (Self::Plan, PLANS_FILE),
            (Self::Comparison, COMPARE_FILE),
            (Self::Study, PLAN_FILE),
        ];
        let there = |&(_, file): &(Self, &str)| folder.join(file).is_file();
        match kinds.into_iter().find(there) {
            Some((kind, _)) => Ok(kind),
            None if !folder.is_dir() => Err(OutputError::NoFolder { folder: folder.to_path_buf() }),
            None => Err(OutputError::NothingToReport { folder: folder.to_path_buf() }),
        }
    }
}

/// Rebuilds plots and report of `folder` from its tables and summaries alone; for a study also its
/// table of runs, from the run folders. The result is identical to the original files.
///
/// Errors: the folder holds none of these; a file of it is damaged (of a study, runs are: the
/// others are shown before that is said), or it is being computed (of a study, runs may be); the
/// system refuses.
pub fn rebuild_report(folder: &Path) -> Result<FolderKind, OutputError> {
    let kind = FolderKind::of(folder)?;
    // The runs of a study may be in progress while it is shown.
    let _lock = (kind != FolderKind::Study).then(|| FolderLock::take(folder)).transpose()?;
    match kind {
        FolderKind::Run => rebuild_run(folder)?,
        FolderKind::Shakedown => Pages.shakedown(folder)?,
        FolderKind::Plan => Pages.plan(folder)?,
        FolderKind::Comparison => Pages.comparison(folder)?,
        FolderKind::Study => {
            let results = StudyFolder::open(folder)?.write_results(&Pages)?;
            let runs = results.damaged().count();
            if let Some((_, first)) = results.damaged().next() {
                let (folder, first) = (folder.to_path_buf(), first.to_owned());
                return Err(OutputError::DamagedRuns { folder, runs, first });
            }
            if let Some(first) = results.flaws.first() {
                let (folder, first) = (folder.to_path_buf(), first.clone());
                return Err(OutputError::DamagedPack { folder, flaws: results.flaws.len(), first });
            }
        }
    }
    Ok(kind)
}

/// Plots and report of a run from its folder alone: from its files or, if these are incomplete,
/// from a repeated computation.
fn rebuild_run(folder: &Path) -> Result<(), OutputError> {
    let mut run = RunFolder::read(folder)?;
    if !run.case.output.is_whole() || run.lacks_samples() {
        let (shown, decision) = recomputed(&run)?;
        run.summary.decision = decision;
        return write_run(&run, &shown);
    }
    let shown = ShownRun::read(folder, run.summary.steps_recorded)?;
    write_run(&run, &shown)
}

/// Without a finished step there are no plots.
fn write_run(run: &RunFolder, shown: &ShownRun) -> Result<(), OutputError> {
    write_chosen(run, shown, Output::ALL)
}

/// Plots and page, as selected by `output`.
fn write_chosen(run: &RunFolder, shown: &ShownRun, output: Output) -> Result<(), OutputError> {
    let plots = match &run.case.space {
        Some(_) => space_plots(&run.summary, &run.growth, shown),
        None => run_plots(&run.summary, &run.growth, shown),
    };
    if output.plots {
        write_plots(&run.path, &plots)?;
    }
    if output.report {
        let page = match &run.case.space {
            Some(space) => space_page(run, space, shown, &plots),
            None => run_page(run, shown, &plots, engine_of(run)?.as_ref()),
        };
        put(&run.path.join(REPORT_FILE), &page.html())?;
    }
    Ok(())
}

/// The engine in the page of `run`, where its case requests one.
///
/// Errors: those of [`PageEngine::find`].
pub(crate) fn engine_of(run: &RunFolder) -> Result<Option<PageEngine>, OutputError> {
    run.case.output.explorer.then(PageEngine::find).transpose()
}

/// Writes the files of `plots` into the folder for plots in `folder`.
fn write_plots(folder: &Path, plots: &[Plot]) -> Result<(), OutputError> {
    if plots.is_empty() {
        return Ok(());
    }
    let folder = inner_folder(folder, PLOTS_FOLDER)?;
    plots.iter().try_for_each(|plot| put(&folder.join(plot.file), &plot.svg))
}

/// Writes `text` to `path` in one piece.
pub fn put(path: &Path, text: &str) -> Result<(), OutputError> {
    replace_file(path, text.as_bytes(), Durability::Cached)
}

/// The plots and pages of this crate, as a presentation of runs in progress.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Pages;

/// Results shown of a run in progress.
#[derive(Debug)]
struct Gathered {
    shown: ShownRun,
    taken: Option<ShownStep>,
    output: Output,
}

impl RunPresentation for Gathered {
    fn take(&mut self, record: &StepRecord, scale: &SifScale) -> Result<(), OutputError> {
        self.taken = Some(self.shown.of_record(record, scale)?);
        Ok(())
    }

    fn keep(&mut self) {
        if let Some(step) = self.taken.take() {
            self.shown.push(step);
        }
    }

    fn finish(&self, folder: &Path) -> Result<(), OutputError> {
        write_chosen(&RunFolder::read(folder)?, &self.shown, self.output)
    }
}

impl Presentation for Pages {
    fn run(&self, output: Output) -> Box<dyn RunPresentation> {
        if !output.is_shown() {
            return Box::new(TablesOnly);
        }
        Box::new(Gathered { shown: ShownRun::default(), taken: None, output })
    }

    fn resumed_run(
        &self,
        folder: &Path,
        steps: usize,
        output: Output,
    ) -> Result<Box<dyn RunPresentation>, OutputError> {
        if !output.is_shown() {
            return Ok(Box::new(TablesOnly));
        }
        Ok(Box::new(Gathered { shown: ShownRun::read(folder, steps)?, taken: None, output }))
    }

    fn shakedown(&self, folder: &Path) -> Result<(), OutputError> {
        let state = ShakedownFolder::open(folder)?;
        let plots = shakedown_plots(&state);
        write_plots(folder, &plots)?;
        put(&folder.join(REPORT_FILE), &shakedown_page(&state, &plots).html())
    }

    fn plan(&self, folder: &Path) -> Result<(), OutputError> {
        let plans = PlanFolder::open(folder)?;
        let plots = plan_plots(&plans.summary);
        write_plots(folder, &plots)?;
        put(&folder.join(REPORT_FILE), &plan_page(&plans, &plots).html())
    }

    fn comparison(&self, folder: &Path) -> Result<(), OutputError> {
        let (comparison, tolerance) = stored_comparison(folder)?;
        let plots = comparison_plots(&comparison);
        plots.iter().try_for_each(|plot| put(&folder.join(plot.file), &plot.svg))?;
        put(&folder.join(REPORT_FILE), &comparison_page(&comparison, tolerance, &plots).html())
    }

    fn study(&self, folder: &StudyFolder, results: &StudyResults) -> Result<(), OutputError> {
        let plan = folder.plan();
        let rows = plan.runs.iter().zip(&results.rows);
        let runs: Vec<StudyRun> = rows.map(|(planned, row)| StudyRun::new(folder, planned, row)).collect();
        let styles = Styles::new(plan);
        let plots = study_plots(plan, &runs, &styles);
        for file in STUDY_PLOTS {
            match plots.iter().find(|plot| plot.file == file) {
                Some(plot) => folder.put(&format!("plots/{file}"), plot.svg.as_bytes())?,
                None => folder.take_away(&format!("plots/{file}"))?,
            }
        }
        let page = study_page((plan, &results.population), &runs, &styles, &folder.study_text()?, &plots);
        folder.put(REPORT_FILE, page.html().as_bytes())
    }
}
