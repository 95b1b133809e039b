//! Errors of a run folder.

use railcrack_vtu::VtuError;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// A run folder that cannot be written, read or taken up again.
#[derive(Debug, Error)]
pub enum OutputError {
    /// The folder already holds a run, and nobody allowed to replace it.
    #[error(
        "{} already holds a run ({file}): take it up again with --resume, replace it with --force, or choose another folder with --out",
        folder.display()
    )]
    HoldsRun {
        /// The folder.
        folder: PathBuf,
        /// A file of the run that is there.
        file: &'static str,
    },
    /// A folder that is not that of a run.
    #[error("{} is not a run folder: it has no {file}", folder.display())]
    NotARun {
        /// The folder.
        folder: PathBuf,
        /// A file that every run has.
        file: &'static str,
    },
    /// A folder that holds nothing that a report shows.
    #[error(
        "{} holds nothing to report on: the folder of a run has summary.json, that of a plastic state shakedown.json, that of a comparison compare.json",
        folder.display()
    )]
    NothingToReport {
        /// The folder.
        folder: PathBuf,
    },
    /// The folder already holds a comparison, and nobody allowed to replace it.
    #[error(
        "{} already holds a comparison ({file}): replace it with --force, or choose another folder with --out",
        folder.display()
    )]
    HoldsComparison {
        /// The folder.
        folder: PathBuf,
        /// A file of it that is there.
        file: &'static str,
    },
    /// The folder already holds a study, and nobody allowed to go on with it or to replace it.
    #[error(
        "{} already holds a study ({file}): go on with it with --resume, replace it with --force, or choose another folder with --out",
        folder.display()
    )]
    HoldsStudy {
        /// The folder.
        folder: PathBuf,
        /// A file of it that is there.
        file: String,
    },
    /// There is no study to go on with.
    #[error("{} holds no study to resume: start one without --resume, or name its folder with --out", folder.display())]
    NoStudy {
        /// The folder.
        folder: PathBuf,
    },
    /// The study is not the one that the folder holds.
    #[error(
        "the study in {} is another one ({difference}): use the study and options it was begun with, replace it with --force, or choose another folder with --out",
        folder.display()
    )]
    StudyChanged {
        /// The folder.
        folder: PathBuf,
        /// The first difference.
        difference: String,
    },
    /// There is no run to take up again.
    #[error("{} holds no run to resume: start one without --resume, or name its folder with --out", folder.display())]
    NoRun {
        /// The folder.
        folder: PathBuf,
    },
    /// The case is not the one that the folder's run computes.
    #[error(
        "the run in {} computes another case (line {line} of its {file} differs: \"{stored}\" there, \"{given}\" now): resume with the case and options it was started with, or start afresh with --force",
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
        "the run in {} was written by railcrack {written_by}, this is {this}: resume it with that version, or start afresh with --force",
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
    #[error("{}: {reason}; start the run afresh with --force", path.display())]
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
        /// Number of the process, where the system tells.
        process: Option<u32>,
    },
    /// Runs of a study whose files are damaged; its results were gathered without them.
    #[error(
        "{}: the results are without {} ({})",
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
    /// There is no such folder.
    #[error("{}: there is no such folder", folder.display())]
    NoFolder {
        /// The folder.
        folder: PathBuf,
    },
    /// A file names something outside its folder.
    #[error(
        "{} names {name:?}, which leads out of its folder: the names in it are plain ones; the file has been changed",
        file.display()
    )]
    NameLeaves {
        /// The file.
        file: PathBuf,
        /// The name in it.
        name: String,
    },
    /// Plots and page that need what a run did not store.
    #[error(
        "plots and page of {} show more than its tables have ([output]), and it cannot be computed again: {reason}",
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
