//! The page of a folder whose results may still be computed.

use crate::built::{Built, FolderKind};
use crate::page_data::PageData;
use crate::pages::RunFolder;
use railcrack::growth::RunStop;
use railcrack::words::Choice;
use railcrack_run::study::{RunState, StudyResults};
use railcrack_run::{OutputError, StudyFolder};
use std::path::Path;

/// Snapshot of the page of a folder.
#[derive(Debug, Clone, PartialEq)]
pub struct LivePage {
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
pub fn live_page(folder: &Path) -> Result<LivePage, OutputError> {
    match FolderKind::of(folder)? {
        FolderKind::Run => run_now(folder),
        FolderKind::Study => study_now(&StudyFolder::open(folder)?),
        kind => {
            let html = Built::of_file(folder, kind)?.page.html();
            Ok(LivePage { html, progress: "complete".to_owned(), is_over: true })
        }
    }
}

fn run_now(folder: &Path) -> Result<LivePage, OutputError> {
    let run = RunFolder::read(folder)?;
    let summary = &run.summary;
    if !run.case.output.is_whole() {
        return Err(OutputError::NotRecomputed {
            folder: folder.to_path_buf(),
            reason: "its tables lack data that the page shows".to_owned(),
        });
    }
    let page_data = PageData::read(folder, summary.steps_recorded)?;
    Ok(LivePage {
        progress: match summary.stop.map(RunStop::word) {
            Some(stop) => format!("ended at step {}: {}", summary.steps, stop.replace('-', " ")),
            None => format!("step {} of {}", summary.steps, run.case.growth.steps),
        },
        is_over: summary.stop.is_some(),
        html: Built::of_run(&run, &page_data)?.page.html(),
    })
}

fn study_now(folder: &StudyFolder) -> Result<LivePage, OutputError> {
    let results: StudyResults = folder.read_results()?;
    let over = results.count(|state| matches!(state, RunState::Done | RunState::Failed { .. }));
    let count = folder.plan().runs.len();
    Ok(LivePage {
        html: Built::of_study(folder, &results)?.page.html(),
        progress: format!("{over} of {count} runs finished"),
        is_over: over == count,
    })
}
