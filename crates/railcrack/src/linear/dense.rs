//! Inverses of dense matrices.

use super::LinearError;
use crate::math::Matrix;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::{cholesky::llt, lu::partial_pivoting, matmul::matmul};
use faer::{Accum, Mat, MatMut, MatRef, Par, Spec};

/// The Cholesky factor of a symmetric positive definite matrix.
pub struct SpdFactor {
    factor: Mat<f64>,
}

impl SpdFactor {
    /// Factors `matrix`, of which the lower triangle is read.
    pub fn new(matrix: &Matrix) -> Result<Self, LinearError> {
        let order = matrix.rows();
        let mut factor = Mat::from_fn(order, order, |i, j| matrix[(i, j)]);
        let mut buffer =
            MemBuffer::new(llt::factor::cholesky_in_place_scratch::<f64>(order, Par::Seq, Spec::default()));
        let stack = MemStack::new(&mut buffer);
        llt::factor::cholesky_in_place(factor.as_mut(), Default::default(), Par::Seq, stack, Spec::default())
            .map_err(|error| match error {
                llt::factor::LltError::NonPositivePivot { index } => {
                    LinearError::NotPositiveDefinite { order, pivot: index }
                }
            })?;
        Ok(Self { factor })
    }

    /// The inverse, exactly symmetric.
    pub fn inverse(&self) -> Matrix {
        let order = self.factor.nrows();
        let mut buffer = MemBuffer::new(llt::inverse::inverse_scratch::<f64>(order, Par::Seq));
        let stack = MemStack::new(&mut buffer);
        let mut inverse = Mat::zeros(order, order);
        llt::inverse::inverse(inverse.as_mut(), self.factor.as_ref(), Par::Seq, stack);
        Matrix::from_fn(order, order, |i, j| inverse[(i.max(j), i.min(j))])
    }

    /// K⁻¹ Bᵀ as rows: the solution for each row of `right` (r × order), r × order.
    pub fn solve_rows(&self, right: &Matrix) -> Matrix {
        let (rows, order) = (right.rows(), self.factor.nrows());
        let mut solution = Mat::from_fn(order, rows, |i, j| right[(j, i)]);
        let scratch = llt::solve::solve_in_place_scratch::<f64>(order, rows, Par::Seq);
        let mut buffer = MemBuffer::new(scratch);
        llt::solve::solve_in_place(
            self.factor.as_ref(),
            solution.as_mut(),
            Par::Seq,
            MemStack::new(&mut buffer),
        );
        Matrix::from_fn(rows, order, |i, j| solution[(j, i)])
    }
}

/// The product A B.
///
/// Errors: as many columns of A as rows of B are needed.
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

/// The inverse of a symmetric positive definite matrix, by Cholesky; exactly symmetric.
pub fn spd_inverse(matrix: &Matrix) -> Result<Matrix, LinearError> {
    Ok(SpdFactor::new(matrix)?.inverse())
}

/// The inverse of a square matrix, by Gaussian elimination with partial pivoting.
pub fn general_inverse(matrix: &Matrix) -> Result<Matrix, LinearError> {
    let order = matrix.rows();
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
        let skewed =
            Matrix::from_fn(7, 7, |i, j| ((3 * i + 5 * j) % 7) as f64 - 3.0 + 8.0 * f64::from(i == j));
        assert!(distance_from_identity(&product(&hilbert, &spd_inverse(&hilbert).unwrap()).unwrap()) < 1e-13);
        assert!(
            distance_from_identity(&product(&skewed, &general_inverse(&skewed).unwrap()).unwrap()) < 1e-13
        );
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
    fn refuses_what_has_no_inverse() {
        let indefinite = Matrix::from_fn(2, 2, |i, j| if i == j { 1.0 } else { 2.0 });
        assert_eq!(spd_inverse(&indefinite), Err(LinearError::NotPositiveDefinite { order: 2, pivot: 1 }));
        assert_eq!(general_inverse(&Matrix::zeros(3, 3)), Err(LinearError::Singular { order: 3 }));
    }
}
