//! Points of profiles in files without a header of columns: two columns with comments, and the
//! files of MiniProf.

use crate::schema::Source;
use std::ops::Range;

/// Whose profile it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Profiled {
    Rail,
    Wheel,
}

/// The points of a profile and where they stand.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct GivenPoints {
    /// (y, z) in the order of the file, mm.
    pub points: Vec<[f64; 2]>,
    pub spans: Vec<Range<usize>>,
}

/// Signs before a comment.
const COMMENTS: [char; 4] = ['!', '%', '#', '"'];

/// A line without its comment, and its bytes in the file.
pub(super) fn lines(source: &Source) -> impl Iterator<Item = (&str, Range<usize>)> {
    let mut end = 0;
    source.text.split_inclusive('\n').map(move |line| {
        let start = end;
        end += line.len();
        let text = line.trim_start_matches('\u{feff}');
        let text = text.split(COMMENTS).next().unwrap_or_default();
        // Two strokes, and the star of a list, begin comments too.
        let text = text.split("//").next().unwrap_or_default().trim();
        let text = if text.starts_with('*') { "" } else { text };
        (text, start..start + line.trim_end().len())
    })
}

/// The numbers of a line, separated by spaces, tabs, semicolons or commas, with a decimal comma
/// where something else separates them; none where one is no number.
pub(super) fn numbers(line: &str) -> Option<Vec<f64>> {
    let spaced: Vec<&str> = line.split([' ', '\t', ';']).filter(|part| !part.is_empty()).collect();
    let parts = if spaced.len() > 1 { spaced } else { line.split(',').collect() };
    let number = |part: &str| {
        // Fortran writes 0.1D-03 as well.
        let text = part.trim_matches([',', ' ']).replace(['D', 'd'], "e");
        let is_decimal = text.matches(',').count() == 1 && !text.contains('.');
        let text = if is_decimal { text.replace(',', ".") } else { text };
        text.parse::<f64>().ok().filter(|number| number.is_finite())
    };
    parts.into_iter().map(number).collect()
}

/// Keyword and value of a line of a header.
pub(super) fn keyword(line: &str) -> Option<(&str, &str)> {
    let (name, value) = line.split_once('=')?;
    Some((name.trim(), value.trim()))
}

/// Whether the file is one of MiniProf: it begins with keywords, or with the name of an older kind.
pub(super) fn is_miniprof(source: &Source) -> bool {
    let Some((first, _)) = lines(source).find(|(line, _)| !line.is_empty()) else { return false };
    let is_name = |name: &str| !name.is_empty() && name.chars().all(|letter| letter.is_alphanumeric());
    first.contains("MINIPROF")
        || first.starts_with('[')
        || keyword(first).is_some_and(|(name, _)| is_name(name))
}

/// Whether the file has two columns of numbers or more, and nothing but comments and a line of
/// names y and z above them.
pub(super) fn is_columns(source: &Source) -> bool {
    let mut rows = lines(source).map(|(line, _)| line).filter(|line| !line.is_empty());
    let is_row = |line: &str| numbers(line).is_some_and(|row| row.len() > 1);
    match rows.next() {
        Some(first) if is_names(first) => rows.next().is_some_and(is_row),
        first => first.is_some_and(is_row),
    }
}

/// Whether a line names the two axes: `y z`, `Y [mm]; Z [mm]`, `x, y`.
fn is_names(line: &str) -> bool {
    let line = line.to_lowercase().replace("[mm]", " ").replace("(mm)", " ");
    let names: Vec<&str> = line.split([' ', '\t', ';', ',']).filter(|name| !name.is_empty()).collect();
    matches!(names[..], ["x", "y"] | ["x", "z"] | ["y", "z"])
}

/// The points of a file in two columns, or of MiniProf, whose `ColumnDef` names the columns: its X
/// and Y are y and z here.
///
/// Errors: a line below the first row has no two numbers, at its place.
pub(super) fn read_columns(source: &Source) -> Result<GivenPoints, (String, Range<usize>)> {
    let mut read = GivenPoints::default();
    let mut columns = [0, 1];
    for (line, span) in lines(source) {
        if let Some((name, value)) = keyword(line) {
            if name.eq_ignore_ascii_case("ColumnDef") {
                columns = named_columns(value)
                    .ok_or_else(|| (format!("`ColumnDef = {value}`: must name X and Y"), span))?;
            }
            continue;
        }
        let is_heading = read.points.is_empty() && numbers(line).is_none_or(|row| row.len() < 2);
        if line.is_empty() || line.starts_with('[') || is_heading {
            continue;
        }
        let row = numbers(line).and_then(|row| Some([*row.get(columns[0])?, *row.get(columns[1])?]));
        let Some(point) = row else {
            return Err((format!("row {}: y and z must be numbers", read.points.len() + 1), span));
        };
        read.points.push(point);
        read.spans.push(span);
    }
    Ok(read)
}

/// The places of X and Y among the columns of MiniProf.
fn named_columns(value: &str) -> Option<[usize; 2]> {
    let place = |name: &str| value.split(',').position(|column| column.trim() == name);
    Some([place("X")?, place("Y")?])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(text: &str) -> Vec<[f64; 2]> {
        read_columns(&Source::new("p", text)).unwrap().points
    }

    #[test]
    fn two_columns_as_they_are_written() {
        let want = [[-30.0, 2.5], [-29.0, 2.25]];
        for text in [
            "! rail\n-30.0 2.5\n-29.0 2.25 ! a point\n",
            "% y z\n  -30\t2.5\t1.0\r\n\r\n  -29\t2.25\t1.0\r\n",
            "# y;z\n-30,0;2,5\n-29,0;2,25\n",
            "y [mm]; z [mm]\n-30;2,5\n-29;2,25\n",
            "\u{feff}-30,2.5\n-29,2.25\n",
            "\"-99 1\n-3.0E+01 2.5\n-2.9D+01, 2.25\n",
        ] {
            let source = Source::new("p", text);
            assert!(is_columns(&source) && !is_miniprof(&source), "{text}");
            assert_eq!(points(text), want, "{text}");
        }
        assert!(!is_columns(&Source::new("p", "y_mm,z_mm\n-30,2.5\n")));
        assert!(!is_columns(&Source::new("p", "root:x:0\n")));
        let (says, span) = read_columns(&Source::new("p", "1 2\n3 x\n")).unwrap_err();
        assert_eq!((says.as_str(), span), ("row 2: y and z must be numbers", 4..7));
    }

    #[test]
    fn files_of_miniprof() {
        let text =
            "FileName=a.ban\nXYPoints=2\nColumnDef=A,X,Y\n\n0.1 -30.0 2.5\n\" 0.1 0 0\n0.1 -29.0 2.25\n";
        assert!(is_miniprof(&Source::new("p", text)));
        assert_eq!(points(text), [[-30.0, 2.5], [-29.0, 2.25]]);
        assert!(read_columns(&Source::new("p", "ColumnDef=X,A\n\n1 2\n")).is_err());
        let parts = "[FileInfo]\nXYPoints=1\n[Profile1Points]\n-30.0 2.5\n[Profile2Points]\n-29.0 2.25\n";
        assert!(is_miniprof(&Source::new("p", parts)));
        assert_eq!(points(parts).len(), 2);
    }
}
