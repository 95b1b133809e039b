//! From growth to a decision: failure, verdict, inspection interval, scatter.

mod companions;
mod course;
mod failure;
mod family;
mod inspection;
mod life_error;
mod maintenance;
mod nominal_course;
mod path;
mod risk;
mod risk_summary;
mod row;
mod row_part;
mod sampler;
mod scatter;
mod stages;
mod summary;
mod tonnage;
mod verdict;
mod walk;
mod wheels;

pub(crate) use companions::slowed;
pub use companions::{FrictionLife, PathLives};
pub use course::{Course, CourseEnd, CourseEvent, CoursePoint, FailureMode};
pub use failure::FailureSummary;
pub(crate) use failure::{Nominal, Question};
pub(crate) use family::Family;
pub use inspection::InspectionSummary;
pub use maintenance::MaintenanceSummary;
pub(crate) use nominal_course::{course_of, question};
pub use path::{GrowthPath, PathPoint};
pub use risk::{DepthCurve, DetectionCurve, IntervalForTarget, Life, Risk};
pub use risk_summary::{RiskAtInterval, RiskSummary, TargetKept};
pub use row::DecisionRow;
pub use row_part::RowPartSummary;
pub(crate) use row_part::{deciding, from_run};
pub(crate) use sampler::{Draw, Draws, Sample, Sampler, Sampling};
pub use scatter::{
    CourseAccuracy, DepthQuantiles, FirstSample, Outlived, Quantiles, ScatterSummary, Sensitivity,
};
pub(crate) use scatter::{Gathered, tonnages};
pub use stages::{StageSummary, StagesSummary};
pub use summary::Decision;
pub(crate) use summary::{Judged, calibration, judged};
pub use tonnage::{TonnageWords, three_digits};
pub(crate) use verdict::deepening;
pub use verdict::{Reason, ReasonKind, Verdict, VerdictLevel};
pub(crate) use walk::{Fate, Track};
pub use wheels::WheelSummary;
