//! Triangular factors of large unsymmetric dense matrices in single precision.

use super::LinearError;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::factor::{lu_in_place, lu_in_place_scratch};
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::solve_unit_lower_triangular_in_place;
use faer::prelude::{Reborrow, ReborrowMut};
use faer::{Accum, MatMut, Par, Spec};
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

/// The triangular factors of a square matrix in single precision, by Gaussian elimination with
/// partial pivoting in panels of columns. They precondition an iteration in double precision, whose
/// residual does not depend on theirs. The bits do not depend on the number of threads.
#[derive(Debug, Clone)]
pub(crate) struct LargeFactor {
    /// Columns of the factors, one after another: U on and above the diagonal, L below, whose
    /// diagonal is one.
    columns: Vec<f32>,
    /// The row of the matrix at each position.
    rows: Vec<usize>,
}

/// Columns that are eliminated together, and columns of the remainder that one thread updates
/// together: their sums do not depend on the thread.
const PANEL: usize = 64;

impl LargeFactor {
    /// Factors the matrix of `order` whose columns, one after another, are `columns`.
    ///
    /// Errors: a wrong number of entries; a pivot that is zero or not finite.
    pub(crate) fn of_columns(order: usize, mut columns: Vec<f32>) -> Result<Self, LinearError> {
        if columns.len() != order * order {
            let quantity = "entries of a matrix to factor";
            return Err(LinearError::WrongLength { quantity, given: columns.len(), expected: order * order });
        }
        let mut rows: Vec<usize> = (0..order).collect();
        let mut all = MatMut::from_column_major_slice_mut(&mut columns, order, order);
        for start in (0..order).step_by(PANEL) {
            let width = PANEL.min(order - start);
            let (mut left, right) = all.rb_mut().split_at_col_mut(start);
            let (panel, rest) = right.split_at_col_mut(width);
            let mut panel = panel.get_mut(start.., ..);
            let below = order - start;
            let (mut forward, mut backward) = (vec![0usize; below], vec![0usize; below]);
            let scratch = lu_in_place_scratch::<usize, f32>(below, width, Par::Seq, Spec::default());
            let mut buffer = MemBuffer::new(scratch);
            let stack = MemStack::new(&mut buffer);
            lu_in_place(panel.rb_mut(), &mut forward, &mut backward, Par::Seq, stack, Spec::default());
            // Few rows change their place.
            let moved: Vec<[usize; 2]> =
                (0..below).filter(|&i| forward[i] != i).map(|i| [start + i, start + forward[i]]).collect();
            let permuted = |columns: MatMut<'_, f32>| {
                let mut columns = columns;
                let mut values = vec![0.0f32; moved.len()];
                for j in 0..columns.ncols() {
                    values.iter_mut().zip(&moved).for_each(|(value, [_, from])| *value = columns[(*from, j)]);
                    values.iter().zip(&moved).for_each(|(value, [to, _])| columns[(*to, j)] = *value);
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
        let pivot = |k: usize| columns[k * order + k];
        if (0..order).any(|k| pivot(k) == 0.0 || !pivot(k).is_finite()) {
            return Err(LinearError::Singular { order });
        }
        Ok(Self { columns, rows })
    }

    /// Number of unknowns.
    pub(crate) fn order(&self) -> usize {
        self.rows.len()
    }

    /// A⁻¹ b to single precision.
    ///
    /// Errors: a wrong length.
    pub(crate) fn solve(&self, right: &[f64]) -> Result<Vec<f64>, LinearError> {
        let order = self.order();
        if right.len() != order {
            let quantity = "entries of a right-hand side";
            return Err(LinearError::WrongLength { quantity, given: right.len(), expected: order });
        }
        let mut solution: Vec<f32> = self.rows.iter().map(|&row| right[row] as f32).collect();
        Arch::new().dispatch(Substitution { columns: &self.columns, unknowns: &mut solution });
        Ok(solution.into_iter().map(f64::from).collect())
    }
}

/// Columns that are subtracted in one pass over the unknowns.
const AT_A_TIME: usize = 8;

/// Forward and backward substitution, in place.
struct Substitution<'a> {
    /// Columns of both factors, one after another.
    columns: &'a [f32],
    unknowns: &'a mut [f32],
}

impl WithSimd for Substitution<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { columns, unknowns } = self;
        let order = unknowns.len();
        let column = |k: usize| &columns[k * order..(k + 1) * order];
        let whole = order - order % AT_A_TIME;
        for start in (0..order).step_by(AT_A_TIME) {
            let end = (start + AT_A_TIME).min(order);
            for k in start..end {
                subtract([&column(k)[k + 1..end]], [unknowns[k]], &mut unknowns[k + 1..end]);
            }
            if end < order {
                let known = std::array::from_fn(|k| unknowns[start + k]);
                let below = std::array::from_fn(|k| &column(start + k)[end..]);
                subtract::<AT_A_TIME>(below, known, &mut unknowns[end..]);
            }
        }
        let starts = (0..order).step_by(AT_A_TIME).rev();
        for start in starts {
            let end = (start + AT_A_TIME).min(order);
            for k in (start..end).rev() {
                unknowns[k] /= column(k)[k];
                subtract([&column(k)[start..k]], [unknowns[k]], &mut unknowns[start..k]);
            }
            if start < whole {
                let known = std::array::from_fn(|k| unknowns[start + k]);
                let above = std::array::from_fn(|k| &column(start + k)[..start]);
                subtract::<AT_A_TIME>(above, known, &mut unknowns[..start]);
            } else {
                (start..end)
                    .for_each(|k| subtract([&column(k)[..start]], [unknowns[k]], &mut unknowns[..start]));
            }
        }
    }
}

