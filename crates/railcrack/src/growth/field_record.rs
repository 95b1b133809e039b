//! Stress and displacement around the cracks at some wheel positions.

use crate::body::FieldGrid;
use crate::math::{Stress, Vec2};
use std::num::NonZeroUsize;

/// Where and when fields are wanted.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldSettings {
    /// Wheel positions x_c, mm: of each, the nearest output position of the stabilised passage is
    /// taken.
    pub positions: Vec<f64>,
    /// Every how many steps, step 0 the first.
    pub every: NonZeroUsize,
}

/// The fields of one step.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldRecord {
    /// Where they are known.
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
    /// Displacement at each point of the grid, mm. Residual stress has none.
    pub displacement: Vec<Vec2>,
    /// Stress at each point of the grid, MPa.
    pub stress: Vec<Stress>,
    /// At the points of the crack faces, what the opposite face exerts, MPa; zero elsewhere.
    pub traction: Vec<Vec2>,
}
