//! Errors of the recomputed paper.

use crate::files::PAGE;
use railcrack::growth::GrowthError;
use railcrack::material::HardeningError;
use railcrack::shakedown::ShakedownError;
use railcrack_case::CaseErrors;
use railcrack_run::OutputError;
use railcrack_run::setup::CarriedStressError;
use std::path::PathBuf;
use thiserror::Error;

/// Why the paper could not be recomputed.
#[derive(Debug, Error)]
pub enum PaperError {
    /// The folder holds an earlier one.
    #[error(
        "{} already contains results of the paper ({PAGE}): replace them with --force, reuse its runs with --resume, or choose another folder with --out",
        folder.display()
    )]
    Exists {
        /// The folder.
        folder: PathBuf,
    },
    /// A file of digitised curves that is refused.
    #[error("{}: {says}", path.display())]
    Overlay {
        /// The file.
        path: PathBuf,
        /// Why.
        says: String,
    },
    /// A case that is refused.
    #[error(transparent)]
    Case(#[from] CaseErrors),
    /// A run that could not do its first step.
    #[error("{name}: {source}")]
    Run {
        /// The run.
        name: String,
        /// Why.
        source: GrowthError,
    },
    /// A stress that the rail cannot carry.
    #[error("{name}: {source}")]
    Stress {
        /// The run.
        name: String,
        /// Why.
        source: CarriedStressError,
    },
    /// The plastic state of Fig. 21.
    #[error(transparent)]
    Shakedown(#[from] ShakedownError),
    /// A steel of Fig. 21.
    #[error(transparent)]
    Steel(#[from] HardeningError),
    /// The system refuses threads.
    #[error("cannot start threads: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// It was interrupted.
    #[error("interrupted")]
    Interrupted,
    /// The system refuses.
    #[error(transparent)]
    Output(#[from] OutputError),
}
