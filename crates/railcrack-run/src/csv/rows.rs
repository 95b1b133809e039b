//! Rows of a table as text: shortest decimal that reads back to the same bits.

use super::line::text_field;
use crate::error::OutputError;

/// Rows under construction. Fields are pushed left to right; [`Rows::end`] closes a row.
#[derive(Debug, Default)]
pub struct Rows {
    /// Sections of the case that bring columns of their own.
    sections: Vec<&'static str>,
    text: Vec<u8>,
    row_start: usize,
    not_finite: Option<(&'static str, f64, String)>,
}

impl Rows {
    /// Rows of a run whose case has `sections`.
    pub fn with_sections(sections: &[&'static str]) -> Self {
        Self { sections: sections.to_vec(), ..Self::default() }
    }

    /// Whether the case has `section`, whose columns are then there.
    pub fn has(&self, section: &str) -> bool {
        self.sections.contains(&section)
    }

    /// Forgets the rows and keeps the memory.
    pub fn clear(&mut self) {
        self.text.clear();
        self.row_start = 0;
        self.not_finite = None;
    }

    /// Bytes of the rows.
    pub fn length(&self) -> usize {
        self.text.len()
    }

    /// A number that counts.
    pub fn count(&mut self, mut value: usize) {
        let mut digits = [0u8; 20];
        let mut first = digits.len();
        loop {
            first -= 1;
            digits[first] = b'0' + (value % 10) as u8;
            value /= 10;
            if value == 0 {
                break;
            }
        }
        self.text.extend_from_slice(&digits[first..]);
        self.text.push(b',');
    }

    /// The real number of `column`: `6.0`, `0.04`, `1e-7`.
    pub fn real(&mut self, column: &'static str, value: f64) {
        if value.is_finite() {
            self.text.extend_from_slice(ryu::Buffer::new().format_finite(value).as_bytes());
        } else if self.not_finite.is_none() {
            let row = String::from_utf8_lossy(&self.text[self.row_start..]).into_owned();
            self.not_finite = Some((column, value, row));
        }
        self.text.push(b',');
    }

    /// A name without commas.
    pub fn name(&mut self, name: &str) {
        self.text.extend_from_slice(name.as_bytes());
        self.text.push(b',');
    }

    /// A text, in quotes where it has commas, quotes or line ends (RFC 4180), and never a formula.
    pub fn quoted(&mut self, text: &str) {
        self.name(&text_field(text));
    }

    /// Closes the row.
    pub fn end(&mut self) {
        if let Some(last) = self.text.last_mut() {
            *last = b'\n';
        }
        self.row_start = self.text.len();
    }

    /// The rows of the table `file`; an error where a number was not finite.
    pub fn text(&self, file: &'static str) -> Result<&[u8], OutputError> {
        match &self.not_finite {
            None => Ok(&self.text),
            Some((column, value, row)) => {
                Err(OutputError::NotFinite { file, column, value: *value, row: row.clone() })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_plain_and_read_back() {
        let values = [6.0, 0.1 + 0.2, 1e-7, -2.5e-17, 1e300, f64::MIN_POSITIVE, -0.0, 123_456_789.25];
        let mut rows = Rows::default();
        for value in values {
            rows.count(usize::MAX);
            rows.real("value", value);
            rows.name("");
            rows.end();
        }
        let text = String::from_utf8(rows.text("test.csv").unwrap().to_vec()).unwrap();
        assert!(text.starts_with("18446744073709551615,6.0,\n"), "{text}");
        assert!(text.contains(",1e-7,"), "{text}");
        for (line, value) in text.lines().zip(values) {
            let read: f64 = line.split(',').nth(1).unwrap().parse().unwrap();
            assert_eq!(read.to_bits(), value.to_bits(), "{line}");
        }
    }

    #[test]
    fn fields_with_commas_are_quoted() {
        let mut rows = Rows::default();
        for text in ["0.025", "[[0.0, 0.0], [4.0, -1.0]]", "a \"b\"\nc"] {
            rows.quoted(text);
        }
        rows.end();
        let text = rows.text("test.csv").unwrap();
        assert_eq!(text, b"0.025,\"[[0.0, 0.0], [4.0, -1.0]]\",\"a \"\"b\"\" c\"\n");
    }

    #[test]
    fn the_first_number_that_is_not_finite_is_named_with_its_row() {
        let mut rows = Rows::default();
        rows.count(7);
        rows.real("good", 1.0);
        rows.end();
        rows.count(8);
        rows.real("bad", f64::NAN);
        rows.real("worse", f64::INFINITY);
        rows.end();
        let message = rows.text("test.csv").unwrap_err().to_string();
        assert!(message.contains("test.csv: bad = NaN in the row \"8,"), "{message}");
        rows.clear();
        assert!(rows.text("test.csv").unwrap().is_empty());
    }
}
