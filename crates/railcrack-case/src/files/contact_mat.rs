//! Output of the rolling-contact program CONTACT: `<experiment>.<case>.mat`, a text file.
//!
//! Groups of rows follow comments that name their columns. The one with MX and MY is the grid, MX
//! by MY elements of DX by DY mm from the corner (XL, YL), x in the direction of rolling, and the
//! last one has a row per element of the contact: its number I from 1, x fastest, the normal
//! pressure PN and the traction PX on the rail, in N/mm². Source: CONTACT, E. Vollebregt, User
//! Guide A.6 and `writmt` of its source.

use crate::schema::{Fault, Source};
use railcrack::load::{ContactRow, Travel};
use std::ops::Range;

/// The grid of the elements.
#[derive(Debug, Clone, Copy)]
struct Grid {
    columns: usize,
    rows: usize,
    left: f64,
    bottom: f64,
    dx: f64,
    dy: f64,
    /// Angle of the direction of rolling from x, radians.
    direction: f64,
}

/// Pressure and shear of all elements of the grid, zero outside of the contact, x fastest.
struct Elements {
    grid: Grid,
    traction: Vec<[f64; 2]>,
    place: Range<usize>,
}

/// Maximum number of elements of a grid.
const MOST_ELEMENTS: f64 = 1e7;

/// Farthest end of a grid, mm: that of a rail and a wheel.
const FARTHEST: f64 = 1e4;

/// Whether a text is such a file: it begins with a comment of Matlab.
pub(super) fn is_contact_output(text: &str) -> bool {
    text.trim_start_matches('\u{feff}').trim_start().starts_with('%')
}

/// Rows of the strip at `lateral` (y in the frame of the contact, mm) under a wheel that runs
/// towards `travel`: between two rows of elements linear, at the middles of the elements, and zero
/// at the middle of the first element outside at either end. The strip then has the load of its
/// elements.
///
/// Errors: no such file; a direction of rolling other than x; a strip outside the contact.
pub(super) fn strip(source: &Source, lateral: f64, travel: Travel) -> Result<Vec<ContactRow>, Box<Fault>> {
    let elements = Elements::read(source)?;
    let Grid { columns, rows, left, bottom, dx, dy, .. } = elements.grid;
    let of_row = |row: usize| -> &[[f64; 2]] { &elements.traction[row * columns..(row + 1) * columns] };
    let pressed = |row: &usize| of_row(*row).iter().any(|traction| traction[0] > 0.0);
    let middle = |row: usize| bottom + (row as f64 + 0.5) * dy;
    let (first, last) = match ((0..rows).find(pressed), (0..rows).rfind(pressed)) {
        (Some(first), Some(last)) => (first, last),
        _ => return Err(fault("no element is in contact".into(), &elements.place)),
    };
    let largest = |row: usize| of_row(row).iter().fold(0.0f64, |most, traction| most.max(traction[0]));
    let by_row: Vec<f64> = (first..=last).map(largest).collect();
    check_ends(&by_row, "y").map_err(|message| fault(message, &elements.place))?;
    let (low, high) = (middle(first) - 0.5 * dy, middle(last) + 0.5 * dy);
    if !(low..=high).contains(&lateral) {
        let message = format!(
            "the contact reaches from y = {low} to {high} mm, but strip_mm = {lateral} is outside it"
        );
        return Err(fault(message, &elements.place));
    }
    // Beyond the middle of the outermost row, the traction of that row applies.
    let at = ((lateral - middle(0)) / dy).clamp(first as f64, last as f64);
    let (below, share) = (at.floor() as usize, at.fract());
    let above = (below + 1).min(rows - 1);
    let mixed = |i: usize| [0, 1].map(|k| (1.0 - share) * of_row(below)[i][k] + share * of_row(above)[i][k]);
    let strip: Vec<[f64; 2]> = (0..columns).map(mixed).collect();
    let is_in = |traction: &[f64; 2]| traction[0] > 0.0;
    let (Some(from), Some(to)) = (strip.iter().position(is_in), strip.iter().rposition(is_in)) else {
        return Err(fault("no element of the strip is in contact".into(), &elements.place));
    };
    let along: Vec<f64> = strip[from..=to].iter().map(|traction| traction[0]).collect();
    check_ends(&along, "x").map_err(|message| fault(message, &elements.place))?;
    let x = |i: f64| left + (i + 0.5) * dx;
    let end = |i: f64| ContactRow { u: x(i), pressure: 0.0, shear: 0.0 };
    let mut table = vec![end(from as f64 - 1.0)];
    for (i, &[pressure, shear]) in strip.iter().enumerate().take(to + 1).skip(from) {
        // An element outside the contact has no shear either.
        let shear = if pressure > 0.0 { shear } else { 0.0 };
        table.push(ContactRow { u: x(i as f64), pressure: pressure.max(0.0), shear });
    }
    table.push(end(to as f64 + 1.0));
    if travel == Travel::Backward {
        // Its x is the direction of rolling.
        table.reverse();
        table.iter_mut().for_each(|row| (row.u, row.shear) = (-row.u, -row.shear));
    }
    Ok(table)
}

