//! Acceptance of TOML values for a key.

use super::declaration::{Kind, NumberRange};
use super::suggest::nearest;
use super::value::Value;
use std::ops::Range;
use toml::Spanned;
use toml::de::DeValue;

/// A value as written, before it is known whether it is accepted.
#[derive(Debug, Clone)]
pub(crate) enum Raw {
    Integer(i64),
    Float(f64),
    TooLarge,
    Text(String),
    List(Vec<(Raw, Range<usize>)>),
    Switch(bool),
    Other(&'static str),
}

impl Raw {
    pub fn read(value: &DeValue) -> Self {
        match value {
            DeValue::String(text) => Self::Text(text.to_string()),
            DeValue::Integer(n) => {
                i64::from_str_radix(n.as_str(), n.radix()).map_or(Self::TooLarge, Self::Integer)
            }
            DeValue::Float(x) => match x.as_str().parse::<f64>() {
                // 1e400 does not stand for infinity.
                Ok(value) if value.is_infinite() && !x.as_str().contains("inf") => Self::TooLarge,
                Ok(value) => Self::Float(value),
                Err(_) => Self::TooLarge,
            },
            DeValue::Boolean(value) => Self::Switch(*value),
            DeValue::Datetime(_) => Self::Other("a date or time"),
            DeValue::Array(items) => Self::List(items.iter().map(spanned).collect()),
            DeValue::Table(_) => Self::Other("a table"),
        }
    }

    pub(super) fn number(&self) -> Option<f64> {
        match self {
            Self::Integer(n) => Some(*n as f64),
            Self::Float(x) => Some(*x),
            _ => None,
        }
    }

    fn text(&self) -> Option<String> {
        match self {
            Self::Text(text) => Some(text.clone()),
            _ => None,
        }
    }

    fn kind(&self) -> &'static str {
        match self {
            Self::Integer(_) | Self::Float(_) | Self::TooLarge => "a number",
            Self::Text(_) => "a string",
            Self::List(_) => "a list",
            Self::Switch(_) => "a boolean",
            Self::Other(kind) => kind,
        }
    }
}

fn spanned(item: &Spanned<DeValue>) -> (Raw, Range<usize>) {
    (Raw::read(item.get_ref()), item.span())
}

/// Why a value is not accepted.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Refusal {
    /// Follows the key and the value: "must be …".
    pub message: String,
    pub help: Option<String>,
    /// The part of the value that is wrong, where it is not the whole.
    pub part: Option<Range<usize>>,
}

impl Refusal {
    fn new(message: String) -> Self {
        Self { message, help: None, part: None }
    }
}

impl Kind {
    /// The value that `raw` gives, or why it is refused; `list` is the help where a list is given
    /// instead of a value.
    pub(crate) fn accept(&self, raw: &Raw, list: &'static str) -> Result<Value, Refusal> {
        match self {
            Self::Number { range, .. } => match (raw.number(), raw) {
                (Some(value), _) if range.contains(value) => Ok(Value::Number(value)),
                (Some(_), _) | (None, Raw::TooLarge) => Err(self.must_be()),
                _ => Err(self.wrong_type(raw, list)),
            },
            Self::NumberOr { range, word, .. } => match (raw.number(), raw) {
                (Some(value), _) if range.contains(value) => Ok(Value::Number(value)),
                (None, Raw::Text(text)) if text == word => Ok(Value::Text(text.clone())),
                (Some(_), _) | (None, Raw::TooLarge | Raw::Text(_)) => Err(self.must_be()),
                _ => Err(self.wrong_type(raw, list)),
            },
            Self::Integer { min, max } => match raw {
                Raw::Integer(n) => match u64::try_from(*n) {
                    Ok(n) if (*min..=*max).contains(&n) => Ok(Value::Integer(n)),
                    _ => Err(self.must_be()),
                },
                Raw::TooLarge => Err(self.must_be()),
                Raw::Float(_) => Err(Refusal::new(format!(
                    "must be {}, written without a decimal point or exponent",
                    self.accepted()
                ))),
                _ => Err(self.wrong_type(raw, list)),
            },
            Self::Text | Self::LongText => match raw {
                Raw::Text(text)
                    if text.chars().count() <= self.most_characters() && !text.chars().any(is_no_text) =>
                {
                    Ok(Value::Text(text.clone()))
                }
                Raw::Text(_) => Err(self.must_be()),
                _ => Err(self.wrong_type(raw, list)),
            },
            Self::Path { .. } => match raw {
                Raw::Text(text) if !text.is_empty() && !text.contains('\0') => Ok(Value::Text(text.clone())),
                Raw::Text(_) => Err(self.must_be()),
                _ => Err(self.wrong_type(raw, list)),
            },
            Self::Choice(words) => match raw {
                Raw::Text(text) => match words().iter().find(|word| word.name == text) {
                    Some(_) => Ok(Value::Text(text.clone())),
                    None => Err(Refusal {
                        help: nearest(text, words().iter().map(|word| word.name))
                            .map(|name| format!("nearest: \"{name}\"")),
                        ..self.must_be()
                    }),
                },
                Raw::Switch(value) => match words().iter().find(|word| word.switch == Some(*value)) {
                    Some(word) => Ok(Value::Text(word.name.into())),
                    None => Err(self.wrong_type(raw, list)),
                },
                _ => Err(self.wrong_type(raw, list)),
            },
            Self::Switch => match raw {
                Raw::Switch(value) => Ok(Value::Switch(*value)),
                _ => Err(self.wrong_type(raw, list)),
            },
            Self::Numbers { range, .. } => self.numbers(raw, *range, list),
            Self::Points { unit, range } => self.points(raw, unit, *range, list),
            Self::Groups { example } => self.groups(raw, example, list),
        }
    }

