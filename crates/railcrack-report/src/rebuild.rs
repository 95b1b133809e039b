//! Plots and report of a results folder, built from its files or at the end of a computation.

use crate::built::{Built, FolderKind, put, write_run};
use crate::page_data::PageData;
use crate::pages::RunFolder;
use crate::recomputed::{Again, AtEnd, Collected, recomputed};
use railcrack_case::Output;
use railcrack_run::files::{REPORT_FILE, STUDY_PLOTS};
use railcrack_run::study::{StudyFolder, StudyResults};
use railcrack_run::{FolderLock, OutputError, Presentation, RunPresentation, TablesOnly};
use std::path::Path;

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
    let page_data = if run.lacks_samples() {
        let (page_data, decision) = recomputed(&run, Again::WithItsDecision)?;
        run.summary.decision = decision;
        page_data
    } else if !run.case.output.is_whole() {
        recomputed(&run, Again::StepsAlone)?.0
    } else {
        PageData::read(folder, run.summary.steps_recorded)?
    };
    write_run(&run, &page_data, Output::ALL)
}

/// The plots and pages of this crate, as a presentation of runs in progress.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Pages;

impl Presentation for Pages {
    fn run(&self, output: Output) -> Box<dyn RunPresentation> {
        if !output.is_shown() {
            return Box::new(TablesOnly);
        }
        Box::new(Collected::after(PageData::default(), AtEnd::Write(output)))
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
        Ok(Box::new(Collected::after(page_data, AtEnd::Write(output))))
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
