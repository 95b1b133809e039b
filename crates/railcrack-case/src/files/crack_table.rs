//! Lists of the cracks of an inspection: one row per crack.

use super::columns::{Column, Columns};
use super::companion::{CaseFile, read_named};
use crate::schema::{Fault, KeyRow, Kind, Report, SectionValues, Source};
use std::path::Path;

const COLUMNS: Columns = Columns {
    columns: &[
        Column::Blank("mouth_mm"),
        Column::Blank("position_m"),
        Column::Alternative("depth_mm"),
        Column::Alternative("length_mm"),
        Column::Blank("at_least_mm"),
        Column::Blank("at_most_mm"),
        Column::Blank("surface_length_mm"),
        Column::Blank("angle_deg"),
        Column::Blank("lateral_mm"),
    ],
    // Positions count from the beginning of a line.
    largest: 1e7,
    help: "a list of cracks has a row per crack, with the columns mouth_mm or position_m, and depth_mm or length_mm, a number or a class such as 0.5-1.0, or at_most_mm; surface_length_mm, angle_deg and lateral_mm may be left out",
};

/// A crack in the list of an inspection.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InspectedCrack {
    /// x coordinate of its mouth, mm; of a list of positions from the smallest of them.
    pub mouth: f64,
    /// Its size.
    pub size: InspectedSize,
    /// Semi-axis along the surface, mm, where its length on the surface is given.
    pub surface_half_length: Option<f64>,
    /// Angle below the surface, degrees.
    pub angle: Option<f64>,
    /// Lateral position of its centre, mm.
    pub lateral: Option<f64>,
}

/// The size of a crack as an inspection gives it, mm; of a class of sizes its upper end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum InspectedSize {
    /// Depth of its tip.
    Depth(f64),
    /// Length along it.
    Length(f64),
}

/// A list of cracks and the text it was read from.
pub type CrackTableFile = CaseFile<Vec<InspectedCrack>>;

/// The keys of a crack that a list gives.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CrackKeys {
    pub mouth: KeyRow<f64>,
    pub depth: KeyRow<f64>,
    pub length: KeyRow<f64>,
    pub surface_half_length: KeyRow<f64>,
    pub angle: KeyRow<f64>,
    pub lateral: KeyRow<f64>,
}

impl InspectedCrack {
    /// The `keys` that it gives, with their values.
    pub(crate) fn values(&self, keys: &CrackKeys) -> impl Iterator<Item = (KeyRow<f64>, f64)> {
        let size = match self.size {
            InspectedSize::Depth(depth) => (keys.depth, depth),
            InspectedSize::Length(length) => (keys.length, length),
        };
        let others = [
            (keys.surface_half_length, self.surface_half_length),
            (keys.angle, self.angle),
            (keys.lateral, self.lateral),
        ];
        let given = others.into_iter().filter_map(|(key, value)| Some((key, value?)));
        [(keys.mouth, self.mouth), size].into_iter().chain(given)
    }
}

/// The cracks in the file that a key names, relative to `folder`, with values that the `keys`
/// accept; none if no file is named or it cannot be read; errors are added to `report`.
pub(crate) fn read_crack_table(
    section: &SectionValues,
    row: KeyRow<String>,
    keys: &CrackKeys,
    folder: &Path,
    report: &mut Report,
) -> Option<CrackTableFile> {
    read_named(section, row, folder, report, &COLUMNS, |source| parse(source, keys))
}

fn parse(source: &Source, keys: &CrackKeys) -> Result<Vec<InspectedCrack>, Box<Fault>> {
    let read = COLUMNS.read(source)?;
    let fault = |number: usize, message: String| COLUMNS.fault_of_row(&read, number, message);
    if read.rows.is_empty() {
        return Err(fault(0, "no rows: a list of cracks needs one at least".into()));
    }
    // Sizes without a column of their own are classes of depth.
    let size = if read.is_given[3] { Measured::length(keys) } else { Measured::depth(keys) };
    let mut cracks = Vec::with_capacity(read.rows.len());
    for (i, row) in read.rows.iter().enumerate() {
        let crack =
            crack_of(row, size, keys).map_err(|says| fault(i + 1, format!("row {}: {says}", i + 1)))?;
        cracks.push(crack);
    }
    if read.is_given[1] && cracks.len() == read.rows.len() {
        let first = read.rows.iter().map(|row| row[1]).fold(f64::INFINITY, f64::min);
        for (i, (crack, row)) in cracks.iter_mut().zip(&read.rows).enumerate() {
            crack.mouth = 1e3 * (row[1] - first);
            let says = |says: String| fault(i + 1, format!("row {}: {says} after the first one", i + 1));
            accepted("mouth_mm", crack.mouth, keys.mouth).map_err(says)?;
        }
    }
    Ok(cracks)
}

