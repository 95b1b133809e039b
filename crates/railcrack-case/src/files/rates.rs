//! Growth rates by equivalent range in CSV files.

use super::columns::{Column, Columns, LARGEST};
use super::companion::{RatesFile, read_named};
use crate::schema::{Fault, KeyRow, Report, SectionValues, Source};
use railcrack::fatigue::{RateTable, RateTableError};
use std::path::Path;

const COLUMNS: Columns = Columns {
    columns: &[Column::Needed("delta_keq_mpa_sqrt_m"), Column::Needed("rate_mm_per_cycle")],
    largest: LARGEST,
    help: "a table of rates begins with the header delta_keq_mpa_sqrt_m,rate_mm_per_cycle and has a row per range, the smallest first; interpolation is linear in log-log scale, with no growth below the first row",
};

/// The rates in the file that a key names, relative to `folder`; none if no file is named or it
/// cannot be read; errors are added to `report`.
pub(crate) fn read_rates(
    section: &SectionValues,
    row: KeyRow<String>,
    folder: &Path,
    report: &mut Report,
) -> Option<RatesFile> {
    read_named(section, row, folder, report, &COLUMNS, parse)
}

fn parse(source: &Source) -> Result<RateTable, Box<Fault>> {
    let read = COLUMNS.read(source)?;
    let rows = read.rows.iter().map(|row| (row[0], row[1])).collect();
    RateTable::new(rows).map_err(|error| {
        let (row, message) = match error {
            RateTableError::Row { row, reason } => (row, reason.to_string()),
            other @ RateTableError::TooShort { .. } => (0, other.to_string()),
        };
        COLUMNS.fault_of_row(&read, row, message)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_by_range() {
        let parsed = |text: &str| parse(&Source::new("rates.csv", text));
        let table = parsed("delta_keq_mpa_sqrt_m,rate_mm_per_cycle\n5,1e-7\n50,1e-3\n").unwrap();
        assert_eq!(table.covers(), (5.0, 50.0));
        let refused = |text| parsed(text).unwrap_err().message;
        assert!(refused("delta_keq_mpa_sqrt_m,rate_mm_per_cycle\n5,1e-7\n4,1e-6\n").contains("= 4"));
        assert!(refused("delta_keq_mpa_sqrt_m,rate_mm_per_cycle\n5,1e-7\n").contains("at least two"));
    }
}
