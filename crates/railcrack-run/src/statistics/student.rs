//! Student's distribution.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};

/// Student's t of 97.5 % for `degrees` ≥ 1 of freedom: within ±t lie 95 % of the distribution.
#[must_use]
pub fn student(degrees: usize) -> f64 {
    let (mut low, mut high) = (0.0, FRAC_PI_2);
    // The interval of angles is halved until only the last bits of t are open.
    for _ in 0..52 {
        let middle = 0.5 * (low + high);
        if within(middle, degrees) < 0.95 { low = middle } else { high = middle }
    }
    low.tan() * (degrees as f64).sqrt()
}

/// The probability that |t| < √ν tan `angle`, ν the `degrees` of freedom: a finite sum (Abramowitz
/// and Stegun 1964, 26.7.3 and 26.7.4).
fn within(angle: f64, degrees: usize) -> f64 {
    let (sin, cos) = angle.sin_cos();
    let is_odd = degrees % 2 == 1;
    let first = if is_odd { cos } else { 1.0 };
    let mut term = if degrees == 1 { 0.0 } else { first };
    let mut sum = term;
    for i in (2 + degrees % 2..degrees.saturating_sub(1)).step_by(2) {
        term *= cos * cos * (i - 1) as f64 / i as f64;
        sum += term;
    }
    if is_odd { FRAC_2_PI * (angle + sin * sum) } else { sin * sum }
}

#[cfg(test)]
mod tests {
    use super::student;

    #[test]
    fn quantiles_are_those_of_tables() {
        // Abramowitz and Stegun 1964, table 26.10; 14 and 1000 by the incomplete beta function.
        for (degrees, t) in [
            (1, 12.706_205),
            (2, 4.302_653),
            (3, 3.182_446),
            (4, 2.776_445),
            (5, 2.570_582),
            (9, 2.262_157),
            (14, 2.144_787),
            (19, 2.093_024),
            (60, 2.000_298),
            (119, 1.980_100),
            (1000, 1.962_339),
        ] {
            assert!((student(degrees) - t).abs() < 1e-6 * t, "{degrees}: {} and {t}", student(degrees));
        }
    }
}