/// The column of the sizes of a list.
#[derive(Debug, Clone, Copy)]
struct Measured {
    column: usize,
    name: &'static str,
    key: KeyRow<f64>,
    of: fn(f64) -> InspectedSize,
}

impl Measured {
    fn depth(keys: &CrackKeys) -> Self {
        Self { column: 2, name: "depth_mm", key: keys.depth, of: InspectedSize::Depth }
    }

    fn length(keys: &CrackKeys) -> Self {
        Self { column: 3, name: "length_mm", key: keys.length, of: InspectedSize::Length }
    }
}

/// The crack of a row, NaN where a field is missing or blank; or what is wrong with which column.
fn crack_of(row: &[f64], measured: Measured, keys: &CrackKeys) -> Result<InspectedCrack, String> {
    let given = |column: usize| row.get(column).copied().filter(|value| !value.is_nan());
    let mouth = match (given(0), given(1)) {
        (Some(mouth), None) => accepted("mouth_mm", mouth, keys.mouth)?,
        (None, Some(_)) => 0.0,
        (Some(_), Some(_)) => {
            return Err("`position_m` says the same thing as `mouth_mm`: give one or the other".into());
        }
        (None, None) => return Err("`mouth_mm` or `position_m` is missing".into()),
    };
    let size = size_of(measured, given(measured.column), (given(4), given(5)))?;
    let surface_half_length = match given(6) {
        Some(length) => Some(0.5 * accepted("surface_length_mm", length, keys.surface_half_length)?),
        None => None,
    };
    let optional = |name, column, key| given(column).map(|value| accepted(name, value, key)).transpose();
    Ok(InspectedCrack {
        mouth,
        size,
        surface_half_length,
        angle: optional("angle_deg", 7, keys.angle)?,
        lateral: optional("lateral_mm", 8, keys.lateral)?,
    })
}

/// The size that a row gives as such or as a class, of which the upper end counts: the deepest
/// crack that it allows.
fn size_of(
    measured: Measured,
    size: Option<f64>,
    (at_least, at_most): (Option<f64>, Option<f64>),
) -> Result<InspectedSize, String> {
    let name = measured.name;
    let size = match (size, at_least, at_most) {
        (Some(size), None, None) => accepted(name, size, measured.key)?,
        (None, at_least, Some(at_most)) => {
            if let Some(at_least) = at_least.filter(|at_least| *at_least >= at_most) {
                return Err(format!("`at_least_mm = {at_least}` must be less than `at_most_mm = {at_most}`"));
            }
            accepted("at_most_mm", at_most, measured.key)?
        }
        (None, Some(at_least), None) => {
            return Err(format!(
                "`{name}` is a class without an upper end, above {at_least}: must be a size, or a class with one, to which the crack is computed"
            ));
        }
        (None, None, None) => return Err(format!("`{name}` is missing, and at_most_mm too")),
        (Some(size), ..) => {
            return Err(format!("`{name} = {size}` is given beside a class: leave it blank, or both bounds"));
        }
    };
    Ok((measured.of)(size))
}

