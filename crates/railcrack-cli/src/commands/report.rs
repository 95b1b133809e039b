//! `railcrack report`.

use crate::exit::{Exit, Failure};
use crate::print;
use clap::Args;
use railcrack_paper::STATEMENTS_FILE;
use railcrack_report::{FolderKind, rebuild_report};
use railcrack_run::StudyFolder;
use railcrack_run::simulation::RunError;
use std::path::{Path, PathBuf};

/// Build plots and HTML report of a folder again, from its files alone
///
/// The folder is that of a run, of a plastic state, of a comparison, of a study or of the paper.
/// What these commands wrote is built again bit for bit; of a run that was interrupted, the
/// finished steps are shown, and of a study the runs that are there.
#[derive(Debug, Args)]
pub struct ReportArguments {
    /// The folder
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// Of a study: make plots and report of run N, in its folder
    #[arg(long, value_name = "N")]
    pub run: Option<usize>,
    /// Draw every plot as a PNG file, too (in builds with the feature png)
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

/// Builds the report and says where it is.
pub fn report(arguments: &ReportArguments) -> Result<Exit, Failure> {
    let folder = &match arguments.run {
        Some(number) => folder_of_run(&arguments.folder, number)?,
        None => arguments.folder.clone(),
    };
    #[cfg(not(feature = "png"))]
    if arguments.png {
        return Err(Failure::NoPng);
    }
    let what = if folder.join(STATEMENTS_FILE).is_file() {
        railcrack_paper::rebuild_report(folder).map_err(RunError::from)?;
        "paper"
    } else {
        match rebuild_report(folder).map_err(RunError::from)? {
            FolderKind::Run => "run",
            FolderKind::Shakedown => "plastic state",
            FolderKind::Comparison => "comparison",
            FolderKind::Study => "study",
        }
    };
    print::stdout(&format!("report of the {what} in {}\n", folder.join("report.html").display()))?;
    #[cfg(feature = "png")]
    if arguments.png {
        let plots = crate::png::write_beside_plots(folder)?;
        print::stdout(&format!("{plots} plots as PNG beside their SVG files\n"))?;
    }
    Ok(Exit::Done)
}
