//! SVG elements, and texts as spans: indices, powers, symbols of quantities in italics.

use crate::markup::{Piece, pieces};
use railcrack_vtu::escaped;
use std::fmt::Write;

/// A picture under construction; y points down, one unit is a pixel.
pub(crate) struct Svg {
    width: f64,
    height: f64,
    body: String,
    clips: usize,
}

/// A line's colour, width and dashes (empty: solid).
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Stroke {
    pub(crate) colour: String,
    pub(crate) width: f64,
    pub(crate) dashes: &'static str,
}

impl Stroke {
    pub(crate) fn solid(colour: &str, width: f64) -> Self {
        Self { colour: colour.to_owned(), width, dashes: "" }
    }
}

/// Position of a text relative to its point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
    /// Middle, reading upwards.
    Upwards,
}

/// Style of a text.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TextStyle {
    pub(crate) size: f64,
    pub(crate) anchor: Anchor,
    pub(crate) colour: &'static str,
    /// `normal` or `bold`.
    pub(crate) weight: &'static str,
}

/// A piece of a text.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Span {
    /// Plain.
    Plain(String),
    /// The symbol of a quantity.
    Italic(String),
    /// Below the line.
    Sub(String),
    /// Above the line.
    Super(String),
}

impl Span {
    pub(crate) fn plain(text: &str) -> Self {
        Self::Plain(text.to_owned())
    }

    /// Number of letters.
    pub(crate) fn letters(&self) -> usize {
        match self {
            Self::Plain(text) | Self::Italic(text) | Self::Sub(text) | Self::Super(text) => {
                text.chars().count()
            }
        }
    }
}

