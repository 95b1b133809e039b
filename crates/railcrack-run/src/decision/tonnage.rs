//! Traffic in words: three significant digits, and months where the traffic of a year is known.

use crate::log::RunInfo;

/// Traffic as sentences give it.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct TonnageWords {
    /// Million gross tonnes in a year, where they are known.
    pub mgt_per_year: Option<f64>,
}

impl TonnageWords {
    /// With the traffic of a year that the case gives, if it does.
    pub(crate) fn of_year(info: &RunInfo) -> Self {
        Self { mgt_per_year: info.mgt_per_year }
    }

    /// `mgt` with its unit, and in months.
    #[must_use]
    pub fn of(&self, mgt: f64) -> String {
        self.noted(mgt, None)
    }

    /// The same with a `note` in the brackets of the months.
    #[must_use]
    pub fn noted(&self, mgt: f64, note: Option<&str>) -> String {
        let months = self.mgt_per_year.map(|year| format!("{} months", three_digits(12.0 * mgt / year)));
        let notes: Vec<&str> = months.as_deref().into_iter().chain(note).collect();
        let notes = if notes.is_empty() { String::new() } else { format!(" ({})", notes.join(", ")) };
        format!("{} million gross tonnes{notes}", three_digits(mgt))
    }
}

/// `value` with three significant digits, in decimals.
#[must_use]
pub fn three_digits(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    // The text itself says where rounding leads: 99.96 is 100, not 100.0.
    let rounded: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    let decimals = (2 - rounded.abs().log10().floor() as i64).clamp(0, 12);
    format!("{rounded:.*}", decimals as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_and_months() {
        let of = [0.0, 1.2345e-4, 0.9996, 2.871, 21.25, 99.96, 135.742, 1234.0].map(three_digits);
        assert_eq!(of, ["0", "0.000123", "1.00", "2.87", "21.2", "100", "136", "1230"]);
        let yearly = TonnageWords { mgt_per_year: Some(20.0) };
        assert_eq!(yearly.of(135.742), "136 million gross tonnes (81.4 months)");
        assert_eq!(yearly.noted(20.0, Some("± 1 %")), "20.0 million gross tonnes (12.0 months, ± 1 %)");
        assert_eq!(TonnageWords::default().of(0.5), "0.500 million gross tonnes");
    }
}
