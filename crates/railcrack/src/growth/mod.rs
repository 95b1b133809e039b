//! Growth of cracks step by step: from a passage over fixed cracks to histories of K, increments
//! and stops.

mod coalescence;
mod crack_fluid;
mod cycles;
mod deferred;
mod driver;
mod error;
mod face_load;
mod fields;
#[cfg(test)]
mod fixtures;
mod front;
mod increments;
mod joining;
mod judge;
mod maintenance;
mod mix;
mod observer;
mod pace;
mod passage;
mod passage_record;
mod pieces;
mod positions;
mod rail_load;
mod record;
mod settings;
mod solvers;
mod state;
mod step_state;
mod stop;
mod stops;
mod surface;
mod tip_sifs;
mod warning;
mod worn;

pub use crack_fluid::{CrackFluid, PressureProfile};
pub use cycles::Interval;
pub use deferred::DeferredGrowth;
pub use driver::{Growth, GrowthProblem, NEAR_TIE};
pub use error::GrowthError;
pub use fields::{FieldRecord, FieldSettings, FieldSnapshot};
pub use front::{
    FaceAcross, FrontInterval, FrontMotion, FrontRecord, FrontShape, FrontState, FrontTip,
};
pub use increments::{Advance, TipAdvance, advance};
pub use judge::TipJudge;
pub use maintenance::{Grinding, Maintenance, StressMoves};
pub use mix::{MOST_WHEELS, MixedWheel, WheelShares};
pub use observer::{Observer, Unobserved};
pub use passage::{PassageError, StabilisedPassage, stabilised_passage};
pub use passage_record::{FaceRecord, PassageRecord, SolverCounts};
pub use pieces::{Piece, PieceKind};
pub use positions::output_positions;
pub use rail_load::RailLoad;
pub use record::{PhaseTimes, StepRecord, TipRecord};
pub use settings::{GrowthSettings, PassageSettings};
pub use state::GrowthState;
pub use step_state::{StepState, TipDrive};
pub use stop::{BreakOut, RunStop, TipStop};
pub use surface::{EarlierRates, WornSurface};
pub use warning::{Warning, WarningKind};
