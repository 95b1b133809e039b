//! Plots and report of a results folder, built from its files.

use crate::engine::PageEngine;
use crate::figures::{
    Plot, StudyRun, Styles, comparison_plots, plan_plots, run_plots, shakedown_plots, space_plots,
    study_plots,
};
use crate::page::Page;
use crate::page_data::{PageData, PageStep};
use crate::pages::{RunFolder, comparison_page, plan_page, run_page, shakedown_page, study_page};
use crate::recomputed::recomputed;
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
use std::sync::{Arc, Mutex, PoisonError};

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

/// Plots and page of a folder.
pub(crate) struct Built {
    plots: Vec<Plot>,
    pub(crate) page: Page,
}

impl Built {
    /// Those of a run with what it shows of its long tables; without a finished step no plots.
    ///
    /// Errors: those of [`PageEngine::find`].
    pub(crate) fn of_run(run: &RunFolder, page_data: &PageData) -> Result<Self, OutputError> {
        let plots = match &run.case.space {
            Some(_) => space_plots(&run.summary, &run.growth, page_data),
            None => run_plots(&run.summary, &run.growth, page_data),
        };
        // The engine computes in the plane.
        let computes = run.case.output.explorer && run.case.space.is_none();
        let engine = computes.then(PageEngine::find).transpose()?;
        let page = run_page(run, page_data, &plots, engine.as_ref());
        Ok(Self { plots, page })
    }

    /// Those of a study with its `results`.
    ///
    /// Errors: the study file cannot be read.
    pub(crate) fn of_study(folder: &StudyFolder, results: &StudyResults) -> Result<Self, OutputError> {
        let plan = folder.plan();
        let rows = plan.runs.iter().zip(&results.rows);
        let runs: Vec<StudyRun> = rows.map(|(planned, row)| StudyRun::new(folder, planned, row)).collect();
        let styles = Styles::new(plan);
        let plots = study_plots(plan, &runs, &styles);
        let page = study_page((plan, &results.population), &runs, &styles, &folder.study_text()?);
        Ok(Self { plots, page })
    }

    /// Those of a stabilised state, of grinding plans or of a comparison, which one file holds.
    ///
    /// Errors: the file is damaged; the folder holds another kind.
    pub(crate) fn of_file(folder: &Path, kind: FolderKind) -> Result<Self, OutputError> {
        let (plots, page) = match kind {
            FolderKind::Shakedown => {
                let state = ShakedownFolder::open(folder)?;
                let plots = shakedown_plots(&state);
                let page = shakedown_page(&state, &plots);
                (plots, page)
            }
            FolderKind::Plan => {
                let plans = PlanFolder::open(folder)?;
                let plots = plan_plots(&plans.summary);
                let page = plan_page(&plans, &plots);
                (plots, page)
            }
            FolderKind::Comparison => {
                let (comparison, tolerance) = stored_comparison(folder)?;
                let plots = comparison_plots(&comparison);
                let page = comparison_page(&comparison, tolerance, &plots);
                (plots, page)
            }
            FolderKind::Run | FolderKind::Study => {
                return Err(OutputError::NothingToReport { folder: folder.to_path_buf() });
            }
        };
        Ok(Self { plots, page })
    }

    /// Writes the files of the plots into the folder for plots in `folder`.
    fn write_plots(&self, folder: &Path) -> Result<(), OutputError> {
        if self.plots.is_empty() {
            return Ok(());
        }
        let folder = inner_folder(folder, PLOTS_FOLDER)?;
        self.plots.iter().try_for_each(|plot| put(&folder.join(plot.file), &plot.svg))
    }

    fn write_page(&self, folder: &Path) -> Result<(), OutputError> {
        put(&folder.join(REPORT_FILE), &self.page.html())
    }
}

