//! The tables of the figures, read: CSV whose names are in quotes where they have commas.

use railcrack_run::csv::line_fields;

/// The set-up of digitised curves in tables and charts.
pub(crate) const DIGITISED: &str = "digitised";

/// A table of strings and numbers.
pub(crate) struct FigureTable {
    columns: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl FigureTable {
    /// Errors: the line of a row that has not as many fields as the header.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let mut lines = text.lines().enumerate().filter(|(_, line)| !line.starts_with('#'));
        let columns = lines.next().map_or_else(Vec::new, |(_, header)| line_fields(header));
        let mut rows = Vec::new();
        for (i, line) in lines {
            let row = line_fields(line);
            if row.len() != columns.len() {
                return Err(format!("line {}: {} fields", i + 1, row.len()));
            }
            rows.push(row);
        }
        Ok(Self { columns, rows })
    }

    /// The place of the column `name`; none where there is none.
    pub(crate) fn column(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|column| column == name)
    }

    /// The rows, field by field.
    pub(crate) fn rows(&self) -> impl Iterator<Item = &[String]> {
        self.rows.iter().map(Vec::as_slice)
    }
}
