//! The inverse of the equations of the free jumps, updated as points change status.

use crate::linear::{LinearError, general_inverse};
use crate::math::{Matrix, axpy, axpy_two, dot};

/// G = R⁻¹ where R holds, for each free jump component, its equation A_i + c_i A_{i+1} on the free components; c_i ≠ 0
/// couples the shear of a slipping point to its pressure. Adding or removing a component costs n² operations.
#[derive(Clone)]
pub(super) struct ActiveInverse<'a> {
    stiffness: &'a Matrix,
    /// The free components, in the order of G's rows.
    free: Vec<usize>,
    /// Place of each component in `free`.
    place: Vec<Option<usize>>,
    /// c_i of each component.
    coupling: Vec<f64>,
    /// G in the leading corner of rows as long as there are components.
    inverse: Vec<f64>,
}

impl<'a> ActiveInverse<'a> {
    pub(super) fn new(stiffness: &'a Matrix) -> Self {
        let n = stiffness.rows();
        Self {
            stiffness,
            free: Vec::with_capacity(n),
            place: vec![None; n],
            coupling: vec![0.0; n],
            inverse: vec![0.0; n * n],
        }
    }

    /// Row `i` of G.
    fn row(&self, i: usize) -> &[f64] {
        &self.inverse[i * self.place.len()..][..self.free.len()]
    }

    pub(super) fn free(&self) -> &[usize] {
        &self.free
    }

    pub(super) fn coupling(&self, component: usize) -> f64 {
        self.coupling[component]
    }

    /// Entry of equation `row` at `column`.
    fn equation(&self, row: usize, column: usize) -> f64 {
        let coupling = self.coupling[row];
        let own = self.stiffness[(row, column)];
        if coupling == 0.0 { own } else { own + coupling * self.stiffness[(row + 1, column)] }
    }

    /// Frees `component` with the equation A_i + `coupling` A_{i+1}. False if that makes R singular to working precision:
    /// the component is free all the same, and [`ActiveInverse::refresh`] decides.
    #[must_use]
    pub(super) fn add(&mut self, component: usize, coupling: f64) -> bool {
        self.coupling[component] = coupling;
        let n = self.free.len();
        // The stiffness is symmetric: the column of `component` is its row.
        let column_row = self.stiffness.row(component);
        let column: Vec<f64> = self
            .free
            .iter()
            .map(|&i| {
                let coupling = self.coupling[i];
                if coupling == 0.0 { column_row[i] } else { column_row[i] + coupling * column_row[i + 1] }
            })
            .collect();
        let row: Vec<f64> = self.free.iter().map(|&j| self.equation(component, j)).collect();
        let g_column: Vec<f64> = (0..n).map(|i| dot(self.row(i), &column)).collect();
        let mut row_g = vec![0.0; n];
        add_rows(&row, |i| self.row(i), &mut row_g);
        let diagonal = self.equation(component, component);
        let pivot = diagonal - dot(&row, &g_column);
        self.place[component] = Some(n);
        self.free.push(component);
        if pivot.abs() <= SINGULAR * diagonal.abs() {
            return false;
        }
        let scale = 1.0 / pivot;
        let stride = self.place.len();
        for (g, &c) in self.inverse.chunks_exact_mut(stride).zip(&g_column) {
            axpy(c * scale, &row_g, &mut g[..n]);
            g[n] = -c * scale;
        }
        let last = &mut self.inverse[n * stride..][..=n];
        for (g, r) in last.iter_mut().zip(&row_g) {
            *g = -r * scale;
        }
        last[n] = scale;
        true
    }

    /// Holds `component`. False if that makes R singular.
    #[must_use]
    pub(super) fn remove(&mut self, component: usize) -> bool {
        let Some(place) = self.place[component].take() else { return true };
        self.coupling[component] = 0.0;
        let stride = self.place.len();
        let last = self.free.len() - 1;
        let mut pivot_row = self.row(place).to_vec();
        let pivot = pivot_row[place];
        pivot_row.swap_remove(place);
        self.free.swap_remove(place);
        if place < last {
            self.place[self.free[place]] = Some(place);
            let (head, tail) = self.inverse.split_at_mut(last * stride);
            head[place * stride..][..=last].copy_from_slice(&tail[..=last]);
        }
        if pivot.abs() <= f64::MIN_POSITIVE {
            return false;
        }
        for g in self.inverse.chunks_exact_mut(stride).take(last) {
            let c = g[place] / pivot;
            g[place] = g[last];
            axpy(-c, &pivot_row, &mut g[..last]);
        }
        true
    }

