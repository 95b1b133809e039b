//! Runs of railcrack: what `railcrack run`, `shakedown`, `sweep` and `compare` compute, the run
//! folder with its tables, checkpoint and summary, and how results are read back.
//!
//! Every file, column, unit and sign is described in `docs/file-formats.md`. Plots and pages are
//! made by someone above this crate ([`Presentation`]).

pub mod budget;
pub mod calibration;
mod case_files;
mod checkpoint;
mod checksum;
pub mod compare;
pub mod csv;
pub mod decision;
mod disk;
mod error;
#[cfg(test)]
mod fault_tests;
mod field_files;
mod field_names;
pub mod files;
pub mod folder;
pub mod histories;
mod lock;
mod memory;
mod parquet;
pub mod population;
mod presentation;
pub mod queue;
mod recorder;
pub mod representative;
mod residual;
mod run_folder;
mod run_info;
mod run_log;
mod same_case;
pub mod shakedown;
pub mod simulation;
mod space_fields;
mod stored_name;
pub mod study;
mod summary;
mod tables;
pub mod validity;
mod verify;
mod words;

pub use case_files::CaseFiles;
pub use compare::Comparison;
pub use csv::ResidualRow;
pub use error::OutputError;
pub use field_files::{field_file, field_grids};
pub use folder::Existing;
pub use lock::{FolderLock, LOCK_FILE};
pub use presentation::{Presentation, RunPresentation, TablesOnly};
pub use recorder::Recorder;
pub use residual::{PlasticOrigin, ProjectionSummary, ReleaseSummary, ResidualSummary, RolledSummary};
pub use run_folder::{FieldFile, RunFolder, field_files};
pub use run_info::{MixInfo, RunInfo};
pub use shakedown::{ShakedownFolder, ShakedownSummary};
pub use study::StudyFolder;
pub use summary::{
    CrackSummary, FractureSummary, FrontSummary, JunctionSummary, PhaseSeconds, PieceSummary, Summary,
    TipSummary,
};
pub use tables::table_descriptions;
pub use verify::{Verification, verify};

/// Version of the program that writes the files.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
