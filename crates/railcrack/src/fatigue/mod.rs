//! Growth rate and direction under non-proportional mixed mode.

mod law;

pub use law::{DirectionCriterion, ParisLaw};
