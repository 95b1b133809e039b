//! The inverse of a small matrix that grows by rows and columns.

use crate::math::{axpy, dot};

/// S⁻¹, kept up to date as S gets a further row and column at its end.
#[derive(Debug, Default)]
pub(super) struct BorderedInverse {
    rows: Vec<Vec<f64>>,
}

impl Clone for BorderedInverse {
    fn clone(&self) -> Self {
        Self { rows: self.rows.clone() }
    }

    fn clone_from(&mut self, other: &Self) {
        self.rows.clone_from(&other.rows);
    }
}

impl BorderedInverse {
    /// Adds the row `below` and the column `beside` with `diagonal` at their end. False where the pivot is not above `singular` or an earlier one was
    /// not: the inverse is then of no use.
    pub(super) fn grow(&mut self, below: &[f64], beside: &[f64], diagonal: f64, singular: f64) -> bool {
        let column = self.times(beside);
        let mut row = vec![0.0; below.len()];
        for (weight, own) in below.iter().zip(&self.rows) {
            axpy(*weight, own, &mut row);
        }
        let pivot = diagonal - dot(below, &column);
        let sound = pivot.abs() > singular;
        let scale = 1.0 / pivot;
        for (own, c) in self.rows.iter_mut().zip(&column) {
            axpy(c * scale, &row, own);
            own.push(-c * scale);
        }
        row.iter_mut().for_each(|r| *r *= -scale);
        row.push(scale);
        self.rows.push(row);
        sound
    }

    /// S⁻¹ x.
    pub(super) fn times(&self, x: &[f64]) -> Vec<f64> {
        self.rows.iter().map(|row| dot(row, x)).collect()
    }

    /// Row `i` of S⁻¹.
    pub(super) fn row(&self, i: usize) -> &[f64] {
        &self.rows[i]
    }
}
