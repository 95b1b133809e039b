//! Anderson acceleration of fixed-point iterations.

use super::dot;

/// Anderson acceleration (Anderson 1965; Walker & Ni 2011, type II): the combination of the last
/// iterates whose residuals cancel best.
pub(crate) struct Anderson {
    depth: usize,
    /// Differences of residuals and of iterates + residuals between consecutive iterations.
    residual_steps: Vec<Vec<f64>>,
    image_steps: Vec<Vec<f64>>,
    last: Option<(Vec<f64>, Vec<f64>)>,
}

impl Anderson {
    pub(crate) fn new(depth: usize) -> Self {
        Self { depth, residual_steps: Vec::new(), image_steps: Vec::new(), last: None }
    }

    /// Replaces the iterate x, whose residual is g(x) − x, by the next one.
    pub(crate) fn advance(&mut self, iterate: &mut [f64], residual: &[f64]) {
        let image: Vec<f64> = iterate.iter().zip(residual).map(|(x, r)| x + r).collect();
        if self.depth == 0 {
            iterate.copy_from_slice(&image);
            return;
        }
        if let Some((old_residual, old_image)) = self.last.take() {
            if self.residual_steps.len() == self.depth {
                self.residual_steps.remove(0);
                self.image_steps.remove(0);
            }
            let step = |new: &[f64], old: &[f64]| new.iter().zip(old).map(|(a, b)| a - b).collect();
            self.residual_steps.push(step(residual, &old_residual));
            self.image_steps.push(step(&image, &old_image));
        }
        let weights = self.weights(residual);
        iterate.copy_from_slice(&image);
        for (weight, step) in weights.iter().zip(&self.image_steps) {
            for (x, s) in iterate.iter_mut().zip(step) {
                *x -= weight * s;
            }
        }
        self.last = Some((residual.to_vec(), image));
    }

    /// Least squares by orthogonalising the newest differences first; linearly dependent directions
    /// are left out.
    fn weights(&self, residual: &[f64]) -> Vec<f64> {
        let m = self.residual_steps.len();
        let mut basis: Vec<Vec<f64>> = Vec::new();
        let mut triangle = vec![vec![0.0; m]; m];
        let mut kept = Vec::new();
        for k in (0..m).rev() {
            let mut vector = self.residual_steps[k].clone();
            let before = dot(&vector, &vector);
            let mut row = vec![0.0; basis.len()];
            for (r, q) in row.iter_mut().zip(&basis) {
                *r = dot(q, &vector);
                vector.iter_mut().zip(q).for_each(|(v, q)| *v -= *r * q);
            }
            let norm2 = dot(&vector, &vector);
            if norm2 <= 1e-20 * before || norm2 == 0.0 {
                continue;
            }
            let norm = norm2.sqrt();
            vector.iter_mut().for_each(|v| *v /= norm);
            let column = basis.len();
            for (i, r) in row.into_iter().enumerate() {
                triangle[i][column] = r;
            }
            triangle[column][column] = norm;
            basis.push(vector);
            kept.push(k);
        }
        let mut right: Vec<f64> = basis.iter().map(|q| dot(q, residual)).collect();
        for i in (0..right.len()).rev() {
            for j in i + 1..right.len() {
                right[i] -= triangle[i][j] * right[j];
            }
            right[i] /= triangle[i][i];
        }
        let mut weights = vec![0.0; m];
        for (k, weight) in kept.into_iter().zip(right) {
            weights[k] = weight;
        }
        weights
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
        for _ in 0..6 {
            let residual: Vec<f64> = map(&x).iter().zip(&x).map(|(g, x)| g - x).collect();
            extrapolation.advance(&mut x, &residual);
        }
        let fixed = map(&x);
        assert!(x.iter().zip(&fixed).all(|(x, g)| (x - g).abs() < 1e-9), "{x:?} {fixed:?}");
    }
}
