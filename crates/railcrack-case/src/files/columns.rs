//! Tables of numbers in CSV files, read by header.

use super::csv_rows::{CsvRow, csv_rows};
use super::size_class::{AT_LEAST, AT_MOST, SizeClass};
use super::units_row::{is_units_row, other_unit};
use crate::schema::{CaseErrors, Fault, Report, Source, escaped, nearest, read_file};
use std::collections::HashMap;
use std::ops::Range;
use std::path::Path;

/// A column of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Column {
    /// Required.
    Needed(&'static str),
    /// One of all alternatives is required, unless a column of [`Column::Blank`] is there: then
    /// each field may be blank. A field may be a class of sizes such as 0.5-1.0 in a table with the
    /// columns at_least_mm and at_most_mm.
    Alternative(&'static str),
    /// Optional; its values are 0 if it is missing.
    Optional(&'static str),
    /// Optional, and so is each field: the values are NaN where they are missing or blank.
    Blank(&'static str),
    /// The same, and a field may be infinite: the radius of what is straight.
    BlankRadius(&'static str),
    /// A known column that is not read: its values are 0.
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
    /// Columns of the file that are none of the table, and are not read.
    pub unused: Vec<String>,
    /// Rows that are copies of an earlier one in all of their fields, and that one, from 1.
    pub copies: Vec<(usize, usize)>,
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
            | Self::BlankRadius(name)
            | Self::PassedOver(name) => name,
        }
    }

    /// Its value in a row without it.
    fn if_missing(self) -> f64 {
        if self.may_be_blank() || matches!(self, Self::Alternative(_)) { f64::NAN } else { 0.0 }
    }

    fn may_be_blank(self) -> bool {
        matches!(self, Self::Blank(_) | Self::BlankRadius(_))
    }
}

impl Columned {
    /// Where each row stands.
    pub(super) fn spans(&self) -> &[Range<usize>] {
        &self.spans
    }
}

impl Columns {
    /// The error that row `number`, from 1, of the file `path` is wrong as `message` says.
    pub fn error_of_row(&self, path: &Path, number: usize, message: String) -> CaseErrors {
        let source = match read_file(path) {
            Ok(source) => source,
            Err(errors) => return errors,
        };
        let fault = match self.read(&source) {
            Ok(read) => self.fault_of_row(&read, number, message),
            Err(_) => self.fault(message, &(0..0)),
        };
        let mut report = Report::new(source);
        report.add(*fault);
        report.into_errors()
    }

    /// The table in the file `path`: separated by commas, or by semicolons or tabs with decimal
    /// points or commas. Lines that begin with # and empty lines are ignored, and so are columns
    /// that are none of the table, and a row of units below the header that are those of the table.
    ///
    /// Errors: the file cannot be read; a column is missing, misspelt, given twice or in another
    /// unit; a row has a different number of fields; a field is not a number.
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
        let mut rows = csv_rows(source).peekable();
        let Some(header) = rows.next() else {
            return Err(self.fault("the file is empty".into(), &(0..0)));
        };
        let order = self.order(&header)?;
        if let Some(units) = rows.next_if(|row| is_units_row(row.fields())) {
            self.check_units(&units, &order)?;
        }
        let is_given = (0..self.columns.len()).map(|column| order.contains(&Some(column))).collect();
        let mut read = Columned {
            rows: Vec::new(),
            is_given,
            unused: self.unused(&header),
            copies: Vec::new(),
            header: header.span.clone(),
            spans: Vec::new(),
        };
        let mut known: HashMap<String, usize> = HashMap::new();
        for row in rows {
            let number = read.rows.len() + 1;
            let text: Vec<&str> = row.fields().collect();
            if let Some(first) = known.insert(text.join("\n"), number) {
                read.copies.push((number, first));
            }
            let values = self.values(&row, &order);
            let fault = |message| self.fault(format!("row {}: {message}", read.rows.len() + 1), &row.span);
            let values = values.map_err(fault)?;
            read.rows.push(values);
            read.spans.push(row.span);
        }
        Ok(read)
    }

    /// The values of `row` in the declared order; or what is wrong with it.
    fn values(&self, row: &CsvRow, order: &[Option<usize>]) -> Result<Vec<f64>, String> {
        if row.len() != order.len() {
            return Err(row.wrong_length(order.len()));
        }
        // Where a row has other columns to say what it says, its alternative may be blank.
        let may_be_blank = self.columns.iter().any(|column| column.may_be_blank());
        let mut values: Vec<f64> = self.columns.iter().map(|column| column.if_missing()).collect();
        let known = order.iter().zip(row.fields()).filter_map(|(column, given)| Some(((*column)?, given)));
        for (column, given) in known {
            match (self.columns[column], row.number(given)) {
                (Column::PassedOver(_), _) => (),
                (Column::Blank(_) | Column::BlankRadius(_) | Column::Alternative(_), _)
                    if given.is_empty() && may_be_blank => {}
                (_, Some(value)) if value.abs() <= self.largest => values[column] = value,
                (Column::BlankRadius(_), Some(value)) if value.is_infinite() => values[column] = value,
                (Column::Alternative(_), _) if self.enter_class(row, given, &mut values) => (),
                (other, _) => {
                    let (name, most) = (other.name(), self.largest);
                    let found = match given.is_empty() {
                        true => format!("`{name}` is blank"),
                        false => format!("`{name} = {given}`"),
                    };
                    return Err(format!("{found}: must be a number in [-{most:e}, {most:e}]"));
                }
            }
        }
        Ok(values)
    }

    /// Enters the class of sizes that `given` of `row` names into the columns of its bounds.
    /// Whether it names one and the table has these columns.
    fn enter_class(&self, row: &CsvRow, given: &str, values: &mut [f64]) -> bool {
        let bounds = self.place(AT_LEAST).zip(self.place(AT_MOST));
        let Some(((low, high), class)) = bounds.zip(SizeClass::of(given, |part| row.number(part))) else {
            return false;
        };
        (values[low], values[high]) = (class.above.unwrap_or(f64::NAN), class.up_to.unwrap_or(f64::NAN));
        true
    }

    /// Errors: the row `units` names another unit for a column than its own.
    fn check_units(&self, units: &CsvRow, order: &[Option<usize>]) -> Result<(), Box<Fault>> {
        for (column, given) in order.iter().zip(units.fields()) {
            let Some(name) = column.map(|column| self.columns[column].name()) else { continue };
            if let Some(own) = other_unit(name, given) {
                let message = format!("`{name}` is in {own}, but the row of units has {given}");
                return Err(self.fault(message, &units.span));
            }
        }
        Ok(())
    }

    /// For each column of the file, the declared column that it is; none of others.
    fn order(&self, header: &CsvRow) -> Result<Vec<Option<usize>>, Box<Fault>> {
        let names: Vec<&str> = header.fields().collect();
        let refuse = |message: String| Err(self.fault(message, &header.span));
        // With another separator it is still such a table.
        let mut words = names.iter().flat_map(|name| name.split([';', '\t', ' ']));
        if !words.any(|word| self.columns.iter().any(|column| column.name() == word.trim_matches('"'))) {
            return Err(Box::new(of_another_kind(self.help)));
        }
        if let Some(twice) =
            (1..names.len()).find(|&i| names[..i].contains(&names[i]) && !names[i].is_empty())
        {
            return refuse(format!("column `{}` is given twice", names[twice]));
        }
        let unknown: Vec<&str> = names.iter().copied().filter(|name| self.place(name).is_none()).collect();
        let absent = self.columns.iter().map(|column| column.name()).filter(|known| !names.contains(known));
        for name in &unknown {
            // Not merely another column: what is meant by it would be left out.
            if absent.clone().any(|known| is_misspelt(name, known)) {
                let near = nearest(name, absent).unwrap_or_default();
                return refuse(format!("unknown column `{name}`; nearest known column: `{near}`"));
            }
        }
        match self.missing(&names) {
            Some(message) if unknown.is_empty() => refuse(message),
            Some(message) => refuse(format!("{message}; unknown column {}", in_words(&unknown))),
            None => Ok(names.iter().map(|name| self.place(name)).collect()),
        }
    }

    /// The columns of the file `source` that are none of the table; none of a file of another kind.
    pub(super) fn unused_of(&self, source: &Source) -> Vec<String> {
        csv_rows(source).next().map(|header| self.unused(&header)).unwrap_or_default()
    }

    fn unused(&self, header: &CsvRow) -> Vec<String> {
        if header.fields().all(|name| self.place(name).is_none()) {
            return Vec::new();
        }
        // A column without a name numbers the rows.
        let is_unused = |name: &&str| !name.is_empty() && self.place(name).is_none();
        header.fields().filter(is_unused).map(escaped).collect()
    }

    fn place(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|column| column.name() == name)
    }

    /// The fault in the columns `names` of a file: one is missing, or more than one alternative is
    /// given; none if they are complete.
    fn missing(&self, names: &[&str]) -> Option<String> {
        let is_there = |column: &&Column| names.contains(&column.name());
        let needed = |column: &&Column| matches!(column, Column::Needed(_));
        if let Some(missing) = self.columns.iter().filter(needed).find(|column| !is_there(column)) {
            return Some(format!("column `{}` is missing", missing.name()));
        }
        let alternatives: Vec<&Column> =
            self.columns.iter().filter(|column| matches!(column, Column::Alternative(_))).collect();
        let blank = |column: &&Column| column.may_be_blank();
        let says = match alternatives.iter().filter(|column| is_there(column)).count() {
            0 if self.columns.iter().filter(blank).any(|column| is_there(&column)) => return None,
            0 if !alternatives.is_empty() => "is missing",
            0 | 1 => return None,
            _ => "must be given, and only one of them",
        };
        let named: Vec<&str> = alternatives.iter().map(|column| column.name()).collect();
        Some(format!("column {} {says}", in_words(&named)))
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

fn in_words(names: &[&str]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(" or ")
}

/// Whether the column `name` of a file is meant to be `known`: another case, one letter wrong, or
/// without its unit.
fn is_misspelt(name: &str, known: &str) -> bool {
    let name = name.to_lowercase();
    let without_unit = known.rsplit_once('_').map(|(quantity, _)| quantity);
    strsim::osa_distance(&name, known) <= 1 || without_unit == Some(name.as_str())
}
