//! Plots and page of a results folder.

use crate::engine::PageEngine;
use crate::figures::{
    Plot, StudyRun, Styles, comparison_plots, plan_plots, run_plots, shakedown_plots, space_plots,
    study_plots,
};
use crate::page::Page;
use crate::page_data::PageData;
use crate::pages::{RunFolder, comparison_page, plan_page, run_page, shakedown_page, study_page};
use railcrack_case::Output;
use railcrack_run::compare::stored_comparison;
use railcrack_run::disk::{Durability, inner_folder, replace_file};
use railcrack_run::files::{
    COMPARE_FILE, PLAN_FILE, PLANS_FILE, PLOTS_FOLDER, REPORT_FILE, SHAKEDOWN_FILE, SUMMARY_FILE,
};
use railcrack_run::study::{StudyFolder, StudyResults};
use railcrack_run::{OutputError, PlanFolder, ShakedownFolder};
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

/// Plots and page of a folder.
pub(crate) struct Built {
    pub(crate) plots: Vec<Plot>,
    pub(crate) page: Page,
}

impl Built {
    /// Those of a run with what it shows of its long tables; without a finished step no plots.
    ///
    /// Errors: those of [`PageEngine::find`].
    pub(crate) fn of_run(run: &RunFolder, page_data: &PageData) -> Result<Self, OutputError> {
        let plots = match run.case.space() {
            Some(_) => space_plots(&run.summary, &run.growth, page_data),
            None => run_plots(&run.summary, &run.growth, page_data, &run.half_widths()),
        };
        // The engine computes in the plane.
        let computes = run.case.output.explorer && run.case.space().is_none();
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
    /// Errors: the file is damaged; this version does not accept the case; the folder holds another
    /// kind.
    pub(crate) fn of_file(folder: &Path, kind: FolderKind) -> Result<Self, OutputError> {
        let (plots, page) = match kind {
            FolderKind::Shakedown => {
                let state = ShakedownFolder::open(folder)?;
                let plots = shakedown_plots(&state);
                let page = shakedown_page(&state, &state.case()?, &plots);
                (plots, page)
            }
            FolderKind::Plan => {
                let plans = PlanFolder::open(folder)?;
                let plots = plan_plots(&plans.summary);
                let page = plan_page(&plans, &plans.case()?);
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
    pub(crate) fn write_plots(&self, folder: &Path) -> Result<(), OutputError> {
        if self.plots.is_empty() {
            return Ok(());
        }
        let folder = inner_folder(folder, PLOTS_FOLDER)?;
        self.plots.iter().try_for_each(|plot| put(&folder.join(plot.file), &plot.svg))
    }

    pub(crate) fn write_page(&self, folder: &Path) -> Result<(), OutputError> {
        put(&folder.join(REPORT_FILE), &self.page.html())
    }
}

/// Plots and page, as selected by `output`.
pub(crate) fn write_run(run: &RunFolder, page_data: &PageData, output: Output) -> Result<(), OutputError> {
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
