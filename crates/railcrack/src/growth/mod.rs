//! Passage → histories, increments, stops: the cracks step by step.

mod record;

pub use record::{
    CrackTip, FacePoint, FaceRecord, GrowthSettings, PassageRecord, PhaseTimes, RunStop, SolverCounts,
    StepRecord, TipRecord, TipStop, Warning,
};
