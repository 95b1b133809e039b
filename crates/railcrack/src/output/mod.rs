//! The run folder: tables as steps finish, a checkpoint, a summary, plots. Fields on meshes as files of VTK.
//!
//! This module reads results and writes files; nothing that computes knows it. Every file, column, unit and sign is
//! described in `docs/file-formats.md`.

mod checkpoint;
mod compare;
mod csv;
mod error;
mod fields;
mod figures;
mod folder;
mod leader;
mod memory;
mod paper;
pub(crate) mod plot;
mod recorder;
pub mod report;
mod residual;
mod shakedown;
mod shown;
mod story;
mod study;
mod summary;

pub use compare::{
    COMPARE_COLUMNS, COMPARE_POSITIONS_COLUMNS, CaseDifference, Comparison, Parting, RunLabel, SifDifference,
    TipComparison, TipSifs,
};
pub use csv::{FACES_COLUMNS, GROWTH_COLUMNS, RESIDUAL_COLUMNS, ResidualRow, SIF_COLUMNS};
pub use error::OutputError;
pub use folder::{CaseFiles, Existing, ROLLED_FOLDER};
pub use paper::{
    CurveRecord, DecisionRecord, FailureRecord, FigureRecord, NumberRecord, PaperRecord, SetupRecord,
    StatementRecord,
};
pub use recorder::{Recorder, RunInfo};
pub use residual::{ProjectionSummary, ReleaseSummary, ResidualSummary, RolledSummary};
pub use shakedown::{
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
