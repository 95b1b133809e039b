//! Classes of sizes, as lists of inspections name them.

/// Columns of the bounds of a class.
pub(super) const AT_LEAST: &str = "at_least_mm";
pub(super) const AT_MOST: &str = "at_most_mm";

/// A class of sizes (mm): above the one and up to the other bound, where they are given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SizeClass {
    pub above: Option<f64>,
    pub up_to: Option<f64>,
}

/// Words and signs between the bounds of a class.
const BETWEEN: [&str; 7] = ["\u{2013}", "\u{2014}", "\u{2212}", "...", "..", " to ", "-"];
/// Signs before the bound of a class with one.
const BELOW: [&str; 4] = ["<=", "\u{2264}", "<", "up to "];
const ABOVE: [&str; 4] = [">=", "\u{2265}", ">", "from "];

impl SizeClass {
    /// The class that `given` names: 0.5-1.0, <0.5, > 2.7; `number` reads a bound. None of others.
    pub fn of(given: &str, number: impl Fn(&str) -> Option<f64>) -> Option<Self> {
        let given = given.trim();
        let given = given.strip_suffix("mm").unwrap_or(given).trim();
        let bound = |text: &str| number(text.trim()).filter(|bound| *bound >= 0.0);
        let after = |signs: [&str; 4]| signs.iter().find_map(|sign| given.strip_prefix(sign));
        if let Some(rest) = after(BELOW) {
            return Some(Self { above: None, up_to: Some(bound(rest)?) });
        }
        if let Some(rest) = after(ABOVE) {
            return Some(Self { above: Some(bound(rest)?), up_to: None });
        }
        let (low, high) = BETWEEN.iter().find_map(|sign| given.split_once(sign))?;
        Some(Self { above: Some(bound(low)?), up_to: Some(bound(high)?) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn classes_as_they_are_written() {
        let of = |given: &str| {
            SizeClass::of(given, |part| part.replace(',', ".").parse().ok())
                .map(|class| (class.above, class.up_to))
        };
        for given in ["0.5-1.0", "0,5 \u{2013} 1,0", "0.5 to 1 mm", "0.5..1.0", "0.5\u{2014}1.0mm"] {
            assert_eq!(of(given), Some((Some(0.5), Some(1.0))), "{given}");
        }
        assert_eq!((of("<0.5"), of("\u{2264} 0,5")), (Some((None, Some(0.5))), Some((None, Some(0.5)))));
        assert_eq!((of("> 2.7 mm"), of(">=2.7")), (Some((Some(2.7), None)), Some((Some(2.7), None))));
        for other in ["", "x", "-3", "1-", "a-b", "1-2-3", "<", "<x"] {
            assert_eq!(of(other), None, "{other}");
        }
    }
}
