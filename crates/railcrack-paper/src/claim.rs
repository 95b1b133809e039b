//! A statement of the paper and the rule that decides it.

use crate::results::SetupResults;

/// A paraphrased statement about results.
pub struct Claim {
    /// Its name.
    pub id: &'static str,
    /// Where the paper says it.
    pub place: &'static str,
    /// The figures whose runs decide it.
    pub figures: &'static [u8],
    /// The statement.
    pub statement: &'static str,
    /// When it counts as true.
    pub rule: &'static str,
    /// The rule; none if a set-up lacks a run that it needs.
    pub decide: fn(SetupResults) -> Option<Decision>,
    /// The reason for the verdict, as far as known; empty otherwise.
    pub why: &'static str,
}

/// The decision on a statement in one set-up.
#[derive(Debug, Clone, PartialEq)]
pub struct Decision {
    /// Whether it holds.
    pub holds: bool,
    /// The numbers that decide it.
    pub numbers: Vec<Number>,
}

/// A number that decides.
#[derive(Debug, Clone, PartialEq)]
pub struct Number {
    /// Its name.
    pub name: String,
    /// Its value.
    pub value: f64,
}

impl Decision {
    pub(super) fn of(holds: bool) -> Self {
        Self { holds, numbers: Vec::new() }
    }

    pub(super) fn with(mut self, name: impl Into<String>, value: f64) -> Self {
        self.numbers.push(Number { name: name.into(), value });
        self
    }

    /// A number for each of `names`.
    pub(super) fn with_all(mut self, what: &str, names: &[&str], values: &[f64]) -> Self {
        for (name, value) in names.iter().zip(values) {
            self = self.with(format!("{what} {name}"), *value);
        }
        self
    }

    /// The numbers in one line, three digits each.
    pub fn text(&self) -> String {
        let number = |n: &Number| format!("{} {}", n.name, rounded(n.value));
        self.numbers.iter().map(number).collect::<Vec<_>>().join(", ")
    }
}

/// K in MPa√m, degrees, millimetres and per cent smaller than that are round-off or tolerance.
const NOTHING: f64 = 5e-4;

/// Three significant digits; more would not be known, fewer would hide differences of a per cent.
pub(super) fn rounded(value: f64) -> String {
    if value.abs() < NOTHING {
        return "0".into();
    }
    if !value.is_finite() {
        return format!("{value}");
    }
    let size = value.abs().log10().floor() as i32;
    if !(-3..6).contains(&size) {
        return format!("{value:.1e}");
    }
    let decimals = (2 - size).max(0) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// Whether each value is larger than the one before.
pub(super) fn rises(values: &[f64]) -> bool {
    values.windows(2).all(|pair| pair[1] > pair[0])
}

/// Whether each value is smaller than the one before.
pub(super) fn falls(values: &[f64]) -> bool {
    values.windows(2).all(|pair| pair[1] < pair[0])
}
