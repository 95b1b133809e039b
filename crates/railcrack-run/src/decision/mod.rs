//! From growth to a decision: depth over traffic, inspection interval, scatter.

mod inspection;
mod maintenance;
mod path;
mod row;
mod sampler;
mod scatter;
mod summary;
mod walk;
mod wheels;

pub use inspection::{CriticalBy, InspectionSummary};
pub use maintenance::MaintenanceSummary;
pub use path::{GrowthPath, PathPoint};
pub use row::DecisionRow;
pub use sampler::Sampling;
pub(crate) use sampler::{Draws, KEYS, Sampler};
pub use scatter::{DepthQuantiles, Quantiles, ScatterSummary, Sensitivity, sampled};
pub(crate) use scatter::{Gathered, spread, tonnages};
pub use summary::Decision;
pub use wheels::WheelSummary;
