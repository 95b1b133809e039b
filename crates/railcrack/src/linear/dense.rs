//! Products and inverses of dense matrices.

use super::LinearError;
use super::large::column_blocks;
use crate::interruption::{Interrupted, Interruption};
use crate::math::{Matrix, axpy, dot};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::linalg::{cholesky::llt, lu::partial_pivoting, matmul::matmul};
use faer::prelude::{Reborrow, ReborrowMut};
use faer::{Accum, Mat, MatMut, MatRef, Par, Spec};
use rayon::prelude::*;

/// Columns that are eliminated together, and rows of the remainder that one thread updates
/// together: their sums do not depend on the thread.
const BLOCK: usize = 192;
/// Rows of a product that one thread computes.
const STRIP: usize = 32;

/// Replaces the lower triangle of a symmetric matrix by that of its Cholesky factor, on this
/// thread. The error is the index of a pivot that is not positive.
pub(super) fn factor_in_place(matrix: MatMut<'_, f64>) -> Result<(), usize> {
    let scratch = llt::factor::cholesky_in_place_scratch::<f64>(matrix.nrows(), Par::Seq, Spec::default());
    let mut buffer = MemBuffer::new(scratch);
    let stack = MemStack::new(&mut buffer);
    llt::factor::cholesky_in_place(matrix, Default::default(), Par::Seq, stack, Spec::default())
        .map(|_| ())
        .map_err(|llt::factor::LltError::NonPositivePivot { index }| index)
}

/// Reasons for which an elimination ends before its last column.
pub(super) enum EliminationError {
    /// The index of a pivot that is not positive.
    Pivot(usize),
    /// Interrupted on request.
    Interrupted(Interrupted),
}

impl From<Interrupted> for EliminationError {
    fn from(interrupted: Interrupted) -> Self {
        Self::Interrupted(interrupted)
    }
}

impl EliminationError {
    /// The error of a matrix of `order` unknowns; `unknown` maps an index in the elimination to the
    /// unknown.
    pub(super) fn of(self, order: usize, unknown: impl Fn(usize) -> usize) -> LinearError {
        match self {
            Self::Pivot(place) => LinearError::NotPositiveDefinite { order, pivot: unknown(place) },
            Self::Interrupted(interrupted) => interrupted.into(),
        }
    }
}

/// Eliminates the first `columns` unknowns of a symmetric matrix (order × order), of which row j
/// holds column j from the diagonal on: its first rows become columns of L, the others their Schur
/// complement. The bits do not depend on the number of threads.
///
/// Errors: an interruption, or the index of a pivot that is not positive.
pub(super) fn eliminate(
    matrix: &mut [f64],
    order: usize,
    columns: usize,
    interruption: Interruption<'_>,
) -> Result<(), EliminationError> {
    // The matrix is symmetric, so that rows are columns.
    let mut matrix = MatMut::from_column_major_slice_mut(matrix, order, order);
    for start in (0..columns).step_by(BLOCK) {
        interruption.check()?;
        let width = BLOCK.min(columns - start);
        let (_, right) = matrix.rb_mut().split_at_col_mut(start);
        let (block, rest) = right.get_mut(start.., ..).split_at_col_mut(width);
        let (mut own, mut below) = block.split_at_row_mut(width);
        factor_in_place(own.rb_mut()).map_err(|pivot| EliminationError::Pivot(start + pivot))?;
        let own = own.rb();
        column_blocks(below.rb_mut().transpose_mut(), BLOCK).for_each(|columns| {
            solve_lower_triangular_in_place(own, columns, Par::Seq);
        });
        let below = below.rb();
        let rest = rest.get_mut(width.., ..);
        column_blocks(rest, BLOCK).enumerate().for_each(|(k, columns)| {
            if interruption.asked() {
                return;
            }
            // The part on and below the diagonal.
            let from = k * BLOCK;
            let lower = columns.get_mut(from.., ..);
            let across = below.get(from..from + lower.ncols(), ..);
            matmul(lower, Accum::Add, below.get(from.., ..), across.transpose(), -1.0, Par::Seq);
        });
    }
    Ok(())
}

