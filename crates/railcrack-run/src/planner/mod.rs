//! The folder of `railcrack plan`: grinding depths and intervals, and what becomes of the rail.

mod document;
mod folder;
mod tables;

pub(crate) use document::civil;
pub use document::{LeastGrinding, PlanOutcome, PlanSummary, PlannedGrinding};
pub use folder::PlanFolder;
pub(crate) use folder::write_plan;
pub use tables::PlanRow;
