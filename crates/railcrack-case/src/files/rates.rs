//! Growth rates by equivalent range in CSV files.

use super::columns::Columns;
use super::companion::{RELATIVE, RatesFile};
use crate::schema::{Fault, KeyRow, Report, SectionValues, Source, read_text};
use railcrack::fatigue::{RateTable, RateTableError};
use std::path::Path;

const COLUMNS: Columns = Columns {
    needed: &["delta_keq_mpa_sqrt_m", "rate_mm_per_cycle"],
    help: "rates begin with the header delta_keq_mpa_sqrt_m,rate_mm_per_cycle and have a row per range, the smallest \
           first: log-log linear between rows, no growth below the first",
};

/// The rates in the file that a key names, relative to `folder`; none where it names none or it
/// cannot be read, which `report` then says.
pub(crate) fn read_rates(
    section: &SectionValues,
    row: KeyRow<String>,
    folder: &Path,
    report: &mut Report,
) -> Option<RatesFile> {
    let given = section.get(row)?;
    let path = folder.join(&given);
    let key = || Some(section.dotted(row.key.name));
    match read_text(&path, &path.display().to_string()) {
        Ok(source) => match parse(&source) {
            Ok(table) => {
                let text = source.text.to_string();
                return Some(RatesFile::new(row, given, text, table));
            }
            Err(fault) => report.add_to(&source, Fault { key: key(), ..*fault }),
        },
        Err(unreadable) => match *unreadable {
            (source, fault) if fault.span.is_some() => report.add_to(&source, Fault { key: key(), ..fault }),
            (_, fault) => report.add(section.fault(row, fault.message).help(RELATIVE)),
        },
    }
    None
}

fn parse(source: &Source) -> Result<RateTable, Box<Fault>> {
    let read = COLUMNS.read(source)?;
    let rows = read.rows.iter().map(|row| (row[0], row[1])).collect();
    RateTable::new(rows).map_err(|error| {
        let (row, message) = match error {
            RateTableError::Row { row, reason } => (row, reason.to_string()),
            other @ RateTableError::TooShort { .. } => (0, other.to_string()),
        };
        COLUMNS.fault(message, read.span_of(row))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_by_range() {
        let parsed = |text: &str| parse(&Source { name: "rates.csv".into(), text: text.into() });
        let table = parsed("delta_keq_mpa_sqrt_m,rate_mm_per_cycle\n5,1e-7\n50,1e-3\n").unwrap();
        assert_eq!(table.covers(), (5.0, 50.0));
        let refused = |text| parsed(text).unwrap_err().message;
        assert!(refused("delta_keq_mpa_sqrt_m,rate_mm_per_cycle\n5,1e-7\n4,1e-6\n").contains("= 4"));
        assert!(refused("delta_keq_mpa_sqrt_m,rate_mm_per_cycle\n5,1e-7\n").contains("at least two"));
    }
}
