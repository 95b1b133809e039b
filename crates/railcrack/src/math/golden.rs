//! Golden section.

const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// The part of a range that is kept where a function has the same value at both inner points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ties {
    /// The part up to the second point.
    First,
    /// The part between them: the mirrored function gives the mirrored argument to the last bit.
    Middle,
}

/// The argument in `[from, to]` at which `value`, which has one maximum there, is largest. Each of
/// `sections` shortens the range to 0.618 of it.
pub fn golden_section(
    [mut from, mut to]: [f64; 2],
    sections: usize,
    ties: Ties,
    value: impl Fn(f64) -> f64,
) -> f64 {
    for _ in 0..sections {
        let width = GOLDEN * (to - from);
        let (left, right) = (to - width, from + width);
        let (at_left, at_right) = (value(left), value(right));
        if at_left >= at_right {
            to = right;
        }
        if at_left < at_right || (at_left == at_right && ties == Ties::Middle) {
            from = left;
        }
    }
    0.5 * (from + to)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_maximum_and_mirrors_it() {
        let hill = |x: f64| -(x - 0.3).powi(2);
        let at = golden_section([-1.0, 1.0], 40, Ties::Middle, hill);
        assert!((at - 0.3).abs() < 1e-7, "{at}");
        assert_eq!(golden_section([-1.0, 1.0], 40, Ties::Middle, |x| hill(-x)), -at);
        assert!(golden_section([0.0, 1.0], 30, Ties::First, |x| -x) < 1e-6);
    }
}
