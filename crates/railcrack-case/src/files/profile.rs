//! Stress profiles in CSV files.

use super::columns::{Column, Columned, Columns};
use super::companion::{ProfileFile, read_named};
use crate::schema::{Fault, KeyRow, Report, SectionValues, Source};
use railcrack::field::{DepthProfile, ProfileError};
use std::path::Path;

/// The columns that are read, those of railcrack's own result files that must vanish, since a
/// balanced profile has no such stress, and those that are redundant.
const COLUMNS: Columns = Columns {
    columns: &[
        Column::Needed("depth_mm"),
        Column::Needed("sxx_mpa"),
        Column::Optional("szz_mpa"),
        Column::Optional("syy_mpa"),
        Column::Optional("sxy_mpa"),
        Column::PassedOver("ep_xx"),
        Column::PassedOver("ep_yy"),
        Column::PassedOver("ep_zz"),
        Column::PassedOver("ep_xy"),
        Column::PassedOver("plastic_per_pass"),
        Column::PassedOver("dang_van_mpa"),
    ],
    // No residual stress of steel is larger than this, MPa.
    largest: 1e4,
    help: "a profile begins with the header depth_mm,sxx_mpa[,szz_mpa] and has a row per depth, from the surface down",
};

/// Places of the stresses among the columns, and those that must vanish.
const STRESSES: std::ops::Range<usize> = 1..5;
const VANISHING: [(usize, &str); 2] = [(3, "syy_mpa"), (4, "sxy_mpa")];

/// A stress that counts as zero, relative to the largest stress of the file: round-off and
/// truncation of a computed profile, far below the scatter of a measured one.
const VANISHED: f64 = 0.01;

/// The profile in the file that a key names, relative to `folder`; none if no file is named or it
/// cannot be read; errors are added to `report`.
pub(crate) fn read_profile(
    section: &SectionValues,
    row: KeyRow<String>,
    folder: &Path,
    report: &mut Report,
) -> Option<ProfileFile> {
    read_named(section, row, folder, report, &COLUMNS, parse)
}

fn parse(source: &Source) -> Result<DepthProfile, Box<Fault>> {
    let read = COLUMNS.read(source)?;
    check_vanishing(&read)?;
    let values = read.rows.iter().map(|row| (row[0], row[1], row[2])).collect();
    let profile = DepthProfile::new(values).map_err(|error| {
        let row = match error {
            ProfileError::Empty => 0,
            ProfileError::NotFinite { row, .. }
            | ProfileError::NegativeDepth { row, .. }
            | ProfileError::NotIncreasing { row, .. } => row,
        };
        COLUMNS.fault_of_row(&read, row, error.to_string())
    })?;
    if read.rows.len() == 1 {
        let message = "the only row: stresses are linear between rows and zero below the last, so that a single one has no effect";
        return Err(COLUMNS.fault_of_row(&read, 1, message.into()));
    }
    Ok(profile)
}

fn check_vanishing(read: &Columned) -> Result<(), Box<Fault>> {
    let stresses = read.rows.iter().flat_map(|row| &row[STRESSES]);
    let largest = stresses.fold(0.0f64, |largest, stress| largest.max(stress.abs()));
    for (i, row) in read.rows.iter().enumerate() {
        for (column, name) in VANISHING {
            if row[column].abs() > VANISHED * largest {
                let message = format!("`{name} = {}`: must be zero in a balanced profile", row[column]);
                return Err(COLUMNS.fault_of_row(read, i + 1, message));
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(text: &str) -> Result<Vec<(f64, f64, f64)>, String> {
        let source = Source::new("p.csv", text);
        parse(&source).map(|p| p.rows().to_vec()).map_err(|f| f.message)
    }

    #[test]
    fn columns_are_found_by_name() {
        let want = Ok(vec![(0.0, 25.0, 5.0), (1.0, -110.0, 0.0)]);
        assert_eq!(parsed("# a comment\nszz_mpa, depth_mm ,sxx_mpa\r\n5,0,25\r\n\r\n0,1,-110\r\n"), want);
        let ours = "depth_mm,sxx_mpa,syy_mpa,szz_mpa,sxy_mpa,ep_xx\n0,25,1e-9,5,0,nan\n1,-110,0,0,0,0\n";
        assert_eq!(parsed(ours), want);
    }

    #[test]
    fn a_single_row_has_no_effect() {
        let error = parsed("depth_mm,sxx_mpa\n0,200\n").unwrap_err();
        assert!(
            error.starts_with("the only row") && parsed("depth_mm,sxx_mpa\n0,9\n1,0\n").is_ok(),
            "{error}"
        );
    }

    #[test]
    fn a_profile_with_shear_is_not_balanced() {
        let error = parsed("depth_mm,sxx_mpa,sxy_mpa\n0,25,1\n").unwrap_err();
        assert!(error.contains("`sxy_mpa = 1`"), "{error}");
    }
}
