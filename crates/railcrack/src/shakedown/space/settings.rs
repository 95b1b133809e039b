//! Settings of the stabilisation in space.

use super::choice::SpaceResolution;

/// Settings of the stabilisation in space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpaceStabilisation {
    /// Resolution in columns, rows and layers.
    pub resolution: SpaceResolution,
    /// Number of passages after which the rail counts as not stabilised.
    pub max_passes: usize,
    /// Change of the residual stress by a passage, over the largest residual stress left by
    /// passages, below which it counts as stabilised.
    pub pass_tolerance: f64,
}

impl Default for SpaceStabilisation {
    fn default() -> Self {
        Self { resolution: SpaceResolution::default(), max_passes: 500, pass_tolerance: 5e-4 }
    }
}
