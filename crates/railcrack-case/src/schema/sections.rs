//! Accepted values of the sections of a file.

use super::declaration::{Key, Kind, OnlyWith, Section};
use super::error::Fault;
use super::row::KeyRow;
use super::value::{FromValue, Value};
use std::fmt::Display;
use std::ops::Range;

/// The sections of a file, as far as they are accepted.
#[derive(Debug)]
pub(crate) struct Sections(pub(super) Vec<SectionValues>);

impl Sections {
    /// All sections in the order of the declaration.
    pub fn iter(&self) -> impl Iterator<Item = &SectionValues> {
        self.0.iter()
    }

    /// The tables of a section; none where it is not written and has no defaults.
    pub fn all<'a>(&'a self, section: &Section) -> impl Iterator<Item = &'a SectionValues> {
        self.0.iter().filter(move |read| read.section.name == section.name)
    }

    /// The section, which does not repeat.
    pub fn one(&self, section: &Section) -> Option<&SectionValues> {
        self.all(section).next()
    }

    /// The section `part` within the table `of`.
    pub fn part(&self, of: &SectionValues, part: &Section) -> Option<&SectionValues> {
        let path = format!("{}.{}", of.path, part.own_name());
        self.0.iter().find(|read| read.section.name == part.name && read.path == path)
    }

    /// Removes the default values of the keys `of` a section.
    pub fn leave_out(&mut self, section: &Section, of: impl Fn(&Key) -> bool) {
        for read in self.0.iter_mut().filter(|read| read.section.name == section.name) {
            read.entries.retain(|entry| entry.is_given || !of(entry.key));
        }
    }

    /// The same sections but for those of `section`, which are the `others`.
    pub fn with(&self, section: &Section, others: Vec<SectionValues>) -> Self {
        let rest = self.0.iter().filter(|read| read.section.name != section.name).cloned();
        Self(rest.chain(others).collect())
    }

    /// Sets a key that is not given to `value`.
    pub fn settle<T>(&mut self, section: &Section, row: KeyRow<T>, value: Value) {
        let Some(key) = section.key(row.key.name) else { return };
        for read in self.0.iter_mut().filter(|read| read.section.name == section.name) {
            if !read.is_given(row) {
                let value = value.clone();
                read.entries.retain(|entry| entry.key.name != key.name);
                read.entries.push(Entry { key, value, span: None, parts: Vec::new(), is_given: false });
            }
        }
    }
}

/// The accepted values of one section.
#[derive(Debug, Clone)]
pub(crate) struct SectionValues {
    pub section: &'static Section,
    /// Its name in messages: `section`, `section[2]`.
    pub path: String,
    /// Where it stands in the file.
    pub span: Range<usize>,
    pub(super) entries: Vec<Entry>,
    /// Keys whose value was given but not accepted.
    pub(super) refused: Vec<&'static str>,
}

/// One accepted value.
#[derive(Debug, Clone)]
pub(crate) struct Entry {
    pub key: &'static Key,
    pub value: Value,
    /// Where it stands; none for defaults and overrides.
    pub span: Option<Range<usize>>,
    /// Where the elements of a list stand.
    pub parts: Vec<Range<usize>>,
    /// Whether the file or an override gives it: no default.
    pub is_given: bool,
}

impl Entry {
    pub(super) fn is_admitted(&self, with: &OnlyWith) -> bool {
        matches!(&self.value, Value::Text(text) if with.admits(text))
    }
}

impl SectionValues {
    /// The values of `section` where `false` is written at `span` in its place; none where it has
    /// no such choice.
    pub(super) fn off(section: &'static Section, path: String, span: Range<usize>) -> Option<Self> {
        let off = section.off?;
        let entry = Entry {
            key: section.key(off.key)?,
            value: Value::Text(off.choice.into()),
            span: Some(span.clone()),
            parts: Vec::new(),
            is_given: true,
        };
        Some(Self { section, path, span, entries: vec![entry], refused: Vec::new() })
    }

