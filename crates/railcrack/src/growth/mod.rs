//! Passage → histories, increments, stops: the cracks step by step.

mod driver;
mod passage;
mod record;

pub use driver::{Growth, GrowthError, GrowthState, Watch};
pub use passage::{PassageError, PassageSettings, RailLoad, StabilisedPassage, stabilised_passage};
pub use record::{
    CrackTip, FacePoint, FaceRecord, GrowthSettings, PassageRecord, PhaseTimes, RunStop, SolverCounts,
    StepRecord, TipRecord, TipStop, Warning,
};
