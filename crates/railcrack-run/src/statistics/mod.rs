//! Distributions and scores of forecasts.

mod normal;
mod score;
mod student;

pub use normal::{density, distribution, log_density};
pub use score::{crps_of_normal, crps_of_samples, quantile_of_sorted};
pub use student::student;
