//! From growth to a decision: depth over traffic, inspection interval, scatter.

mod inspection;
mod maintenance;
mod path;
mod row;
mod scatter;
mod summary;
mod walk;
mod wheels;

pub use inspection::{CriticalBy, InspectionSummary};
pub use maintenance::MaintenanceSummary;
pub use path::{GrowthPath, PathPoint};
pub use row::DecisionRow;
pub use scatter::{DepthQuantiles, Quantiles, Sampling, ScatterSummary, Sensitivity, sampled};
pub use summary::Decision;
pub use wheels::WheelSummary;
