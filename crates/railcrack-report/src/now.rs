//! Live page of a folder whose results may still be computed.

use crate::figures::{
    StudyRun, Styles, comparison_plots, plan_plots, run_plots, shakedown_plots, study_plots,
};
use crate::pages::{RunFolder, comparison_page, plan_page, run_page, shakedown_page, study_page};
use crate::rebuild::{FolderKind, engine_of};
use crate::shown::ShownRun;
use railcrack::growth::RunStop;
use railcrack::words::Choice;
use railcrack_run::compare::stored_comparison;
use railcrack_run::study::{RunState, StudyResults};
use railcrack_run::{OutputError, PlanFolder, ShakedownFolder, StudyFolder};
use std::path::Path;

/// Snapshot of the page of a folder.
#[derive(Debug, Clone, PartialEq)]
pub struct PageNow {
    /// The page, as [`rebuild_report`](crate::rebuild_report) would write it.
    pub html: String,
    /// Progress of the results.
    pub progress: String,
    /// Whether all results are final.
    pub is_over: bool,
}

/// The page of the results finished so far in `folder`. Nothing is written or locked, so that the
/// computation can continue.
///
/// Errors: the folder holds no results yet; a file is damaged or being written; the tables of a run
/// lack data that the page shows.
pub fn page_now(folder: &Path) -> Result<PageNow, OutputError> {
    let whole = |html: String| PageNow { html, progress: "complete".to_owned(), is_over: true };
    Ok(match FolderKind::of(folder)? {
        FolderKind::Run => run_now(folder)?,
        FolderKind::Study => study_now(&StudyFolder::open(folder)?)?,
        FolderKind::Shakedown => {
            let state = ShakedownFolder::open(folder)?;
            whole(shakedown_page(&state, &shakedown_plots(&state)).html())
        }
        FolderKind::Plan => {
            let plans = PlanFolder::open(folder)?;
            whole(plan_page(&plans, &plan_plots(&plans.summary)).html())
        }
        FolderKind::Comparison => {
            let (comparison, tolerance) = stored_comparison(folder)?;
            whole(comparison_page(&comparison, tolerance, &comparison_plots(&comparison)).html())
        }
    })
}

fn run_now(folder: &Path) -> Result<PageNow, OutputError> {
    let run = RunFolder::read(folder)?;
    let summary = &run.summary;
    if !run.case.output.is_whole() {
        return Err(OutputError::NotRecomputed {
            folder: folder.to_path_buf(),
            reason: "its tables lack data that the page shows".to_owned(),
        });
    }
    let shown = ShownRun::read(folder, summary.steps_recorded)?;
    let plots = run_plots(summary, &run.growth, &shown);
    Ok(PageNow {
        progress: match summary.stop.map(RunStop::word) {
            Some(stop) => format!("ended at step {}: {}", summary.steps, stop.replace('-', " ")),
            None => format!("step {} of {}", summary.steps, run.case.growth.steps),
        },
        is_over: summary.stop.is_some(),
        html: run_page(&run, &shown, &plots, engine_of(&run)?.as_ref()).html(),
    })
}

fn study_now(folder: &StudyFolder) -> Result<PageNow, OutputError> {
    let results: StudyResults = folder.read_results()?;
    let plan = folder.plan();
    let rows = plan.runs.iter().zip(&results.rows);
    let runs: Vec<StudyRun> = rows.map(|(planned, row)| StudyRun::new(folder, planned, row)).collect();
    let styles = Styles::new(plan);
    let plots = study_plots(plan, &runs, &styles);
    let over = results.count(|state| matches!(state, RunState::Done | RunState::Failed { .. }));
    Ok(PageNow {
        html: study_page((plan, &results.population), &runs, &styles, &folder.study_text()?, &plots).html(),
        progress: format!("{over} of {} runs finished", runs.len()),
        is_over: over == runs.len(),
    })
}
