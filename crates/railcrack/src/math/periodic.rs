//! Trigonometric interpolation between equidistant nodes of a period of 2π, an even number of them:
//! node j lies at 2πj/n. The interpolant has harmonics up to n/2, the last as a cosine alone.

use std::f64::consts::PI;

/// The angle of node `j` of `count`, radians.
pub(crate) fn node(count: usize, j: usize) -> f64 {
    2.0 * PI * j as f64 / count as f64
}

/// Factors of the harmonics from 0 to `count`/2 in the sum of an interpolant.
fn factors(count: usize) -> impl Iterator<Item = (f64, f64)> {
    let last = count / 2;
    let factor = move |k: usize| if k == 0 || k == last { 1.0 } else { 2.0 };
    (0..=last).map(move |k| (k as f64, factor(k) / count as f64))
}

/// Weight of the value at node `j` of `count` in the interpolant at `angle` (radians).
pub(crate) fn weight(count: usize, j: usize, angle: f64) -> f64 {
    let from = angle - node(count, j);
    factors(count).map(|(k, factor)| factor * (k * from).cos()).sum()
}

/// Weight of the value at node `j` of `count` in the derivative of the interpolant at `angle`.
pub(crate) fn slope_weight(count: usize, j: usize, angle: f64) -> f64 {
    let from = angle - node(count, j);
    factors(count).map(|(k, factor)| -factor * k * (k * from).sin()).sum()
}

/// Coefficients of cos kφ and sin kφ, k from 0 to n/2, of the interpolant of n `values`.
pub(crate) fn harmonics(values: &[f64]) -> Vec<[f64; 2]> {
    let count = values.len();
    let of = |(k, factor): (f64, f64)| {
        let mut sums = [0.0; 2];
        for (j, value) in values.iter().enumerate() {
            let (sin, cos) = (k * node(count, j)).sin_cos();
            sums[0] += factor * value * cos;
            sums[1] += factor * value * sin;
        }
        // The sine of the last harmonic vanishes at every node.
        if 2 * k as usize == count { [sums[0], 0.0] } else { sums }
    };
    factors(count).map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn harmonics_up_to_half_the_nodes_are_exact() {
        const COUNT: usize = 12;
        let of = |phi: f64| 0.3 + (2.0 * phi).cos() - 0.2 * (5.0 * phi).sin() + 0.1 * (6.0 * phi).cos();
        let slope = |phi: f64| -2.0 * (2.0 * phi).sin() - (5.0 * phi).cos() - 0.6 * (6.0 * phi).sin();
        let values: Vec<f64> = (0..COUNT).map(|j| of(node(COUNT, j))).collect();
        for phi in [-0.4, 0.1, 1.3, 2.9, 5.7] {
            let sum = |weight: fn(usize, usize, f64) -> f64| {
                values.iter().enumerate().map(|(j, value)| value * weight(COUNT, j, phi)).sum::<f64>()
            };
            assert!((sum(weight) - of(phi)).abs() < 1e-13 && (sum(slope_weight) - slope(phi)).abs() < 1e-12);
        }
        for (k, [cos, sin]) in harmonics(&values).into_iter().enumerate() {
            let want = match k {
                0 => [0.3, 0.0],
                2 => [1.0, 0.0],
                5 => [0.0, -0.2],
                6 => [0.1, 0.0],
                _ => [0.0; 2],
            };
            assert!((cos - want[0]).abs() < 1e-14 && (sin - want[1]).abs() < 1e-14, "{k} {cos} {sin}");
        }
    }
}
