//! A table of samples given by the user: a row per run, a column per key.

use super::substitute::Substitute;
use crate::case::place_of;
use crate::files::{csv_rows, of_another_kind};
use crate::schema::{CaseErrors, Fault, Kind, Report, Source, read_file};
use crate::tables::SECTIONS;
use std::path::Path;

/// A table whose columns are keys (`contact.friction`, `crack[1].angle_deg`) and whose rows are
/// runs.
#[derive(Debug, Clone, PartialEq)]
pub struct SampleTable {
    pub(in crate::study) columns: Vec<(String, Substitute)>,
}

impl SampleTable {
    /// The table in the file `path`: CSV with a header, `#` before comments.
    ///
    /// Errors: it cannot be read; a column is not a key; a row has a different number of fields.
    pub fn read(path: &Path) -> Result<Self, CaseErrors> {
        Self::of(read_file(path)?)
    }

    /// The table with this `text`; errors call it `name`.
    ///
    /// Errors: see [`SampleTable::read`].
    pub fn parse(text: &str, name: &str) -> Result<Self, CaseErrors> {
        Self::of(Source::new(name, text))
    }

    fn of(source: Source) -> Result<Self, CaseErrors> {
        let mut report = Report::new(source.clone());
        let table = read(&source, &mut report);
        match table {
            Some(columns) if report.is_clean() => Ok(Self { columns }),
            _ => Err(report.into_errors()),
        }
    }
}

fn read(source: &Source, report: &mut Report) -> Option<Vec<(String, Substitute)>> {
    let mut rows = csv_rows(source);
    let help = "the table begins with a header of keys such as contact.friction,crack[1].angle_deg, followed by a row per run";
    let Some(header) = rows.next() else {
        return report.refuse(Fault::new("there is no header").help(help));
    };
    let section = |name: &str| name.trim().split(['.', '[']).next().unwrap_or_default().to_owned();
    let is_known = |name: &str| !name.is_empty() && SECTIONS.iter().any(|section| section.name == name);
    let separated = |field: &str| field.split([';', '\t']).any(|name| is_known(&section(name)));
    if !header.fields().any(separated) {
        return report.refuse(of_another_kind(help));
    }
    let mut columns = Vec::new();
    for name in header.fields() {
        let fault = |says: String| Fault { span: Some(header.span.clone()), ..Fault::new(says) };
        // A column without a name numbers the rows.
        if name.is_empty() {
            columns.push(None);
            continue;
        }
        match place_of(name) {
            Ok((section, number, key)) if is_single(key.kind) => {
                let substitute = Substitute {
                    section: section.name,
                    number: number.unwrap_or(1),
                    key: key.name,
                    values: Vec::new(),
                    span: None,
                };
                columns.push(Some((name.to_owned(), key.kind, substitute)));
            }
            Ok(_) => report
                .add(fault(format!("`{name}` is a list, which a field of a table cannot hold")).help(help)),
            Err((says, near)) => report.add(fault(format!("column `{name}`: {says}")).help(near)),
        }
    }
    for row in rows {
        if row.len() != columns.len() {
            let says = row.wrong_length(columns.len());
            return report.refuse(Fault { span: Some(row.span), ..Fault::new(says).help(help) });
        }
        for (field, column) in row.fields().zip(&mut columns) {
            if let Some((_, kind, substitute)) = column {
                substitute.values.push(toml(field, *kind));
            }
        }
    }
    let columns = columns.into_iter().flatten();
    let columns: Vec<_> = columns.map(|(name, _, substitute)| (name, substitute)).collect();
    if columns.iter().any(|(_, substitute)| substitute.values.is_empty()) {
        report.add(Fault::new("there is no row").help(help));
    }
    Some(columns)
}

fn is_single(kind: Kind) -> bool {
    !matches!(kind, Kind::Numbers { .. } | Kind::Points { .. } | Kind::Groups { .. })
}

/// A field as TOML: a number as it is written elsewhere, too, words with or without quotes.
fn toml(field: &str, kind: Kind) -> String {
    if kind.is_text() {
        return format!("\"{}\"", field.trim_matches('"').replace('\\', "\\\\"));
    }
    match field.parse::<f64>() {
        Ok(value) if matches!(kind, Kind::Number { .. }) => format!("{value:?}"),
        _ => field.to_owned(),
    }
}
