//! Complete elliptic integrals.

use std::f64::consts::FRAC_PI_2;

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

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

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