/// The scalar products R Rᵀ of the rows of R with each other, exactly symmetric. The leading zeros
/// that neighbouring rows share are skipped.
///
/// Errors: an interruption.
pub(crate) fn products_of_rows(rows: &Matrix, interruption: Interruption<'_>) -> Result<Matrix, Interrupted> {
    let (count, length) = (rows.rows(), rows.columns());
    let all = MatRef::from_row_major_slice(rows.entries(), count, length);
    let mut products = Matrix::zeros(count, count);
    products.entries_mut().par_chunks_mut((STRIP * count).max(1)).enumerate().for_each(|(k, strip)| {
        if interruption.asked() {
            return;
        }
        let own = k * STRIP..k * STRIP + strip.len() / count;
        let zeros = |i: usize| rows.row(i).iter().take_while(|value| **value == 0.0).count();
        let from = own.clone().map(zeros).min().unwrap_or(0);
        // The part on and below the diagonal.
        let product = MatMut::from_row_major_slice_mut(strip, own.len(), count).get_mut(.., ..own.end);
        let (left, right) = (all.get(own.clone(), from..), all.get(..own.end, from..).transpose());
        matmul(product, Accum::Replace, left, right, 1.0, Par::Seq);
    });
    interruption.check()?;
    for i in 0..count {
        for j in 0..i {
            products[(j, i)] = products[(i, j)];
        }
    }
    Ok(products)
}

/// √tr(C_k A_kl C_l A_lk), how strongly two units are coupled by the block A_kl of the stiffness,
/// with C of each unit alone: the root of the sum of squared cosines of the angles between the
/// jumps of both in the energy norm.
///
/// Errors: matrices whose shapes do not match.
pub(crate) fn coupling(one: &Matrix, between: &Matrix, other: &Matrix) -> Result<f64, LinearError> {
    let (left, right) = (product(one, between)?, product(between, other)?);
    let pairs = left.entries().iter().zip(right.entries());
    Ok(pairs.map(|(l, r)| l * r).sum::<f64>().max(0.0).sqrt())
}

/// The product A B.
///
/// Errors: a number of columns of A that differs from the number of rows of B.
pub fn product(a: &Matrix, b: &Matrix) -> Result<Matrix, LinearError> {
    if a.columns() != b.rows() {
        let quantity = "rows of the second factor of a product";
        return Err(LinearError::WrongLength { quantity, given: b.rows(), expected: a.columns() });
    }
    let mut product = Matrix::zeros(a.rows(), b.columns());
    let (rows, inner, columns) = (a.rows(), a.columns(), b.columns());
    matmul(
        MatMut::from_row_major_slice_mut(product.entries_mut(), rows, columns),
        Accum::Replace,
        MatRef::from_row_major_slice(a.entries(), rows, inner),
        MatRef::from_row_major_slice(b.entries(), inner, columns),
        1.0,
        Par::Seq,
    );
    Ok(product)
}

/// sum += factor A B.
///
/// Errors: shapes that do not fit.
pub(crate) fn add_product(factor: f64, a: &Matrix, b: &Matrix, sum: &mut Matrix) -> Result<(), LinearError> {
    let (rows, inner, columns) = (a.rows(), a.columns(), b.columns());
    for (quantity, given, expected) in [
        ("rows of the second factor of a product", b.rows(), inner),
        ("rows of a sum of products", sum.rows(), rows),
        ("columns of a sum of products", sum.columns(), columns),
    ] {
        if given != expected {
            return Err(LinearError::WrongLength { quantity, given, expected });
        }
    }
    matmul(
        MatMut::from_row_major_slice_mut(sum.entries_mut(), rows, columns),
        Accum::Add,
        MatRef::from_row_major_slice(a.entries(), rows, inner),
        MatRef::from_row_major_slice(b.entries(), inner, columns),
        factor,
        Par::Seq,
    );
    Ok(())
}

