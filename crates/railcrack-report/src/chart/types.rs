//! Charts and sheets of charts: drawn as an SVG file by one writer, on a page by another.

use super::curve::{Curve, CurveColour, CurveDots, CurveLook, CurveWidth};

/// Whether a chart has the same scale in both directions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ChartAspect {
    /// Independent scales.
    #[default]
    Free,
    /// To scale: crack paths. With an exact range of x it is a strip of a longer picture.
    Equal,
    /// Independent scales, with the file as wide as a page: rows of many cracks.
    Long,
}

/// Where the curves of a chart on a page are named.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ChartLegend {
    /// In a legend above the chart.
    #[default]
    Names,
    /// In tooltips only; the page's choices explain the colours.
    Pointer,
}

/// A filled area: a piece of the rail enclosed by cracks.
#[derive(Debug, Clone, PartialEq)]
pub struct ChartArea {
    /// Its name in the legend.
    pub name: String,
    /// Corners in the units of the axes; the last is joined to the first.
    pub outline: Vec<[f64; 2]>,
}

/// A label at a point of a chart.
#[derive(Debug, Clone, PartialEq)]
pub struct ChartNote {
    /// The point above which they stand, in the units of the axes.
    pub at: [f64; 2],
    /// The words.
    pub words: String,
}

/// Two axes and curves. Texts set indices and powers: `K_{I}`, `10^{6}`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Chart {
    /// Name of the element on a page, unique there: letters, digits, hyphens.
    pub id: String,
    /// A sentence below the chart on a page.
    pub caption: String,
    /// Words above the chart in a file of several; empty for none.
    pub heading: String,
    /// Horizontal axis.
    pub x: ChartAxis,
    /// Vertical axis.
    pub y: ChartAxis,
    /// Areas, below the curves.
    pub areas: Vec<ChartArea>,
    /// Curves, the first below.
    pub curves: Vec<Curve>,
    /// Words at points.
    pub notes: Vec<ChartNote>,
    /// Scales with respect to each other.
    pub aspect: ChartAspect,
    /// Where its curves are named on a page.
    pub legend: ChartLegend,
}

/// A mark in the legend of an SVG file.
#[derive(Debug, Clone, PartialEq)]
pub enum LegendMark {
    /// None: the text is a heading of the entries below.
    Heading,
    /// None: the text is a note.
    Note,
    /// A filled area.
    Area,
    /// A curve.
    Curve {
        /// Its line.
        look: CurveLook,
        /// Its dots.
        dots: CurveDots,
        /// Its width.
        width: CurveWidth,
        /// Its colour.
        colour: CurveColour,
    },
}

/// An entry in the legend of an SVG file.
#[derive(Debug, Clone, PartialEq)]
pub struct LegendEntry {
    /// The mark before the words.
    pub mark: LegendMark,
    /// The words.
    pub words: String,
}

impl LegendEntry {
    /// An entry for curves of this line and colour.
    pub fn curve(words: &str, look: CurveLook, colour: CurveColour) -> Self {
        let mark = LegendMark::Curve { look, dots: CurveDots::None, width: CurveWidth::Usual, colour };
        Self { mark, words: words.to_owned() }
    }

    /// Entries that explain solid and dashed lines, whatever their colour.
    pub fn solid_and_dashed([solid, dashed]: [&str; 2]) -> [Self; 2] {
        [(solid, CurveLook::Line), (dashed, CurveLook::Dashed)]
            .map(|(words, look)| Self::curve(words, look, CurveColour::Quiet))
    }

    /// Words without a mark.
    pub fn note(words: &str) -> Self {
        Self { mark: LegendMark::Note, words: words.to_owned() }
    }

    /// Words that head the entries below.
    pub fn heading(words: &str) -> Self {
        Self { mark: LegendMark::Heading, words: words.to_owned() }
    }
}

/// The legend of an SVG file.
#[derive(Debug, Clone, PartialEq)]
pub enum SheetLegend {
    /// One entry for each name among the curves and areas, then these.
    Names(Vec<LegendEntry>),
    /// These entries.
    Entries(Vec<LegendEntry>),
}

impl Default for SheetLegend {
    fn default() -> Self {
        Self::Names(Vec::new())
    }
}

/// Charts of one SVG file, in rows. Axes with the same title have the same scale.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ChartSheet {
    /// First line of the heading: the title of the case.
    pub title: String,
    /// Second line: the quantity, the model.
    pub subtitle: String,
    /// Charts, row by row from the top.
    pub rows: Vec<Vec<Chart>>,
    /// Entries of the legend.
    pub legend: SheetLegend,
}

impl ChartSheet {
    /// A sheet with one chart.
    pub fn of(title: &str, subtitle: &str, chart: Chart) -> Self {
        Self {
            title: title.to_owned(),
            subtitle: subtitle.to_owned(),
            rows: vec![vec![chart]],
            ..Self::default()
        }
    }

    /// Its charts, row by row.
    pub fn charts(&self) -> impl Iterator<Item = &Chart> {
        self.rows.iter().flatten()
    }
}

/// Scale of an axis.
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

/// Values that an axis covers.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum ChartRange {
    /// The values of the curves with a margin at both ends.
    #[default]
    Around,
    /// The values of the curves and zero, with a margin.
    AroundZero,
    /// Exactly the range of the curves.
    Tight,
    /// From the first to the second.
    Exact([f64; 2]),
}

/// An axis. Its label sets indices and powers: `K_{I}`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ChartAxis {
    /// The quantity: `K_{I}`.
    pub label: String,
    /// Its unit: `MPa√m`; empty for a number without one.
    pub unit: String,
    /// Layout.
    pub scale: ChartScale,
    /// Values covered.
    pub range: ChartRange,
}

impl ChartAxis {
    /// A linear axis around the values.
    pub fn linear(label: &str, unit: &str) -> Self {
        Self { label: label.to_owned(), unit: unit.to_owned(), ..Self::default() }
    }

    /// A logarithmic axis around the values.
    pub fn logarithmic(label: &str, unit: &str) -> Self {
        Self { scale: ChartScale::Logarithmic, ..Self::linear(label, unit) }
    }

    /// Depth below the running surface, mm, downwards.
    pub fn depth() -> Self {
        Self { scale: ChartScale::Depth, ..Self::linear("Depth", "mm") }
    }

    /// The same axis over other values.
    #[must_use]
    pub fn over(self, range: ChartRange) -> Self {
        Self { range, ..self }
    }

    /// Label and unit: `K_{I} (MPa√m)`.
    pub fn title(&self) -> String {
        if self.unit.is_empty() { self.label.clone() } else { format!("{} ({})", self.label, self.unit) }
    }
}
