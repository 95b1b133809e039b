//! Distributions of a value.

use crate::normal;
use std::fmt;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A distribution of the values of a key. Its text, as TOML, is what [`Distribution::parse`] reads.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Distribution {
    /// Mean and standard deviation.
    Normal {
        /// Mean, in the unit of the key.
        mean: f64,
        /// Standard deviation, in the unit of the key.
        deviation: f64,
    },
    /// All values from the lowest to the highest with equal probability.
    Uniform {
        /// The lowest value.
        low: f64,
        /// The highest value.
        high: f64,
    },
    /// exp of a normal distribution: the median, and the standard deviation of the logarithm.
    LogNormal {
        /// The median, in the unit of the key.
        median: f64,
        /// Standard deviation of the logarithm.
        deviation: f64,
    },
    /// Values as written, each with its share of all, which add up to 1.
    Choice(Vec<(String, f64)>),
}

/// Accepted distributions, for messages.
pub(super) const ACCEPTED: &str = "{ normal = [mean, deviation] }, { uniform = [low, high] }, \
     { log-normal = [median, deviation of the logarithm] } or { choice = [[value, weight], …] }";

/// Significant digits of a drawn value: more than any input is known to, and few enough that the
/// mathematical functions of every machine give the same.
const DIGITS: usize = 12;

/// The key of a distribution that is read by itself.
const KEY: &str = "value";

impl Distribution {
    /// The distribution that `table` names for a key, whose value is a number or not; `text` is
    /// that of the file.
    ///
    /// Errors: what is wrong.
    pub(super) fn read(table: &DeTable, is_number: bool, text: &str) -> Result<Self, String> {
        let mut entries = table.iter();
        let (Some((name, value)), None) = (entries.next(), entries.next()) else {
            return Err("a distribution has exactly one name".to_owned());
        };
        let name: &str = name.get_ref();
        let DeValue::Array(items) = value.get_ref() else {
            return Err(format!("`{name}` must be followed by a list"));
        };
        if name == "choice" {
            return choice(items, text);
        }
        let numbers: Option<Vec<f64>> = items.iter().map(|item| number(item.get_ref())).collect();
        let pair = numbers.and_then(|numbers| <[f64; 2]>::try_from(numbers).ok());
        let pair = pair.filter(|pair| pair.iter().all(|number| number.is_finite()));
        if !is_number && ["normal", "uniform", "log-normal"].contains(&name) {
            return Err(
                "this distribution is for numbers only; use `choice` for words and integers".to_owned()
            );
        }
        match (name, pair) {
            ("normal", Some([mean, deviation])) if deviation > 0.0 => Ok(Self::Normal { mean, deviation }),
            ("uniform", Some([low, high])) if low < high => Ok(Self::Uniform { low, high }),
            ("log-normal", Some([median, deviation])) if median > 0.0 && deviation > 0.0 => {
                Ok(Self::LogNormal { median, deviation })
            }
            ("normal", _) => Err("`normal` takes a mean and a standard deviation above 0".to_owned()),
            ("uniform", _) => Err("`uniform` takes a lower and a higher number".to_owned()),
            ("log-normal", _) => {
                Err("`log-normal` takes a median and a standard deviation of the logarithm, both above 0"
                    .to_owned())
            }
            _ => Err(format!("`{name}` is not a distribution")),
        }
    }

    /// The distribution of numbers written in `text`, as TOML; none if it is not a distribution.
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        let document = format!("{KEY} = {text}");
        let root = DeTable::parse(&document).ok()?;
        let DeValue::Table(table) = root.get_ref().get(KEY)?.get_ref() else { return None };
        Self::read(table, true, &document).ok()
    }

    /// `value` (TOML) in standard deviations from the mean; of a log-normal distribution its
    /// logarithm. None for a value that is not a number.
    #[must_use]
    pub fn standardised(&self, value: &str) -> Option<f64> {
        let number: f64 = value.parse().ok()?;
        let standardised = match self {
            Self::Normal { mean, deviation } => (number - mean) / deviation,
            Self::Uniform { low, high } => 12.0_f64.sqrt() * ((number - low) / (high - low) - 0.5),
            Self::LogNormal { median, deviation } => (number / median).ln() / deviation,
            Self::Choice(values) => {
                let numbers: Option<Vec<(f64, f64)>> =
                    values.iter().map(|(value, share)| Some((value.parse().ok()?, *share))).collect();
                let numbers = numbers?;
                let mean: f64 = numbers.iter().map(|(value, share)| value * share).sum();
                let variance: f64 =
                    numbers.iter().map(|(value, share)| share * (value - mean) * (value - mean)).sum();
                if variance > 0.0 { (number - mean) / variance.sqrt() } else { 0.0 }
            }
        };
        standardised.is_finite().then_some(standardised)
    }

    /// The value, as TOML, that a share `u` in (0, 1) of all lies below.
    #[must_use]
    pub fn value(&self, u: f64) -> String {
        match self {
            Self::Normal { mean, deviation } => decimal(mean + deviation * normal::quantile(u)),
            Self::Uniform { low, high } => decimal(low + (high - low) * u),
            Self::LogNormal { median, deviation } => {
                decimal(median * (deviation * normal::quantile(u)).exp())
            }
            Self::Choice(values) => {
                let mut below = 0.0;
                let chosen = values.iter().find(|(_, share)| {
                    below += share;
                    u < below
                });
                chosen.or(values.last()).map_or_else(String::new, |(value, _)| value.clone())
            }
        }
    }
}

