//! One row of the decision block.

use serde::{Deserialize, Serialize};

/// The crack at the start of a growth step.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct DecisionRow {
    /// Length, mm.
    pub length_mm: f64,
    /// Depth of the tip, mm.
    pub depth_mm: f64,
    /// Axles so far.
    pub axles: f64,
    /// Million gross tonnes so far.
    pub mgt: f64,
    /// Growth of the length, mm per million gross tonnes.
    pub length_mm_per_mgt: f64,
    /// Growth of the depth until the next step, mm per million gross tonnes; null in the last.
    pub depth_mm_per_mgt: Option<f64>,
    /// Removal of the surface by wear or grinding (mm per million gross tonnes) that takes as much
    /// from the mouth as the tip grows; null for a crack that is not open to the surface.
    pub balance_mm_per_mgt: Option<f64>,
}
