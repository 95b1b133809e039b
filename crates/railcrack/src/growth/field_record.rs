//! Stress and displacement around the cracks at some wheel positions.

use crate::body::FieldGrid;
use crate::math::{Stress, Vec2};
use std::num::NonZeroUsize;

/// Wheel positions and steps for which fields are recorded.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldSettings {
    /// Wheel positions x_c, mm; each is replaced by the nearest output position of the stabilised
    /// passage.
    pub positions: Vec<f64>,
    /// Interval between recorded steps, beginning with step 0.
    pub every: NonZeroUsize,
}

/// The fields of one step.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldRecord {
    /// The points at which they are known.
    pub grid: FieldGrid,
    /// One per wheel position, in the order of travel.
    pub snapshots: Vec<FieldSnapshot>,
}

/// The field with the wheel at one position.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldSnapshot {
    /// Output position of the stabilised passage, from 0.
    pub position: usize,
    /// x_c, mm.
    pub xc: f64,
    /// Displacement at each point of the grid, mm; residual stress contributes nothing to it.
    pub displacement: Vec<Vec2>,
    /// Stress at each point of the grid, MPa.
    pub stress: Vec<Stress>,
    /// At points of the crack faces, the traction exerted by the opposite face, MPa; zero
    /// elsewhere.
    pub traction: Vec<Vec2>,
}
