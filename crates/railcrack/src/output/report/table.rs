//! Tables of a page.

use super::html::typeset;
use std::fmt::Write;

/// A table of a page. Headings and cells are plain text; `K_{I}` sets an index.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    /// What the table shows, a sentence above it; empty for none.
    pub caption: String,
    /// Column headings with units.
    pub headings: Vec<String>,
    /// Rows; a row shorter than the headings leaves cells empty.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// A table without rows.
    pub fn new(headings: impl IntoIterator<Item = impl Into<String>>) -> Self {
        Self { headings: headings.into_iter().map(Into::into).collect(), ..Self::default() }
    }

    /// Appends a row of cells, one for each heading.
    pub fn row(&mut self, cells: impl IntoIterator<Item = impl Into<String>>) {
        self.rows.push(cells.into_iter().map(Into::into).collect());
    }

    /// Appends the table to `page`. The first cell of a row names it.
    pub(super) fn write(&self, page: &mut String) {
        page.push_str("<div class=\"wide\"><table>\n");
        if !self.caption.is_empty() {
            // Writing to a string does not fail.
            let _ = writeln!(page, "<caption>{}</caption>", typeset(&self.caption));
        }
        page.push_str("<thead><tr>");
        for heading in &self.headings {
            let _ = write!(page, "<th scope=\"col\">{}</th>", typeset(heading));
        }
        page.push_str("</tr></thead>\n<tbody>\n");
        for row in &self.rows {
            page.push_str("<tr>");
            for (column, cell) in row.iter().enumerate() {
                let _ = match (column, is_number(cell)) {
                    (0, _) => write!(page, "<th scope=\"row\">{}</th>", typeset(cell)),
                    (_, true) => write!(page, "<td class=\"number\">{}</td>", typeset(cell)),
                    (_, false) => write!(page, "<td>{}</td>", typeset(cell)),
                };
            }
            page.push_str("</tr>\n");
        }
        page.push_str("</tbody></table></div>\n");
    }
}

/// A cell of numbers without one.
pub(crate) const MISSING: &str = "\u{2013}";

/// Whether a cell holds nothing but a number, or says that there is none: such cells are aligned at their right.
fn is_number(cell: &str) -> bool {
    cell == MISSING
        || cell.starts_with(|letter: char| letter.is_ascii_digit() || letter == '\u{2212}')
            && cell.chars().all(|letter| letter.is_ascii_digit() || "\u{2212}\u{a0}.e+ ".contains(letter))
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
        assert!(page.contains("<th scope=\"col\">ΔK<sub>I</sub> (MPa√m)</th>"), "{page}");
        assert!(
            page.contains("<th scope=\"row\">&lt;b&gt;</th><td class=\"number\">\u{2212}1.5</td>"),
            "{page}"
        );
    }
}
