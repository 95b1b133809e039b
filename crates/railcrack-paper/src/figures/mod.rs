//! The figures: a table each, and charts of it for the SVG file and the page.

mod charts;
mod engines;
mod increments;
mod overlay;
mod sheets;
mod tables;
mod write;

pub(crate) use charts::{Quantity, TableCurve, page_chart};
pub(crate) use engines::engines;
pub(crate) use increments::increments;
pub use overlay::Overlay;
pub(crate) use overlay::{Distance, OVERLAY_COLUMNS, distances, forget_overlays, kept};
pub(crate) use sheets::sheet;
pub(crate) use tables::{DIGITISED, FigureTable};
pub(crate) use write::{path_table, profile_table, sif_table};
