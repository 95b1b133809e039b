//! Rows of the CSV files that users give.

use crate::schema::Source;
use csv::StringRecord;
use std::ops::Range;

/// A row, the header among them.
#[derive(Debug)]
pub(crate) struct CsvRow {
    record: StringRecord,
    separator: u8,
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

    /// The number in the field `given`: with a decimal comma where commas do not separate fields.
    pub fn number(&self, given: &str) -> Option<f64> {
        let is_decimal = self.separator != b',' && given.matches(',').count() == 1 && !given.contains('.');
        if is_decimal { given.replace(',', ".").parse().ok() } else { given.parse().ok() }
    }

    /// The fault of a row with this number of fields in a table of `columns`.
    pub fn wrong_length(&self, columns: usize) -> String {
        let count = self.len();
        let hint = if self.fields().any(|field| field.contains('\n')) {
            ": a quotation mark is not closed"
        } else if count == 2 * columns && self.fields().all(|field| field.parse::<f64>().is_ok()) {
            ": with a decimal comma, fields are separated by semicolons"
        } else {
            ""
        };
        format!("{count} values in a row of {columns} columns{hint}")
    }
}

/// The rows of `source`: as by RFC 4180, separated by commas, semicolons or tabs, whichever the
/// header has, with line ends of any system. Lines that are blank or begin with # are left out.
pub(crate) fn csv_rows(source: &Source) -> impl Iterator<Item = CsvRow> {
    let text = &*source.text;
    let separator = separator(text);
    let mut builder = csv::ReaderBuilder::new();
    builder.has_headers(false).flexible(true).comment(Some(b'#')).delimiter(separator);
    let mut reader = builder.from_reader(text.as_bytes());
    let rows = std::iter::from_fn(move || {
        let from = reader.position().byte() as usize;
        let mut record = StringRecord::new();
        let is_there = reader.read_record(&mut record).unwrap_or(false);
        let between = from..reader.position().byte() as usize;
        is_there.then(|| CsvRow { record, separator, span: place(text, between) })
    });
    rows.filter(|row| {
        let first = row.fields().next().unwrap_or_default();
        !(first.starts_with('#') || first.is_empty() && row.len() == 1)
    })
}

/// The separator of the fields: of those outside of quotes in the header, the most frequent one.
fn separator(text: &str) -> u8 {
    let is_row = |line: &&str| !line.trim().is_empty() && !line.trim_start().starts_with('#');
    let header = text.trim_start_matches('\u{feff}').lines().find(is_row).unwrap_or_default();
    let outside: String = header.split('"').step_by(2).collect();
    let count = |separator: &u8| outside.matches(char::from(*separator)).count();
    // Of equally frequent ones, the last.
    [b'\t', b';', b','].into_iter().max_by_key(count).unwrap_or(b',')
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

    /// As spreadsheets write them where the comma is decimal.
    #[test]
    fn separators_and_decimal_commas() {
        let numbers = |text: &str| -> Vec<Option<f64>> {
            let source = Source::new("t.csv", text);
            let row = csv_rows(&source).nth(1).unwrap();
            row.fields().map(|field| row.number(field)).collect()
        };
        let both = [Some(6.0), Some(1.25)];
        assert_eq!(numbers("\u{feff}mgt;depth_mm\r\n6,0;1,25\r\n"), both);
        assert_eq!(numbers("mgt\tdepth_mm\n6\t1.25\n"), both);
        assert_eq!(numbers("\"mgt; total\",depth_mm\n6,1.25\n"), both);
        assert_eq!(numbers("# a; b; c\n\nmgt,depth_mm\n6,1.25\n"), both);
        // Neither thousands nor, where commas separate, decimals.
        assert_eq!(numbers("mgt;depth_mm\n1.234,5;1,234,5\n"), [None, None]);
        assert_eq!(numbers("mgt,depth_mm\n6,\"1,25\"\n"), [Some(6.0), None]);
    }

    #[test]
    fn rows_of_another_length() {
        let source = Source::new("t.csv", "1,5,2,5\n1,2,x\n\"1,2\n3,4\n");
        let wrong: Vec<String> = csv_rows(&source).map(|row| row.wrong_length(2)).collect();
        assert_eq!(
            wrong,
            [
                "4 values in a row of 2 columns: with a decimal comma, fields are separated by semicolons",
                "3 values in a row of 2 columns",
                "1 values in a row of 2 columns: a quotation mark is not closed",
            ]
        );
    }
}
