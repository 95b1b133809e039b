//! Growth of cracks step by step, in the plane and in space: from passages over fixed cracks to
//! increments and stops.

mod advance;
mod control;
#[cfg(test)]
mod control_tests;
mod cycles;
mod deferred;
mod earlier;
mod error;
mod field_record;
mod front;
mod front_deviation;
mod geometry;
mod growth_loop;
mod history;
mod judge;
#[cfg(test)]
mod loop_tests;
mod maintenance;
mod mix;
mod mover;
mod network_contact;
mod observer;
mod pace;
mod passage_record;
mod piece;
mod pop_in_test;
mod positions;
mod rail;
mod record;
mod repeat;
mod settings;
mod stabilised;
mod state;
mod step_source;
mod step_start;
mod stop;
mod stops;
mod surface;
mod sweeps;
mod turning;
mod warning;
mod warnings;
mod wheel_shares;

pub use advance::{Advance, StepProgress};
pub use control::Course;
pub(crate) use control::LOCATED;
pub use cycles::Interval;
pub use deferred::DeferredGrowth;
pub use earlier::EarlierStep;
pub use error::GrowthError;
pub use field_record::{FieldRecord, FieldSettings, FieldSnapshot};
pub use front::{FaceAcross, FrontMotion, FrontShape, FrontTip, MouthStrip};
pub use front_deviation::FrontDeviation;
pub use geometry::{Geometry, PlaneGeometry, SpaceGeometry, TipCourse};
pub use growth_loop::Growth;
pub use judge::TipJudge;
pub use maintenance::{Grinding, Maintenance, StressMoves};
pub use mover::Mover;
pub use network_contact::NetworkContact;
pub use observer::{Observer, Unobserved};
pub use passage_record::{FaceRecord, PassageRecord, SolverCounts};
pub use piece::{Piece, PieceKind};
pub use pop_in_test::PopInTest;
pub use positions::output_positions;
pub use rail::{BodyReport, CrackedRail, WheelOfRail};
pub use record::{PhaseTimes, PlaneTip, StepRecord, TipGeometry, TipRecord};
pub use settings::{GrowthSettings, PassageSettings};
pub use stabilised::{GroupsError, Overlap, PassageError, StabilisedPassage};
pub use state::GrowthState;
pub use step_source::StepSource;
pub use step_start::StepStart;
pub use stop::{BreakOut, RunStop, TipStop};
pub use surface::WornSurface;
pub use turning::{Jump, Turn, Turning};
pub use warning::{Warning, WarningKind};
pub use warnings::NEAR_TIE;
pub use wheel_shares::{MOST_WHEELS, WheelShares};

pub(crate) use maintenance::Uncovered;
pub(crate) use mix::{MixedTip, WheelDemand, WithoutProgress, under_each_wheel};
pub(crate) use pace::{Event, LEAST_PART, Moving, Pace, WearingCrack, is_worth_a_step};
pub(crate) use repeat::{Memory, Repeated, Repeats, until_repeated};
pub(crate) use stops::{
    ChangingCrack, TipDemand, least_length, nothing_grows, run_stop, spent_ligament, standstill,
};
pub(crate) use sweeps::{KEPT, SweepError, SweepProgress};
