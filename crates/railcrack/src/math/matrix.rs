//! Dense matrices, stored row by row.

use super::dot;
use std::ops::{Index, IndexMut};

/// A dense real matrix stored row by row; `m[(i, j)]` is row i, column j, both from 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Matrix {
    rows: usize,
    columns: usize,
    entries: Vec<f64>,
}

impl Matrix {
    /// The zero matrix, `rows` × `columns`.
    pub fn zeros(rows: usize, columns: usize) -> Self {
        Self { rows, columns, entries: vec![0.0; rows * columns] }
    }

    /// The matrix whose entry (i, j) is `entry(i, j)`.
    pub fn from_fn(rows: usize, columns: usize, mut entry: impl FnMut(usize, usize) -> f64) -> Self {
        let mut entries = Vec::with_capacity(rows * columns);
        for i in 0..rows {
            entries.extend((0..columns).map(|j| entry(i, j)));
        }
        Self { rows, columns, entries }
    }

    /// The matrix with `entries`, row by row; none where they are not `rows` × `columns`.
    pub fn from_entries(rows: usize, columns: usize, entries: Vec<f64>) -> Option<Self> {
        (rows.checked_mul(columns) == Some(entries.len())).then_some(Self { rows, columns, entries })
    }

    /// All entries, row by row.
    pub fn into_entries(self) -> Vec<f64> {
        self.entries
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Row i as a slice of `columns` entries.
    pub fn row(&self, i: usize) -> &[f64] {
        &self.entries[i * self.columns..(i + 1) * self.columns]
    }

    /// Row i, mutable.
    pub fn row_mut(&mut self, i: usize) -> &mut [f64] {
        &mut self.entries[i * self.columns..(i + 1) * self.columns]
    }

    /// All entries, row by row.
    pub(crate) fn entries(&self) -> &[f64] {
        &self.entries
    }

    /// All entries, row by row, mutable.
    pub(crate) fn entries_mut(&mut self) -> &mut [f64] {
        &mut self.entries
    }

    /// Two different rows, the first to read and the second to write.
    pub(crate) fn row_pair(&mut self, read: usize, write: usize) -> (&[f64], &mut [f64]) {
        let (read, write) = self.row_pair_mut(read, write);
        (read, write)
    }

    /// Two different rows, both mutable.
    pub(crate) fn row_pair_mut(&mut self, one: usize, other: usize) -> (&mut [f64], &mut [f64]) {
        let columns = self.columns;
        let (before, after) = self.entries.split_at_mut(one.max(other) * columns);
        let lower = &mut before[one.min(other) * columns..][..columns];
        let upper = &mut after[..columns];
        if one < other { (lower, upper) } else { (upper, lower) }
    }

    /// The product with a column vector of `columns` entries.
    pub fn times(&self, vector: &[f64]) -> Vec<f64> {
        (0..self.rows).map(|i| dot(self.row(i), vector)).collect()
    }

    /// The transpose.
    pub fn transposed(&self) -> Self {
        Self::from_fn(self.columns, self.rows, |i, j| self[(j, i)])
    }
}

impl Index<(usize, usize)> for Matrix {
    type Output = f64;
    fn index(&self, (i, j): (usize, usize)) -> &f64 {
        &self.entries[i * self.columns + j]
    }
}

impl IndexMut<(usize, usize)> for Matrix {
    fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut f64 {
        &mut self.entries[i * self.columns + j]
    }
}
