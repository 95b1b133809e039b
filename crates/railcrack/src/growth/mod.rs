//! Passage → histories, increments, stops: the cracks step by step.

mod driver;
mod record;

pub use driver::{Growth, GrowthError, GrowthState, Watch};
pub use record::{
    CrackTip, FacePoint, FaceRecord, GrowthSettings, PassageRecord, PhaseTimes, RunStop, SolverCounts,
    StepRecord, TipRecord, TipStop, Warning,
};
