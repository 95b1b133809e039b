//! Tables of a page.

use crate::html::{escaped, typeset, typeset_in_parts};
use crate::markup::plain;
use std::fmt::Write;

/// The ground of a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CellTone {
    /// That of the page.
    #[default]
    Plain,
    /// A statement that holds.
    Holds,
    /// A statement that does not hold.
    Fails,
    /// A statement that is not known to hold.
    Doubtful,
}

/// A cell of a table. Its text is plain; `K_{I}` sets an index.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Cell {
    /// Its text.
    pub text: String,
    /// Where it leads: a path from the folder of the page, with `/`; empty for nowhere.
    pub link: String,
    /// Its ground; the text says the same without colour.
    pub tone: CellTone,
}

impl<T: Into<String>> From<T> for Cell {
    fn from(text: T) -> Self {
        Self { text: text.into(), ..Self::default() }
    }
}

impl Cell {
    /// A cell that leads to the file at `link`.
    pub fn linked(text: &str, link: &str) -> Self {
        Self { text: text.to_owned(), link: link.to_owned(), ..Self::default() }
    }

    /// A cell on a ground of its own.
    pub fn toned(text: &str, tone: CellTone) -> Self {
        Self { text: text.to_owned(), tone, ..Self::default() }
    }
}

/// Name and choices of a row, for switches and pointer.
#[derive(Debug, Clone, PartialEq)]
struct RowMark {
    name: String,
    choices: Vec<usize>,
}

/// A table of a page. Headings and cells are plain text; `K_{I}` sets an index.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    /// A sentence above the table; empty for none.
    pub caption: String,
    /// Column headings with units.
    pub headings: Vec<String>,
    /// Rows; a row shorter than the headings leaves cells empty.
    pub rows: Vec<Vec<Cell>>,
    /// Whether its headings sort it, by what a click or a key on them says.
    sorts: bool,
    /// Marks of the first rows; rows without are always shown.
    marks: Vec<RowMark>,
}

impl Table {
    /// A table without rows.
    pub fn new(headings: impl IntoIterator<Item = impl Into<String>>) -> Self {
        Self { headings: headings.into_iter().map(Into::into).collect(), ..Self::default() }
    }

    /// The table with headings that sort it.
    #[must_use]
    pub fn sortable(self) -> Self {
        Self { sorts: true, ..self }
    }

    /// The table without columns in which every number is missing.
    #[must_use]
    pub fn without_empty_columns(mut self) -> Self {
        let is_empty = |column: &usize| {
            let mut cells = self.rows.iter().filter_map(|row| row.get(*column)).peekable();
            cells.peek().is_some() && cells.all(|cell| cell.text == MISSING)
        };
        let empty: Vec<usize> = (0..self.headings.len()).filter(is_empty).collect();
        for column in empty.into_iter().rev() {
            self.headings.remove(column);
            self.rows.iter_mut().for_each(|row| drop(row.remove(column)));
        }
        self
    }

    /// Appends a row of cells, one for each heading.
    pub fn row(&mut self, cells: impl IntoIterator<Item = impl Into<Cell>>) {
        self.rows.push(cells.into_iter().map(Into::into).collect());
    }

    /// Appends a row that stands for the curves called `name`, and is shown where `choices` are
    /// chosen. Rows of this kind come first.
    pub fn row_of(
        &mut self,
        name: &str,
        choices: &[usize],
        cells: impl IntoIterator<Item = impl Into<Cell>>,
    ) {
        self.marks.push(RowMark { name: name.to_owned(), choices: choices.to_vec() });
        self.row(cells);
    }

