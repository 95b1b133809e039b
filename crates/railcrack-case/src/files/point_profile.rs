//! Profiles of rail and wheel as points: CSV files, two columns with comments, and files of
//! MiniProf and Simpack, recognised by their content.

use super::columns::{Column, Columns};
use super::companion::{CaseFile, read_named};
use super::point_lines::{GivenPoints, Profiled, is_columns, is_miniprof, read_columns};
use super::simpack::{is_simpack, read_simpack};
use crate::schema::{Choice, Fault, KeyRow, Report, SectionValues, Source, Word};
use railcrack::profiles::{Profile, ProfileShapeError};
use std::ops::Range;
use std::path::Path;

const COLUMNS: Columns = Columns {
    columns: &[Column::Needed("y_mm"), Column::Needed("z_mm")],
    // No wheel or rail is larger, mm.
    largest: 1e3,
    help: "a profile has the header y_mm,z_mm and a row per point, in the order of the points along it; y across the rail, z downwards. Two columns without a header and files of MiniProf (.ban, .whl) and Simpack (.prr, .prw) are read too",
};

/// A profile and the text it was read from.
pub type PointFile = CaseFile<Profile>;

/// The axes of a file of points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ProfileAxes {
    ZDown,
    ZUp,
    Mirrored,
    MirroredZUp,
}

impl Choice for ProfileAxes {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::ZDown, Word::now("z-down", "y and z as those of the rail here")),
        (Self::ZUp, Word::now("z-up", "z points upwards")),
        (Self::Mirrored, Word::now("mirrored", "y points to the other side")),
        (Self::MirroredZUp, Word::now("mirrored-z-up", "both")),
    ];
}

impl ProfileAxes {
    /// Factors of y and z.
    fn signs(self) -> [f64; 2] {
        match self {
            Self::ZDown => [1.0, 1.0],
            Self::ZUp => [1.0, -1.0],
            Self::Mirrored => [-1.0, 1.0],
            Self::MirroredZUp => [-1.0, -1.0],
        }
    }
}

/// Properties of a profile that are not in the file.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ProfileReading {
    /// Half-length of the smoothing, mm.
    pub smoothing: f64,
    pub is: Profiled,
    /// The axes of the file, where they are given.
    pub axes: Option<ProfileAxes>,
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
    let at = |(says, span): (String, Range<usize>)| COLUMNS.fault(says, &span);
    if is_simpack(source) {
        let read = read_simpack(source).map_err(at)?;
        if read.is.is_some_and(|is| is != reading.is) {
            let [found, wanted] = [reading.is == Profiled::Rail, reading.is == Profiled::Wheel]
                .map(|is_wheel| if is_wheel { "a wheel" } else { "a rail" });
            return Err(COLUMNS.fault(format!("its header says that it is {found}, not {wanted}"), &(0..0)));
        }
        return shaped(&read.given, reading);
    }
    if is_miniprof(source) {
        let read = read_columns(source).map_err(at)?;
        // Neither the format nor its header says where z points.
        let turned = ProfileReading { axes: reading.axes.or(Some(ProfileAxes::ZUp)), ..reading };
        return shaped(&read, reading).or_else(|fault| shaped(&read, turned).map_err(|_| fault));
    }
    if is_columns(source) {
        return shaped(&read_columns(source).map_err(at)?, reading);
    }
    let read = COLUMNS.read(source)?;
    let points = read.rows.iter().map(|row| [row[0], row[1]]).collect();
    shaped(&GivenPoints { points, spans: read.spans().to_vec() }, reading)
}

/// The smooth profile through the `given` points.
fn shaped(given: &GivenPoints, reading: ProfileReading) -> Result<Profile, Box<Fault>> {
    let refused = |error: ProfileShapeError| {
        let row = match error {
            ProfileShapeError::Gap { row, .. } => row,
            _ => given.spans.len(),
        };
        let span = row.checked_sub(1).and_then(|i| given.spans.get(i)).cloned().unwrap_or(0..0);
        let key = match reading.is {
            Profiled::Rail => "rail_profile_axes",
            Profiled::Wheel => "wheel_profile_axes",
        };
        let is_turned =
            matches!(error, ProfileShapeError::UpsideDown { .. } | ProfileShapeError::FlangeUp { .. });
        let fault = COLUMNS.fault(error.to_string(), &span);
        if is_turned {
            Box::new(fault.help(format!("{key} = \"z-up\" reads a file whose z points upwards")))
        } else {
            fault
        }
    };
    let [across, down] = reading.axes.unwrap_or(ProfileAxes::ZDown).signs();
    let points: Vec<[f64; 2]> = given.points.iter().map(|[y, z]| [across * y, down * z]).collect();
    let profile = Profile::smoothed(&points, reading.smoothing).map_err(refused)?;
    match reading.is {
        Profiled::Rail => profile.check_rail().map_err(refused)?,
        Profiled::Wheel => profile.check_wheel().map_err(refused)?,
    }
    Ok(profile)
}

#[cfg(test)]
#[path = "point_profile_tests.rs"]
mod tests;