    /// Inverts afresh.
    pub(super) fn refresh(&mut self) -> Result<(), LinearError> {
        let n = self.free.len();
        let equations = Matrix::from_fn(n, n, |i, j| self.equation(self.free[i], self.free[j]));
        let inverse = general_inverse(&equations)?;
        for (i, g) in self.inverse.chunks_exact_mut(self.place.len()).take(n).enumerate() {
            g[..n].copy_from_slice(inverse.row(i));
        }
        Ok(())
    }

    /// Becomes `other`, an inverse of the same stiffness.
    pub(super) fn copy_from(&mut self, other: &Self) {
        self.free.clone_from(&other.free);
        self.place.clone_from(&other.place);
        self.coupling.clone_from(&other.coupling);
        let (stride, n) = (self.place.len(), self.free.len());
        for (own, new) in
            self.inverse.chunks_exact_mut(stride).zip(other.inverse.chunks_exact(stride)).take(n)
        {
            own[..n].copy_from_slice(&new[..n]);
        }
    }

    /// G times the right-hand sides `right`, in the order of [`ActiveInverse::free`].
    pub(super) fn solve<'s>(&'s self, right: &'s [f64]) -> impl Iterator<Item = f64> + 's {
        (0..self.free.len()).map(move |i| dot(self.row(i), right))
    }
}

/// Pivots below this fraction of the diagonal are taken for zero.
const SINGULAR: f64 = 1e-12;

/// y += Σ weights_i rows(i), two rows at a time.
pub(super) fn add_rows<'m>(weights: &[f64], rows: impl Fn(usize) -> &'m [f64], y: &mut [f64]) {
    let mut pairs = weights.chunks_exact(2);
    for (k, pair) in pairs.by_ref().enumerate() {
        axpy_two((pair[0], rows(2 * k)), (pair[1], rows(2 * k + 1)), y);
    }
    if let [last] = pairs.remainder() {
        axpy(*last, rows(weights.len() - 1), y);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn updates_agree_with_a_fresh_inverse() {
        let stiffness =
            Matrix::from_fn(8, 8, |i, j| 1.0 / (1.0 + (i as f64 - j as f64).abs()) + 2.0 * f64::from(i == j));
        let mut active = ActiveInverse::new(&stiffness);
        for (component, coupling) in [(2, 0.0), (4, 0.3), (0, -0.3), (7, 0.0), (6, 0.0)] {
            assert!(active.add(component, coupling));
        }
        assert!(active.remove(4) && active.remove(6) && active.add(4, 0.0));
        let right = [1.0, -2.0, 0.5, 3.0];
        let updated: Vec<f64> = active.solve(&right).collect();
        active.refresh().unwrap();
        for (fast, fresh) in updated.iter().zip(active.solve(&right)) {
            assert!((fast - fresh).abs() < 1e-13, "{fast} {fresh}");
        }
        assert_eq!(active.free(), [2, 7, 0, 4]);
    }

    #[test]
    fn a_pivot_that_vanishes_is_told_and_repaired_once_the_equations_are_sound() {
        // A_0 + A_1 vanishes on component 0, but not on 0 and 2 together.
        let rows = [[2.0, -2.0, 1.0], [-2.0, 3.0, 0.5], [1.0, 0.5, 4.0]];
        let stiffness = Matrix::from_fn(3, 3, |i, j| rows[i][j]);
        let mut active = ActiveInverse::new(&stiffness);
        assert!(!active.add(0, 1.0));
        assert!(active.refresh().is_err());
        let _ = active.add(2, 0.0);
        active.refresh().unwrap();
        // (A_0 + A_1)·x = 1.5 x_2 = 3 and A_2·x = x_0 + 4 x_2 = 1.
        let x: Vec<f64> = active.solve(&[3.0, 1.0]).collect();
        assert!((x[0] + 7.0).abs() < 1e-14 && (x[1] - 2.0).abs() < 1e-14, "{x:?}");
    }
}
