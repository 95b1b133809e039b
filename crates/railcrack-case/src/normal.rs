//! The normal distribution.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// The quantile of 97.5 %: 95 % of a normal distribution lie within so many standard deviations.
pub const QUANTILE_97_5: f64 = 1.959_963_984_540_054;

/// The standard normal density φ(z).
#[must_use]
pub fn density(z: f64) -> f64 {
    (-0.5 * z * z).exp() / (2.0 * PI).sqrt()
}

/// ln of the normal density of `x` about `mean` with `variance` > 0.
#[must_use]
pub fn log_density(x: f64, mean: f64, variance: f64) -> f64 {
    -0.5 * ((x - mean).powi(2) / variance + (2.0 * PI * variance).ln())
}

/// The standard normal distribution function Φ(z), either tail to 1e-13 of its value down to
/// 1e-300.
#[must_use]
pub fn distribution(z: f64) -> f64 {
    0.5 * libm::erfc(-z * FRAC_1_SQRT_2)
}

/// ln Φ(z), also where Φ(z) itself is too small for a number.
#[must_use]
pub fn log_distribution(z: f64) -> f64 {
    /// Below it the asymptotic series, whose first neglected term is 3e-11 there.
    const FAR: f64 = -37.0;
    if z > 0.0 {
        (-distribution(-z)).ln_1p()
    } else if z > FAR {
        distribution(z).ln()
    } else {
        // Abramowitz and Stegun (1964), 26.2.12.
        let q = (z * z).recip();
        let series = 1.0 - q * (1.0 - 3.0 * q * (1.0 - 5.0 * q));
        -0.5 * (z * z + (2.0 * PI).ln()) - (-z).ln() + series.ln()
    }
}

/// ln(Φ(high) − Φ(low)) for `low` < `high`: the probability of an interval in either tail.
#[must_use]
pub fn log_of_interval(low: f64, high: f64) -> f64 {
    // From the nearer side: a difference of two numbers near one loses its digits.
    let (low, high) = if low > 0.0 { (-high, -low) } else { (low, high) };
    let whole = log_distribution(high);
    whole + (-(log_distribution(low) - whole).exp_m1()).ln()
}

/// The standard normal quantile of `p` in (0, 1), to about 1e-16 of its value (Wichura 1988,
/// algorithm AS 241, PPND16).
#[must_use]
pub fn quantile(p: f64) -> f64 {
    let q = p - 0.5;
    if q.abs() <= 0.425 {
        let r = 0.180_625 - q * q;
        return q * ratio(r, &MIDDLE);
    }
    let r = (-(if q <= 0.0 { p } else { 1.0 - p }).ln()).sqrt();
    let x = if r <= 5.0 { ratio(r - 1.6, &NEAR) } else { ratio(r - 5.0, &FAR) };
    if q < 0.0 { -x } else { x }
}

/// Coefficients of a numerator and a denominator, of ascending powers.
type Rational = [[f64; 8]; 2];

fn ratio(r: f64, of: &Rational) -> f64 {
    let [numerator, denominator] =
        of.map(|coefficients| coefficients.iter().rev().fold(0.0, |sum, coefficient| sum * r + coefficient));
    numerator / denominator
}

/// |p − 0.5| ≤ 0.425, of 0.425² − (p − 0.5)².
#[rustfmt::skip]
const MIDDLE: Rational = [
    [
        3.3871328727963665, 133.14166789178438, 1971.5909503065513, 13731.69376550946,
        45921.95393154987, 67265.7709270087, 33430.57558358813, 2509.0809287301227,
    ],
    [
        1.0, 42.31333070160091, 687.1870074920579, 5394.196021424751,
        21213.794301586597, 39307.89580009271, 28729.085735721943, 5226.495278852854,
    ],
];