/// The triangular factors of a square matrix of a few unknowns, by Gaussian elimination with
/// partial pivoting. Below some dozens of unknowns a call of the blocked factorisation costs more
/// than this.
#[derive(Debug, Clone)]
pub(crate) struct SmallFactor {
    /// U on and above the diagonal, L below, whose diagonal is one.
    entries: Matrix,
    /// The row with which row k was interchanged before its elimination.
    exchanges: Vec<usize>,
}

impl SmallFactor {
    /// Factors `matrix`.
    ///
    /// Errors: a matrix that is not square; a pivot below 1e-12 of the largest entry.
    pub(crate) fn new(mut matrix: Matrix) -> Result<Self, LinearError> {
        let order = matrix.rows();
        if matrix.columns() != order {
            let quantity = "columns of a matrix to factor";
            return Err(LinearError::WrongLength { quantity, given: matrix.columns(), expected: order });
        }
        let largest = matrix.entries().iter().fold(0.0f64, |m, v| m.max(v.abs()));
        let mut exchanges = Vec::with_capacity(order);
        for k in 0..order {
            let size = |i: usize| matrix[(i, k)].abs();
            let pivot = (k + 1..order).fold(k, |best, i| if size(i) > size(best) { i } else { best });
            if size(pivot).is_nan() || size(pivot) <= SINGULAR * largest {
                return Err(LinearError::Singular { order });
            }
            if pivot != k {
                let (upper, lower) = matrix.row_pair_mut(k, pivot);
                upper.swap_with_slice(lower);
            }
            exchanges.push(pivot);
            for i in k + 1..order {
                let (above, row) = matrix.row_pair(k, i);
                let factor = row[k] / above[k];
                row[k] = factor;
                if factor != 0.0 {
                    axpy(-factor, &above[k + 1..], &mut row[k + 1..]);
                }
            }
        }
        Ok(Self { entries: matrix, exchanges })
    }

    /// Solves A x = b in place: `right` is b and becomes x.
    ///
    /// Errors: a wrong length.
    pub(crate) fn solve(&self, right: &mut [f64]) -> Result<(), LinearError> {
        let order = self.entries.rows();
        if right.len() != order {
            let quantity = "entries of a right-hand side";
            return Err(LinearError::WrongLength { quantity, given: right.len(), expected: order });
        }
        for (k, &pivot) in self.exchanges.iter().enumerate() {
            right.swap(k, pivot);
        }
        for k in 1..order {
            right[k] -= dot(&self.entries.row(k)[..k], &right[..k]);
        }
        for k in (0..order).rev() {
            let known = dot(&self.entries.row(k)[k + 1..], &right[k + 1..]);
            right[k] = (right[k] - known) / self.entries[(k, k)];
        }
        Ok(())
    }

    /// A⁻¹.
    fn inverse(&self) -> Matrix {
        let order = self.entries.rows();
        let mut inverse = Matrix::from_fn(order, order, |i, j| f64::from(i == j));
        // Row by row of all right-hand sides, which are the columns of the unit matrix.
        for (k, &pivot) in self.exchanges.iter().enumerate() {
            if pivot != k {
                let (one, other) = inverse.row_pair_mut(k, pivot);
                one.swap_with_slice(other);
            }
        }
        let subtract = |inverse: &mut Matrix, k: usize, j: usize| {
            let (known, right) = inverse.row_pair(j, k);
            axpy(-self.entries[(k, j)], known, right);
        };
        for k in 1..order {
            (0..k).for_each(|j| subtract(&mut inverse, k, j));
        }
        for k in (0..order).rev() {
            (k + 1..order).for_each(|j| subtract(&mut inverse, k, j));
            inverse.row_mut(k).iter_mut().for_each(|value| *value /= self.entries[(k, k)]);
        }
        inverse
    }
}

