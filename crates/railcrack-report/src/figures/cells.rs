//! Cells in columns and rows, filled by class.

use crate::svg::{Axes, Svg, coordinate, decimals_of, sequence};
use std::fmt::Write;
use std::ops::Range;

/// A map of cells, in columns from left to right and rows along y.
pub(super) struct CellMap<'a> {
    pub(super) axes: &'a Axes,
    /// Borders of all columns.
    pub(super) columns: &'a [f64],
    /// Columns shown.
    pub(super) shown: Range<usize>,
    /// Borders of all rows.
    pub(super) rows: &'a [f64],
    /// Number of classes.
    pub(super) classes: usize,
}

impl CellMap<'_> {
    /// Fills the cells: a path for each class, in it a rectangle for neighbours of one row. Returns
    /// the classes that occur.
    pub(super) fn draw(
        &self,
        svg: &mut Svg,
        class: impl Fn(usize, usize) -> usize,
        colour: impl Fn(usize) -> String,
    ) -> Vec<usize> {
        let mut outlines = vec![String::new(); self.classes];
        for row in 0..self.rows.len().saturating_sub(1) {
            let mut from = self.shown.start;
            while from < self.shown.end {
                let here = class(from, row);
                let alike = |column: &usize| class(*column, row) == here;
                let to = (from + 1..self.shown.end).find(|c| !alike(c)).unwrap_or(self.shown.end);
                let [x0, y0] = self.axes.at(self.columns[from], self.rows[row]).map(coordinate);
                let [x1, y1] = self.axes.at(self.columns[to], self.rows[row + 1]).map(coordinate);
                // Writing to a string does not fail.
                let _ = write!(outlines[here], "M{x0} {y0}H{x1}V{y1}H{x0}z");
                from = to;
            }
        }
        self.axes.clip(svg, "");
        let there: Vec<usize> = (0..self.classes).filter(|&class| !outlines[class].is_empty()).collect();
        for &class in &there {
            svg.area("cells", &outlines[class], &colour(class));
        }
        svg.end();
        there
    }
}

/// The colour of `level`, from light for 0 to dark for `last`.
pub(super) fn level_colour(level: usize, last: usize) -> String {
    sequence(1.0 - level as f64 / last as f64)
}

/// `100 to 200`: the values of `level` where one spans `step`.
pub(super) fn level_words(level: usize, step: f64) -> String {
    let decimals = decimals_of(step);
    format!("{:.decimals$} to {:.decimals$}", level as f64 * step, (level + 1) as f64 * step)
}
