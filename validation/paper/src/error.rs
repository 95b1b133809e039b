//! Errors of the recomputed paper.

use railcrack::growth::GrowthError;
use railcrack::material::HardeningError;
use railcrack::shakedown::ShakedownError;
use railcrack_case::CaseErrors;
use railcrack_run::OutputError;
use railcrack_run::setup::CarriedStressError;
use std::path::PathBuf;
use thiserror::Error;

/// Why the paper could not be recomputed, or differs from its pages in the repository.
#[derive(Debug, Error)]
pub enum PaperError {
    /// A name that is no figure with results.
    #[error("`{given}` is not a figure with results: must be one of {accepted}")]
    UnknownFigure {
        /// The name given.
        given: String,
        /// The numbers accepted.
        accepted: String,
    },
    /// A file of figures, set-ups, statements or digitised curves that is refused.
    #[error("{}: {reason}", path.display())]
    Table {
        /// The file.
        path: PathBuf,
        /// The fault.
        reason: String,
    },
    /// A case that is refused.
    #[error(transparent)]
    Case(#[from] CaseErrors),
    /// A run that could not do its first step.
    #[error("{name}: {source}")]
    Run {
        /// The run.
        name: String,
        /// The reason.
        source: GrowthError,
    },
    /// A stress that the rail cannot carry.
    #[error("{name}: {source}")]
    Stress {
        /// The run.
        name: String,
        /// The reason.
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
    /// The system refuses to read or write.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// Lines of the pages in the repository that the program does not confirm.
    #[error("the pages in the repository differ from what was computed:\n{}", .0.join("\n"))]
    Differs(Vec<String>),
}
