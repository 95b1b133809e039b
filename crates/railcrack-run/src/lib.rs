//! Runs of railcrack: what `railcrack run`, `shakedown`, `sweep` and `compare` compute, the run folder with its tables,
//! checkpoint and summary, and how results are read back.
//!
//! Every file, column, unit and sign is described in `docs/file-formats.md`. Plots and pages are made by someone above
//! this crate ([`Presentation`]).

mod checkpoint;
pub mod compare;
pub mod csv;
mod error;
pub mod fields;
pub mod folder;
pub mod histories;
pub mod leader;
mod memory;
mod presentation;
pub mod queue;
mod recorder;
mod residual;
pub mod rolled;
pub mod simulation;
mod story;
pub mod study;
mod summary;

pub use compare::{
    COMPARE_COLUMNS, COMPARE_POSITIONS_COLUMNS, CaseDifference, Comparison, Parting, RunLabel, SifDifference,
    TipComparison, TipSifs,
};
pub use csv::{FACES_COLUMNS, GROWTH_COLUMNS, RESIDUAL_COLUMNS, ResidualRow, SIF_COLUMNS};
pub use error::OutputError;
pub use folder::{CaseFiles, Existing, ROLLED_FOLDER};
pub use presentation::{Presentation, RunPresentation, TablesOnly};
pub use recorder::{Recorder, RunInfo};
pub use residual::{ProjectionSummary, ReleaseSummary, ResidualSummary, RolledSummary};
pub use rolled::{
    Extent, PASSES_COLUMNS, PLASTIC_FILE, PROFILE_COLUMNS, SHAKEDOWN_FILE, ShakedownRecorder,
    ShakedownResults, ShakedownSummary,
};
pub use study::{
    Entry, Outcome, PlannedRun, RunEnd, RunState, STUDY_COLUMNS, StudyAxis, StudyFolder, StudyKey, StudyPlan,
    StudyResults, StudyRow, TIMES_COLUMNS,
};
pub use summary::{CrackSummary, JunctionSummary, PhaseSeconds, PieceSummary, Summary, TipSummary};

/// Version of the program that writes the files.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
