//! Passage → histories, increments, stops: the cracks step by step.

mod coalescence;
mod deferred;
mod driver;
mod face_load;
mod fields;
#[cfg(test)]
mod fixtures;
mod increments;
mod joining;
mod passage;
mod pieces;
mod record;
mod stops;
mod tip_sifs;

pub use deferred::DeferredGrowth;
pub use driver::{Growth, GrowthError, GrowthProblem, GrowthState, NEAR_TIE, Observer, Unobserved};
pub use fields::{FieldRecord, FieldSettings, FieldSnapshot};
pub use increments::{Advance, StepState, TipAdvance, TipDrive, advance};
pub use passage::{PassageError, PassageSettings, RailLoad, StabilisedPassage, stabilised_passage};
pub use pieces::{Piece, PieceKind};
pub use record::{
    BreakOut, FaceRecord, GrowthSettings, PassageRecord, PhaseTimes, RunStop, SolverCounts, StepRecord,
    TipRecord, TipStop, Warning, WarningKind,
};
pub use stops::RailBox;
