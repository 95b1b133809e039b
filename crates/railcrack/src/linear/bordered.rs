//! Triangular factors of matrices that grow by bordering.

use super::LinearError;
use crate::math::inlined::{axpy, dot};
use pulp::{Arch, Simd, WithSimd};

/// The triangular factors of a square matrix of some unknowns, without row interchanges: bordering
/// by a further unknown costs as much as a solution, and the last unknowns are removed at no cost.
/// Suitable for matrices whose leading blocks are well conditioned.
#[derive(Debug, Clone, Default)]
pub(crate) struct BorderedFactor {
    lower: Triangle,
    upper: Triangle,
    /// The diagonal of U.
    pivots: Vec<f64>,
}

/// The off-diagonal lines, one after the other: rows of L left of the diagonal, or columns of U
/// above it.
#[derive(Debug, Clone, Default)]
struct Triangle {
    entries: Vec<f64>,
}

impl Triangle {
    /// The beginning of line `i`, which has i entries.
    const fn start(i: usize) -> usize {
        i * i.saturating_sub(1) / 2
    }

    #[inline(always)]
    fn line(&self, i: usize) -> &[f64] {
        &self.entries[Self::start(i)..Self::start(i + 1)]
    }
}

/// Pivots below this fraction of the largest entry of their row and column count as zero.
const SINGULAR: f64 = 1e-10;

impl BorderedFactor {
    /// Number of unknowns.
    pub(crate) fn order(&self) -> usize {
        self.pivots.len()
    }

    /// Removes all unknowns but the first `order`.
    pub(crate) fn truncate(&mut self, order: usize) {
        self.pivots.truncate(order);
        for triangle in [&mut self.lower, &mut self.upper] {
            triangle.entries.truncate(Triangle::start(self.pivots.len()));
        }
    }

    /// Adds an unknown: its `row` of the matrix up to the previous unknowns, its `column`, and its
    /// `diagonal` entry.
    ///
    /// Errors, after which the factor is unchanged: a wrong length; a pivot below 1e-10 of the
    /// largest of the new entries.
    pub(crate) fn push(&mut self, row: &[f64], column: &[f64], diagonal: f64) -> Result<(), LinearError> {
        let order = self.order();
        for (quantity, given) in [
            ("entries of a row left of the diagonal", row.len()),
            ("entries of a column above the diagonal", column.len()),
        ] {
            if given != order {
                return Err(LinearError::WrongLength { quantity, given, expected: order });
            }
        }
        let largest = row.iter().chain(column).fold(diagonal.abs(), |m, v| m.max(v.abs()));
        self.lower.entries.extend(row);
        self.upper.entries.extend(column);
        let pivot = diagonal - Arch::new().dispatch(BorderElimination(self));
        if pivot.is_nan() || pivot.abs() <= SINGULAR * largest {
            self.truncate(order);
            return Err(LinearError::Singular { order: order + 1 });
        }
        self.pivots.push(pivot);
        Ok(())
    }

    /// Solves A x = b in place: `right` is b and becomes x.
    ///
    /// Errors: a wrong length.
    pub(crate) fn solve(&self, right: &mut [f64]) -> Result<(), LinearError> {
        if right.len() != self.order() {
            let quantity = "entries of a right-hand side";
            return Err(LinearError::WrongLength { quantity, given: right.len(), expected: self.order() });
        }
        Arch::new().dispatch(Solve { factor: self, right });
        Ok(())
    }
}

/// Replaces the lines of the matrix beyond the last pivot by those of its factors, and returns
/// their scalar product.
struct BorderElimination<'a>(&'a mut BorderedFactor);

impl WithSimd for BorderElimination<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> f64 {
        let BorderedFactor { lower, upper, pivots } = self.0;
        let start = Triangle::start(pivots.len());
        let (former, row) = lower.entries.split_at_mut(start);
        let (above, column) = upper.entries.split_at_mut(start);
        for j in 0..pivots.len() {
            let line = Triangle::start(j)..Triangle::start(j + 1);
            column[j] -= dot(&former[line.clone()], &column[..j]);
            row[j] = (row[j] - dot(&above[line], &row[..j])) / pivots[j];
        }
        dot(row, column)
    }
}

struct Solve<'a> {
    factor: &'a BorderedFactor,
    right: &'a mut [f64],
}

impl WithSimd for Solve<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { factor, right } = self;
        for i in 1..right.len() {
            right[i] -= dot(factor.lower.line(i), &right[..i]);
        }
        for j in (0..right.len()).rev() {
            let solved = right[j] / factor.pivots[j];
            right[j] = solved;
            axpy(-solved, factor.upper.line(j), &mut right[..j]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const N: usize = 7;

    fn entry(i: usize, j: usize) -> f64 {
        let off = ((3 * i + 5 * j) as f64).sin();
        if i == j { 4.0 + off } else { off }
    }

    fn push(factor: &mut BorderedFactor, i: usize, place: impl Fn(usize) -> usize) {
        let at = factor.order();
        let row: Vec<f64> = (0..at).map(|j| entry(i, place(j))).collect();
        let column: Vec<f64> = (0..at).map(|j| entry(place(j), i)).collect();
        factor.push(&row, &column, entry(i, i)).unwrap();
    }

    fn assert_solves(factor: &BorderedFactor, place: impl Fn(usize) -> usize) {
        let exact: Vec<f64> = (0..factor.order()).map(|j| 1.0 + j as f64).collect();
        let row = |i: usize| (0..exact.len()).map(|j| entry(place(i), place(j)) * exact[j]).sum();
        let mut right: Vec<f64> = (0..exact.len()).map(row).collect();
        factor.solve(&mut right).unwrap();
        assert!(right.iter().zip(&exact).all(|(got, want)| (got - want).abs() < 1e-13), "{right:?}");
    }

    #[test]
    fn unknowns_come_and_go() {
        let mut factor = BorderedFactor::default();
        for i in 0..N {
            push(&mut factor, i, |j| j);
            assert_solves(&factor, |j| j);
        }
        factor.truncate(3);
        assert_solves(&factor, |j| j);
        // The other unknowns in a different order.
        let place = |j: usize| if j < 3 { j } else { N + 2 - j };
        for at in 3..N {
            push(&mut factor, place(at), place);
            assert_solves(&factor, place);
        }
    }

    #[test]
    fn a_dependent_unknown_is_refused_and_changes_nothing() {
        let mut factor = BorderedFactor::default();
        factor.push(&[], &[], 2.0).unwrap();
        assert!(matches!(factor.push(&[4.0], &[1.0], 2.0), Err(LinearError::Singular { order: 2 })));
        assert!(factor.push(&[1.0, 1.0], &[1.0], 1.0).is_err());
        factor.push(&[4.0], &[1.0], 3.0).unwrap();
        let mut right = [3.0, 7.0];
        factor.solve(&mut right).unwrap();
        assert_eq!(right, [1.0, 1.0]);
        assert!(factor.solve(&mut [1.0]).is_err());
    }
}