/// Order up to which an inverse is computed row by row.
const SMALL: usize = 24;
/// Pivots below this fraction of the largest entry count as zero.
const SINGULAR: f64 = 1e-12;

/// The inverse of a symmetric positive definite matrix, by Cholesky; exactly symmetric.
pub fn spd_inverse(matrix: &Matrix) -> Result<Matrix, LinearError> {
    spd_inverse_unless(Interruption::NEVER, matrix)
}

/// [`spd_inverse`] that stops on an `interruption`.
pub(crate) fn spd_inverse_unless(
    interruption: Interruption<'_>,
    matrix: &Matrix,
) -> Result<Matrix, LinearError> {
    let order = matrix.rows();
    let mut factor = matrix.clone();
    eliminate(factor.entries_mut(), order, order, interruption)
        .map_err(|end| end.of(order, |place| place))?;
    if order > AT_ONCE {
        return large_inverse(factor, interruption);
    }
    let mut buffer = MemBuffer::new(llt::inverse::inverse_scratch::<f64>(order, Par::Seq));
    let stack = MemStack::new(&mut buffer);
    let mut inverse = Matrix::zeros(order, order);
    let columns = MatMut::from_column_major_slice_mut(inverse.entries_mut(), order, order);
    let factor = MatRef::from_column_major_slice(factor.entries(), order, order);
    llt::inverse::inverse(columns, factor, Par::Seq, stack);
    for i in 0..order {
        for j in 0..i {
            inverse[(i, j)] = inverse[(j, i)];
        }
    }
    Ok(inverse)
}

/// Order up to which an inverse is computed from its factor in one call that cannot be interrupted;
/// it takes at most a second.
const AT_ONCE: usize = 3000;

/// L⁻ᵀ L⁻¹ of a factor whose row j is column j of L, in strips.
fn large_inverse(factor: Matrix, interruption: Interruption<'_>) -> Result<Matrix, LinearError> {
    let order = factor.rows();
    let lower = MatRef::from_column_major_slice(factor.entries(), order, order);
    // Row j is column j of L⁻¹.
    let mut columns = Matrix::zeros(order, order);
    columns.entries_mut().par_chunks_mut(STRIP * order).enumerate().for_each(|(k, strip)| {
        if interruption.asked() {
            return;
        }
        let (from, width) = (k * STRIP, strip.len() / order);
        let mut right = MatMut::from_column_major_slice_mut(strip, order, width).get_mut(from.., ..);
        (0..width).for_each(|j| right[(j, j)] = 1.0);
        solve_lower_triangular_in_place(lower.get(from.., from..), right, Par::Seq);
    });
    interruption.check()?;
    // Two matrices of this order at most are held at a time.
    drop(factor);
    Ok(products_of_rows(&columns, interruption)?)
}

