//! The running surface under wear and grinding.

use serde::{Deserialize, Serialize};

/// The removal of the running surface so far.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct WornSurface {
    /// Depth removed since the beginning, mm.
    pub removed: f64,
    /// Number of grindings so far.
    pub grindings: usize,
    /// The greatest length that each crack has had, mm.
    pub longest: Vec<f64>,
}

impl WornSurface {
    /// The greatest length (mm) that crack `crack` (from 0), now `length` (mm) long, has had.
    pub(crate) fn longest_of(&self, crack: usize, length: f64) -> f64 {
        self.longest.get(crack).copied().unwrap_or(0.0).max(length)
    }
}