/// Plots and report of a run from its folder alone: from its files or, if these are incomplete,
/// from a repeated computation.
fn rebuild_run(folder: &Path) -> Result<(), OutputError> {
    let mut run = RunFolder::read(folder)?;
    let page_data = if !run.case.output.is_whole() || run.lacks_samples() {
        let (page_data, decision) = recomputed(&run)?;
        run.summary.decision = decision;
        page_data
    } else {
        PageData::read(folder, run.summary.steps_recorded)?
    };
    write_run(&run, &page_data, Output::ALL)
}

/// Plots and page, as selected by `output`.
fn write_run(run: &RunFolder, page_data: &PageData, output: Output) -> Result<(), OutputError> {
    let built = Built::of_run(run, page_data)?;
    if output.plots {
        built.write_plots(&run.path)?;
    }
    if output.report {
        built.write_page(&run.path)?;
    }
    Ok(())
}

/// Writes `text` to `path` in one piece.
pub fn put(path: &Path, text: &str) -> Result<(), OutputError> {
    replace_file(path, text.as_bytes(), Durability::Cached)
}

/// The plots and pages of this crate, as a presentation of runs in progress.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Pages;

/// What becomes of the collected data when a run has ended.
#[derive(Debug, Clone)]
pub(crate) enum AtEnd {
    /// Plots and page are written, as selected.
    Write(Output),
    /// They are kept here.
    Keep(Arc<Mutex<Option<PageData>>>),
}

/// The data of the page of a run in progress.
#[derive(Debug)]
pub(crate) struct Collected {
    pub(crate) page_data: PageData,
    pub(crate) taken: Option<PageStep>,
    pub(crate) at_end: AtEnd,
}

impl RunPresentation for Collected {
    fn take(&mut self, record: &StepRecord, scale: &SifScale) -> Result<(), OutputError> {
        self.taken = Some(self.page_data.of_record(record, scale)?);
        Ok(())
    }

    fn keep(&mut self) {
        if let Some(step) = self.taken.take() {
            self.page_data.push(step);
        }
    }

    fn finish(&self, folder: &Path) -> Result<(), OutputError> {
        match &self.at_end {
            AtEnd::Write(output) => write_run(&RunFolder::read(folder)?, &self.page_data, *output),
            AtEnd::Keep(slot) => {
                *slot.lock().unwrap_or_else(PoisonError::into_inner) = Some(self.page_data.clone());
                Ok(())
            }
        }
    }
}

impl Presentation for Pages {
    fn run(&self, output: Output) -> Box<dyn RunPresentation> {
        if !output.is_shown() {
            return Box::new(TablesOnly);
        }
        Box::new(Collected { page_data: PageData::default(), taken: None, at_end: AtEnd::Write(output) })
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
        let page_data = PageData::read(folder, steps)?;
        Ok(Box::new(Collected { page_data, taken: None, at_end: AtEnd::Write(output) }))
    }

    fn shakedown(&self, folder: &Path) -> Result<(), OutputError> {
        let built = Built::of_file(folder, FolderKind::Shakedown)?;
        built.write_plots(folder)?;
        built.write_page(folder)
    }

    fn plan(&self, folder: &Path) -> Result<(), OutputError> {
        let built = Built::of_file(folder, FolderKind::Plan)?;
        built.write_plots(folder)?;
        built.write_page(folder)
    }

    fn comparison(&self, folder: &Path) -> Result<(), OutputError> {
        let built = Built::of_file(folder, FolderKind::Comparison)?;
        built.plots.iter().try_for_each(|plot| put(&folder.join(plot.file), &plot.svg))?;
        built.write_page(folder)
    }

    fn study(&self, folder: &StudyFolder, results: &StudyResults) -> Result<(), OutputError> {
        let built = Built::of_study(folder, results)?;
        for file in STUDY_PLOTS {
            match built.plots.iter().find(|plot| plot.file == file) {
                Some(plot) => folder.put(&format!("plots/{file}"), plot.svg.as_bytes())?,
                None => folder.take_away(&format!("plots/{file}"))?,
            }
        }
        folder.put(REPORT_FILE, built.page.html().as_bytes())
    }
}
