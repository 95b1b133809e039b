//! Curves of charts: points, dashes, dots, colours.

use std::ops::Range;

/// Number of colours of things without order.
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
    /// The last one: it finds the end of a curve among others.
    Last,
    /// All but these: those of an initial crack.
    AllBut(Range<usize>),
}

/// Width of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CurveWidth {
    /// As most.
    #[default]
    Usual,
    /// Seen below another curve.
    Wide,
    /// One of many that only their bundle matters of.
    Fine,
}

/// Colour of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CurveColour {
    /// A number in the palette of things without order; it repeats after 9.
    Category(usize),
    /// A place, 0 to 1, along the palette of an ordered scale.
    Along(f64),
    /// That of text: initial cracks.
    Ink,
    /// That of quiet text: dashes explained in a legend.
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

impl CurveLook {
    /// Its name in the data of a page.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Line => "line",
            Self::Dashed => "dashed",
            Self::FineDashed => "fine",
            Self::DashDotted => "dash-dot",
            Self::Dots => "dots",
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
    /// Words under the pointer beside its values; empty for none.
    pub note: String,
    /// Of each group of the page's `Choices` the value that it belongs to; empty: it is always
    /// shown.
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
