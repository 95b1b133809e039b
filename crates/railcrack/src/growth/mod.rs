//! Passage → histories, increments, stops: the cracks step by step.

mod driver;
mod face_load;
mod fields;
#[cfg(test)]
mod fixtures;
mod increments;
mod joining;
mod meetings;
mod passage;
mod pieces;
mod record;
mod stops;
mod tip_sifs;
mod waiting;

pub use driver::NEAR_TIE;
pub use driver::{Growth, GrowthError, GrowthProblem, GrowthState, Unwatched, Watch};
pub use fields::{FieldRecord, FieldSettings, FieldSnapshot};
pub use increments::{Advance, StepState, TipAdvance, TipDrive, advance};
pub use passage::{PassageError, PassageSettings, RailLoad, StabilisedPassage, stabilised_passage};
pub use pieces::{Piece, PieceKind};
pub use record::{
    BreakOut, CrackTip, FacePoint, FaceRecord, GrowthSettings, PassageRecord, PhaseTimes, RunStop,
    SolverCounts, StepRecord, TipRecord, TipStop, Warning,
};
pub use stops::RailBox;
pub use waiting::WaitingGrowth;
