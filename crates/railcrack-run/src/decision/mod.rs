//! From growth to a decision: failure, verdict, inspection interval, scatter.

mod companions;
mod course;
mod events;
mod failure;
mod family;
mod inspection;
mod life_error;
mod maintenance;
mod nominal_run;
mod path;
mod risk;
mod risk_summary;
mod row_part;
mod rows;
mod sampler;
mod scatter;
mod stages;
mod summary;
mod tonnage;
mod verdict;
mod walk;
mod wheels;

pub(crate) use companions::Companions;
pub use companions::{FrictionLife, PathLives};
pub(crate) use course::Course;
pub use course::FailureMode;
pub(crate) use events::Fate;
pub use failure::FailureSummary;
pub(crate) use failure::{Nominal, Question};
pub(crate) use family::Family;
pub use inspection::InspectionSummary;
pub use maintenance::MaintenanceSummary;
pub(crate) use nominal_run::NominalRun;
pub use path::{GrowthPath, PathPoint};
pub use risk::{DepthCurve, DetectionCurve, IntervalForTarget, Life, Risk};
pub use risk_summary::{RiskAtInterval, RiskSummary, TargetKept};
pub use row_part::RowPartSummary;
pub(crate) use row_part::{deciding, from_run};
pub use rows::DecisionRow;
pub(crate) use sampler::{Draw, Draws, Sample, Sampler, Sampling};
pub use scatter::{
    CourseAccuracy, DepthQuantiles, FirstSample, Outlived, Quantiles, ScatterSummary, Sensitivity,
};
pub(crate) use scatter::{Gathered, tonnages};
pub use stages::{StageSummary, StagesSummary};
pub use summary::Decision;
pub(crate) use summary::calibration;
pub use tonnage::{TonnageWords, three_digits};
pub(crate) use verdict::deepening;
pub use verdict::{Reason, ReasonKind, Verdict, VerdictLevel};
pub(crate) use walk::Track;
pub use wheels::WheelSummary;
