//! Accepted values, and the types that they are read as.

use super::declaration::Preset;
use std::fmt;

/// An accepted value.
#[non_exhaustive]
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// An integer.
    Integer(u64),
    /// Text, a word or the name of a file.
    Text(String),
    /// Numbers.
    Numbers(Vec<f64>),
    /// Points (x, y).
    Points(Vec<[f64; 2]>),
    /// Groups of keys.
    Groups(Vec<Vec<String>>),
    /// Yes or no.
    Switch(bool),
}

/// A number, or the word that replaces it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum NumberOr {
    Number(f64),
    Word,
}

impl FromValue for NumberOr {
    fn from_value(value: &Value) -> Option<Self> {
        match value {
            Value::Number(number) => Some(Self::Number(*number)),
            Value::Text(_) => Some(Self::Word),
            _ => None,
        }
    }
}

impl From<Preset> for Value {
    fn from(preset: Preset) -> Self {
        match preset {
            Preset::Number(x) => Self::Number(x),
            Preset::Integer(n) => Self::Integer(n),
            Preset::Text(s) => Self::Text(s.into()),
            Preset::Numbers(numbers) => Self::Numbers(numbers.to_vec()),
            Preset::Points(points) => Self::Points(points.to_vec()),
            Preset::Switch(value) => Self::Switch(value),
            Preset::Groups(groups) => {
                Self::Groups(groups.iter().map(|group| group.iter().map(|&k| k.into()).collect()).collect())
            }
        }
    }
}

/// The value in a message.
impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Number(x) => write!(f, "{x}"),
            other => write!(f, "{}", toml_value(other)),
        }
    }
}

/// A type that a value can be read as.
pub(crate) trait FromValue: Sized {
    /// The value; none where it is of another kind.
    fn from_value(value: &Value) -> Option<Self>;
}

/// Reads choices by their words.
macro_rules! read_by_word {
    ($($choice:ty),+) => {
        $(impl $crate::schema::FromValue for $choice {
            fn from_value(value: &$crate::schema::Value) -> Option<Self> {
                <String as $crate::schema::FromValue>::from_value(value)
                    .and_then(|word| $crate::schema::Choice::of_word(&word))
            }
        })+
    };
}

pub(crate) use read_by_word;

impl FromValue for usize {
    fn from_value(value: &Value) -> Option<Self> {
        match value {
            Value::Integer(n) => Self::try_from(*n).ok(),
            _ => None,
        }
    }
}

/// Reads one kind of value as it is.
macro_rules! read_as_it_is {
    ($($kind:ident: $type:ty),+) => {
        $(impl FromValue for $type {
            fn from_value(value: &Value) -> Option<Self> {
                match value {
                    Value::$kind(value) => Some(value.clone()),
                    _ => None,
                }
            }
        })+
    };
}
read_as_it_is!(
    Number: f64, Text: String, Numbers: Vec<f64>, Points: Vec<[f64; 2]>, Groups: Vec<Vec<String>>,
    Switch: bool
);

/// A value as TOML.
pub(super) fn toml_value(value: &Value) -> String {
    match value {
        Value::Number(x) => number(*x),
        Value::Integer(n) => n.to_string(),
        Value::Switch(value) => value.to_string(),
        Value::Text(text) => quoted(text),
        Value::Numbers(numbers) => {
            format!("[{}]", numbers.iter().map(|x| number(*x)).collect::<Vec<_>>().join(", "))
        }
        Value::Points(points) => list(points),
        Value::Groups(groups) => {
            let group = |keys: &Vec<String>| {
                format!("[{}]", keys.iter().map(|key| quoted(key)).collect::<Vec<_>>().join(", "))
            };
            format!("[{}]", groups.iter().map(group).collect::<Vec<_>>().join(", "))
        }
    }
}

/// A float as TOML writes it, of the shortest text that reads back to the same bits.
fn number(x: f64) -> String {
    format!("{x:?}")
}

fn list(points: &[[f64; 2]]) -> String {
    let points: Vec<String> =
        points.iter().map(|[x, y]| format!("[{}, {}]", number(*x), number(*y))).collect();
    format!("[{}]", points.join(", "))
}

fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' => quoted.push_str("\\\""),
            '\\' => quoted.push_str("\\\\"),
            c if c.is_control() => quoted.push_str(&format!("\\u{:04X}", u32::from(c))),
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}
