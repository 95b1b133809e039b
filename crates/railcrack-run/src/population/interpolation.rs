//! Interpolation of several quantities over a designed sample of inputs.

use railcrack::linear::general_inverse;
use railcrack::math::Matrix;

/// Quantities interpolated over points of the space of inputs: a linear trend, and a stationary
/// Gaussian process of Matérn's kernel of order 5/2 about it (universal kriging; Rasmussen &
/// Williams 2006, 2.7 and 4.2).
///
/// Lengths of the kernel, one per input, and the share of the variance that is not smooth are those
/// with the smallest error at points that are left out (Dubrule 1983: in closed form, from the
/// inverse of the bordered matrix).
#[derive(Debug, Clone)]
pub(super) struct Interpolation {
    points: Vec<Vec<f64>>,
    kernel: Kernel,
    /// Inverse of the kernel's matrix bordered by the trend.
    inverse: Matrix,
    /// The inverse times the values: a row per point and term of the trend, a column per quantity.
    weights: Matrix,
    /// The values: a row per point.
    values: Matrix,
}

#[derive(Debug, Clone)]
struct Kernel {
    /// Length of the kernel for each input.
    lengths: Vec<f64>,
    /// Variance that is not smooth over the whole of the process.
    nugget: f64,
}

impl Kernel {
    fn at(&self, a: &[f64], b: &[f64]) -> f64 {
        let square: f64 =
            a.iter().zip(b).zip(&self.lengths).map(|((a, b), length)| ((a - b) / length).powi(2)).sum();
        let r = (5.0 * square).sqrt();
        (1.0 + r + r * r / 3.0) * (-r).exp()
    }
}

/// First lengths that are tried for all inputs at once, in standard deviations.
const LENGTHS: [f64; 6] = [1.0, 2.0, 4.0, 8.0, 16.0, 32.0];
/// Shares of the variance that is not smooth.
const NUGGETS: [f64; 4] = [1e-8, 1e-5, 1e-3, 3e-2];
/// Factors by which the length of one input is then changed, and how often.
const FACTORS: [f64; 2] = [0.5, 2.0];
const SWEEPS: usize = 2;
/// Standard deviation of a quantity (a ratio or a logarithm) that is the same at all points but for
/// round-off: it must not choose the kernel.
const ROUND_OFF: f64 = 1e-9;

impl Interpolation {
    /// Interpolation of `values`, a row for each of `points`; inputs are in standard deviations.
    /// None where there are too few points for a trend, or they say nothing about it.
    pub fn of(points: &[Vec<f64>], values: &Matrix) -> Option<Self> {
        let inputs = points.first()?.len();
        if points.len() < inputs + 3 {
            return None;
        }
        let mut best: Option<(f64, Self)> = None;
        let consider = |best: &mut Option<(f64, Self)>, kernel: Kernel| {
            let Some(tried) = Self::with(points, values, kernel) else { return };
            let error = tried.left_out_variance();
            if error.is_finite() && best.as_ref().is_none_or(|(least, _)| error < *least) {
                *best = Some((error, tried));
            }
        };
        for length in LENGTHS {
            for nugget in NUGGETS {
                consider(&mut best, Kernel { lengths: vec![length; inputs], nugget });
            }
        }
        for _ in 0..SWEEPS {
            for input in 0..inputs {
                for factor in FACTORS {
                    let mut kernel = best.as_ref()?.1.kernel.clone();
                    kernel.lengths[input] *= factor;
                    consider(&mut best, kernel);
                }
            }
        }
        best.map(|(_, interpolation)| interpolation)
    }

    fn with(points: &[Vec<f64>], values: &Matrix, kernel: Kernel) -> Option<Self> {
        let (n, inputs) = (points.len(), points.first()?.len());
        let trend = |i: usize, term: usize| if term == 0 { 1.0 } else { points[i][term - 1] };
        let order = n + 1 + inputs;
        let bordered = Matrix::from_fn(order, order, |i, j| match (i < n, j < n) {
            (true, true) if i == j => 1.0 + kernel.nugget,
            (true, true) => kernel.at(&points[i], &points[j]),
            (true, false) => trend(i, j - n),
            (false, true) => trend(j, i - n),
            (false, false) => 0.0,
        });
        let inverse = general_inverse(&bordered).ok()?;
        let quantities = values.columns();
        let mut weights = Matrix::zeros(order, quantities);
        for i in 0..order {
            for j in 0..n {
                let entry = inverse[(i, j)];
                for (weight, value) in weights.row_mut(i).iter_mut().zip(values.row(j)) {
                    *weight += entry * value;
                }
            }
        }
        Some(Self { points: points.to_vec(), kernel, inverse, weights, values: values.clone() })
    }

    /// The quantities at `point`.
    pub fn at(&self, point: &[f64]) -> Vec<f64> {
        let n = self.points.len();
        let mut sum = vec![0.0; self.weights.columns()];
        let mut add = |factor: f64, row: &[f64]| {
            sum.iter_mut().zip(row).for_each(|(sum, weight)| *sum += factor * weight);
        };
        for (i, own) in self.points.iter().enumerate() {
            add(self.kernel.at(own, point), self.weights.row(i));
        }
        add(1.0, self.weights.row(n));
        for (term, input) in point.iter().enumerate() {
            add(*input, self.weights.row(n + 1 + term));
        }
        sum
    }

