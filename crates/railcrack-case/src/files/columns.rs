//! Tables of numbers in CSV files, read by header.

use crate::schema::{Fault, Source, nearest};
use std::ops::Range;

/// Columns of a table.
pub(super) struct Columns {
    /// Those that must be there, in the order in which they are returned.
    pub needed: &'static [&'static str],
    /// Description of the file, with its header and rows: help.
    pub help: &'static str,
}

/// A table as read.
pub(super) struct Columned {
    /// `rows[row][column]`, columns in the order of [`Columns::needed`].
    pub rows: Vec<Vec<f64>>,
    /// Where the header and each row stand.
    pub header: Range<usize>,
    pub spans: Vec<Range<usize>>,
}

/// No number of a table is larger: beyond, a unit is wrong.
const LARGEST: f64 = 1e6;

impl Columns {
    /// The table in `source`; lines that begin with # and empty lines are passed over.
    pub fn read(&self, source: &Source) -> Result<Columned, Box<Fault>> {
        let mut lines = lines(source);
        let Some((header, header_span)) = lines.next() else {
            return Err(self.fault("the file is empty".into(), &(0..0)));
        };
        let order = self.order(header, &header_span)?;
        let mut read = Columned { rows: Vec::new(), header: header_span, spans: Vec::new() };
        for (text, span) in lines {
            let fields: Vec<&str> = text.split(',').map(str::trim).collect();
            if fields.len() != order.len() {
                let message = format!("{} values in a row of {} columns", fields.len(), order.len());
                return Err(self.fault(message, &span));
            }
            let mut row = Vec::with_capacity(order.len());
            for (name, &field) in self.needed.iter().zip(&order) {
                let given = fields[field];
                match given.parse::<f64>() {
                    Ok(value) if value.abs() <= LARGEST => row.push(value),
                    _ => {
                        let message = format!("`{name} = {given}`: must be a number in [-1e6, 1e6]");
                        return Err(self.fault(message, &span));
                    }
                }
            }
            read.rows.push(row);
            read.spans.push(span);
        }
        Ok(read)
    }

    /// Of each needed column, which one of the file it is.
    fn order(&self, header: &str, span: &Range<usize>) -> Result<Vec<usize>, Box<Fault>> {
        let names: Vec<&str> = header.split(',').map(str::trim).collect();
        for (i, name) in names.iter().enumerate() {
            if names[..i].contains(name) {
                return Err(self.fault(format!("column `{name}` is given twice"), span));
            }
            if !self.needed.contains(name) {
                let near = nearest(name, self.needed.iter().copied()).unwrap_or_default();
                let message = format!("unknown column `{name}`; nearest known column: `{near}`");
                return Err(self.fault(message, span));
            }
        }
        let place = |needed: &&str| {
            let found = names.iter().position(|name| name == needed);
            found.ok_or_else(|| self.fault(format!("column `{needed}` is missing"), span))
        };
        self.needed.iter().map(place).collect()
    }

    /// A fault at `span`.
    pub fn fault(&self, message: String, span: &Range<usize>) -> Box<Fault> {
        Box::new(Fault { span: Some(span.clone()), ..Fault::new(message).help(self.help) })
    }
}

impl Columned {
    /// Where row `number`, from 1, stands; the header where it is none of them.
    pub fn span_of(&self, number: usize) -> &Range<usize> {
        number.checked_sub(1).and_then(|i| self.spans.get(i)).unwrap_or(&self.header)
    }
}

/// Lines that are neither empty nor comments, with their places.
fn lines(source: &Source) -> impl Iterator<Item = (&str, Range<usize>)> {
    let mut offset = 0;
    source.text.split_inclusive('\n').filter_map(move |raw| {
        let start = offset;
        offset += raw.len();
        let text = raw.trim_end_matches(['\n', '\r']);
        let text = if start == 0 { text.trim_start_matches('\u{feff}') } else { text };
        let is_row = !text.trim().is_empty() && !text.trim_start().starts_with('#');
        is_row.then(|| (text, start..start + raw.trim_end().len()))
    })
}
