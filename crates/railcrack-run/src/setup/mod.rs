//! Rails and traffic of a case: engines, contact solvers, residual stress and wheels in the types
//! of the mechanics. The only room that knows the engines in the plane and that in space.

mod carried;
mod coupling_estimate;
mod demand;
mod engine;
mod fields;
mod plane;
mod prepared;
mod rates_across;
mod rolled;
mod shared;
mod size;
mod space;
mod space_demands;
mod wheel;
mod wheel_demands;

pub use carried::{CarriedStress, CarriedStressError, Projection, Release, plastic_field};
pub use coupling_estimate::{EffectInPlane, unfelt_gap};
pub use demand::{DemandError, WheelDemand};
pub use engine::{body_engine, finite_elements};
pub use prepared::PreparedRun;
pub use rates_across::rates_across;
pub use rolled::{HeaviestWheel, contact_bounds, rolled_rail, stabilisation};
pub use shared::{RailKey, SharedRail, SharedRailError};
pub use size::RunSize;
pub use wheel_demands::wheel_demands;