/// The `value` of the column `name`, which is to be one that `key` accepts.
fn accepted(name: &str, value: f64, key: KeyRow<f64>) -> Result<f64, String> {
    match key.key.kind {
        Kind::Number { range, .. } if !range.contains(value) => {
            Err(format!("`{name} = {value}`: must be {}", key.key.kind.accepted()))
        }
        _ => Ok(value),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::schema::{closed, number, within};

    fn parsed(text: &str) -> Result<Vec<InspectedCrack>, String> {
        let key = |range| number("key", "mm", range, 0.0, "");
        let size = key(closed(1e-3, 1e4));
        let keys = CrackKeys {
            mouth: key(within(1e6)),
            depth: size,
            length: size,
            surface_half_length: size,
            angle: key(closed(0.5, 179.5)),
            lateral: key(within(1e3)),
        };
        parse(&Source::new("i.csv", text), &keys).map_err(|fault| fault.message)
    }

    const PLAIN: InspectedCrack = InspectedCrack {
        mouth: 0.0,
        size: InspectedSize::Depth(1.0),
        surface_half_length: None,
        angle: None,
        lateral: None,
    };

    /// As an instrument exports it: byte order mark, semicolons, decimal commas, units, classes,
    /// further columns.
    #[test]
    fn a_list_of_positions_and_classes() {
        let text = "\u{feff}crack;position_m;depth_mm;surface_length_mm;angle_deg;operator\n-;[m];[mm];[mm];[deg];\n\
                    A;12438,512;0,5\u{2013}1,0;11,2;25;K. M.\nB;12438,5;<0,5;;;\nC;12438,506;2,7;;23;\n";
        let [a, b, c] = parsed(text).unwrap().try_into().unwrap();
        assert!((a.mouth - 12.0).abs() < 1e-6 && b.mouth == 0.0 && (c.mouth - 6.0).abs() < 1e-6);
        let at = |crack: InspectedCrack| InspectedCrack { mouth: 0.0, ..crack };
        assert_eq!(at(a), InspectedCrack { surface_half_length: Some(5.6), angle: Some(25.0), ..PLAIN });
        assert_eq!(b, InspectedCrack { size: InspectedSize::Depth(0.5), ..PLAIN });
        assert_eq!(at(c), InspectedCrack { size: InspectedSize::Depth(2.7), angle: Some(23.0), ..PLAIN });
        assert_eq!(COLUMNS.unused_of(&Source::new("i.csv", text)), ["crack", "operator"]);
    }

    #[test]
    fn lengths_and_bounds() {
        let of = |text| parsed(text).unwrap()[0];
        let lengths = of("mouth_mm,length_mm,lateral_mm\n3,2.5,-6\n");
        let want =
            InspectedCrack { mouth: 3.0, size: InspectedSize::Length(2.5), lateral: Some(-6.0), ..PLAIN };
        assert_eq!(lengths, want);
        assert_eq!(of("mouth_mm,at_least_mm,at_most_mm\n0,0.5,1\n"), PLAIN);
        assert_eq!(of("mouth_mm,length_mm\n0,1.5-2\n").size, InspectedSize::Length(2.0));
    }

    #[test]
    fn refused_with_row_and_column() {
        let refused = |header: &str, row: &str| parsed(&format!("{header}\n{row}\n")).unwrap_err();
        let deep = "mouth_mm,depth_mm";
        for (header, row, says) in [
            (deep, "0,-1", "row 1: `depth_mm = -1`: must be a number in [0.001, 10000] mm"),
            (deep, "0,deep", "row 1: `depth_mm = deep`: must be a number"),
            (deep, "0,>2.7", "row 1: `depth_mm` is a class without an upper end, above 2.7"),
            (deep, "0,2-1", "row 1: `at_least_mm = 2` must be less than `at_most_mm = 1`"),
            (deep, "0,", "row 1: `depth_mm` is missing"),
            (deep, ",1", "row 1: `mouth_mm` or `position_m` is missing"),
            ("mouth_mm,position_m,depth_mm", "0,0,1", "row 1: `position_m` says the same thing"),
            ("mouth_mm,depth_mm,at_most_mm", "0,1,2", "row 1: `depth_mm = 1` is given beside a class"),
            (
                "mouth_mm,depth_mm,angle_deg",
                "0,1,0.1",
                "row 1: `angle_deg = 0.1`: must be a number in [0.5, 179.5]",
            ),
            ("mouth_mm,depth_mm,surface_length_mm", "0,1,0", "row 1: `surface_length_mm = 0`: must be"),
            ("mouth_mm,depth_mm,lateral_mm", "0,1,2000", "row 1: `lateral_mm = 2000`: must be"),
            (
                "mouth_mm,depth_mm,length_mm",
                "0,1,2",
                "column `depth_mm` or `length_mm` must be given, and only one",
            ),
            ("mouth_mm,deph_mm", "0,1", "unknown column `deph_mm`; nearest known column: `depth_mm`"),
            ("position_m,depth_mm", "0,1\n2000,1", "row 2: `mouth_mm = 2000000`: must be"),
        ] {
            let message = refused(header, row);
            assert!(message.starts_with(says), "{message}");
        }
        assert!(parsed("mouth_mm,depth_mm\n").unwrap_err().contains("no rows"));
        let other = parsed("mouth_mm,depth_mm\n-,cm\n0,1\n").unwrap_err();
        assert_eq!(other, "`depth_mm` is in mm, but the row of units has cm");
    }
}
