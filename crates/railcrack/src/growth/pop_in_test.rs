//! The test of a kink in a rail whose toughness is not given.

use serde::{Deserialize, Serialize};

/// A real kink at the tip with the largest k1, in a rail whose toughness is not given: whether it
/// would arrest in a steel of the usual toughness. It has no effect on the run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PopInTest {
    /// The crack, from 0.
    pub crack: usize,
    /// The tip, from 0.
    pub tip: usize,
    /// The largest k1 of a virtual kink, MPa √mm.
    pub k1: f64,
    /// Its direction, radians.
    pub angle: f64,
    /// Length of the real kink, mm.
    pub length: f64,
    /// The largest k1 at its end, MPa √mm; `None` where the kinked crack cannot be computed.
    pub k1_after: Option<f64>,
}

impl PopInTest {
    /// Length of the kink by default, mm.
    pub const LENGTH: f64 = 2.0;

    /// Whether k1 at the end of the kink falls below `toughness` (MPa √mm).
    #[must_use]
    pub fn arrests(&self, toughness: f64) -> bool {
        self.k1_after.is_some_and(|k1| k1 < toughness)
    }
}
