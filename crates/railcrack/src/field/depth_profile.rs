//! A balanced residual stress that depends on depth alone.

use super::StressField;
use crate::math::{Stress, Vec2};
use thiserror::Error;

/// An invalid profile.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ProfileError {
    /// No rows.
    #[error("a profile needs at least one row")]
    Empty,
    /// A value that is not finite.
    #[error("row {row}: {quantity} = {value} must be finite")]
    NotFinite {
        /// Row, from 1.
        row: usize,
        /// Which column.
        quantity: &'static str,
        /// The value given.
        value: f64,
    },
    /// A depth above the surface.
    #[error("row {row}: depth_mm = {value} must not be negative")]
    NegativeDepth {
        /// Row, from 1.
        row: usize,
        /// The value given, mm.
        value: f64,
    },
    /// Depths out of order.
    #[error("row {row}: depth_mm = {value} must exceed that of the row before")]
    NotIncreasing {
        /// Row, from 1.
        row: usize,
        /// The value given, mm.
        value: f64,
    },
}

/// σ_xx(d) and σ_zz(d) by depth d = −y, linear between rows, constant above the first row, zero
/// below the last; σ_yy = σ_xy = 0, so the field is in equilibrium.
#[derive(Debug, Clone, PartialEq)]
pub struct DepthProfile {
    rows: Vec<(f64, f64, f64)>,
}

impl DepthProfile {
    /// Rows (depth mm, σ_xx MPa, σ_zz MPa) by increasing depth.
    pub fn new(rows: Vec<(f64, f64, f64)>) -> Result<Self, ProfileError> {
        if rows.is_empty() {
            return Err(ProfileError::Empty);
        }
        for (i, &(depth, xx, zz)) in rows.iter().enumerate() {
            let row = i + 1;
            for (quantity, value) in [("depth_mm", depth), ("sxx_mpa", xx), ("szz_mpa", zz)] {
                if !value.is_finite() {
                    return Err(ProfileError::NotFinite { row, quantity, value });
                }
            }
            if depth < 0.0 {
                return Err(ProfileError::NegativeDepth { row, value: depth });
            }
            if i > 0 && depth <= rows[i - 1].0 {
                return Err(ProfileError::NotIncreasing { row, value: depth });
            }
        }
        Ok(Self { rows })
    }

    /// The rows (depth mm, σ_xx MPa, σ_zz MPa).
    pub fn rows(&self) -> &[(f64, f64, f64)] {
        &self.rows
    }
}

impl StressField for DepthProfile {
    fn stress(&self, point: Vec2) -> Stress {
        let depth = -point.y;
        let next = self.rows.partition_point(|row| row.0 < depth);
        let (xx, zz) = match (next.checked_sub(1).map(|i| self.rows[i]), self.rows.get(next)) {
            (_, None) => (0.0, 0.0),
            (None, Some(first)) => (first.1, first.2),
            (Some(above), Some(below)) => {
                let t = (depth - above.0) / (below.0 - above.0);
                (above.1 + t * (below.1 - above.1), above.2 + t * (below.2 - above.2))
            }
        };
        Stress { xx, zz, ..Stress::ZERO }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_between_rows_constant_above_zero_below() {
        let profile = DepthProfile::new(vec![(1.0, 10.0, 1.0), (3.0, -10.0, 3.0)]).unwrap();
        let xx = |depth: f64| profile.stress(Vec2::new(7.0, -depth)).xx;
        assert_eq!([xx(0.0), xx(1.0), xx(1.5), xx(3.0), xx(3.1)], [10.0, 10.0, 5.0, -10.0, 0.0]);
    }
}
