//! Log of a run: facts of its case, its finished steps, its residual stress.

mod companion;
mod digest;
mod info;
mod residual;
mod steps;

pub(crate) use companion::{Companion, CompanionKind, Variation};
pub(crate) use digest::StepDigest;
pub use info::{RunInfo, WheelInfo};
pub use residual::{PlasticOrigin, ProjectionSummary, ReleaseSummary, ResidualSummary, RolledSummary};
pub(crate) use steps::{Present, RunLog};
