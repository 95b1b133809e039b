//! A plot of a folder: its SVG file, and its charts for the page.

use crate::chart::{Chart, ChartSheet};
use crate::page::Block;

/// A plot.
pub(crate) struct Plot {
    /// Name of the file.
    pub(crate) file: &'static str,
    /// Its text.
    pub(crate) svg: String,
    /// Its charts; none where it is a picture of another kind.
    pub(crate) charts: Vec<Chart>,
}

impl Plot {
    /// Charts.
    pub(crate) fn sheet(file: &'static str, sheet: ChartSheet) -> Self {
        let svg = sheet.svg();
        Self { file, svg, charts: sheet.rows.into_iter().flatten().collect() }
    }

    /// A picture of another kind.
    pub(crate) fn picture(file: &'static str, svg: String) -> Self {
        Self { file, svg, charts: Vec::new() }
    }
}

/// The chart called `id`.
pub(crate) fn chart(plots: &[Plot], id: &str) -> Option<Chart> {
    plots.iter().flat_map(|plot| &plot.charts).find(|chart| chart.id == id).cloned()
}

/// The charts called `ids`, side by side if there is space.
pub(crate) fn charts(plots: &[Plot], ids: &[&str]) -> Block {
    Block::charts(ids.iter().filter_map(|id| chart(plots, id)))
}