/// The inverse of a square matrix, by Gaussian elimination with partial pivoting.
///
/// Errors: a singular matrix.
pub fn general_inverse(matrix: &Matrix) -> Result<Matrix, LinearError> {
    let order = matrix.rows();
    if order <= SMALL {
        return Ok(SmallFactor::new(matrix.clone())?.inverse());
    }
    let mut factor = Mat::from_fn(order, order, |i, j| matrix[(i, j)]);
    let (mut forward, mut backward) = (vec![0usize; order], vec![0usize; order]);
    let scratch =
        partial_pivoting::factor::lu_in_place_scratch::<usize, f64>(order, order, Par::Seq, Spec::default())
            .or(partial_pivoting::inverse::inverse_scratch::<usize, f64>(order, Par::Seq));
    let mut buffer = MemBuffer::new(scratch);
    let stack = MemStack::new(&mut buffer);
    let (_, permutation) = partial_pivoting::factor::lu_in_place(
        factor.as_mut(),
        &mut forward,
        &mut backward,
        Par::Seq,
        stack,
        Spec::default(),
    );
    let mut inverse = Mat::zeros(order, order);
    partial_pivoting::inverse::inverse(
        inverse.as_mut(),
        factor.as_ref(),
        factor.as_ref(),
        permutation,
        Par::Seq,
        stack,
    );
    let inverse = Matrix::from_fn(order, order, |i, j| inverse[(i, j)]);
    if (0..order).any(|i| inverse.row(i).iter().any(|v| !v.is_finite())) {
        return Err(LinearError::Singular { order });
    }
    Ok(inverse)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn distance_from_identity(m: &Matrix) -> f64 {
        let entry = |i, j| (m[(i, j)] - f64::from(i == j)).abs();
        (0..m.rows())
            .flat_map(|i| (0..m.columns()).map(move |j| (i, j)))
            .fold(0.0, |w, (i, j)| entry(i, j).max(w))
    }

    #[test]
    fn inverses_by_residual() {
        let hilbert = Matrix::from_fn(6, 6, |i, j| 1.0 / (i + j + 1) as f64 + 0.1 * f64::from(i == j));
        assert!(distance_from_identity(&product(&hilbert, &spd_inverse(&hilbert).unwrap()).unwrap()) < 1e-13);
        for order in [0, 1, 7, SMALL, SMALL + 1] {
            // A zero diagonal except for the first entries.
            let entry = |i: usize, j: usize| ((3 * i * i + 5 * j) % 7) as f64 - 3.0;
            let large = |i: usize, j: usize| 30.0 * f64::from(i == (j + 1) % order);
            let skewed = Matrix::from_fn(order, order, |i, j| entry(i, j) + large(i, j));
            let inverse = general_inverse(&skewed).unwrap();
            assert!(distance_from_identity(&product(&skewed, &inverse).unwrap()) < 1e-13, "{order}");
        }
    }

    #[test]
    fn products_of_rectangles() {
        let a = Matrix::from_fn(2, 3, |i, j| (1 + i + 2 * j) as f64);
        let b = Matrix::from_fn(3, 4, |i, j| (i * j) as f64 - 1.0);
        let sum = |i: usize, j: usize| (0..3).map(|k| a[(i, k)] * b[(k, j)]).sum();
        assert_eq!(product(&a, &b), Ok(Matrix::from_fn(2, 4, sum)));
        assert!(matches!(product(&b, &b), Err(LinearError::WrongLength { given: 3, expected: 4, .. })));
    }

    #[test]
    fn products_of_rows_with_leading_zeros() {
        // Rows of two strips, most of which begin with zeros.
        let value = |i: usize, j: usize| if 2 * j < i { 0.0 } else { ((3 * i + 5 * j) % 11) as f64 - 5.0 };
        let rows = Matrix::from_fn(STRIP + 9, 47, value);
        let sum = |i: usize, j: usize| rows.row(i).iter().zip(rows.row(j)).map(|(a, b)| a * b).sum();
        assert_eq!(
            products_of_rows(&rows, Interruption::NEVER).unwrap(),
            Matrix::from_fn(rows.rows(), rows.rows(), sum)
        );
        assert_eq!(products_of_rows(&Matrix::zeros(0, 3), Interruption::NEVER).unwrap(), Matrix::zeros(0, 0));
    }

    #[test]
    fn small_systems_by_residual() {
        for order in [0, 1, 2, 7, 30] {
            // A zero diagonal: without row interchanges the first pivot is zero.
            let entry =
                |i: usize, j: usize| if i == j { 0.0 } else { ((5 * i * i + 3 * j) % 11) as f64 - 4.0 };
            let large = |i: usize, j: usize| 40.0 * f64::from(i == (j + 1) % order);
            let matrix = Matrix::from_fn(order, order, |i, j| entry(i, j) + large(i, j));
            let right: Vec<f64> = (0..order).map(|i| (i as f64).sin()).collect();
            let mut solution = right.clone();
            let factor = SmallFactor::new(matrix.clone()).unwrap();
            factor.solve(&mut solution).unwrap();
            let gap =
                matrix.times(&solution).iter().zip(&right).fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
            assert!(gap < 1e-13, "{order}: {gap}");
        }
        let singular = Matrix::from_fn(3, 3, |i, j| ((i + 1) * (j + 1)) as f64);
        assert_eq!(SmallFactor::new(singular).err(), Some(LinearError::Singular { order: 3 }));
        let unit = SmallFactor::new(Matrix::from_fn(2, 2, |i, j| f64::from(i == j))).unwrap();
        assert!(matches!(unit.solve(&mut [1.0; 3]), Err(LinearError::WrongLength { given: 3, .. })));
        assert!(matches!(
            SmallFactor::new(Matrix::zeros(2, 3)),
            Err(LinearError::WrongLength { given: 3, .. })
        ));
    }

    #[test]
    fn the_inverse_of_several_blocks_by_residual() {
        let order = 2 * BLOCK + 40;
        let near = |i: usize, j: usize| 1.0 / (1.0 + (i as f64 - j as f64).powi(2));
        let matrix =
            Matrix::from_fn(order, order, |i, j| near(i, j) + f64::from(i == j) * (1.0 + (i % 7) as f64));
        assert!(distance_from_identity(&product(&matrix, &spd_inverse(&matrix).unwrap()).unwrap()) < 1e-12);
        let indefinite =
            Matrix::from_fn(order, order, |i, j| matrix[(i, j)] - 20.0 * f64::from(i == j && i == 300));
        assert_eq!(
            spd_inverse(&indefinite).err(),
            Some(LinearError::NotPositiveDefinite { order, pivot: 300 })
        );
    }

    #[test]
    fn the_inverse_in_strips_by_residual() {
        let order = 3 * STRIP + 7;
        let entry = |i: usize, j: usize| 1.0 / (1.0 + (i as f64 - j as f64).powi(2));
        let matrix = Matrix::from_fn(order, order, |i, j| entry(i, j) + if i == j { 1.0 } else { 0.0 });
        let mut factor = matrix.clone();
        assert!(eliminate(factor.entries_mut(), order, order, Interruption::NEVER).is_ok());
        let inverse = large_inverse(factor, Interruption::NEVER).unwrap();
        assert!(distance_from_identity(&product(&matrix, &inverse).unwrap()) < 1e-13);
    }

    #[test]
    fn sums_of_products() {
        let a = Matrix::from_fn(2, 3, |i, j| (1 + i + 2 * j) as f64);
        let b = Matrix::from_fn(3, 4, |i, j| (i * j) as f64 - 1.0);
        let mut sum = Matrix::from_fn(2, 4, |i, j| (i + j) as f64);
        add_product(-2.0, &a, &b, &mut sum).unwrap();
        let once = product(&a, &b).unwrap();
        assert_eq!(sum, Matrix::from_fn(2, 4, |i, j| (i + j) as f64 - 2.0 * once[(i, j)]));
        assert!(matches!(
            add_product(1.0, &a, &b, &mut Matrix::zeros(3, 4)),
            Err(LinearError::WrongLength { given: 3, expected: 2, .. })
        ));
    }

    #[test]
    fn refuses_singular_matrices() {
        let indefinite = Matrix::from_fn(2, 2, |i, j| if i == j { 1.0 } else { 2.0 });
        assert_eq!(spd_inverse(&indefinite), Err(LinearError::NotPositiveDefinite { order: 2, pivot: 1 }));
        for order in [3, SMALL + 1] {
            let zero = Matrix::zeros(order, order);
            assert_eq!(general_inverse(&zero), Err(LinearError::Singular { order }));
        }
    }
}
