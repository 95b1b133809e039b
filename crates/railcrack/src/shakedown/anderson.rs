//! Extrapolation of fixed-point iterations on large fields.

use crate::math::{axpy, dot};

/// Anderson acceleration (Anderson 1965; Walker & Ni 2011, type II) by the normal equations: the fields are long, the
/// history is short.
pub(super) struct Anderson {
    depth: usize,
    /// Differences of residuals and of images between consecutive iterations, oldest first.
    residual_steps: Vec<Vec<f64>>,
    image_steps: Vec<Vec<f64>>,
    last: Option<(Vec<f64>, Vec<f64>)>,
}

/// A pivot of the normal equations below this share of its diagonal adds nothing but round-off.
const DEPENDENT: f64 = 1e-10;

impl Anderson {
    pub(super) fn new(depth: usize) -> Self {
        Self { depth, residual_steps: Vec::new(), image_steps: Vec::new(), last: None }
    }

    /// The next iterate after `iterate`, whose image is `image`.
    pub(super) fn next(&mut self, iterate: &[f64], image: &[f64]) -> Vec<f64> {
        let residual: Vec<f64> = image.iter().zip(iterate).map(|(g, x)| g - x).collect();
        if let Some((mut old_residual, mut old_image)) = self.last.take() {
            if self.residual_steps.len() == self.depth {
                self.residual_steps.remove(0);
                self.image_steps.remove(0);
            }
            old_residual.iter_mut().zip(&residual).for_each(|(old, new)| *old = new - *old);
            old_image.iter_mut().zip(image).for_each(|(old, new)| *old = new - *old);
            self.residual_steps.push(old_residual);
            self.image_steps.push(old_image);
        }
        let mut next = image.to_vec();
        for (weight, step) in self.weights(&residual).into_iter().zip(&self.image_steps) {
            axpy(-weight, step, &mut next);
        }
        self.last = Some((residual, image.to_vec()));
        next
    }

    /// Least squares of the residual by its differences, the newest eliminated first.
    fn weights(&self, residual: &[f64]) -> Vec<f64> {
        let m = self.residual_steps.len();
        let newest = |i: usize| &self.residual_steps[m - 1 - i];
        let mut matrix: Vec<Vec<f64>> = (0..m)
            .map(|i| (0..m).map(|j| if j <= i { dot(newest(i), newest(j)) } else { 0.0 }).collect())
            .collect();
        let mut right: Vec<f64> = (0..m).map(|i| dot(newest(i), residual)).collect();
        // Cholesky; a direction that depends on newer ones is left out.
        for i in 0..m {
            let diagonal = matrix[i][i];
            for j in 0..i {
                let sum: f64 = (0..j).map(|k| matrix[i][k] * matrix[j][k]).sum();
                matrix[i][j] = if matrix[j][j] > 0.0 { (matrix[i][j] - sum) / matrix[j][j] } else { 0.0 };
            }
            let pivot = diagonal - (0..i).map(|k| matrix[i][k] * matrix[i][k]).sum::<f64>();
            matrix[i][i] = if pivot > DEPENDENT * diagonal { pivot.sqrt() } else { 0.0 };
        }
        for i in 0..m {
            let sum: f64 = (0..i).map(|k| matrix[i][k] * right[k]).sum();
            right[i] = if matrix[i][i] > 0.0 { (right[i] - sum) / matrix[i][i] } else { 0.0 };
        }
        for i in (0..m).rev() {
            let sum: f64 = (i + 1..m).map(|k| matrix[k][i] * right[k]).sum();
            right[i] = if matrix[i][i] > 0.0 { (right[i] - sum) / matrix[i][i] } else { 0.0 };
        }
        right.reverse();
        right
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_a_linear_fixed_point_in_as_many_steps_as_unknowns() {
        let map =
            |x: &[f64]| vec![0.9 * x[0] + 0.3 * x[1] + 1.0, -0.2 * x[0] + 0.95 * x[1], 0.99 * x[2] + 0.5];
        let mut x = vec![0.0; 3];
        let mut extrapolation = Anderson::new(5);
        for _ in 0..8 {
            x = extrapolation.next(&x, &map(&x));
        }
        let fixed = map(&x);
        assert!(x.iter().zip(&fixed).all(|(x, g)| (x - g).abs() < 1e-8), "{x:?} {fixed:?}");
    }
}
