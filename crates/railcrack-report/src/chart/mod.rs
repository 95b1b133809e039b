//! Charts, and their two writers.

mod curve;
mod page;
mod sheet;
mod types;

pub(crate) use curve::CATEGORIES;
pub(crate) use sheet::{HEADING, dashes, draw_heading};

pub use curve::{Curve, CurveColour, CurveDots, CurveLook, CurveWidth};
pub use types::{
    Chart, ChartArea, ChartAspect, ChartAxis, ChartLegend, ChartNote, ChartRange, ChartScale, ChartSheet,
    LegendEntry, LegendMark, SheetLegend,
};
