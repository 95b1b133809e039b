//! A picture of lines in one frame.

use super::{HEADING, draw_title};
use crate::svg::{Axes, Axis, CATEGORIES, Entry, Frame, Mark, Span, Stroke, Svg, draw_legend, legend_width};
use crate::{ChartAxis, ChartScale, Curve, CurveColour, CurveLook, LineChart};

/// A line and its words in the legend.
pub(super) struct Line {
    pub points: Vec<[f64; 2]>,
    pub stroke: Stroke,
    pub words: String,
    pub dots: Dots,
}

/// Whether the points of a line are marked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Dots {
    Shown,
    Hidden,
}

/// The whole picture: title of the case, what it shows, titles and scales of the axes, lines.
pub(super) struct LinePicture<'a> {
    pub title: &'a str,
    pub shows: Vec<Span>,
    pub x_title: Vec<Span>,
    pub y_title: Vec<Span>,
    pub x: Axis,
    pub y: Axis,
    pub size: [f64; 2],
    pub lines: Vec<Line>,
}

impl LinePicture<'_> {
    /// The same for a page: its curves with their values, and the static picture.
    pub(super) fn chart(&self, id: &str, caption: &str) -> LineChart {
        let axis = |title: &[Span], axis: &Axis| {
            let [from, to] = axis.ends();
            let scale = if from > to { ChartScale::Depth } else { ChartScale::Linear };
            ChartAxis { title: markup(title), scale, range: Some([from.min(to), from.max(to)]) }
        };
        let curve = |line: &Line| Curve {
            look: match (line.dots, line.points.len(), line.stroke.dashes) {
                (Dots::Shown, 1, _) => CurveLook::Dots,
                (Dots::Shown, ..) => CurveLook::Dotted,
                (Dots::Hidden, _, "") => CurveLook::Line,
                (Dots::Hidden, ..) => CurveLook::Dashed,
            },
            colour: CATEGORIES
                .iter()
                .position(|&colour| colour == line.stroke.colour)
                .map(CurveColour::Category),
            ..Curve::line(&line.words, line.points.clone())
        };
        LineChart {
            id: id.to_owned(),
            caption: caption.to_owned(),
            x: axis(&self.x_title, &self.x),
            y: axis(&self.y_title, &self.y),
            curves: self.lines.iter().map(curve).collect(),
            picture: Some(self.draw()),
            ..LineChart::default()
        }
    }

    pub(super) fn draw(&self) -> String {
        let entry = |line: &Line| {
            let mark = match line.dots {
                Dots::Shown => Mark::Dotted(line.stroke.clone()),
                Dots::Hidden => Mark::Line(line.stroke.clone()),
            };
            Entry { mark, words: line.words.clone() }
        };
        let entries: Vec<Entry> = self.lines.iter().map(entry).collect();
        let [width, height] = self.size;
        let frame = Frame { left: 76.0, top: HEADING, width, height };
        let whole = frame.right() + 20.0 + legend_width(&entries);
        let mut svg =
            Svg::new(whole, (frame.bottom() + 56.0).max(HEADING + 20.0 + 18.0 * entries.len() as f64));
        draw_title(&mut svg, frame.left, whole - frame.left, self.title, &self.shows);
        let axes = Axes { frame, x: self.x.clone(), y: self.y.clone() };
        axes.draw_grid(&mut svg);
        axes.clip(&mut svg);
        for line in &self.lines {
            let points: Vec<[f64; 2]> = line.points.iter().map(|&[x, y]| axes.at(x, y)).collect();
            svg.polyline("series", &points, &line.stroke);
            if line.dots == Dots::Shown {
                for point in points {
                    svg.dot(point, 2.6, &line.stroke.colour);
                }
            }
        }
        svg.unclip();
        axes.draw_frame(&mut svg, &self.x_title, &self.y_title);
        draw_legend(&mut svg, [frame.right() + 16.0, frame.top], &entries);
        let shows: String = self.shows.iter().map(plain).collect();
        svg.finish(&format!("{shows}: {}", self.title))
    }
}

/// A title as texts of a page have it.
pub(super) fn markup(spans: &[Span]) -> String {
    let text = |span: &Span| match span {
        Span::Plain(text) => text.clone(),
        Span::Italic(symbol) => (*symbol).to_owned(),
        Span::Sub(index) => format!("_{{{index}}}"),
        Span::Super(power) => format!("^{{{power}}}"),
    };
    spans.iter().map(text).collect()
}

fn plain(span: &Span) -> &str {
    match span {
        Span::Plain(text) | Span::Super(text) => text,
        Span::Italic(text) | Span::Sub(text) => text,
    }
}
