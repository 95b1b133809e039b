//! Rails and traffic of a case: engines, contact solvers, residual stress and wheels in the types
//! of the mechanics. The only room that knows the engines in the plane and that in space.

mod carried;
mod coarse_crack;
mod coarse_front;
mod coupling_estimate;
mod demand;
mod engine;
mod fields;
mod grouping;
mod layered;
mod plane;
mod prepared;
mod rates_across;
mod represented;
mod rolled;
mod shared;
mod size;
mod space;
mod space_demands;
mod wheel;
mod wheel_bounds;
mod wheel_demands;
mod wheel_patch;

pub use carried::{CarriedStress, CarriedStressError, Projection, Release, RolledStress, plastic_field};
pub use coupling_estimate::{EffectInPlane, uncoupled_gap};
pub use demand::{DemandError, WheelDemand};
pub use engine::{body_engine, finite_elements};
pub use layered::{LayeredStress, SectionStress};
pub use prepared::PreparedRun;
pub(crate) use prepared::known_straight;
pub use rates_across::rates_across;
pub use represented::{represented, represented_in};
pub use rolled::{
    HeaviestWheel, rail_in_space, rolled_rail, rolling_wheels, stabilisation, stabilisation_in_space,
};
pub use shared::{RailKey, SharedRail, SharedRailError};
pub use size::RunSize;
pub use wheel::{plane_field, wheel_field};
pub use wheel_bounds::{WheelBound, WheelBounds};
pub use wheel_demands::wheel_demands;
pub use wheel_patch::{patch_beside, rolls_on_patches, wheel_patches};
