//! The folder of a study: a run folder for each of its runs, one table of them, overlay plots.

mod folder;
mod outcome;
mod plan;
mod results;
mod state;
mod table;
mod write;

pub use folder::{Entry, StudyFolder};
pub use outcome::{Outcome, RunEnd};
pub use plan::{PlannedRun, StudyAxis, StudyKey, StudyPlan};
pub use results::StudyResults;
pub use state::{RunState, StudyRow};
pub use table::{StudySummaryRow, TimesRow};
