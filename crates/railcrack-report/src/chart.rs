//! Line charts of a page.

use super::html::{escaped, json_for_script, still, typeset};
use super::numbers::numbers;
use serde_json::json;
use std::fmt::Write;

/// Colours of things without order.
const CATEGORIES: usize = 7;
/// The last colour of the ordered scale, from 0.
const ORDERED: f64 = 20.0;

/// How values are laid out along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ChartScale {
    /// Evenly.
    #[default]
    Linear,
    /// By their logarithm; values ≤ 0 are left out.
    Logarithmic,
    /// Evenly, the y axis downwards.
    Depth,
}

/// An axis.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ChartAxis {
    /// Quantity and unit: `K_{I} (MPa√m)`.
    pub title: String,
    /// Layout.
    pub scale: ChartScale,
    /// Smallest and largest value shown; around the data where none.
    pub range: Option<[f64; 2]>,
}

impl ChartAxis {
    /// A linear axis around the data.
    pub fn linear(title: &str) -> Self {
        Self { title: title.to_owned(), scale: ChartScale::Linear, range: None }
    }

    /// A logarithmic axis around the data.
    pub fn logarithmic(title: &str) -> Self {
        Self { scale: ChartScale::Logarithmic, ..Self::linear(title) }
    }
}

/// How a curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CurveLook {
    /// A line.
    Line,
    /// A dashed line.
    Dashed,
    /// A line of short dashes.
    FineDashed,
    /// A line of dashes and dots.
    DashDotted,
    /// A line with a dot at every point.
    Dotted,
    /// Dots only.
    Dots,
}

/// The colour of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CurveColour {
    /// A number in the palette of things without order; it repeats after 7.
    Category(usize),
    /// A place, 0 to 1, along the palette of an ordered scale.
    Along(f64),
}

/// A curve: points (x, y) in the order in which they are joined.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Its name in the legend.
    pub name: String,
    /// Points in the units of the axes.
    pub points: Vec<[f64; 2]>,
    /// How it is drawn.
    pub look: CurveLook,
    /// Its colour; that of its place among the curves where none.
    pub colour: Option<CurveColour>,
    /// What else the pointer says of it; empty for nothing.
    pub note: String,
    /// Of each group of the page's [`Choices`](super::Choices) the value that it belongs to; empty: it is always shown.
    pub choices: Vec<usize>,
}

impl Curve {
    /// A line.
    pub fn line(name: &str, points: Vec<[f64; 2]>) -> Self {
        Self {
            name: name.to_owned(),
            points,
            look: CurveLook::Line,
            colour: None,
            note: String::new(),
            choices: Vec::new(),
        }
    }

    /// The same curve, drawn otherwise.
    pub fn with_look(self, look: CurveLook) -> Self {
        Self { look, ..self }
    }

    /// The same curve in colour number `colour`.
    pub fn with_colour(self, colour: usize) -> Self {
        Self { colour: Some(CurveColour::Category(colour)), ..self }
    }

    /// The same curve, shown where these values are chosen.
    pub fn with_choices(self, choices: Vec<usize>) -> Self {
        Self { choices, ..self }
    }
}

/// Whether a chart has the same scale in both directions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ChartAspect {
    /// Each axis fills its side.
    #[default]
    Free,
    /// To scale: crack paths.
    Equal,
}

/// Whether a chart names its curves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ChartLegend {
    /// In a legend above it.
    #[default]
    Names,
    /// Under the pointer only: the page's choices say which colour is what.
    Pointer,
}

impl CurveLook {
    /// Its name in the data of a page.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Line => "line",
            Self::Dashed => "dashed",
            Self::FineDashed => "fine",
            Self::DashDotted => "dash-dot",
            Self::Dotted => "dotted",
            Self::Dots => "dots",
        }
    }
}

impl CurveColour {
    /// Its name in the style of a page.
    pub(super) fn name(self) -> String {
        match self {
            Self::Category(number) => format!("c{}", number % CATEGORIES),
            Self::Along(place) => format!("s{:.0}", place.clamp(0.0, 1.0) * ORDERED),
        }
    }
}

/// A chart of lines that gives its values under the pointer.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LineChart {
    /// Name of the element, unique on the page: letters, digits, hyphens.
    pub id: String,
    /// What it shows, a sentence.
    pub caption: String,
    /// Horizontal axis.
    pub x: ChartAxis,
    /// Vertical axis.
    pub y: ChartAxis,
    /// Curves, the first below.
    pub curves: Vec<Curve>,
    /// Scales with respect to each other.
    pub aspect: ChartAspect,
    /// Where its curves are named.
    pub legend: ChartLegend,
    /// The same as a static SVG, for readers without scripts; none leaves them the caption.
    pub picture: Option<String>,
}

impl LineChart {
    /// Appends the chart to `page`: a figure with its data, which the page's script draws.
    pub(super) fn write(&self, page: &mut String) {
        let (id, caption) = (escaped(&self.id), typeset(&self.caption));
        let data = json_for_script(&self.data());
        // Writing to a string does not fail.
        let _ = writeln!(
            page,
            "<figure class=\"chart\" id=\"{id}\" data-name=\"{id}\">\n<div class=\"drawing\"></div>\n\
             <script type=\"application/json\">{data}</script>"
        );
        if let Some(picture) = &self.picture {
            let _ = writeln!(page, "<noscript>{}</noscript>", still(picture, &self.caption));
        }
        let _ = writeln!(page, "<figcaption>{caption}</figcaption>\n</figure>");
    }

    fn data(&self) -> serde_json::Value {
        let axis = |axis: &ChartAxis| {
            json!({
                "title": axis.title,
                "scale": match axis.scale {
                    ChartScale::Linear => "linear",
                    ChartScale::Logarithmic => "log",
                    ChartScale::Depth => "depth",
                },
                "range": axis.range.map(numbers),
            })
        };
        let curve = |(place, curve): (usize, &Curve)| {
            json!({
                "name": curve.name,
                "note": curve.note,
                "look": curve.look.name(),
                "colour": curve.colour.unwrap_or(CurveColour::Category(place)).name(),
                "choices": curve.choices,
                "x": numbers(curve.points.iter().map(|point| point[0])),
                "y": numbers(curve.points.iter().map(|point| point[1])),
            })
        };
        json!({
            "x": axis(&self.x),
            "y": axis(&self.y),
            "equal": self.aspect == ChartAspect::Equal,
            "legend": self.legend == ChartLegend::Names,
            "caption": self.caption,
            "curves": self.curves.iter().enumerate().map(curve).collect::<Vec<_>>(),
        })
    }
}
