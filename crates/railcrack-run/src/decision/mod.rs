//! From growth to a decision: depth over traffic, inspection interval, scatter.

mod inspection;
mod path;
mod scatter;
mod summary;
mod wheels;

pub use inspection::{CriticalBy, InspectionSummary};
pub use path::{GrowthPath, PathPoint};
pub use scatter::{DepthQuantiles, Quantiles, ScatterSummary, Sensitivity, sampled};
pub use summary::{Decision, DecisionRow};
pub use wheels::WheelSummary;
