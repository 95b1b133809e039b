//! Numbers as people read them on terminals.

/// Values below this are round-off in every unit used here: mm, MPa, MPa√m, MGT, mm per cycle.
pub const ROUND_OFF: f64 = 1e-12;

/// `value` rounded to `digits` significant decimal digits.
pub fn rounded(value: f64, digits: usize) -> f64 {
    let decimals = digits.saturating_sub(1);
    format!("{value:.decimals$e}").parse().unwrap_or(value)
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
        shown.push_str(&number.parse().map_or_else(|_| number.to_owned(), constant));
        let factors = after.strip_prefix(' ').filter(|_| is_coefficient);
        if factors.is_some() {
            shown.push_str(" \u{b7} ");
        }
        rest = factors.unwrap_or(after);
    }
    shown.push_str(rest);
    shown.replace("dK", "\u{394}K")
}

/// A constant of a formula: of none, whatever its unit, is a small value round-off.
fn constant(value: f64) -> String {
    if value != 0.0 && value.abs() < ROUND_OFF { format!("{:e}", rounded(value, 4)) } else { short(value) }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_the_terminal_have_four_digits() {
        let shown = [845.0, 6.75, 8_959.412_3, -692.864_247_402_077_5, 210_000.0, 2.080_080_446_913_026e-9];
        assert_eq!(shown.map(short), ["845", "6.75", "8959", "-692.9", "210000", "2.08e-9"]);
        assert_eq!([-0.0, 0.000_123_456, f64::INFINITY].map(short), ["0", "0.0001235", "inf"]);
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
