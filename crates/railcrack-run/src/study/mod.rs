//! The folder of a study: a run folder for each of its runs, one table of them, overlay plots.

mod folder;
mod outcome;
mod plan;
mod results;
mod state;
mod table;

pub use folder::{Entry, StudyFolder};
pub use outcome::{Outcome, RunEnd};
pub use plan::{PlannedRun, StudyAxis, StudyKey, StudyPlan};
pub use results::StudyResults;
pub use state::{RunState, StudyRow};
pub use table::{STUDY_COLUMNS, TIMES_COLUMNS};

pub use folder::PLAN_FILE;
pub use outcome::OUTCOME_FILE;
pub use results::LeadingTip;
