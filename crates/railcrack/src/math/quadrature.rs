//! Quadrature rules.

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

#[cfg(test)]
mod tests {
    use super::*;

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
}
