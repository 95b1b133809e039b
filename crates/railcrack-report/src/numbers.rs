//! Numbers for people and for pages.

use serde_json::Value;

/// `value` rounded to `digits` significant decimal digits.
pub fn rounded(value: f64, digits: usize) -> f64 {
    let decimals = digits.saturating_sub(1);
    format!("{value:.decimals$e}").parse().unwrap_or(value)
}

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

/// Values below this are round-off in every unit used here: mm, MPa, MPa√m, MGT, mm per cycle.
const ROUND_OFF: f64 = 1e-12;

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

/// Four significant digits without trailing zeros, the integer part always whole: `210000`,
/// `8959`, `6.75`, `-692.9`, `2.08e-9`. ASCII, for terminals and formulas.
pub fn short(value: f64) -> String {
    if value.abs() < ROUND_OFF {
        return "0".to_owned();
    }
    match value.abs() {
        1e-4..1e4 => rounded(value, 4).to_string(),
        1e4..1e9 => format!("{value:.0}"),
        _ if value.is_finite() => format!("{:e}", rounded(value, 4)),
        _ => value.to_string(),
    }
}

/// [`short`] with a true minus sign, for the prose of pages.
pub(crate) fn given(value: f64) -> String {
    short(value).replace('-', "\u{2212}")
}

/// The formula of a growth law, `da/dN = 2e-9 dK^3.33`, as people read it: numbers by [`short`],
/// ΔK, and a dot behind the coefficient.
pub fn formula(text: &str) -> String {
    let mut shown = String::new();
    let mut rest = text;
    while let Some(start) = rest.find(|letter: char| letter.is_ascii_digit()) {
        let (before, from) = rest.split_at(start);
        let (number, after) = from.split_at(number_length(from));
        // `da/dN = ` is followed by the coefficient and its factors.
        let is_coefficient = shown.is_empty() && before.ends_with("= ");
        shown.push_str(before);
        shown.push_str(&number.parse().map_or_else(|_| number.to_owned(), short));
        let factors = after.strip_prefix(' ').filter(|_| is_coefficient);
        if factors.is_some() {
            shown.push_str(" \u{b7} ");
        }
        rest = factors.unwrap_or(after);
    }
    shown.push_str(rest);
    shown.replace("dK", "\u{394}K")
}

/// Bytes of the number at the start of `text`, with its exponent.
fn number_length(text: &str) -> usize {
    let digits = |text: &str, dot: bool| {
        text.find(|letter: char| !(letter.is_ascii_digit() || dot && letter == '.')).unwrap_or(text.len())
    };
    let mantissa = digits(text, true);
    let exponent = text[mantissa..].strip_prefix('e').map_or(0, |power| {
        let sign = usize::from(power.starts_with('-'));
        match digits(&power[sign..], false) {
            0 => 0,
            length => 1 + sign + length,
        }
    });
    mantissa + exponent
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

    #[test]
    fn numbers_of_the_terminal_have_four_digits() {
        let shown = [845.0, 6.75, 8_959.412_3, -692.864_247_402_077_5, 210_000.0, 2.080_080_446_913_026e-9];
        assert_eq!(shown.map(short), ["845", "6.75", "8959", "-692.9", "210000", "2.08e-9"]);
        assert_eq!([-0.0, 0.000_123_456, f64::INFINITY].map(short), ["0", "0.0001235", "inf"]);
    }

    /// Round-off of a sum over 20 MGT, as a passage or a tonnage that is nothing has it.
    #[test]
    fn residues_are_zero() {
        let residue = 4.5e-14;
        assert_eq!([tonnage(residue), tonnage(20.0)], ["0.00", "20.00"]);
        assert_eq!([significant(residue), significant(-residue), short(residue)], ["0"; 3]);
        assert_eq!(significant(1.5e-10), "1.500e\u{2212}10", "a slow rate is none");
    }

    #[test]
    fn formulas_are_short() {
        let law = "da/dN = 2.080080446913026e-9 dK^3.9123687897930126";
        assert_eq!(formula(law), "da/dN = 2.08e-9 \u{b7} \u{394}K^3.912");
        assert_eq!(
            formula("da/dN = 1e-9 [(1-f)/(1-R) dK]^3 (1 - 5/dK)^0.5/(1 - Kmax/40)^0.5"),
            "da/dN = 1e-9 \u{b7} [(1-f)/(1-R) \u{394}K]^3 (1 - 5/\u{394}K)^0.5/(1 - Kmax/40)^0.5"
        );
        assert_eq!(formula("dK^2 = dKI^2 + 0.772 dKII^2"), "\u{394}K^2 = \u{394}KI^2 + 0.772 \u{394}KII^2");
        assert_eq!(
            formula("da/dN = a table of 12 rows from dK = 3.5 to 40"),
            "da/dN = a table of 12 rows from \u{394}K = 3.5 to 40"
        );
    }
}
