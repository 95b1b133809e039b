//! Fields of the rows of a table that is read.

use super::column::Column;
use crate::error::OutputError;
use std::path::{Path, PathBuf};

/// The fields of a row, in the order of the columns that were declared.
#[derive(Debug)]
pub struct Fields<'a> {
    layout: &'a Layout,
    line: usize,
    text: &'a [&'a str],
    next: usize,
}

impl<'a> Fields<'a> {
    /// The text of a column; empty in a table that was written without it.
    fn text_of(&self, column: usize) -> &'a str {
        self.layout.places.get(column).copied().flatten().map_or("", |place| self.text[place])
    }

    /// Whether the next field is empty; it is passed over then.
    pub(super) fn skip_empty(&mut self) -> bool {
        let is_empty = self.text_of(self.next).is_empty();
        self.next += usize::from(is_empty);
        is_empty
    }

    /// The next field, parsed by `parse`.
    pub(super) fn parse<T>(
        &mut self,
        accepted: &str,
        parse: impl FnOnce(&str) -> Option<T>,
    ) -> Result<T, OutputError> {
        let value = parse(self.text_of(self.next)).ok_or_else(|| self.unreadable(accepted));
        self.next += 1;
        value
    }

    pub(super) fn unreadable(&self, accepted: &str) -> OutputError {
        let (line, found) = (self.line, self.text_of(self.next));
        let column = self.layout.columns.get(self.next).copied().unwrap_or_default();
        self.layout.damaged(format!("line {line}: {column} is \"{found}\", not {accepted}"))
    }
}

/// Where the declared columns stand in the file.
#[derive(Debug)]
pub(super) struct Layout {
    pub(super) path: PathBuf,
    columns: Vec<&'static str>,
    places: Vec<Option<usize>>,
}

impl Layout {
    pub(super) fn of(path: &Path, declared: &'static [Column], header: &str) -> Result<Self, OutputError> {
        let present: Vec<&str> = header.split(',').collect();
        let mut layout = Self { path: path.to_path_buf(), columns: Vec::new(), places: Vec::new() };
        for column in declared {
            let place = present.iter().position(|name| *name == column.name);
            if place.is_none() && column.section.is_none() {
                return Err(layout.damaged(format!("no column {}", column.name)));
            }
            layout.columns.push(column.name);
            layout.places.push(place);
        }
        Ok(layout)
    }

    pub(super) fn damaged(&self, reason: String) -> OutputError {
        OutputError::damaged(&self.path, reason)
    }

    /// The fields of the row `text` in line `line`; `fields` keeps its memory from row to row.
    pub(super) fn fields<'a>(
        &'a self,
        line: usize,
        text: &'a str,
        fields: &'a mut Vec<&'a str>,
    ) -> Result<Fields<'a>, OutputError> {
        fields.clear();
        fields.extend(text.split(','));
        if self.places.iter().flatten().any(|&place| place >= fields.len()) {
            return Err(self.damaged(format!("line {line}: {} fields", fields.len())));
        }
        Ok(Fields { layout: self, line, text: fields, next: 0 })
    }
}
