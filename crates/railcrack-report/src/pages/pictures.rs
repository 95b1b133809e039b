//! Plots of a folder on its page.

use crate::figures::{Plot, chart};
use crate::page::Block;

/// The charts called `ids`, side by side if there is space.
pub(super) fn charts(plots: &[Plot], ids: &[&str]) -> Block {
    Block::charts(ids.iter().filter_map(|id| chart(plots, id)))
}

/// The plot in `file` as a picture for readers without scripts; an empty caption is replaced by
/// that of its chart.
pub(super) fn still(plots: &[Plot], file: &str, caption: &str) -> Option<Block> {
    let plot = plots.iter().find(|plot| plot.file == file)?;
    let own = plot.charts.first().map_or("", |chart| &chart.caption);
    let caption = if caption.is_empty() { own } else { caption };
    Some(Block::Still { svg: plot.svg.clone(), caption: caption.to_owned() })
}
