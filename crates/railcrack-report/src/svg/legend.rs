//! Legends: a column of marks and words beside the axes.

use super::{Anchor, INK, Span, Stroke, Svg, TextStyle};

/// What stands before the words.
#[derive(Debug, Clone, PartialEq)]
pub enum Mark {
    /// A line as in the plot.
    Line(Stroke),
    /// A line with the dots of its increments.
    Dotted(Stroke),
    /// A filled box.
    Box(String),
    /// Nothing: the words head the entries below.
    Heading,
}

/// One line of a legend.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    pub mark: Mark,
    pub words: String,
}

/// Distance between entries, pixels.
const LINE: f64 = 18.0;
/// Width of a mark.
const MARK: f64 = 24.0;

/// Width of the legend, pixels, from the usual width of letters.
pub fn legend_width(entries: &[Entry]) -> f64 {
    let letters = entries.iter().map(|entry| entry.words.chars().count()).max().unwrap_or(0);
    MARK + 8.0 + 6.9 * letters as f64
}

/// Draws `entries` downwards from the upper left corner `at`.
pub fn draw_legend(svg: &mut Svg, at: [f64; 2], entries: &[Entry]) {
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
            Mark::Heading => {}
            Mark::Box(fill) => svg.rectangle([x + 6.0, y - 6.0, 12.0, 12.0], fill, "#999999"),
        }
        let (indent, weight) =
            if entry.mark == Mark::Heading { (0.0, "bold") } else { (MARK + 8.0, "normal") };
        svg.text([x + indent, y + 4.2], &[Span::plain(&entry.words)], TextStyle { weight, ..style });
    }
}