/// Below, to √(−ln p) = 5, of √(−ln p) − 1.6.
#[rustfmt::skip]
const NEAR: Rational = [
    [
        1.4234371107496835, 4.630337846156546, 5.769497221460691, 3.6478483247632045,
        1.2704582524523684, 0.2417807251774506, 0.022723844989269184, 0.0007745450142783414,
    ],
    [
        1.0, 2.053191626637759, 1.6763848301838038, 0.6897673349851,
        0.14810397642748008, 0.015198666563616457, 0.0005475938084995345, 1.0507500716444169e-09,
    ],
];

/// Beyond, of √(−ln p) − 5.
#[rustfmt::skip]
const FAR: Rational = [
    [
        6.657904643501103, 5.463784911164114, 1.7848265399172913, 0.29656057182850487,
        0.026532189526576124, 0.0012426609473880784, 2.7115555687434876e-05, 2.0103343992922881e-07,
    ],
    [
        1.0, 0.599832206555888, 0.1369298809227358, 0.014875361290850615,
        0.0007868691311456133, 1.8463183175100548e-05, 1.421511758316446e-07, 2.0442631033899397e-15,
    ],
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_tables() {
        // Abramowitz and Stegun (1964), table 26.5, and the tails of 1e-10 and 1e-20 by series.
        for (p, x) in [
            (0.5, 0.0),
            (0.975, 1.959_963_984_540_054),
            (0.995, 2.575_829_303_548_901),
            (0.001, -3.090_232_306_167_813),
            (1e-10, -6.361_340_902_404_056),
            (1e-20, -9.262_340_089_798_405),
        ] {
            assert!((quantile(p) - x).abs() <= 1e-13 * x.abs(), "{p}: {} and {x}", quantile(p));
        }
    }

    /// To be near means by a part of `want`.
    fn close(got: f64, want: f64, tolerance: f64) {
        assert!((got - want).abs() <= tolerance * want.abs(), "{got} {want}");
    }

    #[test]
    fn densities() {
        close(density(1.0), 0.241_970_724_519_143_37, 1e-15);
        close(log_density(3.0, 1.0, 4.0), (density(1.0) / 2.0).ln(), 1e-14);
    }

    #[test]
    fn both_tails_of_the_distribution() {
        // Abramowitz and Stegun (1964), table 26.1, and mpmath with 30 digits.
        for (z, want) in [
            (0.0, 0.5),
            (-1.0, 0.158_655_253_931_457_05),
            (-2.0, 0.022_750_131_948_179_21),
            (-4.0, 3.167_124_183_311_992e-5),
            (-10.0, 7.619_853_024_160_527e-24),
            (-30.0, 4.906_713_927_148_187e-198),
        ] {
            close(distribution(z), want, 1e-13);
            close(distribution(-z), 1.0 - want, 1e-15);
            close(log_distribution(z), want.ln(), 1e-13);
            close(log_distribution(-z), (-want).ln_1p(), 1e-13);
        }
        close(distribution(QUANTILE_97_5), 0.975, 1e-15);
        assert_eq!((distribution(-40.0), distribution(40.0)), (0.0, 1.0));
        assert_eq!(log_distribution(f64::NEG_INFINITY), f64::NEG_INFINITY);
        // Beyond the smallest number: mpmath.
        close(log_distribution(-40.0), -804.608_442_013_754, 1e-12);
        close(log_distribution(-1e3), -500_007.826_694_812_2, 1e-14);
    }

    #[test]
    fn intervals_in_both_tails() {
        close(log_of_interval(-1.0, 1.0), 0.682_689_492_137_086_f64.ln(), 1e-13);
        close(log_of_interval(f64::NEG_INFINITY, -9.0), log_distribution(-9.0), 1e-15);
        assert_eq!(log_of_interval(9.0, 11.0), log_of_interval(-11.0, -9.0));
        close(log_of_interval(9.0, 11.0), log_distribution(-9.0), 1e-7);
        // A narrow one has its width times the density.
        close(log_of_interval(50.0, 50.0 + 1e-9), -1250.0 + (1e-9 * density(0.0)).ln(), 1e-7);
    }
}
