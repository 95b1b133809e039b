//! The case: reading, checking, and preparation of a run.

mod build;
mod carried;
#[expect(clippy::module_inception, reason = "the type gives its file the name")]
mod case;
mod coarse_crack;
mod coarse_front;
mod coupled;
mod coupling_estimate;
mod cracks;
mod engines;
mod finite_section;
mod fitted;
mod front_shape;
mod in_page;
mod known_sizes;
mod limits;
mod mix;
mod overrides;
mod prepared;
mod rates_across;
mod read;
mod read_wheel;
mod representatives;
mod rolling_patch;
mod row_scatter;
mod setting;
mod shared;
mod size;
mod space;
mod space_case;
mod space_demands;
mod wheel_demands;
mod wheel_table;
mod wheels_of_table;

pub use carried::{CarriedStress, CarriedStressError, Projection, Release};
pub use case::{Case, HeaviestWheel};
pub use coupling_estimate::EffectInPlane;
pub use fitted::{Coefficient, NoCoefficient, NoNumber};
pub use in_page::NotInPage;
pub use known_sizes::KnownSizes;
pub use mix::MixedWheel;
pub use overrides::Overrides;
pub use prepared::PreparedRun;
pub use shared::{RailKey, SharedRail, SharedRailError};
pub use size::RunSize;
pub use space_case::SpaceCase;
pub use wheel_demands::{DemandError, WheelDemand};
pub use wheel_table::{TabledWheel, WheelTable};

pub(crate) use build::build;
pub(crate) use setting::place_of;
