//! Charts, and their two writers.

mod page;
mod sheet;
mod types;

pub(crate) use sheet::{HEADING, dashes, draw_heading};

pub(crate) use types::CATEGORIES;

pub use types::{
    Chart, ChartArea, ChartAspect, ChartAxis, ChartLegend, ChartNote, ChartRange, ChartScale, ChartSheet,
    Curve, CurveColour, CurveDots, CurveLook, CurveWidth, LegendEntry, LegendMark, SheetLegend,
};
