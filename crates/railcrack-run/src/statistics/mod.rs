//! Student's distribution and scores of forecasts.

mod score;
mod student;

pub use score::{crps_of_normal, crps_of_samples, quantile_of_sorted};
pub use student::student;