/// The content of a text of this size.
fn content(spans: &[Span], size: f64) -> String {
    if let [Span::Plain(text)] = spans {
        return escaped(text);
    }
    let mut content = String::new();
    let mut raised = 0.0;
    for span in spans {
        let small = || format!(r#" font-size="{}""#, coordinate(0.72 * size));
        let (text, height, own) = match span {
            Span::Plain(text) => (text, 0.0, String::new()),
            Span::Italic(text) => (text, 0.0, r#" font-style="italic""#.to_owned()),
            Span::Sub(text) => (text, -0.25, small()),
            Span::Super(text) => (text, 0.35, small()),
        };
        let shift = coordinate((raised - height) * size);
        raised = height;
        // Writing to a string does not fail.
        let _ = write!(content, r#"<tspan dy="{shift}"{own}>{}</tspan>"#, escaped(text));
    }
    content
}

/// A coordinate with at most two decimals.
pub(crate) fn coordinate(value: f64) -> String {
    let hundredths = (value * 100.0).round() as i64;
    let (sign, size) = (if hundredths < 0 { "-" } else { "" }, hundredths.abs());
    match (size / 100, size % 100) {
        (whole, 0) => format!("{sign}{whole}"),
        (whole, part) if part % 10 == 0 => format!("{sign}{whole}.{}", part / 10),
        (whole, part) => format!("{sign}{whole}.{part:02}"),
    }
}

impl Svg {
    pub(crate) fn new(width: f64, height: f64) -> Self {
        Self { width, height, body: String::new(), clips: 0 }
    }

    fn push(&mut self, element: std::fmt::Arguments) {
        // Writing to a string does not fail.
        let _ = self.body.write_fmt(element);
        self.body.push('\n');
    }

    pub(crate) fn rectangle(&mut self, [x, y, width, height]: [f64; 4], fill: &str, stroke: &str) {
        let [x, y, width, height] = [x, y, width, height].map(coordinate);
        self.push(format_args!(
            r#"<rect x="{x}" y="{y}" width="{width}" height="{height}" fill="{fill}" stroke="{stroke}"/>"#
        ));
    }

    /// An open line through `points`; `name` becomes its class.
    pub(crate) fn polyline(&mut self, name: &str, points: &[[f64; 2]], stroke: &Stroke) {
        let mut place = String::with_capacity(points.len() * 12);
        for [x, y] in points {
            let _ = write!(place, "{},{} ", coordinate(*x), coordinate(*y));
        }
        let Stroke { colour, width, dashes } = stroke;
        let dashes =
            if dashes.is_empty() { String::new() } else { format!(r#" stroke-dasharray="{dashes}""#) };
        self.push(format_args!(
            r#"<polyline class="{name}" points="{}" fill="none" stroke="{colour}" stroke-width="{width}" stroke-linejoin="round" stroke-linecap="round"{dashes}/>"#,
            place.trim_end()
        ));
    }

    /// Areas given by the path `outline`, filled without anti-aliasing so that neighbours leave no
    /// gap.
    pub(crate) fn area(&mut self, name: &str, outline: &str, fill: &str) {
        self.push(format_args!(
            r#"<path class="{name}" d="{outline}" fill="{fill}" shape-rendering="crispEdges"/>"#
        ));
    }

    pub(crate) fn dot(&mut self, [x, y]: [f64; 2], radius: f64, fill: &str) {
        let (x, y) = (coordinate(x), coordinate(y));
        self.push(format_args!(r#"<circle cx="{x}" cy="{y}" r="{radius}" fill="{fill}"/>"#));
    }

    /// Lines without dashes, given by the path `d`; `name` becomes their class.
    pub(crate) fn lines(&mut self, name: &str, d: &str, colour: &str, width: f64) {
        self.push(format_args!(
            r#"<path class="{name}" d="{d}" fill="none" stroke="{colour}" stroke-width="{width}"/>"#
        ));
    }

    /// Begins a group with these attributes, which [`Svg::end`] ends.
    pub(crate) fn begin(&mut self, attributes: &str) {
        self.push(format_args!("<g{attributes}>"));
    }

    pub(crate) fn end(&mut self) {
        self.push(format_args!("</g>"));
    }

    pub(crate) fn text(&mut self, at: [f64; 2], spans: &[Span], style: TextStyle) {
        if !spans.is_empty() {
            self.labels("", &[(at, spans.to_vec())], style);
        }
    }

    /// Texts of one style, each at its place, in a group called `name`; a single one without a name
    /// stands alone.
    pub(crate) fn labels(&mut self, name: &str, labels: &[([f64; 2], Vec<Span>)], style: TextStyle) {
        let TextStyle { size, anchor, colour, weight } = style;
        let anchor_word = match anchor {
            Anchor::Start => "start",
            Anchor::Middle | Anchor::Upwards => "middle",
            Anchor::End => "end",
        };
        let shared = format!(
            r#" font-size="{size}" font-weight="{weight}" text-anchor="{anchor_word}" fill="{colour}""#
        );
        let is_alone = name.is_empty() && labels.len() == 1;
        if !is_alone {
            self.begin(&format!(r#" aria-label="{}"{shared}"#, escaped(name)));
        }
        for (at, spans) in labels {
            let [x, y] = at.map(coordinate);
            let own = if is_alone { shared.as_str() } else { "" };
            let turn = match anchor {
                Anchor::Upwards => format!(r#" transform="rotate(-90 {x} {y})""#),
                _ => String::new(),
            };
            // Spaces at the border of two spans would be dropped without xml:space.
            let space = if spans.len() > 1 { r#" xml:space="preserve""# } else { "" };
            let content = content(spans, size);
            self.push(format_args!(r#"<text{space} x="{x}" y="{y}"{own}{turn}>{content}</text>"#));
        }
        if !is_alone {
            self.end();
        }
    }

    /// Begins a group that is clipped to the rectangle, which [`Svg::end`] ends; `of` makes the
    /// name of the clip unique on a page.
    pub(crate) fn clip(&mut self, of: &str, [x, y, width, height]: [f64; 4]) {
        self.clips += 1;
        let [x, y, width, height] = [x, y, width, height].map(coordinate);
        let id = format!("{of}clip{}", self.clips);
        self.push(format_args!(
            r##"<clipPath id="{id}"><rect x="{x}" y="{y}" width="{width}" height="{height}"/></clipPath><g class="curves" clip-path="url(#{id})">"##
        ));
    }

    /// The picture as a part of a page, with these attributes.
    pub(crate) fn finish_in_page(self, attributes: &str) -> String {
        let (width, height) = (coordinate(self.width), coordinate(self.height));
        format!("<svg viewBox=\"0 0 {width} {height}\" role=\"img\" {attributes}>\n{}</svg>", self.body)
    }

    /// The picture as a file on a white ground.
    pub(crate) fn finish(self, description: &str) -> String {
        let (width, height) = (coordinate(self.width), coordinate(self.height));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" font-family=\"Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif\">\n<title>{}</title>\n<rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n{}</svg>\n",
            escaped(description),
            self.body
        )
    }
}

/// The spans of a text in which single letters are no symbols.
pub(crate) fn text(text: &str) -> Vec<Span> {
    set(text, |_, _| false)
}

/// The spans of the title of an axis: a letter that stands alone is a symbol.
pub(crate) fn quantity(text: &str) -> Vec<Span> {
    let stands = |neighbour: Option<char>| neighbour.is_none_or(|c| !c.is_alphanumeric() && c != '√');
    set(text, |before, after| stands(before) && stands(after))
}

fn set(text: &str, is_symbol: impl Fn(Option<char>, Option<char>) -> bool) -> Vec<Span> {
    let mut spans = Vec::new();
    for piece in pieces(text) {
        match piece {
            Piece::Index(index) => spans.push(Span::Sub(index.to_owned())),
            Piece::Power(power) => spans.push(Span::Super(power.to_owned())),
            Piece::Plain(words) => {
                let letters: Vec<char> = words.chars().collect();
                let mut run = String::new();
                for (i, &letter) in letters.iter().enumerate() {
                    let before = i.checked_sub(1).map(|i| letters[i]);
                    if letter.is_alphabetic() && is_symbol(before, letters.get(i + 1).copied()) {
                        if !run.is_empty() {
                            spans.push(Span::Plain(std::mem::take(&mut run)));
                        }
                        spans.push(Span::Italic(letter.to_string()));
                    } else {
                        run.push(letter);
                    }
                }
                if !run.is_empty() {
                    spans.push(Span::Plain(run));
                }
            }
        }
    }
    spans
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_are_short() {
        assert_eq!([1.0, -0.5, 0.256, -0.001, 12.305].map(coordinate), ["1", "-0.5", "0.26", "0", "12.31"]);
    }
}

#[cfg(test)]
mod words_tests {
    use super::*;

    #[test]
    fn symbols_stand_alone() {
        let plain = |text: &str| Span::Plain(text.to_owned());
        let italic = |text: &str| Span::Italic(text.to_owned());
        let sub = |text: &str| Span::Sub(text.to_owned());
        assert_eq!(quantity("K_{I} (MPa√m)"), [italic("K"), sub("I"), plain(" (MPa√m)")]);
        assert_eq!(quantity("da/dN of a"), [plain("da/dN of "), italic("a")]);
        assert_eq!(text("a K_{I"), [plain("a K_{I")]);
    }
}
