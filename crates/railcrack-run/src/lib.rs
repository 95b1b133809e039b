//! Runs of railcrack: what `railcrack run`, `shakedown`, `sweep` and `compare` compute, the run
//! folder with its tables, checkpoint and summary, and how results are read back.
//!
//! Every file, column, unit and sign is described in `docs/file-formats.md`. Plots and pages are
//! made by a crate above this one ([`Presentation`]).

pub mod calibration;
pub mod compare;
pub mod contact;
pub mod csv;
pub mod decision;
pub mod description;
pub mod disk;
mod error;
mod fields;
#[cfg(fuzzing)]
pub mod fuzzing;
mod log;
pub mod machine;
pub mod numbers;
mod parquet;
pub mod planner;
mod population;
mod presentation;
pub mod run_folder;
pub mod setup;
pub mod shakedown;
pub mod simulation;
pub mod statistics;
pub mod study;
pub mod summary;
mod tables;
pub mod validation;
mod verify;

pub use compare::Comparison;
pub use csv::ResidualRow;
pub use disk::files;
pub use disk::{FolderLock, LOCK_FILE, VERSION};
pub use error::OutputError;
pub use fields::{FieldFile, field_file, field_files, field_grids};
pub use log::{
    PlasticOrigin, ProjectionSummary, ReleaseSummary, ResidualSummary, RolledSummary, RunInfo, WheelInfo,
};
pub use planner::{PlanFolder, PlanSummary};
pub use presentation::{Presentation, RunPresentation, TablesOnly};
pub use run_folder::{
    CaseFiles, Existing, OF_A_RUN, ResultFolder, ResultKind, RunFolder, Verification, WithRun, clear_run,
    is_file_of_run,
};
pub use shakedown::{ShakedownFolder, ShakedownSummary};
pub use simulation::Recorder;
pub use study::StudyFolder;
pub use summary::{
    CrackSummary, FractureSummary, FrontSummary, JunctionSummary, PhaseSeconds, PieceSummary, Summary,
    TipSummary,
};
pub use tables::table_descriptions;
pub use verify::verify;
