//! Numbers for people and for pages.

use serde_json::Value;

use railcrack_run::numbers::ROUND_OFF;
pub(crate) use railcrack_run::numbers::{rounded, short};

/// A number of a chart: six digits, more than any screen shows; null for what is not finite.
pub fn number(value: f64) -> Value {
    serde_json::Number::from_f64(rounded(value, 6)).map_or(Value::Null, Value::Number)
}

/// Numbers of a chart.
pub fn numbers(values: impl IntoIterator<Item = f64>) -> Value {
    Value::Array(values.into_iter().map(number).collect())
}

/// A count with its digits in groups of three: `1 197 467`; a power of ten where it has more than
/// 15 digits.
pub fn grouped(value: f64) -> String {
    let digits = format!("{value:.0}");
    if digits.len() > 15 {
        return format!("{value:.3e}");
    }
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) && !text.ends_with('-') {
            // A space at which no line breaks.
            text.push('\u{a0}');
        }
        text.push(digit);
    }
    text
}

/// Four significant digits: `0.1235`, `12.35`, `1234.6` (one decimal at least), `1.235e-6`. Values
/// below `ROUND_OFF` are zero.
pub fn significant(value: f64) -> String {
    let size = value.abs();
    match size {
        ..ROUND_OFF => "0".to_owned(),
        1e-3..1e6 => {
            let decimals = (3.0 - size.log10().floor()).clamp(1.0, 7.0) as usize;
            format!("{value:.decimals$}")
        }
        _ => format!("{value:.3e}"),
    }
    .replace('-', "\u{2212}")
}

/// [`short`] with a true minus sign, for the prose of pages.
pub(crate) fn given(value: f64) -> String {
    short(value).replace('-', "\u{2212}")
}

/// Letters of a value of a key that somebody has written; drawn ones have more.
const WRITTEN: usize = 9;

/// The value of a key as people read it: one that was drawn has four significant digits.
pub(crate) fn brief(value: &str) -> String {
    match value.parse::<f64>() {
        Ok(number) if value.len() > WRITTEN && number.is_finite() => significant(number),
        _ => value.to_owned(),
    }
}

/// A value with a fixed number of decimals and a true minus sign.
pub fn fixed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    // No "−0.0".
    let is_zero = text.chars().all(|letter| matches!(letter, '-' | '0' | '.'));
    if is_zero { text.replace('-', "") } else { text.replace('-', "\u{2212}") }
}

/// Million gross tonnes: two decimals, of small values four significant digits. Below a tonne it is
/// zero.
pub fn tonnage(value: f64) -> String {
    match value.abs() {
        ..1e-6 => fixed(0.0, 2),
        ..0.1 => significant(value),
        _ => fixed(value, 2),
    }
}

/// `text` cut to about `letters` letters.
pub(crate) fn shortened(text: &str, letters: f64) -> String {
    let most = letters.max(8.0) as usize;
    if text.chars().count() <= most {
        return text.to_owned();
    }
    let mut short: String = text.chars().take(most - 1).collect();
    short.truncate(short.trim_end().len());
    short.push('\u{2026}');
    short
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_true() {
        assert_eq!(rounded(1_197_467.055_6, 6), 1_197_470.0);
        assert_eq!(number(2.469_427_064e-6).to_string(), "2.46943e-6");
        assert_eq!(number(f64::NAN), Value::Null);
        assert_eq!(grouped(1_197_467.05), "1\u{a0}197\u{a0}467");
        assert_eq!(grouped(999.0), "999");
        assert_eq!(
            [0.123_46, 12.346, 1234.56, -0.5].map(significant),
            ["0.1235", "12.35", "1234.6", "\u{2212}0.5000"]
        );
        assert_eq!(["0.29368231828", "0.123456", "60E1"].map(brief), ["0.2937", "0.123456", "60E1"]);
        assert_eq!(significant(2.5e-6), "2.500e\u{2212}6");
        assert_eq!([fixed(-0.04, 1), fixed(-1.25, 1)], ["0.0", "\u{2212}1.2"]);
    }

    /// Round-off of a sum over 20 MGT, as a passage or a tonnage that is nothing has it.
    #[test]
    fn residues_are_zero() {
        let residue = 4.5e-14;
        assert_eq!([tonnage(residue), tonnage(20.0)], ["0.00", "20.00"]);
        assert_eq!([significant(residue), significant(-residue), short(residue)], ["0"; 3]);
        assert_eq!(significant(1.5e-10), "1.500e\u{2212}10", "a slow rate is none");
    }
}
