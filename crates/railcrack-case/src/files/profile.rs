//! Stress profiles in CSV files.

use super::companion::{ProfileFile, RELATIVE};
use crate::schema::{Fault, KeyRow, Report, SectionValues, Source, nearest, read_text};
use railcrack::field::{DepthProfile, ProfileError};
use std::ops::Range;
use std::path::Path;

/// Columns that are read.
const COLUMNS: [&str; 3] = ["depth_mm", "sxx_mpa", "szz_mpa"];

/// Columns of our own result files that say nothing new about a balanced profile.
const IGNORED: [&str; 6] = ["ep_xx", "ep_yy", "ep_zz", "ep_xy", "plastic_per_pass", "dang_van_mpa"];

/// Columns of our own result files that must vanish: a balanced profile has no such stress.
const VANISHING: [&str; 2] = ["syy_mpa", "sxy_mpa"];

/// A stress that counts as zero, relative to the largest stress of the file: round-off and
/// truncation of a computed profile, far below the scatter of a measured one.
const VANISHED: f64 = 0.01;

/// No residual stress of steel is larger than this, MPa: beyond, a unit is wrong.
const LARGEST: f64 = 1e4;

/// The profile in the file that a key names, relative to `folder`; none where it names none or it
/// cannot be read, which `report` then says.
pub(crate) fn read_profile(
    section: &SectionValues,
    row: KeyRow<String>,
    folder: &Path,
    report: &mut Report,
) -> Option<ProfileFile> {
    let given = section.get(row)?;
    let path = folder.join(&given);
    let key = || Some(section.dotted(row.key.name));
    match read_text(&path, &path.display().to_string()) {
        Ok(source) => match parse(&source) {
            Ok(profile) => {
                let text = source.text.to_string();
                return Some(ProfileFile::new(row, given, text, profile));
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

/// A line that is neither empty nor a comment, with its place in the file.
struct Line<'a> {
    text: &'a str,
    span: Range<usize>,
}

fn parse(source: &Source) -> Result<DepthProfile, Box<Fault>> {
    let mut offset = 0;
    let mut lines = Vec::new();
    for raw in source.text.split_inclusive('\n') {
        let text = raw.trim_end_matches(['\n', '\r']);
        let text = if offset == 0 { text.trim_start_matches('\u{feff}') } else { text };
        if !text.trim().is_empty() && !text.trim_start().starts_with('#') {
            lines.push(Line { text, span: offset..offset + raw.trim_end().len() });
        }
        offset += raw.len();
    }
    let Some((header, rows)) = lines.split_first() else {
        return Err(fault("the profile is empty".into(), &(0..0)));
    };
    let columns = read_header(header)?;
    let mut table = Vec::with_capacity(rows.len());
    for row in rows {
        table.push(read_row(row, &columns)?);
    }
    check_vanishing(&columns, &table, rows)?;
    let column = |name: &str| columns.iter().position(|c| *c == name);
    let value = |row: &[f64], name: &str| column(name).and_then(|i| row.get(i).copied()).unwrap_or(0.0);
    let values =
        table.iter().map(|r| (value(r, COLUMNS[0]), value(r, COLUMNS[1]), value(r, COLUMNS[2]))).collect();
    DepthProfile::new(values).map_err(|error| {
        let row = match error {
            ProfileError::Empty => return fault(error.to_string(), &header.span),
            ProfileError::NotFinite { row, .. }
            | ProfileError::NegativeDepth { row, .. }
            | ProfileError::NotIncreasing { row, .. } => row,
        };
        let span = row.checked_sub(1).and_then(|i| rows.get(i)).map_or(&header.span, |r| &r.span);
        fault(error.to_string(), span)
    })
}

fn fault(message: String, span: &Range<usize>) -> Box<Fault> {
    let [depth, sxx, szz] = COLUMNS;
    let help =
        format!("a profile begins with the header {depth},{sxx}[,{szz}] and has a row per depth, downwards");
    Box::new(Fault { span: Some(span.clone()), ..Fault::new(message).help(help) })
}

fn read_header<'a>(header: &Line<'a>) -> Result<Vec<&'a str>, Box<Fault>> {
    let columns: Vec<&str> = header.text.split(',').map(str::trim).collect();
    for (i, name) in columns.iter().enumerate() {
        if columns[..i].contains(name) {
            return Err(fault(format!("column `{name}` is given twice"), &header.span));
        }
        if !COLUMNS.contains(name) && !IGNORED.contains(name) && !VANISHING.contains(name) {
            let near = nearest(name, COLUMNS).unwrap_or_default();
            return Err(fault(
                format!("unknown column `{name}`; nearest known column: `{near}`"),
                &header.span,
            ));
        }
    }
    for needed in &COLUMNS[..2] {
        if !columns.contains(needed) {
            return Err(fault(format!("column `{needed}` is missing"), &header.span));
        }
    }
    Ok(columns)
}

fn read_row(row: &Line, columns: &[&str]) -> Result<Vec<f64>, Box<Fault>> {
    let fields: Vec<&str> = row.text.split(',').map(str::trim).collect();
    if fields.len() != columns.len() {
        let message = format!("{} values in a row of {} columns", fields.len(), columns.len());
        return Err(fault(message, &row.span));
    }
    let mut values = Vec::with_capacity(fields.len());
    for (name, field) in columns.iter().zip(fields) {
        match field.parse::<f64>() {
            Ok(value) if value.is_finite() && value.abs() <= LARGEST => values.push(value),
            _ if IGNORED.contains(name) => values.push(0.0),
            _ => {
                let message = format!("`{name} = {field}`: must be a number in [-1e4, 1e4]");
                return Err(fault(message, &row.span));
            }
        }
    }
    Ok(values)
}

fn check_vanishing(columns: &[&str], table: &[Vec<f64>], rows: &[Line]) -> Result<(), Box<Fault>> {
    let stress = |name: &str| name.ends_with("_mpa") && !IGNORED.contains(&name);
    let mut largest: f64 = 0.0;
    for row in table {
        for (name, value) in columns.iter().zip(row) {
            if stress(name) {
                largest = largest.max(value.abs());
            }
        }
    }
    for (values, row) in table.iter().zip(rows) {
        for (name, value) in columns.iter().zip(values) {
            if VANISHING.contains(name) && value.abs() > VANISHED * largest {
                let message = format!("`{name} = {value}`: must be zero in a balanced profile");
                return Err(fault(message, &row.span));
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(text: &str) -> Result<Vec<(f64, f64, f64)>, String> {
        let source = Source { name: "p.csv".into(), text: text.into() };
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
    fn a_profile_with_shear_is_not_balanced() {
        let error = parsed("depth_mm,sxx_mpa,sxy_mpa\n0,25,1\n").unwrap_err();
        assert!(error.contains("`sxy_mpa = 1`"), "{error}");
    }
}