/// Largest ratio of the outermost pressure of a contact to the one next to it: the pressure grows
/// with the root of the distance d (in elements) from the edge, so that it is √(d/(d + 1)), at most
/// 0.71 for an element whose neighbour is outside.
const EDGE: f64 = 0.8;

/// Errors: the `pressures` along `axis` do not fall towards one of their ends.
fn check_ends(pressures: &[f64], axis: &str) -> Result<(), String> {
    let falls = |end: Option<&f64>, next: Option<&f64>| match (end, next) {
        (Some(end), Some(next)) => end <= &(EDGE * next),
        _ => true,
    };
    let count = pressures.len();
    let at_end = falls(pressures.last(), count.checked_sub(2).map(|i| &pressures[i]));
    if count < FEWEST || at_end && falls(pressures.first(), pressures.get(1)) {
        return Ok(());
    }
    let (side, [end, next]) = match at_end {
        true => ("smallest", [pressures[0], pressures[1]]),
        false => ("largest", [pressures[count - 1], pressures[count - 2]]),
    };
    Err(format!(
        "the contact is cut off at its {side} {axis}: the pressure there is {end} MPa, next to {next} MPa, where at an edge it falls \
         to less than {EDGE} of that; the file ends within the contact, or its grid does"
    ))
}

/// Elements across a contact from which on its edges can be told.
const FEWEST: usize = 5;

