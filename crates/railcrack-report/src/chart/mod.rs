//! Charts, and their two writers.

mod axis;
mod curve;
mod page;
mod sheet;
mod types;

pub(crate) use curve::CATEGORIES;
pub(crate) use sheet::{HEADING, dashes, draw_heading};

pub use axis::{ChartAxis, ChartRange, ChartScale};
pub use curve::{Curve, CurveColour, CurveDots, CurveLook, CurveWidth};
pub use types::{
    Chart, ChartArea, ChartAspect, ChartLegend, ChartNote, ChartSheet, LegendEntry, LegendMark, SheetLegend,
};
