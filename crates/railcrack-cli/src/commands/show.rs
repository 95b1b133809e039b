//! `railcrack show`.

use crate::exit::{Exit, Failure};
use crate::print;
use clap::Args;
use railcrack_report::FolderKind;
use railcrack_run::csv::{line_field, line_fields};
use railcrack_run::simulation::RunError;
use std::path::{Path, PathBuf};

/// Print a table of results, or some of its columns
///
/// The folder is that of a run, a plastic state, a comparison, grinding plans or a study. Without
/// --table its main table is printed: growth, profile, compare, plan or summary. Numbers have six
/// significant digits, with --exact all digits.
#[derive(Debug, Args)]
pub struct ShowArguments {
    /// Folder of results
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Table: growth, sif, faces, residual, summary, times, … [default: the main table]
    #[arg(long, value_name = "NAME")]
    table: Option<String>,
    /// Columns, separated by commas, in the order of the output [default: all]
    #[arg(long, value_name = "COLUMN,…", value_delimiter = ',')]
    columns: Vec<String>,
    /// Print only the last N rows
    #[arg(long, value_name = "N")]
    last: Option<usize>,
    /// Print all digits as comma-separated values, for other programs
    #[arg(long)]
    exact: bool,
}

/// Prints the table.
pub fn show(arguments: &ShowArguments) -> Result<Exit, Failure> {
    let folder = &arguments.folder;
    let name = match &arguments.table {
        Some(name) => name.strip_suffix(".csv").unwrap_or(name).to_owned(),
        None => main_table(folder)?.to_owned(),
    };
    let path = folder.join(format!("{name}.csv"));
    if name.contains(['/', '\\']) || !path.is_file() {
        let there = tables(folder).join(", ");
        return Err(Failure::Show(format!(
            "{} has no table `{name}`: the tables are {there}",
            folder.display()
        )));
    }
    let text = std::fs::read_to_string(&path).map_err(|reason| RunError::System {
        action: format!("read {}", path.display()),
        reason: reason.to_string(),
    })?;
    let mut lines = text.lines().filter(|line| !line.starts_with('#')).map(line_fields);
    let headings = lines.next().unwrap_or_default();
    let chosen = chosen(&headings, &arguments.columns)?;
    let mut rows: Vec<Vec<String>> = lines.map(|row| picked(&row, &chosen)).collect();
    rows.drain(..rows.len().saturating_sub(arguments.last.unwrap_or(usize::MAX)));
    let headings = picked(&headings, &chosen);
    let text = if arguments.exact { exact(&headings, &rows) } else { aligned(&headings, &rows) };
    print::stdout(&text)?;
    Ok(Exit::Done)
}

fn main_table(folder: &Path) -> Result<&'static str, Failure> {
    Ok(match FolderKind::of(folder).map_err(RunError::from)? {
        FolderKind::Run => "growth",
        FolderKind::Shakedown => "profile",
        FolderKind::Plan => "plan",
        FolderKind::Comparison => "compare",
        FolderKind::Study => "summary",
    })
}

/// The names of the tables in `folder`.
fn tables(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut names: Vec<String> = entries
        .filter_map(|entry| entry.file_name().to_str()?.strip_suffix(".csv").map(str::to_owned))
        .collect();
    names.sort();
    if names.is_empty() { vec!["none".to_owned()] } else { names }
}

/// Indices of the requested columns; all if none is named. A key of a study is named with its
/// section, or without it if that is unambiguous.
fn chosen(headings: &[String], wanted: &[String]) -> Result<Vec<usize>, Failure> {
    if wanted.is_empty() {
        return Ok((0..headings.len()).collect());
    }
    let refused = |name: &str, there: &[String]| {
        Failure::Show(format!("no column `{name}`: the columns are {}", there.join(", ")))
    };
    let place = |name: &String| {
        let name = name.trim();
        if let Some(place) = headings.iter().position(|heading| heading == name) {
            return Ok(place);
        }
        let is_it = |heading: &String| heading.rsplit_once('.').is_some_and(|(_, key)| key == name);
        let all: Vec<usize> = (0..headings.len()).filter(|&place| is_it(&headings[place])).collect();
        match all[..] {
            [place] => Ok(place),
            [] => Err(refused(name, headings)),
            _ => Err(refused(name, &picked(headings, &all))),
        }
    };
    wanted.iter().map(place).collect()
}

