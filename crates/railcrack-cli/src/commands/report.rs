//! `railcrack report`.

use crate::exit::{Exit, Failure};
use crate::print;
use clap::Args;
use railcrack_report::{FolderKind, rebuild_report};
use railcrack_run::StudyFolder;
use railcrack_run::simulation::RunError;
use std::path::{Path, PathBuf};

/// Rebuild plots and HTML report of a folder from its files alone
///
/// The folder is that of a run, a plastic state, a comparison, grinding plans or a study. The
/// rebuilt files are identical to the original ones, byte for byte. For an interrupted run the
/// finished steps are shown, for an interrupted study the finished runs.
#[derive(Debug, Args)]
pub struct ReportArguments {
    /// Folder of results
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// For a study: build plots and report of run N, in the folder of that run
    #[arg(long, value_name = "N")]
    pub run: Option<usize>,
    /// Also draw every plot as a PNG file (in builds with the feature png)
    #[arg(long)]
    pub png: bool,
}

/// The folder of run `number` of the study in `folder`.
fn folder_of_run(folder: &Path, number: usize) -> Result<PathBuf, Failure> {
    let study = StudyFolder::open(folder).map_err(RunError::from)?;
    let runs = &study.plan().runs;
    let Some(run) = runs.iter().find(|run| run.number == number) else {
        return Err(Failure::Show(format!(
            "{} has runs 1 to {}, not {number}",
            folder.display(),
            runs.len()
        )));
    };
    Ok(study.unpacked(run).map_err(RunError::from)?)
}

/// Builds the report and prints its location.
pub fn report(arguments: &ReportArguments) -> Result<Exit, Failure> {
    let folder = &match arguments.run {
        Some(number) => folder_of_run(&arguments.folder, number)?,
        None => arguments.folder.clone(),
    };
    #[cfg(not(feature = "png"))]
    if arguments.png {
        return Err(Failure::NoPng);
    }
    let what = match rebuild_report(folder).map_err(RunError::from)? {
        FolderKind::Run => "run",
        FolderKind::Shakedown => "plastic state",
        FolderKind::Plan => "grinding plans",
        FolderKind::Comparison => "comparison",
        FolderKind::Study => "study",
    };
    print::stdout(&format!("report of the {what} in {}\n", folder.join("report.html").display()))?;
    #[cfg(feature = "png")]
    if arguments.png {
        let plots = crate::png::write_beside_plots(folder)?;
        print::stdout(&format!("{plots} plots also written as PNG\n"))?;
    }
    Ok(Exit::Done)
}
