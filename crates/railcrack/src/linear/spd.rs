//! Dense Cholesky factors whose leading rows can be reused.

use super::LinearError;
use super::dense::factor_in_place;
use super::large::column_blocks;
use crate::interruption::Interruption;
use crate::math::Matrix;
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{solve_lower_triangular_in_place, solve_upper_triangular_in_place};
use faer::prelude::ReborrowMut;
use faer::{Accum, MatMut, MatRef, Par};
use rayon::prelude::*;
use std::sync::Arc;

/// The Cholesky factor K = L Lᵀ of a symmetric positive definite matrix.
///
/// It is computed in blocks of rows from the first row on. A row of L depends only on the rows of K
/// up to its own, so that a matrix with the same leading rows reuses their blocks, which are
/// shared.
#[derive(Debug, Clone, Default)]
pub(crate) struct SpdFactor {
    order: usize,
    blocks: Vec<Arc<FactorRows>>,
}

/// Some rows of L.
#[derive(Debug)]
struct FactorRows {
    start: usize,
    /// (start + w) × w: the rows are stored contiguously, in the order in which products read them;
    /// the entries above the diagonal are meaningless.
    rows: Matrix,
}

/// Rows of a block.
const BLOCK: usize = 96;
/// Number of rows that one thread solves together; their sums do not depend on the thread.
const TOGETHER: usize = 48;

impl SpdFactor {
    /// Factors a matrix of `order` unknowns: `fill(i, row)` adds the entries (i, 0) to (i, i) to
    /// the i + 1 zeros of `row`. The bits do not depend on the number of threads.
    ///
    /// Errors: a matrix that is not positive definite (the error gives the unknown).
    #[cfg(test)]
    pub(crate) fn new(order: usize, fill: impl Fn(usize, &mut [f64]) + Sync) -> Result<Self, LinearError> {
        Self::default().changed(0, order, Interruption::NEVER, fill)
    }

    /// [`SpdFactor::new`] of a matrix whose rows before `unchanged` are those of this one. The bits
    /// are those of a factorisation from scratch.
    ///
    /// Errors: a matrix that is not positive definite; an interruption.
    pub(crate) fn changed(
        mut self,
        unchanged: usize,
        order: usize,
        interruption: Interruption<'_>,
        fill: impl Fn(usize, &mut [f64]) + Sync,
    ) -> Result<Self, LinearError> {
        let first = self.kept(unchanged.min(order));
        let kept = first / BLOCK;
        self.blocks.truncate(kept);
        self.order = order;
        for (start, rows) in (first..order).step_by(BLOCK).zip(self.rows_from(first, interruption, fill)) {
            interruption.check()?;
            let block = self.block(start, kept, rows);
            self.blocks.push(Arc::new(
                block.map_err(|pivot| LinearError::NotPositiveDefinite { order, pivot: start + pivot })?,
            ));
        }
        Ok(self)
    }

    /// Number of rows that [`SpdFactor::changed`] reuses from this factor without requesting them,
    /// if the rows before `unchanged` are the same.
    pub(crate) fn kept(&self, unchanged: usize) -> usize {
        unchanged.min(self.order) / BLOCK * BLOCK
    }

    /// The rows of the matrix from `first` on in blocks, with the existing part of L applied to
    /// them.
    fn rows_from(
        &self,
        first: usize,
        interruption: Interruption<'_>,
        fill: impl Fn(usize, &mut [f64]) + Sync,
    ) -> Vec<Matrix> {
        let starts = (first..self.order).step_by(BLOCK);
        let width = |start: usize| BLOCK.min(self.order - start);
        let mut blocks: Vec<Matrix> =
            starts.map(|start| Matrix::zeros(width(start), start + width(start))).collect();
        blocks.par_iter_mut().enumerate().for_each(|(k, block)| {
            let stride = block.columns();
            block.entries_mut().par_chunks_mut(TOGETHER * stride).enumerate().for_each(|(chunk, rows)| {
                if interruption.asked() {
                    return;
                }
                for (i, row) in (first + k * BLOCK + chunk * TOGETHER..).zip(rows.chunks_exact_mut(stride)) {
                    fill(i, &mut row[..=i]);
                }
                forward(&self.blocks, rows, stride, 0);
            });
        });
        blocks
    }

