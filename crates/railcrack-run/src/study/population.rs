//! A population of cracks: its quantiles and their accuracy.

use crate::decision::ScatterSummary;
use serde::{Deserialize, Serialize};

/// Relative error (per cent) of interpolated tonnages until critical, over runs that are left out.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct InterpolationError {
    /// Over how many runs.
    pub runs: usize,
    /// Root mean square, percent.
    pub rms_percent: f64,
    /// The largest, percent.
    pub worst_percent: f64,
    /// Explained fraction of the variance of the logarithm of these tonnages, at most 1.
    pub explained: f64,
}

/// Samples between the runs of a study that have the same values of the keys that are not drawn.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Population {
    /// These values: `friction = 0.1`; empty where all keys are drawn.
    pub choice: String,
    /// Runs between which paths are interpolated.
    pub runs: usize,
    /// Runs that are done, and whose path cannot be interpolated: the crack does not grow.
    pub left_out: usize,
    /// The error of the interpolation; null where no run gets from detectable to critical.
    pub error: Option<InterpolationError>,
    /// The inspection interval (million gross tonnes) at the means of all keys.
    pub interval_mgt: Option<f64>,
    /// The samples; null where they cannot be made.
    pub scatter: Option<ScatterSummary>,
    /// Reason why they cannot be made.
    pub reason: Option<String>,
}
