//! Legends: a column of marks and labels next to the axes.

use super::element::{Anchor, Stroke, Svg, TextStyle, text};
use super::palette::INK;
use crate::markup::plain;

/// The mark before the words.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Mark {
    /// A line as in the plot.
    Line(Stroke),
    /// A line with dots.
    Dotted(Stroke),
    /// A dot.
    Dot(String),
    /// A filled box.
    Box(String),
    /// None: the text is a heading of the entries below.
    Heading,
    /// None: the text is a note.
    Note,
}

/// One line of a legend.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Entry {
    pub(crate) mark: Mark,
    pub(crate) words: String,
}

/// Distance between entries, pixels.
const LINE: f64 = 18.0;
/// Width of a mark.
const MARK: f64 = 24.0;

/// Width of the legend, pixels, from the usual width of letters.
pub(crate) fn legend_width(entries: &[Entry]) -> f64 {
    let letters = entries.iter().map(|entry| plain(&entry.words).chars().count()).max().unwrap_or(0);
    if entries.is_empty() {
        return 0.0;
    }
    MARK + 8.0 + 6.9 * letters as f64
}

/// Draws `entries` downwards from the upper left corner `at`.
pub(crate) fn draw_legend(svg: &mut Svg, at: [f64; 2], entries: &[Entry]) {
    let style = TextStyle { size: 12.0, anchor: Anchor::Start, colour: INK, weight: "normal" };
    for (i, entry) in entries.iter().enumerate() {
        let (x, y) = (at[0], at[1] + 8.0 + LINE * i as f64);
        match &entry.mark {
            Mark::Line(stroke) => svg.polyline("mark", &[[x, y], [x + MARK, y]], stroke),
            Mark::Dotted(stroke) => {
                svg.polyline("mark", &[[x, y], [x + MARK, y]], stroke);
                for part in [0.0, 0.5, 1.0] {
                    svg.dot([x + part * MARK, y], 2.2, &stroke.colour);
                }
            }
            Mark::Dot(colour) => svg.dot([x + 0.5 * MARK, y], 2.6, colour),
            Mark::Heading | Mark::Note => {}
            Mark::Box(fill) => svg.rectangle([x + 6.0, y - 6.0, 12.0, 12.0], fill, "#999999"),
        }
        let (indent, weight) = match entry.mark {
            Mark::Heading => (0.0, "bold"),
            Mark::Note => (0.0, "normal"),
            _ => (MARK + 8.0, "normal"),
        };
        svg.text([x + indent, y + 4.2], &text(&entry.words), TextStyle { weight, ..style });
    }
}