    /// The block of L at `start` from its `rows` of the matrix, to which the first `applied` blocks
    /// are applied, or the index among them of a pivot that is not positive.
    fn block(&self, start: usize, applied: usize, mut rows: Matrix) -> Result<FactorRows, usize> {
        let (width, stride) = (rows.rows(), rows.columns());
        rows.entries_mut().par_chunks_mut(TOGETHER * stride).for_each(|rows| {
            forward(&self.blocks[applied..], rows, stride, 0);
        });
        let all = MatMut::from_row_major_slice_mut(rows.entries_mut(), width, stride);
        let (left, mut own) = all.split_at_col_mut(start);
        let left = left.as_ref();
        column_blocks(own.rb_mut(), TOGETHER).enumerate().for_each(|(chunk, columns)| {
            // The part on and below the diagonal.
            let from = chunk * TOGETHER;
            let across = left.get(from..from + columns.ncols(), ..).transpose();
            matmul(columns.get_mut(from.., ..), Accum::Add, left.get(from.., ..), across, -1.0, Par::Seq);
        });
        factor_in_place(own)?;
        Ok(FactorRows { start, rows: rows.transposed() })
    }

    /// L⁻¹ Bᵀ as rows, one for each row of `right` (r × order), so that their scalar products are B
    /// K⁻¹ Bᵀ. The leading zeros that neighbouring rows share are skipped.
    ///
    /// Errors: rows of a wrong length; an interruption.
    pub(crate) fn half_solve_rows(
        &self,
        mut right: Matrix,
        interruption: Interruption<'_>,
    ) -> Result<Matrix, LinearError> {
        let stride = right.columns();
        self.expect_length(stride)?;
        right.entries_mut().par_chunks_mut((TOGETHER * stride).max(1)).for_each(|rows| {
            if interruption.asked() {
                return;
            }
            let zeros = |row: &[f64]| row.iter().take_while(|value| **value == 0.0).count();
            let first = rows.chunks_exact(stride).map(zeros).min().unwrap_or(0) / BLOCK;
            forward(&self.blocks[first.min(self.blocks.len())..], rows, stride, first * BLOCK);
        });
        interruption.check()?;
        Ok(right)
    }

    /// L⁻ᵀ `half`, in place: K⁻¹ b from L⁻¹ b.
    ///
    /// Errors: a wrong length.
    pub(crate) fn back_solve(&self, half: &mut [f64]) -> Result<(), LinearError> {
        self.expect_length(half.len())?;
        let mut rest = MatMut::from_column_major_slice_mut(half, self.order, 1);
        for block in self.blocks.iter().rev() {
            let (before, mut own) = rest.rb_mut().split_at_row_mut(block.start);
            let mut own = own.rb_mut().get_mut(..block.width(), ..);
            solve_upper_triangular_in_place(block.diagonal().transpose(), own.rb_mut(), Par::Seq);
            let coupling = block.matrix().get(.., ..block.start).transpose();
            matmul(before, Accum::Add, coupling, own.as_ref(), -1.0, Par::Seq);
        }
        Ok(())
    }

    fn expect_length(&self, given: usize) -> Result<(), LinearError> {
        let expected = self.order;
        let quantity = "entries of a right-hand side";
        if given == expected { Ok(()) } else { Err(LinearError::WrongLength { quantity, given, expected }) }
    }
}

/// Forward substitution, L⁻¹ b, of right-hand sides as rows of `stride` entries, whose entries
/// before `first` are zero, for the unknowns of `blocks`. All previous blocks are applied already,
/// or multiply zeros only.
fn forward(blocks: &[Arc<FactorRows>], rows: &mut [f64], stride: usize, first: usize) {
    let mut all = MatMut::from_row_major_slice_mut(rows, rows.len() / stride, stride);
    for block in blocks {
        let (solved, right) = all.rb_mut().split_at_col_mut(block.start);
        let mut own = right.get_mut(.., ..block.width());
        let known = block.matrix().get(.., first..block.start).transpose();
        matmul(own.rb_mut(), Accum::Add, solved.as_ref().get(.., first..), known, -1.0, Par::Seq);
        solve_lower_triangular_in_place(block.diagonal(), own.transpose_mut(), Par::Seq);
    }
}

