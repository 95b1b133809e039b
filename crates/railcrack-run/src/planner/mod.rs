//! The folder of `railcrack plan`: grinding depths and intervals, and what becomes of the rail.

mod document;
mod folder;
mod tables;

pub use document::{LeastGrinding, PlanOutcome, PlanSummary, PlannedGrinding};
pub(crate) use document::{civil, today};
pub use folder::PlanFolder;
pub(crate) use folder::write_plan;
pub use tables::PlanRow;
