//! From growth to a decision: depth over traffic, inspection interval, scatter.

mod inspection;
mod maintenance;
mod path;
mod scatter;
mod summary;
mod walk;
mod wheels;

pub use inspection::{CriticalBy, InspectionSummary};
pub use maintenance::MaintenanceSummary;
pub use path::{GrowthPath, PathPoint};
pub use scatter::{DepthQuantiles, Quantiles, Sampling, ScatterSummary, Sensitivity, sampled};
pub use summary::{Decision, DecisionRow};
pub use wheels::WheelSummary;