    /// The section as it is where the row `number` (from 1) of the file that the key `table` names
    /// gives the `values`: faults of it stand at that key.
    pub fn of_row<T>(
        &self,
        table: KeyRow<T>,
        number: usize,
        values: impl IntoIterator<Item = (KeyRow<f64>, f64)>,
    ) -> Self {
        let span = self.span_of(table);
        let mut row =
            Self { path: format!("{}.row[{number}]", self.path), span: span.clone(), ..self.clone() };
        for (own, value) in values {
            row.entries.retain(|entry| entry.key.name != own.key.name);
            let Some(key) = self.section.key(own.key.name) else { continue };
            let (value, span) = (Value::Number(value), Some(span.clone()));
            row.entries.push(Entry { key, value, span, parts: Vec::new(), is_given: true });
        }
        row
    }

    /// The value of a key; none where it is not given and has no default.
    pub fn get<T: FromValue>(&self, row: KeyRow<T>) -> Option<T> {
        T::from_value(&self.entry(row)?.value)
    }

    /// The value of a key with its places.
    pub fn entry<T>(&self, row: KeyRow<T>) -> Option<&Entry> {
        self.named(row.key.name)
    }

    pub(super) fn named(&self, key: &str) -> Option<&Entry> {
        self.entries.iter().find(|e| e.key.name == key)
    }

    /// Whether the file or an override gives this key a value.
    pub fn is_given<T>(&self, row: KeyRow<T>) -> bool {
        self.is_given_name(row.key.name)
    }

    /// Whether the file or an override gives the key `name` a value.
    pub fn is_given_name(&self, name: &str) -> bool {
        self.named(name).is_some_and(|entry| entry.is_given)
    }

    /// Whether a key was given a value that was not accepted, so that it cannot be checked further.
    pub fn is_refused<T>(&self, row: KeyRow<T>) -> bool {
        self.has_refused(&row.key)
    }

    pub(super) fn has_refused(&self, key: &Key) -> bool {
        self.refused.contains(&key.name)
    }

    /// The place of a key, or that of the section if the key is not given.
    pub fn span_of<T>(&self, row: KeyRow<T>) -> Range<usize> {
        self.entry(row).and_then(|e| e.span.clone()).unwrap_or(self.span.clone())
    }

    /// A key with its section, in messages.
    pub fn dotted(&self, key: &str) -> String {
        if self.path.is_empty() { key.into() } else { format!("{}.{key}", self.path) }
    }

    /// A fault of the value of a key.
    pub fn fault<T>(&self, row: KeyRow<T>, says: impl Display) -> Fault {
        self.fault_of_name(row.key.name, says)
    }

    /// A fault of the value of the key `name`.
    pub fn fault_of_name(&self, name: &str, says: impl Display) -> Fault {
        let (dotted, entry) = (self.dotted(name), self.named(name));
        let value = entry.map_or(String::new(), |entry| format!(" = {}", entry.value));
        let span = entry.and_then(|entry| entry.span.clone()).unwrap_or(self.span.clone());
        Fault::of(dotted.clone(), span, format!("`{dotted}{value}`: {says}"))
    }

    /// A fault of the section as a whole.
    pub fn fault_of_all(&self, says: impl Display) -> Fault {
        Fault::of(self.path.clone(), self.span.clone(), format!("`{}`: {says}", self.path))
    }

    /// Key and value in the order of the declaration, files under the names of a complete copy.
    pub(super) fn values(&self) -> Vec<(&'static str, Value)> {
        let value = |key: &Key| {
            let given = self.named(key.name)?;
            Some(match key.kind {
                Kind::Path { kept_as } => Value::Text(kept_as.into()),
                _ => given.value.clone(),
            })
        };
        self.section.keys.iter().filter_map(|key| Some((key.name, value(key)?))).collect()
    }
}
