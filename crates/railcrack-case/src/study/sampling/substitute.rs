//! Lists that replace distributions or single values in a document.

use crate::schema::{Fault, Report, SectionPresence};
use crate::tables::SECTIONS;
use std::borrow::Cow;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

/// The values of a key, run by run.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::study) struct Substitute {
    pub section: &'static str,
    /// Number of the table of a repeated section, from 1.
    pub number: usize,
    pub key: &'static str,
    /// As TOML.
    pub values: Vec<String>,
    /// Where the value stands that they replace; none where it comes from another file.
    pub span: Option<Range<usize>>,
}

impl Substitute {
    /// Its key with its section, as elsewhere.
    pub fn dotted(&self) -> String {
        let (outer, inner) = self.section.split_once('.').unwrap_or((self.section, ""));
        let section = SECTIONS.iter().find(|section| section.name == outer);
        let within = if inner.is_empty() { String::new() } else { format!(".{inner}") };
        match section.map(|section| section.presence) {
            Some(SectionPresence::Repeated | SectionPresence::Several) => {
                format!("{outer}[{}]{within}.{}", self.number, self.key)
            }
            _ => format!("{}.{}", self.section, self.key),
        }
    }
}

/// `root` with lists of these values in it; values that cannot be inserted are added to `report`.
pub(in crate::study) fn substituted<'a>(
    root: &DeTable<'a>,
    substitutes: &'a [Substitute],
    report: &mut Report,
) -> DeTable<'a> {
    let mut root = root.clone();
    // Places outside any text, so that messages show none.
    let end = report.source.text.len();
    for (i, substitute) in substitutes.iter().enumerate() {
        let span = substitute.span.clone().unwrap_or(end + 2 * i + 1..end + 2 * i + 2);
        let mut list = DeArray::new();
        for text in &substitute.values {
            match value(text) {
                Some(value) => list.push(Spanned::new(span.clone(), value)),
                None => {
                    report.add(Fault::new(format!("`{} = {text}` is not valid TOML", substitute.key)));
                    return root;
                }
            }
        }
        let Some(table) = table_of(&mut root, substitute) else {
            let says = format!("`{}`: the file has no such section", substitute.dotted());
            report.add(Fault::new(says).help("a crack must be defined before its values can vary"));
            continue;
        };
        let value = Spanned::new(span.clone(), DeValue::Array(list));
        match table.get_mut(substitute.key) {
            Some(there) => *there = value,
            None => drop(table.insert(Spanned::new(span, Cow::Borrowed(substitute.key)), value)),
        }
    }
    root
}

/// The table of a section, made where the section may be left out and is.
fn table_of<'t, 'a>(root: &'t mut DeTable<'a>, of: &Substitute) -> Option<&'t mut DeTable<'a>> {
    let (outer, inner) = of.section.split_once('.').unwrap_or((of.section, ""));
    let section = SECTIONS.iter().find(|section| section.name == outer)?;
    let is_one = !matches!(section.presence, SectionPresence::Repeated | SectionPresence::Several);
    if is_one && root.get(section.name).is_none() {
        let name = Spanned::new(0..0, Cow::Borrowed(section.name));
        root.insert(name, Spanned::new(0..0, DeValue::Table(DeTable::new())));
    }
    let place = root.get_mut(section.name)?.get_mut();
    let table = if is_one {
        as_table(place)?
    } else {
        let DeValue::Array(tables) = place else { return None };
        as_table(tables.get_mut(of.number.checked_sub(1)?)?.get_mut())?
    };
    if inner.is_empty() { Some(table) } else { as_table(table.get_mut(inner)?.get_mut()) }
}

fn as_table<'t, 'a>(value: &'t mut DeValue<'a>) -> Option<&'t mut DeTable<'a>> {
    match value {
        DeValue::Table(table) => Some(table),
        _ => None,
    }
}

fn value(text: &str) -> Option<DeValue<'_>> {
    DeValue::parse(text).ok().map(Spanned::into_inner)
}
