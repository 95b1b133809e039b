//! Quadrature rules, graded nodes, Lagrange polynomials and elliptic integrals.

use std::f64::consts::FRAC_PI_2;

/// The `n`-point Gauss–Legendre rule on [0, 1]: (point, weight), exact for polynomials of degree
/// 2n − 1.
///
/// Points by Newton's method on the Legendre recurrence (Abramowitz & Stegun, 25.4.29).
pub fn gauss_legendre(n: usize) -> Vec<(f64, f64)> {
    let mut rule = vec![(0.0, 0.0); n];
    for i in 0..n.div_ceil(2) {
        let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..100 {
            let (mut p, mut previous) = (1.0, 0.0);
            for j in 0..n {
                let j = j as f64;
                (p, previous) = (((2.0 * j + 1.0) * x * p - j * previous) / (j + 1.0), p);
            }
            slope = n as f64 * (x * p - previous) / (x * x - 1.0);
            let step = p / slope;
            x -= step;
            if step.abs() < 1e-15 {
                break;
            }
        }
        let weight = 1.0 / ((1.0 - x * x) * slope * slope);
        rule[i] = (0.5 * (1.0 - x), weight);
        rule[n - 1 - i] = (0.5 * (1.0 + x), weight);
    }
    rule
}

/// Interior points that divide [a, b] into intervals with equal integrals of `density` (elements
/// per length). The number of intervals is the rounded-up integral over [a, b], so that the
/// elements of this graded mesh have the size 1/density or slightly less.
pub(crate) fn quantiles(a: f64, b: f64, density: impl Fn(f64) -> f64) -> Vec<f64> {
    const CELLS: usize = 400;
    let step = (b - a) / CELLS as f64;
    let mut sums = vec![0.0];
    for i in 0..CELLS {
        sums.push(sums[i] + step * density(a + (i as f64 + 0.5) * step));
    }
    let total = sums[CELLS];
    // Slightly below the ceiling, so that a uniform density gives exactly the number of elements it
    // stands for.
    let count = (total - 1e-6).ceil().max(1.0) as usize;
    (1..count)
        .map(|k| {
            let want = total * k as f64 / count as f64;
            let cell = sums.partition_point(|&sum| sum <= want).clamp(1, CELLS) - 1;
            a + step * (cell as f64 + (want - sums[cell]) / (sums[cell + 1] - sums[cell]))
        })
        .collect()
}

/// Complete elliptic integrals of one modulus e.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CompleteElliptic {
    /// K, of the first kind.
    pub k: f64,
    /// E, of the second kind.
    pub e: f64,
    /// D = (K − E)/e², without cancellation where e vanishes: π/4 there.
    pub d: f64,
}

/// K, E and D of the complementary modulus k′ = √(1 − e²) = `complement`, in (0, 1], by the
/// arithmetic–geometric mean (Abramowitz and Stegun, 17.6).
pub(crate) fn complete_elliptic(complement: f64) -> CompleteElliptic {
    let modulus2 = (1.0 - complement) * (1.0 + complement);
    let (mut a, mut g) = (1.0, complement);
    // ½ + Σ 2^(n−1) c_n²/e²; c_1 = (1 − k′)/2 = e²/(2 (1 + k′)).
    let mut sum = 0.5;
    let mut power = 1.0;
    let mut ratio = 0.5 / (1.0 + complement); // c_n/e²
    loop {
        (a, g) = (0.5 * (a + g), (a * g).sqrt());
        let term = power * ratio * ratio * modulus2;
        sum += term;
        if term <= 1e-17 * sum {
            break;
        }
        // c_(n+1) = c_n²/(4 a_(n+1)), a_(n+1) the next mean.
        ratio = ratio * ratio * modulus2 / (4.0 * (0.5 * (a + g)));
        power *= 2.0;
    }
    let k = FRAC_PI_2 / (0.5 * (a + g));
    let d = k * sum;
    CompleteElliptic { k, e: k - modulus2 * d, d }
}

/// Weights of the Lagrange polynomial through the four points of `at` nearest to `x` (all, if there
/// are fewer), and the index of the first.
pub(crate) fn lagrange(at: &[f64], x: f64) -> (usize, Vec<f64>) {
    let count = at.len().min(4);
    let above = at.partition_point(|&point| point <= x);
    let first = above.saturating_sub(count / 2).min(at.len() - count);
    let points = &at[first..first + count];
    let weight = |j: usize| {
        let others = points.iter().enumerate().filter(|(k, _)| *k != j);
        others.map(|(_, point)| (x - point) / (points[j] - point)).product()
    };
    (first, (0..count).map(weight).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn integrates_polynomials_up_to_degree_two_n_minus_one() {
        for n in 1..=12 {
            let rule = gauss_legendre(n);
            for degree in 0..2 * n {
                let sum: f64 = rule.iter().map(|(x, w)| w * x.powi(degree as i32)).sum();
                assert!((sum - 1.0 / (degree as f64 + 1.0)).abs() < 1e-14, "n {n}, degree {degree}: {sum}");
            }
            let beyond: f64 = rule.iter().map(|(x, w)| w * x.powi(2 * n as i32)).sum();
            assert!(n > 8 || (beyond - 1.0 / (2.0 * n as f64 + 1.0)).abs() > 1e-14);
        }
    }

    #[test]
    fn tabulated_values() {
        // Abramowitz and Stegun, table 17.1: parameter e² = 0.5 and 0.99; e = 0 exactly.
        let at = |parameter: f64| complete_elliptic((1.0 - parameter).sqrt());
        for (parameter, k, e) in [
            (0.0, FRAC_PI_2, FRAC_PI_2),
            (0.5, 1.854_074_677_301_372, 1.350_643_881_047_675),
            (0.99, 3.695_637_362_989_875, 1.015_993_545_025_224),
        ] {
            let got = at(parameter);
            assert!((got.k - k).abs() < 1e-14 && (got.e - e).abs() < 1e-14, "{parameter}: {got:?}");
        }
        assert!((at(0.0).d - 0.25 * PI).abs() < 1e-16);
        assert!((at(1e-9).d - 0.25 * PI).abs() < 1e-9);
    }
}
