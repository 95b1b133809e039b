//! Rows of the CSV files that users give.

use crate::schema::Source;
use csv::StringRecord;
use std::ops::Range;

/// A row, the header among them.
#[derive(Debug)]
pub(crate) struct CsvRow {
    record: StringRecord,
    /// Its bytes in the file.
    pub span: Range<usize>,
}

impl CsvRow {
    /// Its fields without quotes and the spaces around them.
    pub fn fields(&self) -> impl Iterator<Item = &str> {
        self.record.iter().map(|field| {
            let field = field.trim();
            // Quotes behind a space are part of the field in RFC 4180, and not what is meant.
            let inner = field.strip_prefix('"').and_then(|field| field.strip_suffix('"'));
            inner.map_or(field, str::trim)
        })
    }

    /// Number of its fields.
    pub fn len(&self) -> usize {
        self.record.len()
    }

    /// The fault of a row with this number of fields in a table of `columns`.
    pub fn wrong_length(&self, columns: usize) -> String {
        let count = self.len();
        let hint = if self.fields().any(|field| field.contains('\n')) {
            ": a quotation mark is not closed"
        } else if count == 2 * columns && self.fields().all(|field| field.parse::<f64>().is_ok()) {
            ": numbers have a decimal point, not a comma"
        } else {
            ""
        };
        format!("{count} values in a row of {columns} columns{hint}")
    }
}

/// The rows of `source`: comma-separated as by RFC 4180, with line ends of any system. Lines that
/// are blank or begin with # are left out.
pub(crate) fn csv_rows(source: &Source) -> impl Iterator<Item = CsvRow> {
    let text = &*source.text;
    let mut builder = csv::ReaderBuilder::new();
    builder.has_headers(false).flexible(true).comment(Some(b'#'));
    let mut reader = builder.from_reader(text.as_bytes());
    let rows = std::iter::from_fn(move || {
        let from = reader.position().byte() as usize;
        let mut record = StringRecord::new();
        let is_there = reader.read_record(&mut record).unwrap_or(false);
        let between = from..reader.position().byte() as usize;
        is_there.then(|| CsvRow { record, span: place(text, between) })
    });
    rows.filter(|row| {
        let first = row.fields().next().unwrap_or_default();
        !(first.starts_with('#') || first.is_empty() && row.len() == 1)
    })
}

/// The bytes of the row in `between`: without the comments and blank lines before it and its end.
fn place(text: &str, between: Range<usize>) -> Range<usize> {
    let (mut start, read) = (between.start, text.get(between).unwrap_or_default());
    let mut rest = read;
    for line in read.split_inclusive('\n') {
        if !matches!(line.trim_start_matches('\u{feff}').bytes().next(), None | Some(b'#' | b'\r' | b'\n')) {
            break;
        }
        start += line.len();
        rest = &rest[line.len()..];
    }
    start..start + rest.trim_end().len()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(text: &str) -> Vec<(Vec<String>, String)> {
        let source = Source::new("t.csv", text);
        let row = |row: CsvRow| (row.fields().map(str::to_owned).collect(), text[row.span].to_owned());
        csv_rows(&source).map(row).collect()
    }

    /// As spreadsheets, R and pandas write them, each row with its own text.
    #[test]
    fn rows_as_programs_write_them() {
        let text = "\u{feff}# by R, \"quoted\r\n\"mgt\",\"depth_mm\"\r\n\r\n  \r\n\"6.0\" , 1.2 \r\n# a\n  # b\n 7, \"1.5\"\r\"x, \"\"y\"\"\",\n";
        let of = |fields: [&str; 2], text: &str| (fields.map(str::to_owned).to_vec(), text.to_owned());
        assert_eq!(
            rows(text),
            [
                of(["mgt", "depth_mm"], "\"mgt\",\"depth_mm\""),
                of(["6.0", "1.2"], "\"6.0\" , 1.2"),
                of(["7", "1.5"], " 7, \"1.5\""),
                of(["x, \"y\"", ""], "\"x, \"\"y\"\"\","),
            ]
        );
        assert!(rows("").is_empty() && rows("\u{feff}").is_empty() && rows("# only\n\n").is_empty());
        assert_eq!(rows("\u{feff}a,b\n1,2")[0], of(["a", "b"], "\u{feff}a,b"));
    }

    #[test]
    fn rows_of_another_length() {
        let source = Source::new("t.csv", "1,5,2,5\n1,2,x\n\"1,2\n3,4\n");
        let wrong: Vec<String> = csv_rows(&source).map(|row| row.wrong_length(2)).collect();
        assert_eq!(
            wrong,
            [
                "4 values in a row of 2 columns: numbers have a decimal point, not a comma",
                "3 values in a row of 2 columns",
                "1 values in a row of 2 columns: a quotation mark is not closed",
            ]
        );
    }
}
