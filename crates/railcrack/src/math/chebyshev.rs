//! Interpolation of analytic functions at Chebyshev points.

use std::f64::consts::PI;
use std::ops::RangeInclusive;

/// The roots of the Chebyshev polynomial of degree `count`, mapped to `range`, in increasing order.
pub(crate) fn points(range: &RangeInclusive<f64>, count: usize) -> Vec<f64> {
    let (middle, half) = (0.5 * (range.start() + range.end()), 0.5 * (range.end() - range.start()));
    (0..count).map(|j| middle - half * (PI * (j as f64 + 0.5) / count as f64).cos()).collect()
}

/// The weights with which the values at [`points`] give the value of their interpolating polynomial
/// at `at` (second barycentric formula with weights (−1)^j sin((2j + 1) π / 2n); Berrut &
/// Trefethen, SIAM Review 46, 2004).
pub(crate) fn weights(points: &[f64], at: f64) -> Vec<f64> {
    if let Some(hit) = points.iter().position(|&point| point == at) {
        return (0..points.len()).map(|j| f64::from(j == hit)).collect();
    }
    let n = points.len() as f64;
    let term = |(j, point): (usize, &f64)| {
        let sign = if j.is_multiple_of(2) { 1.0 } else { -1.0 };
        sign * (PI * (j as f64 + 0.5) / n).sin() / (at - point)
    };
    let terms: Vec<f64> = points.iter().enumerate().map(term).collect();
    let sum: f64 = terms.iter().sum();
    terms.into_iter().map(|term| term / sum).collect()
}

/// Convergence rate of the interpolation on a range, where n points leave an error of the order of
/// e^(−rate n). The function is analytic except for branch points on the real axis at the distance
/// `beyond` from the ends of the range, and others at the distance `beside` from the axis (both in
/// half-lengths of the range). The rate is ln ρ of the largest ellipse between them, with semi-axes
/// (ρ ± 1/ρ)/2 (Trefethen, Approximation Theory and Approximation Practice, theorem 8.2).
pub(crate) fn rate(beyond: f64, beside: f64) -> f64 {
    let real = (beyond + (beyond * (beyond + 2.0)).sqrt()).ln_1p();
    real.min(beside.asinh())
}

/// Number of points for an error of `tolerance` relative to the size of the function; infinite for
/// a rate of zero.
pub(crate) fn count(rate: f64, tolerance: f64) -> f64 {
    // The constant of the theorem, 2 / (ρ − 1), is 2/rate for the small rates at which it matters.
    ((1.0 / tolerance).ln() + (2.0 / rate).ln().max(0.0)) / rate + 2.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn interpolates_a_logarithm_and_a_root_within_the_predicted_error() {
        const TOLERANCE: f64 = 1e-8;
        for gap in [0.05, 0.5, 3.0, 40.0] {
            let range = -3.0..=5.0;
            let n = count(rate(gap / 4.0, f64::INFINITY), TOLERANCE).ceil() as usize;
            let points = points(&range, n);
            for function in [|x: f64| x.ln(), |x: f64| x.sqrt()] {
                let values: Vec<f64> = points.iter().map(|x| function(5.0 + gap - x)).collect();
                let size = values.iter().fold(1.0, |size: f64, v| size.max(v.abs()));
                for i in 0..=200 {
                    let x = -3.0 + 0.04 * f64::from(i);
                    let got: f64 = weights(&points, x).iter().zip(&values).map(|(w, v)| w * v).sum();
                    let error = (got - function(5.0 + gap - x)).abs() / size;
                    assert!(error < TOLERANCE, "gap {gap}, {n} points, at {x}: {error:e}");
                }
            }
        }
    }

    #[test]
    fn poles_beside_the_range_lower_the_rate() {
        const TOLERANCE: f64 = 1e-8;
        for beside in [0.3, 1.0, 5.0] {
            let n = count(rate(10.0, beside / 4.0), TOLERANCE).ceil() as usize;
            let points = points(&(-3.0..=5.0), n);
            let function = |x: f64| ((x - 1.0).powi(2) + beside * beside).ln();
            for i in 0..=200 {
                let x = -3.0 + 0.04 * f64::from(i);
                let got: f64 = weights(&points, x).iter().zip(&points).map(|(w, p)| w * function(*p)).sum();
                let error = (got - function(x)).abs();
                assert!(error < TOLERANCE, "beside {beside}, {n} points, at {x}: {error:e}");
            }
        }
    }

    #[test]
    fn a_point_gives_its_own_value() {
        let points = points(&(0.0..=1.0), 5);
        assert_eq!(weights(&points, points[3]), [0.0, 0.0, 0.0, 1.0, 0.0]);
    }
}