    /// One `quantity` at `point`.
    pub fn one_at(&self, point: &[f64], quantity: usize) -> f64 {
        let n = self.points.len();
        let weight = |row: usize| self.weights[(row, quantity)];
        let near = self.points.iter().enumerate().map(|(i, own)| self.kernel.at(own, point) * weight(i));
        let trend = point.iter().enumerate().map(|(term, input)| input * weight(n + 1 + term));
        near.sum::<f64>() + weight(n) + trend.sum::<f64>()
    }

    /// The quantities at point `i`, interpolated from all others.
    pub fn left_out(&self, i: usize) -> Vec<f64> {
        let own = self.inverse[(i, i)];
        self.values
            .row(i)
            .iter()
            .zip(self.weights.row(i))
            .map(|(value, weight)| value - weight / own)
            .collect()
    }

    /// Mean square of the errors at points left out over the variance, summed over the quantities.
    fn left_out_variance(&self) -> f64 {
        let n = self.points.len();
        let mut sum = 0.0;
        for quantity in 0..self.values.columns() {
            let mean = (0..n).map(|i| self.values[(i, quantity)]).sum::<f64>() / n as f64;
            let variance: f64 = (0..n).map(|i| (self.values[(i, quantity)] - mean).powi(2)).sum();
            let error: f64 =
                (0..n).map(|i| (self.weights[(i, quantity)] / self.inverse[(i, i)]).powi(2)).sum();
            if variance > n as f64 * ROUND_OFF * ROUND_OFF {
                sum += error / variance;
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points of Halton's sequence in (−2, 2)², off any grid.
    fn points(count: usize) -> Vec<Vec<f64>> {
        let radical = |mut i: usize, base: usize| {
            let (mut value, mut digit) = (0.0, 1.0);
            while i > 0 {
                digit /= base as f64;
                value += digit * (i % base) as f64;
                i /= base;
            }
            value
        };
        (1..=count).map(|i| [2, 3].map(|base| 4.0 * radical(i, base) - 2.0).to_vec()).collect()
    }

    fn quantities(x: &[f64]) -> [f64; 2] {
        [3.0 - 0.5 * x[0] + 2.0 * x[1], (0.6 * x[0]).sin() + 0.2 * x[0] * x[1] + 0.1 * x[1] * x[1]]
    }

    fn fitted(count: usize) -> Interpolation {
        let points = points(count);
        let values = Matrix::from_fn(count, 2, |i, j| quantities(&points[i])[j]);
        Interpolation::of(&points, &values).unwrap()
    }

    #[test]
    fn a_plane_is_exact_and_a_smooth_function_converges() {
        let worst = |count: usize| {
            let interpolation = fitted(count);
            let mut worst = [0.0_f64; 2];
            for at in [[0.3, -1.1], [-1.2, 0.4], [1.3, 1.2], [0.0, 0.0]] {
                let (found, exact) = (interpolation.at(&at), quantities(&at));
                worst = [0, 1].map(|j| worst[j].max((found[j] - exact[j]).abs()));
            }
            worst
        };
        let (few, many) = (worst(20), worst(60));
        assert!(few[0] < 1e-4 && many[0] < 1e-4, "{few:?}, {many:?}");
        assert!(few[1] < 0.1 && many[1] < 0.1 * few[1], "{few:?}, {many:?}");
    }

    #[test]
    fn round_off_does_not_choose_the_kernel() {
        let points = points(30);
        let kernel = |constant: &dyn Fn(usize) -> f64| {
            let value = |i: usize, j: usize| if j < 2 { quantities(&points[i])[j] } else { constant(i) };
            let fitted = Interpolation::of(&points, &Matrix::from_fn(30, 3, value)).unwrap();
            (fitted.kernel.lengths, fitted.kernel.nugget)
        };
        let exact = kernel(&|_| 1.4);
        for seed in 1..8 {
            let noise = |i: usize| 1e-13 * ((i * i * seed) as f64 * 0.618).fract();
            assert_eq!(kernel(&|i| 1.4 + noise(i)), exact, "{seed}");
        }
        assert_ne!(kernel(&|i| 1.4 + ((i * i) as f64 * 0.618).fract()), exact);
    }

    #[test]
    fn a_point_left_out_is_that_of_a_fit_without_it() {
        let whole = fitted(25);
        for i in [0, 7, 24] {
            let mut points = points(25);
            let left_out = points.remove(i);
            let values = Matrix::from_fn(24, 2, |i, j| quantities(&points[i])[j]);
            let without = Interpolation::with(&points, &values, whole.kernel.clone()).unwrap();
            for (closed, direct) in whole.left_out(i).iter().zip(without.at(&left_out)) {
                assert!((closed - direct).abs() < 1e-6, "{i}: {closed} and {direct}");
            }
        }
    }
}
