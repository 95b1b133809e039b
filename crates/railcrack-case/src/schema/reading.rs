//! Reading one of several sets of values from a document.

use super::accept::Raw;
use super::declaration::{FileSchema, Preset};
use toml::Spanned;
use toml::de::DeValue;

/// How a document is read.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reading<'a> {
    pub file: &'static FileSchema,
    pub overrides: &'a [Override],
    pub chosen: &'a Chosen,
    /// Defaults that replace those of the declaration.
    pub defaults: Defaults,
}

/// Section, key and default.
pub(crate) type Defaults = &'static [(&'static str, &'static str, Preset)];

impl Reading<'_> {
    /// The default that replaces that of the declaration, if there is one.
    pub fn default_of(&self, section: &str, key: &str) -> Option<Preset> {
        self.defaults.iter().find(|(s, k, _)| (*s, *k) == (section, key)).map(|(_, _, preset)| *preset)
    }

    /// The last override of a key in the `number`-th table (from 1) of its section.
    pub fn override_of(&self, section: &str, number: usize, key: &str) -> Option<&Override> {
        let is_it = |given: &&Override| {
            (given.section, given.key) == (section, key) && given.number.is_none_or(|own| own == number)
        };
        self.overrides.iter().rev().find(is_it)
    }

    /// Whether a value from elsewhere belongs to `section`, which then exists.
    pub fn overrides_in(&self, section: &str) -> bool {
        self.overrides.iter().any(|given| given.section == section)
    }

    /// The values from elsewhere for tables of `section`, or of a part of it, that are missing from
    /// a file with `count` of them.
    pub fn overrides_beyond(&self, section: &str, count: usize) -> impl Iterator<Item = &Override> {
        self.overrides.iter().filter(move |given| {
            let outer = given.section.split('.').next();
            outer == Some(section) && given.number.unwrap_or(1) > count
        })
    }
}

/// A value from elsewhere that replaces the one in the file.
#[derive(Debug, Clone)]
pub(crate) struct Override {
    pub section: &'static str,
    pub key: &'static str,
    /// Number of the table of a repeated section, from 1; none for all tables.
    pub number: Option<usize>,
    /// The option with which it was given, with its value as written.
    pub shown: String,
    /// None for a key that is left out of the file.
    pub value: Option<Raw>,
}

/// The elements chosen from lists given instead of values; none without lists.
#[derive(Debug, Clone, Default)]
pub(crate) struct Chosen {
    /// Where a list begins in the text, and the index of its element.
    elements: Vec<(usize, usize)>,
}

impl Chosen {
    pub fn new(elements: Vec<(usize, usize)>) -> Self {
        Self { elements }
    }

    /// The value itself, or the chosen element if a list is given instead: errors then point to
    /// that element.
    pub fn of<'d, 'i>(&self, value: &'d Spanned<DeValue<'i>>) -> &'d Spanned<DeValue<'i>> {
        let start = value.span().start;
        let index = self.elements.iter().find(|(list, _)| *list == start).map(|(_, index)| *index);
        match (index, value.get_ref()) {
            (Some(index), DeValue::Array(items)) => items.get(index).unwrap_or(value),
            _ => value,
        }
    }
}