impl Elements {
    fn read(source: &Source) -> Result<Self, Box<Fault>> {
        let mut names: Vec<&str> = Vec::new();
        let mut grid: Option<Grid> = None;
        let mut traction: Vec<[f64; 2]> = Vec::new();
        let mut offset = 0;
        let mut place = 0..0;
        for raw in source.text.split_inclusive('\n') {
            let span = offset..offset + raw.trim_end().len();
            offset += raw.len();
            let line = raw.trim();
            if let Some(comment) = line.strip_prefix('%') {
                names = comment.split_whitespace().collect();
                place = span;
                continue;
            }
            if line.is_empty() {
                continue;
            }
            let value = |name: &str| -> Result<f64, Box<Fault>> {
                let text = names
                    .iter()
                    .position(|other| *other == name)
                    .and_then(|i| line.split_whitespace().nth(i));
                let text =
                    text.ok_or_else(|| fault(format!("a value of column {name} is missing"), &span))?;
                // Fortran writes 0.1D-03 as well.
                let number =
                    text.replace(['D', 'd'], "e").parse::<f64>().ok().filter(|number| number.is_finite());
                number.ok_or_else(|| fault(format!("`{name} = {text}`: must be a number"), &span))
            };
            if names.contains(&"MX") && names.contains(&"MY") {
                let read = Grid {
                    columns: 0,
                    rows: 0,
                    left: value("XL")?,
                    bottom: value("YL")?,
                    dx: value("DX")?,
                    dy: value("DY")?,
                    direction: value("CHI")?,
                };
                let (columns, rows) = (value("MX")?, value("MY")?);
                let read = checked(read, columns, rows, &span)?;
                traction = vec![[0.0; 2]; read.columns * read.rows];
                grid = Some(read);
            } else if names.contains(&"PN") && names.contains(&"PX") {
                let number = value("I")?;
                let element = (number >= 1.0 && number.fract() == 0.0)
                    .then(|| number as usize - 1)
                    .and_then(|i| traction.get_mut(i));
                let Some(element) = element else {
                    return Err(fault(format!("`I = {number}`: is not an element of the grid"), &span));
                };
                // The last line of a file that is cut off may still have these.
                if line.split_whitespace().count() < names.len() {
                    return Err(fault(format!("element {number} has fewer values than columns"), &span));
                }
                *element = [value("PN")?, value("PX")?];
            }
        }
        let Some(grid) = grid else {
            // It may be any file with a comment: nothing of it is shown.
            let missing = fault("no comment names MX and MY: the grid is missing".into(), &place);
            return Err(Box::new(Fault { span: None, ..*missing }));
        };
        Ok(Self { grid, traction, place })
    }
}

fn checked(grid: Grid, columns: f64, rows: f64, span: &Range<usize>) -> Result<Grid, Box<Fault>> {
    let whole = |count: f64| count >= 1.0 && count.fract() == 0.0;
    if !whole(columns) || !whole(rows) || columns * rows > MOST_ELEMENTS {
        return Err(fault(
            format!("`MX = {columns}`, `MY = {rows}`: must be integers, with at most 1e7 elements"),
            span,
        ));
    }
    let [x, y] = [grid.left + columns * grid.dx, grid.bottom + rows * grid.dy];
    let fits = [grid.left, grid.bottom, x, y].into_iter().all(|end| end.abs() <= FARTHEST);
    if !(grid.dx > 0.0 && grid.dy > 0.0 && fits) {
        let message = format!(
            "`DX = {}`, `DY = {}`: must be positive, and the grid within {FARTHEST} mm of its origin",
            grid.dx, grid.dy
        );
        return Err(fault(message, span));
    }
    if grid.direction.abs() > 1e-6 {
        let message = format!("`CHI = {}`: the wheel must roll along x", grid.direction);
        return Err(fault(message, span));
    }
    Ok(Grid { columns: columns as usize, rows: rows as usize, ..grid })
}

