//! Exit codes, and what leads to them.

use railcrack::case::CaseErrors;
use std::path::PathBuf;
use std::process::ExitCode;
use thiserror::Error;

/// How the program ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Exit {
    /// What was asked for is done.
    Done,
    /// The command line, the case file or a file that it names is wrong.
    BadInput,
    /// Something cannot be read or written.
    CannotReadOrWrite,
    // `run` adds: not converged, 3; interrupted, 130.
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(match exit {
            Exit::Done => 0,
            Exit::BadInput => 2,
            Exit::CannotReadOrWrite => 4,
        })
    }
}

/// Why a command could not do its work.
#[derive(Debug, Error)]
pub enum Failure {
    /// A case that is wrong.
    #[error("{0}")]
    Case(#[from] CaseErrors),
    /// A file that is already there.
    #[error("{} is already there; --force replaces it", path.display())]
    Exists {
        /// The file.
        path: PathBuf,
    },
    /// A file that cannot be written.
    #[error("cannot write {}: {source}", path.display())]
    CannotWrite {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// Standard output that cannot be written.
    #[error("cannot write to standard output: {0}")]
    Stdout(std::io::Error),
}

impl Failure {
    /// The exit code of this failure.
    pub fn exit(&self) -> Exit {
        match self {
            Self::Case(_) => Exit::BadInput,
            Self::Exists { .. } | Self::CannotWrite { .. } | Self::Stdout(_) => Exit::CannotReadOrWrite,
        }
    }
}