fn picked(row: &[String], chosen: &[usize]) -> Vec<String> {
    chosen.iter().map(|&place| row.get(place).cloned().unwrap_or_default()).collect()
}

fn exact(headings: &[String], rows: &[Vec<String>]) -> String {
    let line =
        |row: &[String]| row.iter().map(|field| line_field(field)).collect::<Vec<_>>().join(",") + "\n";
    std::iter::once(line(headings)).chain(rows.iter().map(|row| line(row))).collect()
}

/// Columns with their headings: numbers aligned to the right, words to the left.
fn aligned(headings: &[String], rows: &[Vec<String>]) -> String {
    let shown: Vec<Vec<String>> =
        rows.iter().map(|row| row.iter().map(|field| short(field)).collect()).collect();
    let column = |place: usize| shown.iter().map(move |row| row[place].as_str());
    let is_number = |field: &str| field.is_empty() || field.parse::<f64>().is_ok();
    let numeric: Vec<bool> = (0..headings.len()).map(|place| column(place).all(is_number)).collect();
    let length = |field: &str| field.chars().count();
    let widths: Vec<usize> = (0..headings.len())
        .map(|place| column(place).map(length).chain([length(&headings[place])]).max().unwrap_or(0))
        .collect();
    let line = |row: &[String]| {
        let cells = row.iter().zip(&widths).zip(&numeric).map(|((field, width), numeric)| {
            let gap = " ".repeat(width - length(field));
            if *numeric { gap + field } else { field.clone() + &gap }
        });
        cells.collect::<Vec<_>>().join("  ").trim_end().to_owned() + "\n"
    };
    std::iter::once(line(headings)).chain(shown.iter().map(|row| line(row))).collect()
}

/// Formats numbers with six significant digits and leaves other text unchanged.
fn short(field: &str) -> String {
    let is_whole = field.bytes().all(|byte| byte.is_ascii_digit() || byte == b'-');
    let Some(value) = field.parse::<f64>().ok().filter(|value| value.is_finite() && !is_whole) else {
        return field.to_owned();
    };
    let magnitude = if value == 0.0 { 0 } else { value.abs().log10().floor() as i32 };
    if !(-4..9).contains(&magnitude) {
        return format!("{value:.5e}");
    }
    let text = format!("{value:.*}", (5 - magnitude).max(0) as usize);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_aligned() {
        let shown =
            ["1234567", "0.1234567", "-2.5e-12", "3.0", "8312778.4", "arrest", "", "1.5e12"].map(short);
        assert_eq!(
            shown,
            ["1234567", "0.123457", "-2.50000e-12", "3", "8312778", "arrest", "", "1.50000e12"]
        );
        let row = |fields: [&str; 2]| fields.map(str::to_owned).to_vec();
        let text = aligned(&row(["length_mm", "stop"]), &[row(["6.25", "arrest"]), row(["", ""])]);
        assert_eq!(text, "length_mm  stop\n     6.25  arrest\n\n");
    }

    #[test]
    fn a_key_is_found_without_its_section_where_that_is_clear() {
        let headings = ["run", "contact.friction", "crack[1].friction", "crack[1].angle_deg"];
        let headings = headings.map(str::to_owned);
        let of = |names: &[&str]| {
            chosen(&headings, &names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>())
        };
        assert_eq!(of(&["angle_deg", "run", "contact.friction"]).ok(), Some(vec![3, 0, 1]));
        let told = |names: &[&str]| match of(names) {
            Err(Failure::Show(told)) => told,
            _ => String::new(),
        };
        assert!(told(&["friction"]).ends_with("the columns are contact.friction, crack[1].friction"));
        assert!(told(&["angle"]).contains("the columns are run, contact.friction"));
    }
}
