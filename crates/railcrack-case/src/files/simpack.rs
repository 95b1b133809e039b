//! Profiles of the multibody program Simpack, `.prr` and `.prw`, which rolling-contact programs
//! read and write too.
//!
//! Two sections, header and spline, each between `.begin` and `.end`, with `name = value` and
//! comments after !; within the second one the points y, z (and a weight) between `point.begin` and
//! `point.end`. The points are shifted, rotated, cut and mirrored as the section says, in the order
//! of its numbered comments; y points to the right in the direction of travel and z downwards.
//! Source: `read_simpack` of the rolling-contact program CONTACT.

use super::point_lines::{GivenPoints, Profiled, keyword, numbers};
use crate::schema::Source;
use std::collections::HashMap;
use std::ops::Range;

/// A file of Simpack: of what, and its points as it says they are to be used.
#[derive(Debug)]
pub(super) struct Simpack {
    pub is: Option<Profiled>,
    pub given: GivenPoints,
}

/// Whether the file is one of Simpack.
pub(super) fn is_simpack(source: &Source) -> bool {
    let begins = |line: &str| line.starts_with("header.begin") || line.starts_with("spline.begin");
    source.text.lines().any(|line| begins(line.trim_start_matches('\u{feff}').trim()))
}

/// The file `source`.
///
/// Errors: a value or a point that is no number, at its place.
pub(super) fn read_simpack(source: &Source) -> Result<Simpack, (String, Range<usize>)> {
    let mut options: HashMap<String, f64> = HashMap::new();
    let (mut given, mut section, mut is) = (GivenPoints::default(), String::new(), None);
    let mut end = 0;
    for raw in source.text.split_inclusive('\n') {
        let span = end..end + raw.trim_end().len();
        end += raw.len();
        let line = without_comment(raw.trim_start_matches('\u{feff}')).trim();
        if let Some((name, part)) = line.split_once('.').filter(|(_, part)| matches!(*part, "begin" | "end"))
        {
            let inner = if part == "begin" {
                name
            } else if name == "point" {
                "spline"
            } else {
                ""
            };
            inner.clone_into(&mut section);
        } else if let Some((name, value)) = keyword(line) {
            let value = value.parse::<f64>().ok();
            match (section.as_str(), value) {
                ("header", Some(value)) if name == "type" => {
                    is = Some(if value == 0.0 { Profiled::Rail } else { Profiled::Wheel });
                }
                ("spline", Some(value)) => drop(options.insert(name.to_owned(), value)),
                ("spline", None) if OPTIONS.contains(&name) => {
                    return Err((format!("`{name}`: must be a number"), span));
                }
                _ => (),
            }
        } else if section == "point" && !line.is_empty() {
            let row = numbers(line).and_then(|row| Some([*row.first()?, *row.get(1)?]));
            let row = row.ok_or_else(|| {
                (format!("point {}: must be y and z", given.points.len() + 1), span.clone())
            })?;
            given.points.push(row);
            given.spans.push(span);
        }
    }
    Ok(Simpack { is, given: used(&given, &options) })
}

/// Numbers of the section that change the points.
const OPTIONS: [&str; 12] = [
    "shift.y",
    "shift.z",
    "rotate",
    "bound.y.min",
    "bound.y.max",
    "bound.z.min",
    "bound.z.max",
    "mirror.y",
    "mirror.z",
    "inversion",
    "units.len.f",
    "units.ang.f",
];

/// A line up to the first ! outside of quotes.
fn without_comment(line: &str) -> &str {
    let mut is_quoted = false;
    let end = line.char_indices().find(|(_, letter)| {
        is_quoted ^= *letter == '\'';
        *letter == '!' && !is_quoted
    });
    end.map_or(line, |(at, _)| &line[..at])
}

