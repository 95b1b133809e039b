//! What is read of a document in which lists stand in place of values.

use super::overrides::Overrides;
use toml::Spanned;
use toml::de::DeValue;

/// How one case is read from a document.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reading<'a> {
    pub overrides: &'a Overrides,
    pub chosen: &'a Chosen,
}

/// The elements that a run of a study takes of the lists in place of values; none in a case.
#[derive(Debug, Clone, Default)]
pub(super) struct Chosen {
    /// Where a list begins in the text, and the index of its element.
    elements: Vec<(usize, usize)>,
}

impl Chosen {
    pub fn new(elements: Vec<(usize, usize)>) -> Self {
        Self { elements }
    }

    /// The value itself, or of a list in its place the chosen element: errors then point to that element.
    pub fn of<'d, 'i>(&self, value: &'d Spanned<DeValue<'i>>) -> &'d Spanned<DeValue<'i>> {
        let start = value.span().start;
        let index = self.elements.iter().find(|(list, _)| *list == start).map(|(_, index)| *index);
        match (index, value.get_ref()) {
            (Some(index), DeValue::Array(items)) => items.get(index).unwrap_or(value),
            _ => value,
        }
    }
}
