//! SVG elements.

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

    pub(crate) fn text(&mut self, at: [f64; 2], spans: &[Span], style: TextStyle) {
        if spans.is_empty() {
            return;
        }
        let [x, y] = at.map(coordinate);
        let (anchor, turn) = match style.anchor {
            Anchor::Start => ("start", String::new()),
            Anchor::Middle => ("middle", String::new()),
            Anchor::End => ("end", String::new()),
            Anchor::Upwards => ("middle", format!(r#" transform="rotate(-90 {x} {y})""#)),
        };
        let mut content = String::new();
        let mut raised = 0.0;
        for span in spans {
            let (text, height, style_of_span) = match span {
                Span::Plain(text) => (text.as_str(), 0.0, String::new()),
                Span::Italic(text) => (text.as_str(), 0.0, r#" font-style="italic""#.to_owned()),
                Span::Sub(text) => {
                    (text.as_str(), -0.25, format!(r#" font-size="{}""#, coordinate(0.72 * style.size)))
                }
                Span::Super(text) => {
                    (text.as_str(), 0.35, format!(r#" font-size="{}""#, coordinate(0.72 * style.size)))
                }
            };
            let shift = coordinate((raised - height) * style.size);
            raised = height;
            let _ = write!(content, r#"<tspan dy="{shift}"{style_of_span}>{}</tspan>"#, escaped(text));
        }
        let TextStyle { size, colour, weight, .. } = style;
        // Spaces at the border of two spans would be dropped without xml:space.
        self.push(format_args!(
            r#"<text xml:space="preserve" x="{x}" y="{y}" font-size="{size}" font-weight="{weight}" text-anchor="{anchor}" fill="{colour}"{turn}>{content}</text>"#
        ));
    }

    /// Clips everything drawn until [`Svg::unclip`] to the rectangle.
    pub(crate) fn clip(&mut self, [x, y, width, height]: [f64; 4]) {
        self.clips += 1;
        let [x, y, width, height] = [x, y, width, height].map(coordinate);
        let id = self.clips;
        self.push(format_args!(
            r##"<clipPath id="clip{id}"><rect x="{x}" y="{y}" width="{width}" height="{height}"/></clipPath><g clip-path="url(#clip{id})">"##
        ));
    }

    pub(crate) fn unclip(&mut self) {
        self.push(format_args!("</g>"));
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_are_short() {
        assert_eq!([1.0, -0.5, 0.256, -0.001, 12.305].map(coordinate), ["1", "-0.5", "0.26", "0", "12.31"]);
    }
}
