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

impl FieldSettings {
    /// Whether fields of `step` are recorded.
    pub(crate) fn are_due(&self, step: usize) -> bool {
        step.is_multiple_of(self.every.get())
    }

    /// Indices of the output positions `xc` (mm) nearest to those wanted, in increasing order
    /// without repetition.
    pub(crate) fn nearest(&self, xc: &[f64]) -> Vec<usize> {
        let distance = |i: usize, x: f64| (xc[i] - x).abs();
        let of = |&x: &f64| (0..xc.len()).min_by(|&i, &j| distance(i, x).total_cmp(&distance(j, x)));
        let mut chosen: Vec<usize> = self.positions.iter().filter_map(of).collect();
        chosen.sort_unstable();
        chosen.dedup();
        chosen
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_positions_once_and_in_order() {
        let nearest = |xc: &[f64], wanted: &[f64]| {
            FieldSettings { positions: wanted.to_vec(), every: NonZeroUsize::MIN }.nearest(xc)
        };
        let there = [-6.0, -3.0, 0.0, 3.0, 6.0];
        assert_eq!(nearest(&there, &[0.2, -1.0, -100.0, 5.0]), [0, 2, 4]);
        let back = [6.0, 3.0, 0.0, -3.0];
        assert_eq!(nearest(&back, &[-2.0, 2.9]), [1, 3]);
        assert!(nearest(&there, &[]).is_empty());
    }
}
