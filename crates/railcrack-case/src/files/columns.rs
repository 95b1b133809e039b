//! Tables of numbers in CSV files, read by header.

use crate::schema::{CaseErrors, Fault, Report, Source, nearest, read_file};
use std::ops::Range;
use std::path::Path;

/// A column of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Column {
    /// Required.
    Needed(&'static str),
    /// Exactly one of all alternatives is required.
    Alternative(&'static str),
    /// Optional; its values are 0 if it is missing.
    Optional(&'static str),
    /// Optional, and so is each field: the values are NaN where they are missing or blank.
    Blank(&'static str),
    /// Optional, with any text, and not read: its values are 0.
    PassedOver(&'static str),
}

/// Declaration of a table: its columns in the order in which their values are returned.
#[derive(Debug, Clone, Copy)]
pub struct Columns {
    /// The columns.
    pub columns: &'static [Column],
    /// Upper limit of all numbers: a larger one is in the wrong unit.
    pub largest: f64,
    /// Description of the file, with its header and rows: help.
    pub help: &'static str,
}

/// A table as read.
#[derive(Debug, Clone, PartialEq)]
pub struct Columned {
    /// `rows[row][column]`, columns in the order of [`Columns::columns`].
    pub rows: Vec<Vec<f64>>,
    /// Whether each column is present.
    pub is_given: Vec<bool>,
    /// Where the header and each row stand.
    header: Range<usize>,
    spans: Vec<Range<usize>>,
}

/// Limit of the numbers in most tables.
pub(super) const LARGEST: f64 = 1e6;

impl Column {
    fn name(self) -> &'static str {
        match self {
            Self::Needed(name)
            | Self::Alternative(name)
            | Self::Optional(name)
            | Self::Blank(name)
            | Self::PassedOver(name) => name,
        }
    }

    /// Its value in a row without it.
    fn if_missing(self) -> f64 {
        if matches!(self, Self::Blank(_)) { f64::NAN } else { 0.0 }
    }
}

impl Columns {
    /// The error that row `number`, from 1, of the file `path` is wrong as `message` says.
    pub fn error_of_row(&self, path: &Path, number: usize, message: String) -> CaseErrors {
        let source = match read_file(path) {
            Ok(source) => source,
            Err(errors) => return errors,
        };
        let span = lines(&source).nth(number).map_or(0..0, |(_, span)| span);
        let mut report = Report::new(source);
        report.add(*self.fault(message, &span));
        report.into_errors()
    }

    /// The table in the file `path`; lines that begin with # and empty lines are ignored.
    ///
    /// Errors: the file cannot be read; a column is unknown, missing or given twice; a row has a
    /// different number of fields; a field is not a number.
    pub fn read_file(&self, path: &Path) -> Result<Columned, CaseErrors> {
        let source = read_file(path)?;
        self.read(&source).map_err(|fault| {
            let mut report = Report::new(source.clone());
            report.add(*fault);
            report.into_errors()
        })
    }

    /// The table in `source`.
    pub(crate) fn read(&self, source: &Source) -> Result<Columned, Box<Fault>> {
        let mut lines = lines(source);
        let Some((header, header_span)) = lines.next() else {
            return Err(self.fault("the file is empty".into(), &(0..0)));
        };
        let order = self.order(header, &header_span)?;
        let is_given = (0..self.columns.len()).map(|column| order.contains(&column)).collect();
        let mut read = Columned { rows: Vec::new(), is_given, header: header_span, spans: Vec::new() };
        // Where a row has other columns to say what it says, its alternative may be blank.
        let may_be_blank = self.columns.iter().any(|column| matches!(column, Column::Blank(_)));
        for (text, span) in lines {
            let fields: Vec<&str> = text.split(',').map(str::trim).collect();
            if fields.len() != order.len() {
                let (number, columns) = (read.rows.len() + 1, order.len());
                let mut message =
                    format!("row {number}: {} values in a row of {columns} columns", fields.len());
                if fields.len() == 2 * order.len() && fields.iter().all(|field| field.parse::<f64>().is_ok())
                {
                    message.push_str(": numbers have a decimal point, not a comma");
                }
                return Err(self.fault(message, &span));
            }
            let mut row: Vec<f64> = self.columns.iter().map(|column| column.if_missing()).collect();
            for (&column, given) in order.iter().zip(fields) {
                match (self.columns[column], given.parse::<f64>()) {
                    (Column::PassedOver(_), _) => (),
                    (Column::Blank(_) | Column::Alternative(_), _) if given.is_empty() && may_be_blank => {
                        row[column] = f64::NAN;
                    }
                    (_, Ok(value)) if value.abs() <= self.largest => row[column] = value,
                    (other, _) => {
                        let (name, most) = (other.name(), self.largest);
                        let number = read.rows.len() + 1;
                        let found = match given.is_empty() {
                            true => format!("`{name}` is blank"),
                            false => format!("`{name} = {given}`"),
                        };
                        let message =
                            format!("row {number}: {found}: must be a number in [-{most:e}, {most:e}]");
                        return Err(self.fault(message, &span));
                    }
                }
            }
            read.rows.push(row);
            read.spans.push(span);
        }
        Ok(read)
    }

    /// For each column of the file, the declared column that it corresponds to.
    fn order(&self, header: &str, span: &Range<usize>) -> Result<Vec<usize>, Box<Fault>> {
        let names: Vec<&str> = header.split(',').map(str::trim).collect();
        // With another separator it is still such a table.
        let mut words = header.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
        if !words.any(|word| self.columns.iter().any(|column| column.name() == word)) {
            return Err(Box::new(of_another_kind(self.help)));
        }
        if let Some(other) = [";", "\t"].into_iter().find(|other| names.len() == 1 && header.contains(other))
        {
            let other = if other == ";" { "semicolons" } else { "tabs" };
            let message =
                format!("columns are separated by commas, not by {other}; numbers have a decimal point");
            return Err(self.fault(message, span));
        }
        let mut order = Vec::with_capacity(names.len());
        for (i, name) in names.iter().enumerate() {
            if names[..i].contains(name) {
                return Err(self.fault(format!("column `{name}` is given twice"), span));
            }
            let Some(column) = self.columns.iter().position(|column| column.name() == *name) else {
                let known = self.columns.iter().filter(|column| !matches!(column, Column::PassedOver(_)));
                let near = nearest(name, known.map(|column| column.name())).unwrap_or_default();
                let message = format!("unknown column `{name}`; nearest known column: `{near}`");
                return Err(self.fault(message, span));
            };
            order.push(column);
        }
        let is_there = |column: &&Column| names.contains(&column.name());
        let needed = |column: &&Column| matches!(column, Column::Needed(_));
        if let Some(missing) = self.columns.iter().filter(needed).find(|column| !is_there(column)) {
            return Err(self.fault(format!("column `{}` is missing", missing.name()), span));
        }
        let alternatives: Vec<&Column> =
            self.columns.iter().filter(|column| matches!(column, Column::Alternative(_))).collect();
        let given = alternatives.iter().filter(|column| is_there(column)).count();
        if given != 1 && !alternatives.is_empty() {
            let named: Vec<String> =
                alternatives.iter().map(|column| format!("`{}`", column.name())).collect();
            let says = if given == 0 { "is missing" } else { "must be given, and only one of them" };
            return Err(self.fault(format!("column {} {says}", named.join(" or ")), span));
        }
        Ok(order)
    }

    /// A fault at `span`.
    pub(super) fn fault(&self, message: String, span: &Range<usize>) -> Box<Fault> {
        Box::new(Fault { span: Some(span.clone()), ..Fault::new(message).help(self.help) })
    }

    /// A fault of row `number` of `read`, from 1, or of its header where there is no such row.
    pub(super) fn fault_of_row(&self, read: &Columned, number: usize, message: String) -> Box<Fault> {
        let row = number.checked_sub(1).and_then(|i| read.spans.get(i));
        self.fault(message, row.unwrap_or(&read.header))
    }
}

/// A fault of a file whose first line names no column of the table: what it holds is not shown.
pub(crate) fn of_another_kind(help: &str) -> Fault {
    Fault::new("the file is of another kind: its first line names none of the columns").help(help)
}

/// Lines of a table that are neither empty nor comments, with their places.
pub(crate) fn lines(source: &Source) -> impl Iterator<Item = (&str, Range<usize>)> {
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