impl FactorRows {
    fn width(&self) -> usize {
        self.rows.columns()
    }

    /// Its rows, w × (start + w).
    fn matrix(&self) -> MatRef<'_, f64> {
        MatRef::from_column_major_slice(self.rows.entries(), self.width(), self.rows.rows())
    }

    /// The lower triangle at the diagonal.
    fn diagonal(&self) -> MatRef<'_, f64> {
        self.matrix().get(.., self.start..)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::{products_of_rows, spd_inverse};

    const ORDER: usize = 2 * BLOCK + 40;

    fn entry(i: usize, j: usize) -> f64 {
        let near = 1.0 / (1.0 + (i as f64 - j as f64).powi(2));
        near + if i == j { 1.0 + (i % 7) as f64 } else { 0.0 }
    }

    fn fill(i: usize, row: &mut [f64]) {
        row.iter_mut().enumerate().for_each(|(j, value)| *value += entry(i, j));
    }

    /// Right-hand sides in two groups, some of which begin with zeros.
    fn right() -> Matrix {
        let value = |i: usize, j: usize| if j < 9 * i { 0.0 } else { ((i + 2 * j) as f64).sin() };
        Matrix::from_fn(TOGETHER + 5, ORDER, value)
    }

    #[test]
    fn substitutions_agree_with_the_inverse() {
        let factor = SpdFactor::new(ORDER, fill).unwrap();
        let inverse = spd_inverse(&Matrix::from_fn(ORDER, ORDER, entry)).unwrap();
        let right = right();
        let half = factor.half_solve_rows(right.clone(), Interruption::NEVER).unwrap();
        let energies = products_of_rows(&half, Interruption::NEVER).unwrap();
        for i in 0..right.rows() {
            let solution = inverse.times(right.row(i));
            for j in 0..right.rows() {
                let want: f64 = right.row(j).iter().zip(&solution).map(|(b, x)| b * x).sum();
                assert!((energies[(j, i)] - want).abs() < 1e-11, "({j}, {i})");
            }
            let mut own = half.row(i).to_vec();
            factor.back_solve(&mut own).unwrap();
            let gap = own.iter().zip(&solution).fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
            assert!(gap < 1e-13, "{i}: {gap:e}");
        }
        assert!(factor.half_solve_rows(Matrix::zeros(1, 3), Interruption::NEVER).is_err());
        assert!(factor.back_solve(&mut [0.0]).is_err());
    }

    #[test]
    fn leading_rows_are_reused_bit_for_bit() {
        let right = right();
        let halves = |factor: &SpdFactor| factor.half_solve_rows(right.clone(), Interruption::NEVER).unwrap();
        let changed_from = BLOCK + 7;
        let other = |i: usize, row: &mut [f64]| {
            fill(i, row);
            if i >= changed_from {
                row[i - 3] += 0.25;
            }
        };
        let afresh = halves(&SpdFactor::new(ORDER, other).unwrap());
        let unchanged = SpdFactor::new(ORDER - 60, fill).unwrap();
        assert_ne!(halves(&SpdFactor::new(ORDER, fill).unwrap()), afresh);
        // Rows that are declared unchanged are not requested again.
        let guarded = |i: usize, row: &mut [f64]| {
            assert!(i >= BLOCK, "row {i}");
            other(i, row);
        };
        let changed = unchanged.changed(changed_from, ORDER, Interruption::NEVER, guarded).unwrap();
        assert_eq!(halves(&changed), afresh);
        for threads in [1, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| assert_eq!(halves(&SpdFactor::new(ORDER, other).unwrap()), afresh));
        }
    }

    #[test]
    fn a_pivot_that_is_not_positive_is_named() {
        for pivot in [3, BLOCK + 100] {
            let indefinite = |i: usize, row: &mut [f64]| {
                fill(i, row);
                if i == pivot {
                    row[i] = -1.0;
                }
            };
            let want = LinearError::NotPositiveDefinite { order: ORDER, pivot };
            assert_eq!(SpdFactor::new(ORDER, indefinite).unwrap_err(), want);
        }
    }
}
