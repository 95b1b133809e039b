//! Dense matrices, stored row by row, and kernels over slices of numbers.

use pulp::{Arch, Simd, WithSimd};
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

/// Partial sums of a scalar product: as many as the widest vector unit needs to hide the latency of
/// an addition.
const SUMS: usize = 8;

/// Scalar product.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    Arch::new().dispatch(Dot { a, b })
}

/// y += a x.
pub(crate) fn axpy(a: f64, x: &[f64], y: &mut [f64]) {
    Arch::new().dispatch(Axpy { a, x, y });
}

/// Rows added in one pass over the sum.
const ROWS: usize = 4;

/// Components of the sums of a pass over the rows: those of a dozen sums fit into the fastest
/// memory.
const COLUMNS: usize = 256;

/// y += Σ weights_i rows(i) for each of `ys`, each with its own weights; every row is read once.
/// Rows and sums have the same length.
pub(crate) fn add_rows_to_each<'m>(
    weights: &[impl AsRef<[f64]>],
    rows: impl Fn(usize) -> &'m [f64],
    ys: &mut [impl AsMut<[f64]>],
) {
    Arch::new().dispatch(AddRows { weights, rows, ys });
}

struct Dot<'a> {
    a: &'a [f64],
    b: &'a [f64],
}

impl WithSimd for Dot<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> f64 {
        inlined::dot(self.a, self.b)
    }
}

struct Axpy<'a> {
    a: f64,
    x: &'a [f64],
    y: &'a mut [f64],
}

impl WithSimd for Axpy<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        inlined::axpy(self.a, self.x, self.y);
    }
}

struct AddRows<'a, W, R, Y> {
    weights: &'a [W],
    rows: R,
    ys: &'a mut [Y],
}

impl<'m, W: AsRef<[f64]>, R: Fn(usize) -> &'m [f64], Y: AsMut<[f64]>> WithSimd for AddRows<'_, W, R, Y> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let count = self.weights.iter().map(|weights| weights.as_ref().len()).min().unwrap_or(0);
        let length = self.ys.iter_mut().map(|y| y.as_mut().len()).max().unwrap_or(0);
        let rest = count - count % ROWS;
        for from in (0..length).step_by(COLUMNS) {
            let columns = from..(from + COLUMNS).min(length);
            for first in (0..rest).step_by(ROWS) {
                let [x, z, u, v] = [0, 1, 2, 3].map(|k| &(self.rows)(first + k)[columns.clone()]);
                for (weights, y) in self.weights.iter().zip(self.ys.iter_mut()) {
                    let [a, b, c, d] = weights.as_ref().as_chunks::<ROWS>().0[first / ROWS];
                    let y = y.as_mut()[columns.clone()].iter_mut();
                    for ((((y, x), z), u), v) in y.zip(x).zip(z).zip(u).zip(v) {
                        *y = (((*y + a * x) + b * z) + c * u) + d * v;
                    }
                }
            }
            for k in rest..count {
                let x = &(self.rows)(k)[columns.clone()];
                for (weights, y) in self.weights.iter().zip(self.ys.iter_mut()) {
                    inlined::axpy(weights.as_ref()[k], x, &mut y.as_mut()[columns.clone()]);
                }
            }
        }
    }
}

/// The same kernels for inlining into a larger loop compiled for the vector unit, since a call
/// costs more than short vectors gain.
pub(crate) mod inlined {
    use super::SUMS;

    /// Scalar product.
    #[inline(always)]
    pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
        let mut sums = [0.0; SUMS];
        let (a_blocks, a_rest) = a.as_chunks::<SUMS>();
        let (b_blocks, b_rest) = b.as_chunks::<SUMS>();
        for (x, y) in a_blocks.iter().zip(b_blocks) {
            for k in 0..SUMS {
                sums[k] += x[k] * y[k];
            }
        }
        for (sum, (x, y)) in sums.iter_mut().zip(a_rest.iter().zip(b_rest)) {
            *sum += x * y;
        }
        let mut width = SUMS / 2;
        while width > 0 {
            for k in 0..width {
                sums[k] += sums[k + width];
            }
            width /= 2;
        }
        sums[0]
    }

    /// y += a x.
    #[inline(always)]
    pub(crate) fn axpy(a: f64, x: &[f64], y: &mut [f64]) {
        for (y, x) in y.iter_mut().zip(x) {
            *y += a * x;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agree_with_plain_loops() {
        for n in [0, 1, 7, 8, 15, 16, 17, 40, 100, 256, 700] {
            let a: Vec<f64> = (0..n).map(|i| (i as f64 * 0.7).sin()).collect();
            let b: Vec<f64> = (0..n).map(|i| (i as f64 * 1.3).cos()).collect();
            let plain: f64 = a.iter().zip(&b).map(|(x, y)| x * y).sum();
            assert!((dot(&a, &b) - plain).abs() < 1e-14 * (1.0 + n as f64), "{n}");
            let mut once = b.clone();
            for (weight, row) in [(2.0, &a), (-3.0, &b), (0.5, &a), (1.5, &b), (-0.5, &a)] {
                axpy(weight, row, &mut once);
            }
            let rows = [&a, &b, &a, &b, &a];
            let weights = [2.0, -3.0, 0.5, 1.5, -0.5];
            let (mut one, mut other) = (b.clone(), a.clone());
            add_rows_to_each(&[weights, [0.0; 5]], |k| rows[k], &mut [&mut one, &mut other]);
            assert_eq!([&one, &other], [&once, &a]);
            assert!(once.iter().zip(&a).zip(&b).all(|((y, a), b)| (y - (2.0 * a - 0.5 * b)).abs() < 1e-14));
        }
    }
}
