//! Short ways to declare a key.

use super::table::{Availability, Choice, Key, Kind, NumberRange, OnlyWith, Presence, Preset, RangeEnd};
use Preset::{Integer, Number, Text};

/// \[0, 1/2).
pub(super) const FROM_ZERO_BELOW_HALF: NumberRange =
    NumberRange { min: RangeEnd::Closed(0.0), max: RangeEnd::Open(0.5) };

/// \[min, max\].
pub(super) const fn closed(min: f64, max: f64) -> NumberRange {
    NumberRange::closed(min, max)
}

/// (0, max\].
pub(super) const fn positive(max: f64) -> NumberRange {
    NumberRange::positive(max)
}

/// A length in mm.
pub(super) const fn length(range: NumberRange) -> Kind {
    Kind::Number { unit: "mm", range }
}

/// Any key.
pub(super) const fn key(name: &'static str, kind: Kind, presence: Presence, doc: &'static str) -> Key {
    Key { name, kind, presence, doc, only_with: None, reference: None }
}

/// A number with a default.
pub(super) const fn number(
    name: &'static str,
    unit: &'static str,
    range: NumberRange,
    default: f64,
    doc: &'static str,
) -> Key {
    key(name, Kind::Number { unit, range }, Presence::Default(Number(default)), doc)
}

/// A number that must be given.
pub(super) const fn required(
    name: &'static str,
    unit: &'static str,
    range: NumberRange,
    reference: Preset,
    doc: &'static str,
) -> Key {
    key(name, Kind::Number { unit, range }, Presence::Required(reference), doc)
}

/// An integer with a default.
pub(super) const fn integer(name: &'static str, min: u64, max: u64, default: u64, doc: &'static str) -> Key {
    key(name, Kind::Integer { min, max }, Presence::Default(Integer(default)), doc)
}

/// One of several words, with a default.
pub(super) const fn choice(
    name: &'static str,
    choices: &'static [Choice],
    default: &'static str,
    doc: &'static str,
) -> Key {
    key(name, Kind::Choice(choices), Presence::Default(Text(default)), doc)
}

/// A support of a block.
pub(super) const fn support(
    name: &'static str,
    choices: &'static [Choice],
    default: &'static str,
    doc: &'static str,
) -> Key {
    let with = OnlyWith { key: "boundary", choice: "block" };
    Key { only_with: Some(with), ..choice(name, choices, default, doc) }
}

/// A word that this version has.
pub(super) const fn now(name: &'static str, doc: &'static str) -> Choice {
    Choice { name, doc, availability: Availability::Now }
}

/// A word that a later version will have.
pub(super) const fn later(name: &'static str, doc: &'static str, availability: Availability) -> Choice {
    Choice { name, doc, availability }
}
