//! Curves of charts: points, dashes, dots, colours.

use std::ops::Range;

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
