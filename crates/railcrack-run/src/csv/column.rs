//! Columns of tables.

/// A column of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Column {
    /// Its name, with the unit of its numbers.
    pub name: &'static str,
    /// Its meaning, line by line.
    pub meaning: &'static [&'static str],
    /// The section of the case without which a run has no such column; none where every run has it.
    pub section: Option<&'static str>,
}