    /// The length of a text.
    fn most_characters(&self) -> usize {
        if matches!(self, Self::LongText) { Self::LONG_TEXT } else { 200 }
    }

    fn groups(&self, raw: &Raw, example: &str, list: &'static str) -> Result<Value, Refusal> {
        let Raw::List(items) = raw else { return Err(self.wrong_type(raw, list)) };
        let mut groups = Vec::with_capacity(items.len());
        for (index, (item, span)) in items.iter().enumerate() {
            let keys: Option<Vec<String>> = match item {
                Raw::List(keys) if keys.len() >= 2 => keys.iter().map(|(key, _)| key.text()).collect(),
                _ => None,
            };
            let Some(keys) = keys else {
                return Err(Refusal {
                    message: format!("group {} must be a list of at least two keys in quotes", index + 1),
                    help: Some(format!("such as [{example}]")),
                    part: Some(span.clone()),
                });
            };
            groups.push(keys);
        }
        Ok(Value::Groups(groups))
    }

    fn numbers(&self, raw: &Raw, range: NumberRange, list: &'static str) -> Result<Value, Refusal> {
        let Raw::List(items) = raw else { return Err(self.wrong_type(raw, list)) };
        if items.len() > Self::MOST_NUMBERS {
            return Err(Refusal::new(format!("must be {}; {} given", self.accepted(), items.len())));
        }
        let mut numbers = Vec::with_capacity(items.len());
        for (index, (item, span)) in items.iter().enumerate() {
            match item.number() {
                Some(value) if range.contains(value) => numbers.push(value),
                _ => {
                    return Err(Refusal {
                        message: format!("entry {} must be a number in {range}", index + 1),
                        help: None,
                        part: Some(span.clone()),
                    });
                }
            }
        }
        Ok(Value::Numbers(numbers))
    }

    fn points(
        &self,
        raw: &Raw,
        unit: &str,
        range: NumberRange,
        list: &'static str,
    ) -> Result<Value, Refusal> {
        let Raw::List(items) = raw else { return Err(self.wrong_type(raw, list)) };
        if items.len() < 2 || items.len() > Self::MOST_POINTS {
            let message =
                format!("must be {}, at most {}; {} given", self.accepted(), Self::MOST_POINTS, items.len());
            return Err(Refusal::new(message));
        }
        let mut points = Vec::with_capacity(items.len());
        for (index, (item, span)) in items.iter().enumerate() {
            let pair = match item {
                Raw::List(pair) => match pair.as_slice() {
                    [(x, _), (y, _)] => x.number().zip(y.number()),
                    _ => None,
                },
                _ => None,
            };
            match pair {
                Some((x, y)) if range.contains(x) && range.contains(y) => points.push([x, y]),
                _ => {
                    return Err(Refusal {
                        message: format!("point {} must be two numbers [x, y] in {range} {unit}", index + 1),
                        help: None,
                        part: Some(span.clone()),
                    });
                }
            }
        }
        Ok(Value::Points(points))
    }

    fn must_be(&self) -> Refusal {
        Refusal::new(format!("must be {}", self.accepted()))
    }

    fn wrong_type(&self, raw: &Raw, list: &'static str) -> Refusal {
        let help = match (self, raw) {
            (Self::Number { .. } | Self::Integer { .. }, Raw::Text(text)) => {
                Some(match point_for_comma(text) {
                    Some(number) => format!("numbers have a decimal point and no quotes: {number}"),
                    None => "numbers are written without quotes".into(),
                })
            }
            (
                Self::Number { .. }
                | Self::NumberOr { .. }
                | Self::Integer { .. }
                | Self::Choice(_)
                | Self::Switch
                | Self::Path { .. },
                Raw::List(_),
            ) => Some(list.into()),
            (Self::Switch, Raw::Text(_)) => Some("true and false are written without quotes".into()),
            (Self::Numbers { .. }, Raw::Integer(_) | Raw::Float(_)) => {
                Some("a list is written in brackets, one number included".into())
            }
            (Self::Choice(_) | Self::Text | Self::LongText | Self::Path { .. }, _) => {
                Some("text is written in quotes".into())
            }
            _ => None,
        };
        Refusal { message: format!("must be {}, not {}", self.accepted(), raw.kind()), help, part: None }
    }
}

/// Whether `letter` belongs to no line of text: control characters, and the noncharacters that XML
/// and therefore plots cannot hold.
fn is_no_text(letter: char) -> bool {
    letter.is_control() || matches!(letter, '\u{fffe}' | '\u{ffff}')
}

/// A number with a decimal comma, `0,5`, as TOML writes it.
pub(super) fn point_for_comma(text: &str) -> Option<String> {
    let (whole, part) = text.trim().split_once(',')?;
    let is_digits = |digits: &str| digits.chars().all(|digit| digit.is_ascii_digit() || digit == '_');
    let is_number = !whole.is_empty() && is_digits(whole.trim_start_matches(['-', '+']));
    let power = part.find(['e', 'E']).unwrap_or(part.len());
    let has_part =
        power > 0 && is_digits(&part[..power]) && format!("0{}", &part[power..]).parse::<f64>().is_ok();
    (is_number && has_part).then(|| format!("{whole}.{part}"))
}
