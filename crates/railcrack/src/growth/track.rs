//! Histories of jumps and forces along the way of the wheel.

use crate::math::{Matrix, axpy};

/// Values at coordinates of a path, linear between them.
#[derive(Debug, Clone)]
pub(super) struct Track {
    /// The coordinates, in the order of travel.
    at: Vec<f64>,
    /// A row for each of them.
    values: Matrix,
}

impl Track {
    /// The rows of `values` at the coordinates `at`, in order.
    pub fn new(at: Vec<f64>, values: Matrix) -> Self {
        Self { at, values }
    }

    /// The coordinates.
    pub fn at(&self) -> &[f64] {
        &self.at
    }

    /// The values, a row for each coordinate.
    pub fn values(&self) -> &Matrix {
        &self.values
    }

    /// The rows before and after `at` with their weights.
    fn beside(&self, at: f64) -> [(usize, f64); 2] {
        let last = self.at.len() - 1;
        let travel = self.at[last] - self.at[0];
        let after = self.at.partition_point(|x| (x - at) * travel <= 0.0).clamp(1.min(last), last);
        let before = after.saturating_sub(1);
        let step = self.at[after] - self.at[before];
        let share = if step == 0.0 { 1.0 } else { ((at - self.at[before]) / step).clamp(0.0, 1.0) };
        [(before, 1.0 - share), (after, share)]
    }

    /// Adds the values at `at` to `sum`.
    pub fn add(&self, at: f64, sum: &mut [f64]) {
        for (row, share) in self.beside(at) {
            if share != 0.0 {
                axpy(share, self.values.row(row), sum);
            }
        }
    }

    /// The values at other coordinates, a row for each.
    pub fn resampled(&self, at: &[f64]) -> Matrix {
        let mut values = Matrix::zeros(at.len(), self.values.columns());
        for (i, &x) in at.iter().enumerate() {
            self.add(x, values.row_mut(i));
        }
        values
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_linear_between_coordinates_in_either_direction() {
        for travel in [1.0, -1.0] {
            let at: Vec<f64> = [0.0, 1.0, 4.0].iter().map(|x| travel * x).collect();
            let track = Track::new(at, Matrix::from_fn(3, 2, |i, c| [1.0, 3.0, 0.0][i] * (1.0 + c as f64)));
            let sample = [-1.0, 0.0, 0.5, 1.0, 2.0, 4.0, 9.0].map(|x| travel * x);
            let values = track.resampled(&sample);
            for (i, want) in [1.0, 1.0, 2.0, 3.0, 2.0, 0.0, 0.0].into_iter().enumerate() {
                assert!((values[(i, 0)] - want).abs() < 1e-15 && (values[(i, 1)] - 2.0 * want).abs() < 1e-15);
            }
        }
    }
}