/// sum −= Σ weights_k columns_k; all of the same length.
#[inline(always)]
fn subtract<const N: usize>(columns: [&[f32]; N], weights: [f32; N], sum: &mut [f32]) {
    let columns = columns.map(|column| &column[..sum.len()]);
    for (i, value) in sum.iter_mut().enumerate() {
        let mut rest = *value;
        for k in 0..N {
            rest -= weights[k] * columns[k][i];
        }
        *value = rest;
    }
}

/// The columns of a matrix in blocks of `width`, the last one with what is left, in order.
pub(super) fn column_blocks<T: Send + Sync>(
    matrix: MatMut<'_, T>,
    width: usize,
) -> impl IndexedParallelIterator<Item = MatMut<'_, T>> {
    let mut blocks = Vec::with_capacity(matrix.ncols().div_ceil(width));
    let mut rest = matrix;
    while rest.ncols() > width {
        let (block, right) = rest.split_at_col_mut(width);
        blocks.push(block);
        rest = right;
    }
    if rest.ncols() > 0 {
        blocks.push(rest);
    }
    blocks.into_par_iter()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Matrix;

    /// A zero diagonal: without row interchanges the first pivot is zero.
    fn entry(order: usize, i: usize, j: usize) -> f64 {
        let large = 40.0 * f64::from(i == (j + 1) % order);
        if i == j { 0.0 } else { large + ((5 * i * i + 3 * j) % 11) as f64 / 11.0 - 0.4 }
    }

    fn factored(order: usize, entry: impl Fn(usize, usize) -> f64) -> Result<LargeFactor, LinearError> {
        LargeFactor::of_columns(
            order,
            (0..order * order).map(|k| entry(k % order, k / order) as f32).collect(),
        )
    }

    #[test]
    fn solutions_by_residual() {
        for order in [0, 1, 2, PANEL - 1, PANEL, 3 * PANEL + 7] {
            let entry = |i: usize, j: usize| if order == 1 { 3.0 } else { entry(order, i, j) };
            let right: Vec<f64> = (0..order).map(|i| (i as f64).sin()).collect();
            let factor = factored(order, entry).unwrap();
            let solution = factor.solve(&right).unwrap();
            let product = Matrix::from_fn(order, order, entry).times(&solution);
            let gap = product.iter().zip(&right).fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
            assert!(gap < 2e-5, "{order}: {gap:e}");
            for threads in [1, 3] {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                let again = pool.install(|| factored(order, entry).unwrap().solve(&right).unwrap());
                assert_eq!(solution, again, "{order}, {threads} threads");
            }
        }
    }

    #[test]
    fn refuses_what_it_cannot_factor() {
        let singular = factored(3, |i, j| if j == 1 { 0.0 } else { (i + j + i * j) as f64 });
        assert_eq!(singular.err(), Some(LinearError::Singular { order: 3 }));
        assert!(matches!(
            LargeFactor::of_columns(2, vec![0.0; 6]),
            Err(LinearError::WrongLength { given: 6, expected: 4, .. })
        ));
        let unit = factored(2, |i, j| f64::from(i == j)).unwrap();
        assert!(matches!(unit.solve(&[1.0; 3]), Err(LinearError::WrongLength { given: 3, .. })));
    }
}