/// The points as they are to be used, mm.
fn used(given: &GivenPoints, options: &HashMap<String, f64>) -> GivenPoints {
    let of = |name: &str| options.get(name).copied();
    let is_on = |name: &str| of(name) == Some(1.0);
    // Bounds count where they are in order.
    let bounds = |low: &str, high: &str| of(low).zip(of(high)).filter(|(low, high)| low < high);
    let (sin, cos) = (of("rotate").unwrap_or(0.0) / of("units.ang.f").unwrap_or(1.0)).sin_cos();
    let scale = of("units.len.f").filter(|units| *units > 0.0).map_or(1.0, |units| 1e3 / units);
    let mut read = GivenPoints::default();
    for (&[y, z], span) in given.points.iter().zip(&given.spans) {
        let (y, z) = (y + of("shift.y").unwrap_or(0.0), z + of("shift.z").unwrap_or(0.0));
        let (y, mut z) = (y * cos - z * sin, y * sin + z * cos);
        if bounds("bound.y.min", "bound.y.max").is_some_and(|(low, high)| !(low..=high).contains(&y)) {
            continue;
        }
        if let Some((low, high)) = bounds("bound.z.min", "bound.z.max") {
            z = z.clamp(low, high);
        }
        let y = if is_on("mirror.y") { -y } else { y };
        let z = if is_on("mirror.z") { -z } else { z };
        read.points.push([scale * y, scale * z]);
        read.spans.push(span.clone());
    }
    if is_on("inversion") {
        read.points.reverse();
        read.spans.reverse();
    }
    read
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(options: &str, points: &str) -> String {
        format!(
            "! profile\n  header.begin\n version = 1 ! Version\n type = 1 ! 1=wheel\n header.end\n spline.begin\n \
             comment = 'as new! '\n{options}    point.begin\n    ! y z weight\n{points}    point.end\n  spline.end\n"
        )
    }

    fn read(options: &str, points: &str) -> Vec<[f64; 2]> {
        let text = file(options, points);
        let source = Source::new("w.prw", &text);
        assert!(is_simpack(&source));
        let read = read_simpack(&source).unwrap();
        assert_eq!(read.is, Some(Profiled::Wheel));
        read.given.points
    }

    #[test]
    fn points_are_changed_as_the_file_says() {
        let points = "-1.0\t2.0\n3.0 4.0 1.0 ! last\n";
        assert_eq!(read("", points), [[-1.0, 2.0], [3.0, 4.0]]);
        assert_eq!(read("units.len.f = +1.0e+00\n", points), [[-1e3, 2e3], [3e3, 4e3]]);
        assert_eq!(read("mirror.y = 1\nmirror.z = 0\n", points), [[1.0, 2.0], [-3.0, 4.0]]);
        assert_eq!(read("mirror.z = 1\ninversion = 1\n", points), [[3.0, -4.0], [-1.0, -2.0]]);
        assert_eq!(read("shift.y = 1\nbound.y.min = 0\nbound.y.max = 3\n", points), [[0.0, 2.0]]);
        // Bounds out of order are none.
        assert_eq!(read("bound.y.min = 1\nbound.y.max = 0\n", points).len(), 2);
        assert_eq!(read("bound.z.min = 0\nbound.z.max = 3\n", points)[1], [3.0, 3.0]);
        let [turned, _] = read("rotate = 90\nunits.ang.f = 57.29577951308232\n", points)[..] else {
            panic!()
        };
        assert!((turned[0] + 2.0).abs() < 1e-12 && (turned[1] + 1.0).abs() < 1e-12, "{turned:?}");
    }

    #[test]
    fn refused_at_their_place() {
        let refused = |options: &str, points: &str| {
            let text = file(options, points);
            let (says, span) = read_simpack(&Source::new("w.prw", &text)).unwrap_err();
            (says, text[span].trim().to_owned())
        };
        assert_eq!(refused("", "1 x\n"), ("point 1: must be y and z".to_owned(), "1 x".to_owned()));
        assert_eq!(refused("mirror.y = on\n", "1 2\n").0, "`mirror.y`: must be a number");
    }
}
