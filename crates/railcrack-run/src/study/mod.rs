//! The folder of a study: a run folder for each of its runs, one table of them, overlay plots.

mod csv_text;
mod folder;
mod outcome;
mod packed;
mod plan;
mod results;
mod state;
mod table;
mod tables;
mod write;

pub use folder::{Entry, StudyFolder};
pub use outcome::{Outcome, RunEnd};
pub(crate) use packed::RunFiles;
pub use plan::{PlannedRun, StudyAxis, StudyKey, StudyPlan};
pub use results::StudyResults;
pub use state::{RunState, StudyRow};
pub use table::{StudySummaryRow, TimesRow};
