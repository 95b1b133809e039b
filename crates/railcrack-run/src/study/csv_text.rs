//! Tables of a study as text: their rows appended to Parquet files, and the stabilised passages
//! among them.

use crate::csv::line_fields;
use crate::parquet::{ColumnKind, ParquetFile};
use std::collections::HashMap;

/// Appends the rows of the CSV table `text`, preceded by the values `before` of the first columns;
/// a column that the text does not have stays empty.
pub(super) fn append(file: &mut ParquetFile, before: &[&str], text: &str) {
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let names = lines.next().map(line_fields).unwrap_or_default();
    let own = file.columns().iter().skip(before.len());
    let places: Vec<Option<usize>> =
        own.map(|(name, _)| names.iter().position(|other| other == name)).collect();
    for line in lines {
        let row = line_fields(line);
        let own = places.iter().map(|place| place.and_then(|at| row.get(at)).map_or("", String::as_str));
        file.row(before.iter().copied().chain(own));
    }
}

/// The kind of a column of results by its name: counts and names are not measured numbers.
pub(super) fn kind_of(column: &str) -> ColumnKind {
    match column {
        "run" | "step" | "steps" | "passage" | "passages" | "crack" | "tip" | "position" | "wheel"
        | "segment" | "warnings" | "failure_crack" => ColumnKind::Integer,
        "folder" | "state" | "stop" | "status" | "reason" | "verdict" | "reasons" | "failure" => {
            ColumnKind::Text
        }
        _ => ColumnKind::Number,
    }
}

/// The rows of the stabilised passage of each step (and of each wheel, where there are several) of
/// the table `text`: the last passage.
pub(super) fn stabilised(text: &str) -> String {
    let mut lines = text.split_inclusive('\n');
    let mut kept = String::new();
    let mut header: Vec<&str> = Vec::new();
    for line in lines.by_ref() {
        kept.push_str(line);
        if !line.starts_with('#') {
            header = line.trim_end().split(',').collect();
            break;
        }
    }
    let place = |name: &str| header.iter().position(|column| *column == name);
    let (step, passage, wheel) = (place("step"), place("passage"), place("wheel"));
    let rows: Vec<(&str, [&str; 2], usize)> = lines
        .map(|line| {
            let field =
                |at: Option<usize>| at.and_then(|at| line.trim_end().split(',').nth(at)).unwrap_or_default();
            (line, [field(step), field(wheel)], field(passage).parse().unwrap_or(0))
        })
        .collect();
    let mut last: HashMap<[&str; 2], usize> = HashMap::new();
    for (_, of, passage) in &rows {
        let most = last.entry(*of).or_default();
        *most = (*most).max(*passage);
    }
    let is_last = |(_, of, passage): &&(&str, [&str; 2], usize)| last.get(of) == Some(passage);
    rows.iter().filter(is_last).for_each(|(line, _, _)| kept.push_str(line));
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_passage_of_a_step_is_kept() {
        let text = "# c\nstep,passage,ki\n0,1,a\n0,2,b\n1,1,c\n2,1,d\n2,2,e\n2,2,f\n";
        assert_eq!(stabilised(text), "# c\nstep,passage,ki\n0,2,b\n1,1,c\n2,2,e\n2,2,f\n");
        let mix = "step,passage,ki,wheel\n0,1,a,1\n0,2,b,1\n0,1,c,2\n";
        assert_eq!(stabilised(mix), "step,passage,ki,wheel\n0,2,b,1\n0,1,c,2\n");
    }
}
