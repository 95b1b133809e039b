//! Profiles of rail and wheel as points.

use super::columns::{Column, Columns};
use super::companion::{CaseFile, read_named};
use crate::schema::{Fault, KeyRow, Report, SectionValues, Source};
use railcrack::profiles::{Profile, ProfileShapeError};
use std::path::Path;

const COLUMNS: Columns = Columns {
    columns: &[Column::Needed("y_mm"), Column::Needed("z_mm")],
    // No wheel or rail is larger, mm.
    largest: 1e3,
    help: "a profile has the header y_mm,z_mm and a row per point, in the order of the points along it; y across the rail, z downwards",
};

/// A profile and the text it was read from.
pub type PointFile = CaseFile<Profile>;

/// Whose profile it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Profiled {
    Rail,
    Wheel,
}

/// Properties of a profile that are not in the file.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ProfileReading {
    /// Half-length of the smoothing, mm.
    pub smoothing: f64,
    pub is: Profiled,
}

/// The profile in the file that a key names, relative to `folder`; none if it cannot be read;
/// errors are added to `report`.
pub(crate) fn read_points(
    section: &SectionValues,
    row: KeyRow<String>,
    reading: ProfileReading,
    folder: &Path,
    report: &mut Report,
) -> Option<PointFile> {
    read_named(section, row, folder, report, &COLUMNS, |source| parse(source, reading))
}

fn parse(source: &Source, reading: ProfileReading) -> Result<Profile, Box<Fault>> {
    let read = COLUMNS.read(source)?;
    let points: Vec<[f64; 2]> = read.rows.iter().map(|row| [row[0], row[1]]).collect();
    let refused = |error: ProfileShapeError| {
        let row = match error {
            ProfileShapeError::Gap { row, .. } => row,
            _ => read.rows.len(),
        };
        COLUMNS.fault_of_row(&read, row, error.to_string())
    };
    let profile = Profile::smoothed(&points, reading.smoothing).map_err(refused)?;
    if reading.is == Profiled::Rail {
        profile.check_rail().map_err(refused)?;
    }
    Ok(profile)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(text: &str, is: Profiled) -> String {
        parse(&Source::new("p.csv", text), ProfileReading { smoothing: 1.0, is }).unwrap_err().message
    }

    #[test]
    fn refused_profiles() {
        let rows = |z: fn(f64) -> f64| -> String {
            let row = |i: i32| format!("{},{}\n", i, z(f64::from(i)));
            format!("y_mm,z_mm\n{}", (-20..=20).map(row).collect::<String>())
        };
        let crown = |y: f64| y * y / 600.0;
        assert!(
            parse(&Source::new("p.csv", &rows(crown)), ProfileReading { smoothing: 1.0, is: Profiled::Rail })
                .is_ok()
        );
        let down = |y: f64| -y * y / 600.0;
        assert!(refused(&rows(down), Profiled::Rail).contains("z_mm is measured downwards"));
        assert!(
            refused("y_mm,z_mm\n0,0\n1,0\n", Profiled::Wheel)
                .contains("2 points; a profile needs at least 10")
        );
        assert!(
            refused("y_mm,z_mm\n0,0\n9,0\n", Profiled::Wheel)
                .contains("row 2 lies 9.000 mm from the row before")
        );
        assert!(refused("y_mm,height\n0,0\n", Profiled::Wheel).contains("unknown column `height`"));
        assert!(refused("y_mm,z_mm\n0,x\n", Profiled::Wheel).contains("`z_mm = x`: must be a number"));
    }
}
