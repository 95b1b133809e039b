//! Fracture toughness over temperature in CSV files.

use super::columns::{Column, Columns, LARGEST};
use super::companion::{ToughnessFile, read_named};
use crate::schema::{Fault, KeyRow, Report, SectionValues, Source};
use railcrack::fatigue::{Toughness, ToughnessError};
use std::path::Path;

const COLUMNS: Columns = Columns {
    columns: &[Column::Needed("temperature_c"), Column::Needed("toughness_mpa_sqrt_m")],
    largest: LARGEST,
    help: "a toughness table begins with the header temperature_c,toughness_mpa_sqrt_m and has a row per temperature, the lowest first; interpolation is linear, with constant values beyond the ends",
};

/// The toughness in the file that a key names, relative to `folder`; none if no file is named or it
/// cannot be read; errors are added to `report`.
pub(crate) fn read_toughness(
    section: &SectionValues,
    row: KeyRow<String>,
    folder: &Path,
    report: &mut Report,
) -> Option<ToughnessFile> {
    read_named(section, row, folder, report, &COLUMNS, parse)
}

fn parse(source: &Source) -> Result<Toughness, Box<Fault>> {
    let read = COLUMNS.read(source)?;
    let rows = read.rows.iter().map(|row| (row[0], row[1])).collect();
    Toughness::by_temperature(rows).map_err(|error| {
        let (row, message) = match error {
            ToughnessError::Row { row, reason } => (row, reason.to_string()),
            other => (0, other.to_string()),
        };
        COLUMNS.fault_of_row(&read, row, message)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_by_temperature() {
        let parsed = |text: &str| parse(&Source::new("k.csv", text));
        let table = parsed("temperature_c,toughness_mpa_sqrt_m\n-40,26\n20,38\n").unwrap();
        assert_eq!(table.at(-10.0), 32.0);
        let refused = |text| parsed(text).unwrap_err().message;
        assert!(
            refused("temperature_c,toughness_mpa_sqrt_m\n20,38\n-40,26\n").contains("temperature_c = -40")
        );
        assert!(refused("temperature_c,toughness_mpa_sqrt_m\n20,0\n").contains("toughness_mpa_sqrt_m = 0"));
    }
}