fn fault(message: String, span: &Range<usize>) -> Box<Fault> {
    let help = "expected a file <experiment>.<case>.mat of CONTACT, with its comments";
    Box::new(Fault { span: Some(span.clone()), ..Fault::new(message).help(help) })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Four by three elements of 1 by 2 mm.
    const FILE: &str = "\
%   MX    MY     XL            YL            DX            DY            CHI           DQ
      4    3     -2.00000      -3.00000       1.00000       2.00000       0.00000       1.00000
%    I    IGS    H   MU   PN   PX   PY   UN   UX   UY   SREL
      2    1      0.0  0.3  100.0  -10.0  1.0  0.0  0.0  0.0  0.0
      6    1      0.0  0.3  200.0  -60.0  2.0  0.0  0.0  0.0  0.0
      7    2      0.0  0.3  300.0  -90.0  2.0  0.0  0.0  0.0  0.0
";

    fn rows(text: &str, lateral: f64, travel: Travel) -> Result<Vec<[f64; 3]>, String> {
        let source = Source::new("c.mat", text);
        let rows = strip(&source, lateral, travel).map_err(|fault| fault.message)?;
        Ok(rows.into_iter().map(|row| [row.u, row.pressure, row.shear]).collect())
    }

    #[test]
    fn strips_of_rows_and_between_them() {
        assert!(is_contact_output(FILE) && !is_contact_output("u_mm,p_mpa\n"));
        // The row in the middle: elements 5 to 8, at x = −1.5 … 1.5.
        let middle = [[-1.5, 0.0, 0.0], [-0.5, 200.0, -60.0], [0.5, 300.0, -90.0], [1.5, 0.0, 0.0]];
        assert_eq!(rows(FILE, 0.0, Travel::Forward).unwrap(), middle);
        let half = [[-1.5, 0.0, 0.0], [-0.5, 150.0, -35.0], [0.5, 150.0, -45.0], [1.5, 0.0, 0.0]];
        assert_eq!(rows(FILE, -1.0, Travel::Forward).unwrap(), half);
        let back = [[-1.5, 0.0, 0.0], [-0.5, 300.0, 90.0], [0.5, 200.0, 60.0], [1.5, 0.0, 0.0]];
        assert_eq!(rows(FILE, 0.0, Travel::Backward).unwrap(), back);
        // The load of the strip is that of its elements.
        let load: f64 =
            middle.windows(2).map(|pair| 0.5 * (pair[0][1] + pair[1][1]) * (pair[1][0] - pair[0][0])).sum();
        assert_eq!(load, 500.0);
    }

    /// Elements of a Hertz contact with semi-axes of 5.6 and 4.6 elements, up to the number `last`.
    fn hertz(last: usize) -> String {
        let mut text = "% MX MY XL YL DX DY CHI\n12 10 -6 -5 1 1 0\n% I PN PX\n".to_owned();
        for i in 0..last {
            let (x, y) = ((i % 12) as f64 - 5.5, (i / 12) as f64 - 4.5);
            let inside = 1.0 - (x / 5.6).powi(2) - (y / 4.6).powi(2);
            if inside > 0.0 {
                text.push_str(&format!("{} {:.3} 0\n", i + 1, 900.0 * inside.sqrt()));
            }
        }
        text
    }

    #[test]
    fn a_file_that_ends_within_the_contact_is_refused() {
        assert!(rows(&hertz(120), 0.0, Travel::Forward).is_ok());
        // At the end of a row, and within one.
        for last in [72, 76, 79] {
            let says = rows(&hertz(last), 0.0, Travel::Forward).unwrap_err();
            assert!(says.starts_with("the contact is cut off at its largest y"), "{last}: {says}");
        }
        let says = rows(&format!("{FILE}      8    2 0.0 0.3 100\n"), 0.0, Travel::Forward).unwrap_err();
        assert_eq!(says, "element 8 has fewer values than columns");
    }

    #[test]
    fn refused_with_what_is_wrong() {
        let refused = |text: &str, lateral| rows(text, lateral, Travel::Forward).unwrap_err();
        assert!(refused(FILE, 2.5).contains("from y = -3 to 1 mm, but strip_mm = 2.5"));
        assert!(refused("% nothing\n", 0.0).contains("the grid is missing"));
        assert!(
            refused(&FILE.replace("      7    2", "     13    2"), 0.0)
                .contains("`I = 13`: is not an element")
        );
        assert!(
            refused(&FILE.replace("      7    2", "      0    2"), 0.0)
                .contains("`I = 0`: is not an element")
        );
        assert!(refused(&FILE.replace("300.0", "3OO.0"), 0.0).contains("`PN = 3OO.0`: must be a number"));
        assert!(
            refused(&FILE.replace("0.00000       1.00000\n", "3.14159       1.00000\n"), 0.0).contains("CHI")
        );
        // Elements whose places are not finite.
        for size in ["1e308", "-1.0", "inf"] {
            assert!(refused(&FILE.replacen("1.00000", size, 9), 0.0).contains("must be"), "{size}");
        }
        assert!(refused(&FILE.replace("      4    3", "      0    3"), 0.0).contains("MX = 0"));
    }
}
