//! The folder of a study: a run folder for each of its runs, one table of them, overlay plots.

mod csv_text;
mod difference;
mod folder;
mod outcome;
mod packed;
mod packing;
mod plan;
mod population;
mod population_plan;
mod results;
mod state;
mod table;
mod tables;

pub use folder::{Entry, ExistingRuns, StudyFolder};
#[cfg(fuzzing)]
pub use packed::fuzz_packed;
pub use plan::{PlannedRun, StudyAxis, StudyKey, StudyPlan};
pub use population::{InterpolationError, Population};
pub(crate) use population_plan::distributions;
pub use population_plan::{Between, PopulationPlan};
pub use results::StudyResults;
pub use state::{RunState, StudyRow};
pub(crate) use table::listed_as_done;
pub use table::{StudySummaryRow, TimesRow};
