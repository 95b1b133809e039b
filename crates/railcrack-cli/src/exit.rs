//! Exit codes and failures of commands.

use railcrack::shakedown::ShakedownError;
use railcrack_case::CaseErrors;
use railcrack_run::OutputError;
use railcrack_run::machine::OverBudget;
use railcrack_run::setup::{CarriedStressError, DemandError};
use railcrack_run::simulation::RunError;
use std::path::PathBuf;
use std::process::ExitCode;
use thiserror::Error;

/// Outcome of the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Exit {
    /// Done.
    Done,
    /// Two runs differ by more than the given tolerance.
    Differs,
    /// The command line, the case file or a file named in it is invalid.
    BadInput,
    /// Something cannot be read or written.
    CannotReadOrWrite,
    /// No solution was found.
    NotConverged,
    /// Interrupted by the user; finished results are kept.
    Interrupted,
}

impl Exit {
    /// The exit code of the program.
    pub const fn code(self) -> u8 {
        match self {
            Self::Done => 0,
            Self::Differs => 1,
            Self::BadInput => 2,
            Self::NotConverged => 3,
            Self::CannotReadOrWrite => 4,
            Self::Interrupted => 130,
        }
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit.code())
    }
}

/// Failure of a command.
#[derive(Debug, Error)]
pub enum Failure {
    /// An invalid case.
    #[error("{0}")]
    Case(#[from] CaseErrors),
    /// A run that failed.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The results would replace an input of the command.
    #[error("{} is an input and would be replaced by the results: choose another place with --out", path.display())]
    InputReplaced {
        /// The input.
        path: PathBuf,
    },
    /// Measurements, or a case that cannot be calibrated.
    #[error("{reason}")]
    Calibration {
        /// The fault and its location.
        reason: String,
    },
    /// A passage that cannot be computed.
    #[error(transparent)]
    Demand(#[from] DemandError),
    /// A build without support for PNG files.
    #[cfg(not(feature = "png"))]
    #[error(
        "this build of railcrack cannot draw PNG files; install one that can: \
         cargo install --path crates/railcrack-cli --features png"
    )]
    NoPng,
    /// A run that exceeds the resources of the machine.
    #[error(transparent)]
    OverBudget(#[from] OverBudget),
    /// An existing file.
    #[error("{} already exists; --force replaces it", path.display())]
    Exists {
        /// The file.
        path: PathBuf,
    },
    /// A folder that cannot be read.
    #[error("cannot read the folder {}: {source}", path.display())]
    CannotRead {
        /// The folder.
        path: PathBuf,
        /// Error of the operating system.
        source: std::io::Error,
    },
    /// A file that cannot be written.
    #[error("cannot write {}: {source}", path.display())]
    CannotWrite {
        /// The file.
        path: PathBuf,
        /// Error of the operating system.
        source: std::io::Error,
    },
    /// Standard input that cannot be read.
    #[error("cannot read the case from standard input: {0}")]
    Stdin(std::io::Error),
    /// A table that cannot be shown.
    #[error("{0}")]
    Show(String),
    /// Standard output that cannot be written.
    #[error("cannot write to standard output: {0}")]
    Stdout(std::io::Error),
}

impl Failure {
    /// The exit code of this failure.
    pub fn exit(&self) -> Exit {
        match self {
            Self::Case(_) | Self::Calibration { .. } | Self::OverBudget(_) | Self::InputReplaced { .. } => {
                Exit::BadInput
            }
            Self::Run(error) => exit_of_run(error),
            Self::Demand(DemandError::Stress(CarriedStressError::Field(_))) => Exit::BadInput,
            Self::Demand(_) => Exit::NotConverged,
            #[cfg(not(feature = "png"))]
            Self::NoPng => Exit::BadInput,
            Self::Show(_) => Exit::BadInput,
            Self::Stdin(_)
            | Self::Exists { .. }
            | Self::CannotRead { .. }
            | Self::CannotWrite { .. }
            | Self::Stdout(_) => Exit::CannotReadOrWrite,
        }
    }
}

/// The exit code of a failed run.
fn exit_of_run(error: &RunError) -> Exit {
    match error {
        RunError::Output(error) => match error {
            OutputError::HoldsRun { .. }
            | OutputError::NoRun { .. }
            | OutputError::NotARun { .. }
            | OutputError::NoPageEngine { .. }
            | OutputError::NothingToReport { .. }
            | OutputError::NoFolder { .. }
            | OutputError::HoldsResults { .. }
            | OutputError::OtherResults { .. }
            | OutputError::HoldsStudy { .. }
            | OutputError::NoStudy { .. }
            | OutputError::StudyChanged { .. }
            | OutputError::OtherStudy { .. }
            | OutputError::InTheWay { .. }
            | OutputError::CaseChanged { .. }
            | OutputError::NoSif { .. }
            | OutputError::OtherVersion { .. } => Exit::BadInput,
            OutputError::NotFinite { .. } | OutputError::Field(_) => Exit::NotConverged,
            OutputError::InUse { .. }
            | OutputError::DamagedRuns { .. }
            | OutputError::DamagedPack { .. }
            | OutputError::NotRecomputed { .. }
            | OutputError::Damaged { .. }
            | OutputError::BadPageEngine { .. }
            | OutputError::NameLeaves { .. }
            | OutputError::Io { .. } => Exit::CannotReadOrWrite,
        },
        RunError::Rolled(_) | RunError::System { .. } => Exit::CannotReadOrWrite,
        RunError::Plan(_) | RunError::Residual(CarriedStressError::Field(_)) => Exit::BadInput,
        RunError::Residual(_)
        | RunError::Growth(_)
        | RunError::NoLayers
        | RunError::Shakedown(ShakedownError::NotConverged { .. }) => Exit::NotConverged,
        RunError::Shakedown(_) => Exit::BadInput,
    }
}
