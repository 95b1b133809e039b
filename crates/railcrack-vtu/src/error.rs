//! Errors of reading and writing VTK files.

use railcrack::mesh::GridError;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Errors of reading or writing a grid.
#[derive(Debug, Error)]
pub enum VtuError {
    /// An error of the operating system.
    #[error("cannot {action} {}: {reason}", path.display())]
    Io {
        /// The attempted action.
        action: &'static str,
        /// The file.
        path: PathBuf,
        /// The system's reason.
        reason: std::io::Error,
    },
    /// An inconsistent grid.
    #[error("{}: {reason}", path.display())]
    Grid {
        /// The file.
        path: PathBuf,
        /// The inconsistency.
        reason: GridError,
    },
    /// Contents that violate the format.
    #[error("{}: {part}: {reason}", path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// Element or array.
        part: String,
        /// The fault.
        reason: String,
    },
    /// A file of an unsupported kind.
    #[error("{}: {part} is {found}: {accepted}", path.display())]
    Unsupported {
        /// The file.
        path: PathBuf,
        /// Element, attribute or array.
        part: String,
        /// The value found.
        found: String,
        /// The supported values, or the remedy.
        accepted: &'static str,
    },
}

/// The fault of a part of a file, before the name of the file is known.
#[derive(Debug)]
pub(super) enum Fault {
    Malformed { part: String, reason: String },
    Unsupported { part: String, found: String, accepted: &'static str },
    Grid(GridError),
}

impl Fault {
    pub(super) fn malformed(part: impl Into<String>, reason: impl Into<String>) -> Self {
        Self::Malformed { part: part.into(), reason: reason.into() }
    }

    pub(super) fn unsupported(
        part: impl Into<String>,
        found: impl Into<String>,
        accepted: &'static str,
    ) -> Self {
        Self::Unsupported { part: part.into(), found: found.into(), accepted }
    }

    pub(super) fn of(self, path: &Path) -> VtuError {
        let path = path.to_path_buf();
        match self {
            Self::Malformed { part, reason } => VtuError::Malformed { path, part, reason },
            Self::Unsupported { part, found, accepted } => {
                VtuError::Unsupported { path, part, found, accepted }
            }
            Self::Grid(reason) => VtuError::Grid { path, reason },
        }
    }
}

impl From<GridError> for Fault {
    fn from(error: GridError) -> Self {
        Self::Grid(error)
    }
}
