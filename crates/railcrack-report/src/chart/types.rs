//! Charts and sheets of charts: axes, curves, areas, words; drawn for files and for pages.

use std::ops::Range;

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

/// Number of categorical colours.
pub(crate) const CATEGORIES: usize = 9;
/// The last colour of the ordered scale of a page, from 0.
const ORDERED: f64 = 20.0;

/// The line of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CurveLook {
    /// Solid.
    Line,
    /// Dashed.
    Dashed,
    /// Of short dashes.
    FineDashed,
    /// Of dashes and dots.
    DashDotted,
    /// Of a pattern of its own, by its number modulo 10, for more curves than there are plain
    /// looks.
    Varied(u8),
    /// No line: dots only.
    Dots,
}

/// Points of a curve that carry a dot.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum CurveDots {
    /// None.
    #[default]
    None,
    /// All.
    All,
    /// The last one, which marks the end of a curve among others.
    Last,
    /// All except the given number of first points, which belong to an initial crack.
    AllBut(Range<usize>),
}

/// Width of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CurveWidth {
    /// Normal.
    #[default]
    Usual,
    /// Wide, visible below another curve.
    Wide,
    /// Thin, one of many curves shown as a bundle.
    Fine,
}

/// Colour of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CurveColour {
    /// An index in the categorical palette, which repeats after 9.
    Category(usize),
    /// A position from 0 to 1 on the sequential palette.
    Along(f64),
    /// The text colour, for initial cracks.
    Ink,
    /// The colour of secondary text, for dashes explained in a legend.
    Quiet,
}

impl CurveColour {
    /// The colour of tip, crack or run `place` of `count`: distinct colours for a few, an ordered
    /// scale for many.
    pub fn of(place: usize, count: usize) -> Self {
        if count <= CATEGORIES {
            Self::Category(place)
        } else {
            Self::Along(place as f64 / (count - 1) as f64)
        }
    }

    /// Its name in the style of a page.
    pub(crate) fn name(self) -> String {
        match self {
            Self::Category(number) => format!("c{}", number % CATEGORIES),
            Self::Along(place) => format!("s{:.0}", place.clamp(0.0, 1.0) * ORDERED),
            Self::Ink => "ink".to_owned(),
            Self::Quiet => "quiet".to_owned(),
        }
    }
}

/// A curve: points (x, y) in the order in which they are joined.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Its name in the legend; empty: it has no entry.
    pub name: String,
    /// Points in the units of the axes.
    pub points: Vec<[f64; 2]>,
    /// Its line.
    pub look: CurveLook,
    /// Its dots.
    pub dots: CurveDots,
    /// Its width.
    pub width: CurveWidth,
    /// Its colour; that of its place among the curves where none.
    pub colour: Option<CurveColour>,
    /// Text in the tooltip in addition to the values; empty for none.
    pub note: String,
    /// The value of the curve in each group of the page's `Choices`; empty for a curve that is
    /// always shown.
    pub choices: Vec<usize>,
}

impl Curve {
    /// A solid line without dots.
    pub fn line(name: &str, points: Vec<[f64; 2]>) -> Self {
        Self {
            name: name.to_owned(),
            points,
            look: CurveLook::Line,
            dots: CurveDots::None,
            width: CurveWidth::Usual,
            colour: None,
            note: String::new(),
            choices: Vec::new(),
        }
    }

    /// The curve with another line.
    #[must_use]
    pub fn with_look(self, look: CurveLook) -> Self {
        Self { look, ..self }
    }

    /// The curve with dots.
    #[must_use]
    pub fn with_dots(self, dots: CurveDots) -> Self {
        Self { dots, ..self }
    }

    /// The curve with another width.
    #[must_use]
    pub fn with_width(self, width: CurveWidth) -> Self {
        Self { width, ..self }
    }

    /// The curve in a colour.
    #[must_use]
    pub fn with_colour(self, colour: CurveColour) -> Self {
        Self { colour: Some(colour), ..self }
    }

    /// The curve, shown where these values are chosen.
    #[must_use]
    pub fn with_choices(self, choices: Vec<usize>) -> Self {
        Self { choices, ..self }
    }

    /// Whether the point at `place` carries a dot.
    pub(crate) fn has_dot(&self, place: usize) -> bool {
        self.look == CurveLook::Dots
            || match &self.dots {
                CurveDots::None => false,
                CurveDots::All => true,
                CurveDots::Last => place + 1 == self.points.len(),
                CurveDots::AllBut(bare) => !bare.contains(&place),
            }
    }
}
