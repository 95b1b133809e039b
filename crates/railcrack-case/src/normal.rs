//! Quantiles of the normal distribution.

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
    use super::quantile;

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
}
