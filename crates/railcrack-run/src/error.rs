//! Errors of a run folder.

use railcrack_vtu::VtuError;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// A run folder that cannot be written, read or resumed.
#[derive(Debug, Error)]
pub enum OutputError {
    /// The folder already holds a run, and replacing it was not requested.
    #[error(
        "{} already holds a run ({file}): take it up again with `railcrack run --resume`, replace it with --force, or choose another folder with --out",
        folder.display()
    )]
    HoldsRun {
        /// The folder.
        folder: PathBuf,
        /// A file of the existing run.
        file: &'static str,
    },
    /// A page that is to compute, without the module that does.
    #[error(
        "a page that computes (`[output] explorer = true`) needs the file {file}, which is not there: looked for {}; the variable RAILCRACK_ENGINE names another place; releases have it, and in the sources `tools/web_module.sh {}` makes it",
        shown(places),
        places.last().and_then(|place| place.parent()).unwrap_or(Path::new("")).display()
    )]
    NoPageEngine {
        /// Its name.
        file: String,
        /// Where it was looked for.
        places: Vec<PathBuf>,
    },
    /// A file that is not the module with which a page computes.
    #[error("{}: {reason}; `RAILCRACK_ENGINE` must name the file of this version", path.display())]
    BadPageEngine {
        /// The file.
        path: PathBuf,
        /// The fault.
        reason: String,
    },
    /// A folder that is not that of a run.
    #[error("{} is not a run folder: it has no {file}", folder.display())]
    NotARun {
        /// The folder.
        folder: PathBuf,
        /// A file that every run has.
        file: &'static str,
    },
    /// A folder without results to report on.
    #[error(
        "{} holds no results to report on: a run folder has summary.json, a plastic state shakedown.json, a comparison compare.json",
        folder.display()
    )]
    NothingToReport {
        /// The folder.
        folder: PathBuf,
    },
    /// The folder already holds results of the command, and replacing these was not requested.
    #[error(
        "{} already holds results ({file}): replace them with --force, or choose another folder with --out",
        folder.display()
    )]
    HoldsResults {
        /// The folder.
        folder: PathBuf,
        /// A file of them that exists.
        file: String,
    },
    /// The folder holds results of another command.
    #[error("{} holds other results ({file}): choose another folder with --out", folder.display())]
    OtherResults {
        /// The folder.
        folder: PathBuf,
        /// A file by which they are known.
        file: &'static str,
    },
    /// The folder already holds a study, and neither resuming nor replacing it was requested.
    #[error(
        "{} already holds a study ({file}): go on with it with --resume, replace it with --force, or choose another folder with --out",
        folder.display()
    )]
    HoldsStudy {
        /// The folder.
        folder: PathBuf,
        /// A file of it that exists.
        file: String,
    },
    /// The folder has a file that would be replaced, and holds no results.
    #[error(
        "{} already has {file}, which would be replaced: move it, replace it with --force, or choose another folder with --out",
        folder.display()
    )]
    InTheWay {
        /// The folder.
        folder: PathBuf,
        /// The file.
        file: String,
    },
    /// There is no study to resume.
    #[error("{} holds no study to resume: start one without --resume, or name its folder with --out", folder.display())]
    NoStudy {
        /// The folder.
        folder: PathBuf,
    },
    /// The study differs from the one in the folder.
    #[error(
        "the study in {} differs ({difference}): use the study and options it was started with, replace it with --force, or choose another folder with --out",
        folder.display()
    )]
    StudyChanged {
        /// The folder.
        folder: PathBuf,
        /// The first difference.
        difference: String,
    },
    /// A file of packed runs holds one of another study.
    #[error(
        "{} holds run {number} of another study ({difference}): take the file out of the folder, or replace the study with --force",
        file.display()
    )]
    OtherStudy {
        /// The file.
        file: PathBuf,
        /// The number of the run.
        number: usize,
        /// The first difference of its case.
        difference: String,
    },
    /// There is no run to resume.
    #[error("{} holds no run to resume: start one without --resume, or name its folder with --out", folder.display())]
    NoRun {
        /// The folder.
        folder: PathBuf,
    },
    /// The case differs from that of the run in the folder.
    #[error(
        "the run in {} computes a different case (line {line} of its {file} differs: \"{stored}\" there, \"{given}\" now): resume with the case and options it was started with, or start again with --force",
        folder.display()
    )]
    CaseChanged {
        /// The folder.
        folder: PathBuf,
        /// `case.toml`, or a file that it names.
        file: String,
        /// The first line that differs, from 1.
        line: usize,
        /// That line in the folder.
        stored: String,
        /// That line now.
        given: String,
    },
    /// The run was written by another version of the program.
    #[error(
        "the run in {} was written by railcrack {written_by}, this is {this}: resume it with that version, or start again with --force",
        folder.display()
    )]
    OtherVersion {
        /// The folder.
        folder: PathBuf,
        /// The version that wrote it, or the version of its checkpoint format.
        written_by: String,
        /// This version.
        this: String,
    },
    /// A file of the run does not hold what a run writes.
    #[error("{}: {reason}; start the run again with --force", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The fault.
        reason: String,
    },
    /// Another process computes in the folder.
    #[error(
        "{} is being computed by another process{}: wait for it or stop it, or choose another folder with --out",
        folder.display(),
        process.map_or_else(String::new, |process| format!(" ({process})"))
    )]
    InUse {
        /// The folder.
        folder: PathBuf,
        /// Number of the process, if the system provides it.
        process: Option<u32>,
    },
    /// Runs of a study whose files are damaged; its results were gathered without them.
    #[error(
        "{}: the results leave out {} ({})",
        folder.display(),
        if *runs == 1 { "a damaged run".to_owned() } else { format!("{runs} damaged runs") },
        first
    )]
    DamagedRuns {
        /// The folder of the study.
        folder: PathBuf,
        /// How many.
        runs: usize,
        /// The fault of the first of them.
        first: String,
    },
    /// Files of packed runs that are damaged or belong to another study.
    #[error("{}: {first}{}", folder.display(), if *flaws == 1 { String::new() } else { format!(" (and {} more)", flaws - 1) })]
    DamagedPack {
        /// The folder of the study.
        folder: PathBuf,
        /// How many flaws.
        flaws: usize,
        /// The first of them.
        first: String,
    },
    /// There is no such folder.
    #[error("{}: there is no such folder", folder.display())]
    NoFolder {
        /// The folder.
        folder: PathBuf,
    },
    /// A file names something outside its folder.
    #[error(
        "{} names {name:?}, which is outside its folder: the program writes plain names only, so the file has been changed",
        file.display()
    )]
    NameLeaves {
        /// The file.
        file: PathBuf,
        /// The name in it.
        name: String,
    },
    /// Plots and page that need results that the run did not store.
    #[error(
        "plots and page of {} need more than its tables contain ([output]), and the run cannot be computed again: {reason}",
        folder.display()
    )]
    NotRecomputed {
        /// The run folder.
        folder: PathBuf,
        /// Why.
        reason: String,
    },
    /// Runs that cannot be compared: one has no K.
    #[error("{} has no sif.csv: its case has sif = \"none\" in [output]", folder.display())]
    NoSif {
        /// The run folder.
        folder: PathBuf,
    },
    /// A result that is not a finite number; nothing of its step is written.
    #[error("{file}: {column} = {value} in the row \"{row}...\": a result must be a finite number")]
    NotFinite {
        /// The table.
        file: &'static str,
        /// The column.
        column: &'static str,
        /// The beginning of the row, up to that column.
        row: String,
        /// The value.
        value: f64,
    },
    /// A field that cannot be written.
    #[error(transparent)]
    Field(VtuError),
    /// The system refused.
    #[error("cannot {action} {}: {reason}", path.display())]
    Io {
        /// The attempted action.
        action: &'static str,
        /// The file or folder.
        path: PathBuf,
        /// The system's reason.
        reason: std::io::Error,
    },
}

/// Paths in a sentence.
fn shown(places: &[PathBuf]) -> String {
    if places.is_empty() {
        return "nowhere, since the folder of the program is not known".to_owned();
    }
    places.iter().map(|place| place.display().to_string()).collect::<Vec<String>>().join(", ")
}

impl From<VtuError> for OutputError {
    fn from(error: VtuError) -> Self {
        match error {
            VtuError::Io { action, path, reason } => Self::Io { action, path, reason },
            other => Self::Field(other),
        }
    }
}

impl OutputError {
    /// Wraps the system's refusal to `action` the file or folder `path`.
    pub fn io(action: &'static str, path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.to_path_buf();
        move |reason| Self::Io { action, path, reason }
    }

    /// A file that does not hold what a run writes.
    pub fn damaged(path: &Path, reason: impl Into<String>) -> Self {
        Self::Damaged { path: path.to_path_buf(), reason: reason.into() }
    }
}