    /// Appends the table to `page`. The first cell of a row names it.
    pub(super) fn write(&self, page: &mut String) {
        // The caption is not scrolled with the table. Writing to a string does not fail.
        page.push_str("<div class=\"table\">");
        let class = if self.sorts { " class=\"sorts\"" } else { "" };
        let _ = if self.caption.is_empty() {
            write!(page, "<div class=\"wide\"><table{class}>\n<thead><tr>")
        } else {
            let (caption, label) = (typeset(&self.caption), escaped(&plain(&self.caption)));
            let table = format!("<div class=\"wide\"><table{class} aria-label=\"{label}\">");
            write!(page, "<p class=\"caption\">{caption}</p>\n{table}\n<thead><tr>")
        };
        let short: Vec<bool> = (0..self.headings.len()).map(|column| self.is_short(column)).collect();
        for (column, heading) in self.headings.iter().enumerate() {
            // A heading stands above its numbers.
            let mut cells =
                self.rows.iter().filter_map(|row| row.get(column)).filter(|cell| !cell.text.is_empty());
            let is_numbers =
                column > 0 && cells.clone().next().is_some() && cells.all(|cell| is_number(&cell.text));
            let class = if is_numbers { " class=\"number\"" } else { "" };
            let _ = write!(page, "<th scope=\"col\"{class}>{}</th>", typeset_in_parts(heading));
        }
        page.push_str("</tr></thead>\n<tbody>\n");
        for (place, row) in self.rows.iter().enumerate() {
            match self.marks.get(place) {
                Some(RowMark { name, choices }) => {
                    let choices: Vec<String> = choices.iter().map(usize::to_string).collect();
                    let (name, choices) = (escaped(name), choices.join(","));
                    let _ = write!(page, "<tr data-name=\"{name}\" data-choices=\"{choices}\">");
                }
                None => page.push_str("<tr>"),
            }
            for (column, cell) in row.iter().enumerate() {
                let text = if cell.link.is_empty() {
                    typeset_in_parts(&cell.text)
                } else {
                    format!("<a href=\"{}\">{}</a>", escaped(&cell.link), typeset(&cell.text))
                };
                let _ = match (column, cell.tone, is_number(&cell.text)) {
                    (0, ..) => write!(page, "<th scope=\"row\">{text}</th>"),
                    (_, CellTone::Holds, _) => write!(page, "<td class=\"holds\">{text}</td>"),
                    (_, CellTone::Fails, _) => write!(page, "<td class=\"fails\">{text}</td>"),
                    (_, CellTone::Doubtful, _) => write!(page, "<td class=\"doubtful\">{text}</td>"),
                    (_, CellTone::Plain, true) => write!(page, "<td class=\"number\">{text}</td>"),
                    (_, CellTone::Plain, false) if short.get(column) == Some(&true) => {
                        write!(page, "<td class=\"short\">{text}</td>")
                    }
                    (_, CellTone::Plain, false) => write!(page, "<td>{text}</td>"),
                };
            }
            page.push_str("</tr>\n");
        }
        page.push_str("</tbody></table></div></div>\n");
    }

    /// Whether the words of a column stand on one line each.
    fn is_short(&self, column: usize) -> bool {
        self.rows
            .iter()
            .filter_map(|row| row.get(column))
            .all(|cell| plain(&cell.text).chars().count() <= SHORT)
    }
}

/// Letters of a cell that are not broken into lines on a screen.
const SHORT: usize = 40;

/// A cell of numbers without one.
pub const MISSING: &str = "\u{2013}";

/// Whether a cell holds nothing but a number, or says that there is none: such cells are aligned at
/// their right.
fn is_number(cell: &str) -> bool {
    let digits = cell.trim_start_matches(['\u{2212}', '-']);
    cell == MISSING
        || digits.starts_with(|letter: char| letter.is_ascii_digit())
            && digits.chars().all(|letter| letter.is_ascii_digit() || "\u{2212}-\u{a0}.e+ ".contains(letter))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_text() {
        let mut table = Table::new(["step", "ΔK_{I} (MPa√m)"]);
        table.row(["<b>", "\u{2212}1.5"]);
        let mut page = String::new();
        table.write(&mut page);
        assert!(page.contains("<th scope=\"col\" class=\"number\">ΔK<sub>I</sub> (MPa√m)</th>"), "{page}");
        assert!(
            page.contains("<tr><th scope=\"row\">&lt;b&gt;</th><td class=\"number\">\u{2212}1.5</td>"),
            "{page}"
        );
    }

    #[test]
    fn numbers_are_told_from_words() {
        assert!(
            ["0", "-0.1", "1e-6", "\u{2212}2.5e\u{2212}4", "1\u{a0}197", MISSING].into_iter().all(is_number)
        );
        assert!(!["", "-", "6.00 \u{2192} 8.21", "spall", "0 to 1.70"].into_iter().any(is_number));
    }

    #[test]
    fn rows_may_lead_to_other_pages_and_follow_the_switches() {
        let mut table = Table::new(["run", "cycles"]);
        table.row_of("run 1: \"x\"", &[0, 2], [Cell::linked("1", "runs/1/report.html"), "10".into()]);
        let mut page = String::new();
        table.write(&mut page);
        let row = "<tr data-name=\"run 1: &quot;x&quot;\" data-choices=\"0,2\"><th scope=\"row\">\
                   <a href=\"runs/1/report.html\">1</a></th><td class=\"number\">10</td></tr>";
        assert!(page.contains(row), "{page}");
    }
}
