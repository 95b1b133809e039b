//! Distributions of a value.

use super::normal;
use crate::schema::Kind;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A distribution of the values of a key.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Distribution {
    /// Mean and standard deviation.
    Normal { mean: f64, deviation: f64 },
    /// From the lowest to the highest value, all alike.
    Uniform { low: f64, high: f64 },
    /// exp of a normal distribution: the median, and the standard deviation of the logarithm.
    LogNormal { median: f64, deviation: f64 },
    /// Values as written, each with its share of all, which add up to 1.
    Choice(Vec<(String, f64)>),
}

/// Accepted distributions, for messages.
pub(super) const ACCEPTED: &str = "{ normal = [mean, deviation] }, { uniform = [low, high] }, \
     { log-normal = [median, deviation of the logarithm] } or { choice = [[value, weight], …] }";

/// Significant digits of a drawn value: more than any input is known to, and few enough that the
/// mathematical functions of every machine give the same.
const DIGITS: usize = 12;

impl Distribution {
    /// The distribution that `table` names for a key of `kind`; `text` is that of the file.
    ///
    /// Errors: what is wrong.
    pub(super) fn read(table: &DeTable, kind: Kind, text: &str) -> Result<Self, String> {
        let mut entries = table.iter();
        let (Some((name, value)), None) = (entries.next(), entries.next()) else {
            return Err("a distribution has one name".to_owned());
        };
        let name: &str = name.get_ref();
        let DeValue::Array(items) = value.get_ref() else {
            return Err(format!("`{name}` is followed by a list"));
        };
        if name == "choice" {
            return choice(items, text);
        }
        let numbers: Option<Vec<f64>> = items.iter().map(|item| number(item.get_ref())).collect();
        let pair = numbers.and_then(|numbers| <[f64; 2]>::try_from(numbers).ok());
        let pair = pair.filter(|pair| pair.iter().all(|number| number.is_finite()));
        if !matches!(kind, Kind::Number { .. }) && ["normal", "uniform", "log-normal"].contains(&name) {
            return Err("only numbers have such a distribution; words and integers have `choice`".to_owned());
        }
        match (name, pair) {
            ("normal", Some([mean, deviation])) if deviation > 0.0 => Ok(Self::Normal { mean, deviation }),
            ("uniform", Some([low, high])) if low < high => Ok(Self::Uniform { low, high }),
            ("log-normal", Some([median, deviation])) if median > 0.0 && deviation > 0.0 => {
                Ok(Self::LogNormal { median, deviation })
            }
            ("normal", _) => Err("`normal` is a mean and a deviation above 0".to_owned()),
            ("uniform", _) => Err("`uniform` is a lower and a higher number".to_owned()),
            ("log-normal", _) => {
                Err("`log-normal` is a median and a deviation of the logarithm, both above 0".to_owned())
            }
            _ => Err(format!("`{name}` is no distribution")),
        }
    }

    /// The value, as TOML, that a share `u` in (0, 1) of all lies below.
    pub(super) fn value(&self, u: f64) -> String {
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
            return Err("`choice` is a list of pairs, a value and a weight above 0".to_owned());
        };
        values.push((text.get(span).unwrap_or_default().to_owned(), weight));
    }
    let sum: f64 = values.iter().map(|(_, weight)| weight).sum();
    if values.is_empty() {
        return Err("`choice` is a list of at least one pair".to_owned());
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
}
