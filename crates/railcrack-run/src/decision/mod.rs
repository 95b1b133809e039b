//! From growth to a decision: failure, verdict, inspection interval, scatter.

mod act_on;
mod companions;
mod course;
mod events;
mod failure;
mod family;
mod governing;
mod inspection;
mod interval_words;
mod life_error;
mod path;
mod reason;
mod risk;
mod risk_summary;
mod rows;
mod run_end;
mod sampler;
mod scatter;
mod summary;
mod tonnage;
mod tornado;
mod verdict;
mod walk;
mod wheels;
mod window;

pub use act_on::{IntervalBasis, IntervalToActOn, RiskAtInterval};
pub(crate) use companions::{Companions, deciding, from_run};
pub use companions::{FrictionLife, PathLives, RowPartSummary};
pub(crate) use course::Course;
pub use course::FailureMode;
pub(crate) use events::Fate;
pub use failure::FailureSummary;
pub(crate) use failure::{Nominal, NominalRun, Question};
pub(crate) use family::Family;
pub use governing::DecisionPath;
pub use inspection::{InspectionSummary, StageSummary, StagesSummary};
pub use interval_words::interval_in_words;
pub(crate) use path::{GrowthPath, PathPoint};
pub use reason::{Reason, ReasonKind, VerdictLevel};
pub use risk::{DepthCurve, DetectionCurve, IntervalForTarget, Life, Risk};
pub use risk_summary::{RiskSummary, TargetKept};
pub use rows::{DecisionRow, MaintenanceSummary};
pub(crate) use sampler::{Draw, Draws, Sample, Sampler, Sampling};
pub use scatter::{
    CourseAccuracy, DepthQuantiles, FirstSample, Outlived, Quantiles, ScatterSummary, Sensitivity,
};
pub(crate) use scatter::{Gathered, tonnages};
pub use summary::Decision;
pub(crate) use summary::calibration;
pub use tonnage::{TonnageWords, three_digits};
pub use tornado::TornadoBar;
pub use verdict::Verdict;
pub(crate) use verdict::deepening;
pub(crate) use walk::Track;
pub use wheels::WheelSummary;
