//! Growth of cracks step by step, in the plane and in space: from passages over fixed cracks to
//! increments and stops.

mod advance;
mod control;
#[cfg(test)]
mod control_tests;
mod front;
mod front_way;
mod geometry;
mod growth_loop;
mod history;
#[cfg(test)]
mod loop_tests;
mod mix;
mod positions;
mod rail;
mod record;
mod removal;
mod settings;
mod stabilised;
mod state;
mod step_size;
mod step_source;
mod step_start;
mod stop;
mod stops;
mod surface;
mod sweeps;
mod tonnage;
mod turning;
mod warning;
mod warnings;
mod wheel_shares;

pub use advance::{Advance, StepProgress};
pub use control::Course;
pub(crate) use control::LOCATED;
pub use front::{FaceAcross, FrontDeviation, FrontMotion, FrontShape, FrontTip};
pub use front_way::{FrontTurns, FrontWay};
pub use geometry::{Geometry, PlaneGeometry, SpaceGeometry, TipCourse};
pub use growth_loop::Growth;
pub use history::Interval;
pub use positions::output_positions;
pub use rail::{BodyReport, CrackedRail, Observer, TipJudge, Unobserved, WheelOfRail};
pub use record::{
    FaceRecord, FieldRecord, FieldSettings, FieldSnapshot, PassageRecord, PhaseTimes, Piece, PieceCause,
    PieceKind, PlaneTip, SolverCounts, StepRecord, TipGeometry, TipRecord,
};
pub use removal::{Grinding, StressMoves, SurfaceRemoval, THIN_FLAKE};
pub use settings::{Answer, GrowthSettings, PassageSettings};
pub use stabilised::{GroupsError, GrowthError, Overlap, PassageError, StabilisedPassage};
pub use state::GrowthState;
pub use step_source::StepSource;
pub use step_start::{EarlierStep, Mover, StepStart};
pub use stop::{BreakOut, RunStop, TipStop};
pub use surface::WornSurface;
pub use sweeps::NetworkContact;
pub use tonnage::{Axles, Mgt, Traffic};
pub use turning::{DeferredGrowth, Jump, Turn, Turning};
pub use warning::{PopInTest, Warning, WarningKind};
pub use warnings::NEAR_TIE;
pub use wheel_shares::{MOST_WHEELS, WheelShares};

pub(crate) use mix::{MixedTip, WheelDemand, WithoutProgress, under_each_wheel};
pub(crate) use removal::Uncovered;
pub(crate) use stabilised::{Memory, Repeated, Repeats, until_repeated};
pub(crate) use step_size::{Event, LEAST_PART, Moving, StepSize, WearingCrack, is_worth_a_step};
pub(crate) use stops::{
    ChangingCrack, LargestCracks, TipDemand, least_length, nothing_grows, run_stop, spent_ligament,
    standstill,
};
pub(crate) use sweeps::{KEPT, SweepError, SweepProgress};
