//! Log of a run: facts of its case, its finished steps, its residual stress.

mod info;
mod residual;
mod steps;

pub use info::{MixInfo, RunInfo};
pub use residual::{PlasticOrigin, ProjectionSummary, ReleaseSummary, ResidualSummary, RolledSummary};
pub(crate) use steps::{Present, RunLog, StepDigest};
