//! Triangular factors of large unsymmetric dense matrices.

use super::LinearError;
use super::blocks::column_blocks;
use crate::math::Matrix;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::factor::{lu_in_place, lu_in_place_scratch};
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{solve_unit_lower_triangular_in_place, solve_upper_triangular_in_place};
use faer::prelude::{Reborrow, ReborrowMut};
use faer::{Accum, MatMut, MatRef, Par, Spec};
use rayon::prelude::*;

/// The triangular factors of a square matrix, by Gaussian elimination with partial pivoting in
/// panels of columns. The bits do not depend on the number of threads.
#[derive(Debug, Clone)]
pub(crate) struct LargeFactor {
    /// Row j is column j of the factors: U on and above the diagonal, L below, whose diagonal is
    /// one.
    columns: Matrix,
    /// The row of the matrix at each position.
    rows: Vec<usize>,
}

/// Columns that are eliminated together, and columns of the remainder that one thread updates
/// together: their sums do not depend on the thread.
const PANEL: usize = 64;
/// Pivots below this fraction of the largest entry count as zero.
const SINGULAR: f64 = 1e-12;

impl LargeFactor {
    /// Factors the matrix of which row j of `columns` is column j.
    ///
    /// Errors: a matrix that is not square; a pivot below 1e-12 of the largest entry.
    pub(crate) fn of_columns(mut columns: Matrix) -> Result<Self, LinearError> {
        let order = columns.rows();
        if columns.columns() != order {
            let quantity = "columns of a matrix to factor";
            return Err(LinearError::WrongLength { quantity, given: columns.columns(), expected: order });
        }
        let largest = columns.entries().iter().fold(0.0f64, |m, v| m.max(v.abs()));
        let mut rows: Vec<usize> = (0..order).collect();
        let mut all = MatMut::from_column_major_slice_mut(columns.entries_mut(), order, order);
        for start in (0..order).step_by(PANEL) {
            let width = PANEL.min(order - start);
            let (mut left, right) = all.rb_mut().split_at_col_mut(start);
            let (panel, rest) = right.split_at_col_mut(width);
            let mut panel = panel.get_mut(start.., ..);
            let below = order - start;
            let (mut forward, mut backward) = (vec![0usize; below], vec![0usize; below]);
            let scratch = lu_in_place_scratch::<usize, f64>(below, width, Par::Seq, Spec::default());
            let mut buffer = MemBuffer::new(scratch);
            let stack = MemStack::new(&mut buffer);
            lu_in_place(panel.rb_mut(), &mut forward, &mut backward, Par::Seq, stack, Spec::default());
            let permuted = |columns: MatMut<'_, f64>| {
                let mut columns = columns;
                let mut column = vec![0.0; below];
                for j in 0..columns.ncols() {
                    (0..below).for_each(|i| column[i] = columns[(start + forward[i], j)]);
                    (0..below).for_each(|i| columns[(start + i, j)] = column[i]);
                }
            };
            permuted(left.rb_mut());
            let before = rows[start..].to_vec();
            (0..below).for_each(|i| rows[start + i] = before[forward[i]]);
            let panel = panel.rb();
            column_blocks(rest, PANEL).for_each(|mut columns| {
                permuted(columns.rb_mut());
                let (mut own, under) = columns.get_mut(start.., ..).split_at_row_mut(width);
                solve_unit_lower_triangular_in_place(panel.get(..width, ..), own.rb_mut(), Par::Seq);
                matmul(under, Accum::Add, panel.get(width.., ..), own.rb(), -1.0, Par::Seq);
            });
        }
        let size = |k: usize| columns[(k, k)].abs();
        if (0..order).any(|k| size(k).is_nan() || size(k) <= SINGULAR * largest) {
            return Err(LinearError::Singular { order });
        }
        Ok(Self { columns, rows })
    }

    /// Number of unknowns.
    pub(crate) fn order(&self) -> usize {
        self.rows.len()
    }

    /// A⁻¹ b.
    ///
    /// Errors: a wrong length.
    pub(crate) fn solve(&self, right: &[f64]) -> Result<Vec<f64>, LinearError> {
        let order = self.order();
        if right.len() != order {
            let quantity = "entries of a right-hand side";
            return Err(LinearError::WrongLength { quantity, given: right.len(), expected: order });
        }
        let mut solution: Vec<f64> = self.rows.iter().map(|&row| right[row]).collect();
        let factors = MatRef::from_column_major_slice(self.columns.entries(), order, order);
        let mut unknowns = MatMut::from_column_major_slice_mut(&mut solution, order, 1);
        solve_unit_lower_triangular_in_place(factors, unknowns.rb_mut(), Par::Seq);
        solve_upper_triangular_in_place(factors, unknowns, Par::Seq);
        Ok(solution)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A zero diagonal: without row interchanges the first pivot is zero.
    fn entry(order: usize, i: usize, j: usize) -> f64 {
        let large = 40.0 * f64::from(i == (j + 1) % order);
        if i == j { 0.0 } else { large + ((5 * i * i + 3 * j) % 11) as f64 / 11.0 - 0.4 }
    }

    #[test]
    fn solutions_by_residual() {
        for order in [0, 1, 2, PANEL - 1, PANEL, 3 * PANEL + 7] {
            let entry = |i: usize, j: usize| if order == 1 { 3.0 } else { entry(order, i, j) };
            let right: Vec<f64> = (0..order).map(|i| (i as f64).sin()).collect();
            let factor = LargeFactor::of_columns(Matrix::from_fn(order, order, |j, i| entry(i, j))).unwrap();
            let solution = factor.solve(&right).unwrap();
            let product = Matrix::from_fn(order, order, entry).times(&solution);
            let gap = product.iter().zip(&right).fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
            assert!(gap < 1e-12, "{order}: {gap:e}");
            for threads in [1, 3] {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                let columns = Matrix::from_fn(order, order, |j, i| entry(i, j));
                let again = pool.install(|| LargeFactor::of_columns(columns).unwrap().solve(&right).unwrap());
                assert_eq!(solution, again, "{order}, {threads} threads");
            }
        }
    }

    #[test]
    fn refuses_what_it_cannot_factor() {
        let singular = Matrix::from_fn(3, 3, |i, j| ((i + 1) * (j + 1)) as f64);
        assert_eq!(LargeFactor::of_columns(singular).err(), Some(LinearError::Singular { order: 3 }));
        assert!(matches!(
            LargeFactor::of_columns(Matrix::zeros(2, 3)),
            Err(LinearError::WrongLength { given: 3, .. })
        ));
        let unit = LargeFactor::of_columns(Matrix::from_fn(2, 2, |i, j| f64::from(i == j))).unwrap();
        assert!(matches!(unit.solve(&[1.0; 3]), Err(LinearError::WrongLength { given: 3, .. })));
    }
}
