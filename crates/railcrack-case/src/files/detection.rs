//! Probability of detection over depth in CSV files.

use super::columns::{Column, Columns, LARGEST};
use super::companion::{DetectionFile, read_named};
use super::detection_table::DetectionTable;
use crate::schema::{Fault, KeyRow, Report, SectionValues, Source};
use std::path::Path;

const COLUMNS: Columns = Columns {
    columns: &[Column::Needed("depth_mm"), Column::Needed("probability")],
    largest: LARGEST,
    help: "a table of detection begins with the header depth_mm,probability and has a row per depth, the shallowest first; interpolation is linear, with no detection above the first depth and a constant probability below the last",
};

/// The table in the file that a key names, relative to `folder`; none if no file is named or it
/// cannot be read; errors are added to `report`.
pub(crate) fn read_detection(
    section: &SectionValues,
    row: KeyRow<String>,
    folder: &Path,
    report: &mut Report,
) -> Option<DetectionFile> {
    read_named(section, row, folder, report, &COLUMNS, parse)
}

fn parse(source: &Source) -> Result<DetectionTable, Box<Fault>> {
    let read = COLUMNS.read(source)?;
    let rows: Vec<(f64, f64)> = read.rows.iter().map(|row| (row[0], row[1])).collect();
    let mut before = (-1.0, 0.0);
    for (i, &(depth, probability)) in rows.iter().enumerate() {
        let fault = |message: String| Err(COLUMNS.fault_of_row(&read, i + 1, message));
        if depth < 0.0 || depth <= before.0 {
            return fault(format!(
                "depth_mm = {depth} must be zero or more, and more than in the row before"
            ));
        }
        if !(before.1..=1.0).contains(&probability) {
            return fault(format!(
                "probability = {probability} must be between 0 and 1, and not less than in the row before"
            ));
        }
        before = (depth, probability);
    }
    if rows.is_empty() {
        return Err(COLUMNS.fault_of_row(&read, 0, "the table has no row".to_owned()));
    }
    Ok(DetectionTable::of(rows))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_by_depth() {
        let parsed = |text: &str| parse(&Source::new("pod.csv", text));
        let table = parsed("depth_mm,probability\n0.5,0\n2,0.5\n5,0.9\n").unwrap();
        assert_eq!(table.rows(), [(0.5, 0.0), (2.0, 0.5), (5.0, 0.9)]);
        let refused = |rows: &str| parsed(&format!("depth_mm,probability\n{rows}")).unwrap_err().message;
        assert!(refused("2,0.5\n1,0.9\n").contains("depth_mm = 1"));
        assert!(refused("-1,0.5\n").contains("depth_mm = -1"));
        assert!(refused("1,0.5\n2,1.5\n").contains("probability = 1.5"));
        assert!(refused("1,0.5\n2,0.4\n").contains("probability = 0.4"));
        assert!(!refused("").is_empty());
    }
}
