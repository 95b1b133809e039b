//! Usual range of a quantity, and the words outside of it.

use crate::schema::{in_other_unit, short};

/// The usual range of a quantity, whatever its sign. Zero, where it is accepted, stands for the
/// absence of what it measures, and infinity for the straight and the unlimited: both are usual.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Usual {
    /// The quantity in words.
    pub quantity: &'static str,
    /// Its keys, `section.key`; a section is that of a wheel too.
    pub keys: &'static [&'static str],
    /// Its columns in tables of users.
    pub columns: &'static [&'static str],
    /// Its unit; empty for a pure number.
    pub unit: &'static str,
    /// The smallest and the largest usual size.
    pub range: (f64, f64),
    /// Where the range comes from.
    pub source: &'static str,
}

impl Usual {
    /// The remark on the `value` of `name`, where it is unusual: with the guess of another unit if
    /// that makes it usual.
    #[must_use]
    pub fn remark(&self, name: &str, value: f64) -> Option<String> {
        if self.includes(value) {
            return None;
        }
        let (low, high) = self.range;
        let unit = if self.unit.is_empty() { String::new() } else { format!(" {}", self.unit) };
        let guess = in_other_unit(self.unit, value, |other| self.includes(other));
        let guess = guess.map_or_else(String::new, |guess| format!("; {guess}"));
        let range = format!("{} to {}{unit}", short(low), short(high));
        Some(format!("{name} = {} is unusual: {} is from {range}{guess}", rounded(value), self.quantity))
    }

    /// Whether `value` is usual.
    #[must_use]
    pub fn includes(&self, value: f64) -> bool {
        let (low, high) = self.range;
        value == 0.0 || value.is_infinite() || (low..=high).contains(&value.abs())
    }
}

/// A number with six digits at most.
pub(super) fn rounded(value: f64) -> String {
    let digits: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    short(digits)
}
