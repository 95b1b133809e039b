//! Round numbers on an axis.

/// The smallest 1, 2 or 5 times a power of ten that divides `span` into at most `most` steps.
pub(crate) fn round_step(span: f64, most: usize) -> f64 {
    let least = span / most.max(1) as f64;
    if !(least > 0.0 && least.is_finite()) {
        return 1.0;
    }
    let decade = 10f64.powf(least.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|digit| digit * decade);
    // A span that is a whole number of steps up to round-off keeps its step.
    steps.into_iter().find(|&step| step >= least * (1.0 - 1e-9)).unwrap_or(10.0 * decade)
}

/// Multiples of `step` from `low` to `high`, ends included.
pub(crate) fn multiples(low: f64, high: f64, step: f64) -> Vec<f64> {
    let first = (low / step - 1e-9).ceil() as i64;
    let last = (high / step + 1e-9).floor() as i64;
    (first..=last).map(|i| i as f64 * step).collect()
}

/// The power of ten, a multiple of three, that scales values up to `largest` to between 1 and 10⁴;
/// 0 for values that need no scaling.
pub(crate) fn scale_exponent(largest: f64) -> i32 {
    if !(largest > 0.0 && largest.is_finite()) || (1e-2..1e4).contains(&largest) {
        return 0;
    }
    (largest.log10() / 3.0).floor() as i32 * 3
}

/// Decimals that multiples of `step` need.
pub(crate) fn decimals_of(step: f64) -> usize {
    (-step.log10() - 1e-9).ceil().clamp(0.0, 12.0) as usize
}

/// `value` with the decimals that multiples of `step` need; a true minus sign.
pub(crate) fn tick_label(value: f64, step: f64) -> String {
    let decimals = decimals_of(step);
    // No "-0".
    let value = if value.abs() < 1e-9 * step { 0.0 } else { value };
    format!("{value:.decimals$}").replace('-', "\u{2212}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_round_and_few() {
        let cases = [(12.0, 6, 2.0), (12.0, 8, 2.0), (1.0, 5, 0.2), (3.7e6, 6, 1e6), (0.031, 7, 0.005)];
        for (span, most, want) in cases {
            let step = round_step(span, most);
            assert!((step / want - 1.0).abs() < 1e-12, "{span}: {step}");
        }
        assert_eq!(round_step(0.0, 5), 1.0);
    }

    #[test]
    fn ticks_include_the_ends() {
        assert_eq!(multiples(-6.0, 6.0, 2.0), [-6.0, -4.0, -2.0, 0.0, 2.0, 4.0, 6.0]);
        assert_eq!(multiples(0.05, 0.42, 0.1).len(), 4);
    }

    #[test]
    fn labels_carry_the_decimals_of_the_step() {
        assert_eq!(tick_label(-2.0, 2.0), "\u{2212}2");
        assert_eq!(tick_label(0.1 + 0.2, 0.05), "0.30");
        assert_eq!(tick_label(-1e-17, 0.5), "0.0");
        assert_eq!((scale_exponent(3.7e6), scale_exponent(900.0), scale_exponent(2e-7)), (6, 0, -9));
    }
}