impl fmt::Display for Distribution {
    /// As TOML.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Normal { mean, deviation } => write!(f, "{{ normal = [{mean:?}, {deviation:?}] }}"),
            Self::Uniform { low, high } => write!(f, "{{ uniform = [{low:?}, {high:?}] }}"),
            Self::LogNormal { median, deviation } => {
                write!(f, "{{ log-normal = [{median:?}, {deviation:?}] }}")
            }
            Self::Choice(values) => {
                let pairs: Vec<String> =
                    values.iter().map(|(value, share)| format!("[{value}, {share:?}]")).collect();
                write!(f, "{{ choice = [{}] }}", pairs.join(", "))
            }
        }
    }
}

/// `value` with [`DIGITS`] digits as TOML.
fn decimal(value: f64) -> String {
    let rounded = format!("{value:.*e}", DIGITS - 1).parse().unwrap_or(value);
    format!("{rounded:?}")
}

fn choice(items: &[Spanned<DeValue>], text: &str) -> Result<Distribution, String> {
    let mut values = Vec::with_capacity(items.len());
    for item in items {
        let pair = match item.get_ref() {
            DeValue::Array(pair) => match pair.as_ref() {
                [value, weight] => number(weight.get_ref()).map(|weight| (value.span(), weight)),
                _ => None,
            },
            _ => None,
        };
        let Some((span, weight)) = pair.filter(|(_, weight)| weight.is_finite() && *weight > 0.0) else {
            return Err("`choice` takes a list of pairs of a value and a weight above 0".to_owned());
        };
        values.push((text.get(span).unwrap_or_default().to_owned(), weight));
    }
    let sum: f64 = values.iter().map(|(_, weight)| weight).sum();
    if values.is_empty() {
        return Err("`choice` takes a list of at least one pair".to_owned());
    }
    values.iter_mut().for_each(|(_, weight)| *weight /= sum);
    Ok(Distribution::Choice(values))
}

fn number(value: &DeValue) -> Option<f64> {
    match value {
        DeValue::Integer(n) => i64::from_str_radix(n.as_str(), n.radix()).ok().map(|n| n as f64),
        DeValue::Float(x) => x.as_str().replace('_', "").parse().ok(),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_the_quantiles_of_their_distribution() {
        let normal = Distribution::Normal { mean: 0.3, deviation: 0.05 };
        assert_eq!([0.5, 0.975].map(|u| normal.value(u)), ["0.3", "0.397998199227"]);
        assert_eq!(Distribution::Uniform { low: -1.0, high: 3.0 }.value(0.25), "0.0");
        assert_eq!(Distribution::LogNormal { median: 2.0, deviation: 0.5 }.value(0.5), "2.0");
        let choice = Distribution::Choice(vec![("\"a\"".into(), 0.25), ("\"b\"".into(), 0.75)]);
        assert_eq!([0.2, 0.3, 0.999_999_9].map(|u| choice.value(u)), ["\"a\"", "\"b\"", "\"b\""]);
    }

    #[test]
    fn values_are_standardised_and_texts_lead_back_to_their_distributions() {
        let all = [
            (Distribution::Normal { mean: 0.3, deviation: 0.05 }, normal::quantile as fn(f64) -> f64),
            (Distribution::Uniform { low: -1.0, high: 3.0 }, |u| 12.0_f64.sqrt() * (u - 0.5)),
            (Distribution::LogNormal { median: 2.0, deviation: 0.5 }, normal::quantile),
        ];
        for (distribution, exact) in all {
            for u in [1e-3, 0.3, 0.5, 0.99] {
                let found = distribution.standardised(&distribution.value(u)).unwrap();
                assert!((found - exact(u)).abs() < 1e-8, "{distribution} at {u}: {found}");
            }
            assert_eq!(Distribution::parse(&distribution.to_string()), Some(distribution));
        }
        let choice = Distribution::parse("{ choice = [[0.1, 1], [0.5, 3]] }").unwrap();
        // Mean 0.4, standard deviation √(0.25 · 0.3² + 0.75 · 0.1²).
        assert!((choice.standardised("0.1").unwrap() + 0.3 / 0.03_f64.sqrt()).abs() < 1e-12);
        assert_eq!(Distribution::parse(&choice.to_string()), Some(choice));
        assert_eq!(Distribution::parse("{ normal = [1, 0] }"), None);
        assert_eq!(Distribution::Choice(vec![("\"a\"".into(), 1.0)]).standardised("\"a\""), None);
    }
}
