//! The way in which one of several sets of values is read from a document.

use super::accept::Raw;
use super::declaration::FileSchema;
use toml::Spanned;
use toml::de::DeValue;

/// How a document is read.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reading<'a> {
    pub file: &'static FileSchema,
    pub overrides: &'a [Override],
    pub chosen: &'a Chosen,
}

impl Reading<'_> {
    /// The override of a key.
    pub fn override_of(&self, section: &str, key: &str) -> Option<&Override> {
        self.overrides.iter().find(|given| (given.section, given.key) == (section, key))
    }
}

/// A value from elsewhere that takes the place of the file's.
#[derive(Debug, Clone)]
pub(crate) struct Override {
    pub section: &'static str,
    pub key: &'static str,
    /// The option with which it was given.
    pub option: &'static str,
    pub value: Raw,
}

impl Override {
    /// The option with its value, for messages.
    pub fn shown(&self) -> String {
        match &self.value {
            Raw::Integer(n) => format!("{} {n}", self.option),
            Raw::Text(text) => format!("{} {text}", self.option),
            _ => format!("{} (too large)", self.option),
        }
    }
}

/// The elements taken of lists that stand in place of values; none where no list does.
#[derive(Debug, Clone, Default)]
pub(crate) struct Chosen {
    /// Where a list begins in the text, and the index of its element.
    elements: Vec<(usize, usize)>,
}

impl Chosen {
    pub fn new(elements: Vec<(usize, usize)>) -> Self {
        Self { elements }
    }

    /// The value itself, or of a list in its place the chosen element: errors then point to that
    /// element.
    pub fn of<'d, 'i>(&self, value: &'d Spanned<DeValue<'i>>) -> &'d Spanned<DeValue<'i>> {
        let start = value.span().start;
        let index = self.elements.iter().find(|(list, _)| *list == start).map(|(_, index)| *index);
        match (index, value.get_ref()) {
            (Some(index), DeValue::Array(items)) => items.get(index).unwrap_or(value),
            _ => value,
        }
    }
}
