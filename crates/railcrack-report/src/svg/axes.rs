//! Axes: a frame, two scales, ticks at round numbers.

use super::ticks::{multiples, round_step, scale_exponent, tick_label};
use super::{Anchor, INK, LIGHT, Span, Stroke, Svg, TextStyle};

/// The rectangle inside the axes, pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    pub left: f64,
    pub top: f64,
    pub width: f64,
    pub height: f64,
}

impl Frame {
    pub fn bottom(self) -> f64 {
        self.top + self.height
    }

    pub fn right(self) -> f64 {
        self.left + self.width
    }

    fn rectangle(self) -> [f64; 4] {
        [self.left, self.top, self.width, self.height]
    }
}

/// One scale, from its left or lower end to its right or upper end (`from` > `to` runs backwards).
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    from: f64,
    to: f64,
    ticks: Vec<f64>,
    step: f64,
    exponent: i32,
}

impl Axis {
    /// Exactly from `from` to `to`, with at most `most` ticks or so; a range without extent is widened.
    pub fn exact(from: f64, to: f64, most: usize) -> Self {
        let (from, to) = if from == to {
            let half = 0.5 * from.abs().max(1.0);
            (from - half, to + half)
        } else {
            (from, to)
        };
        let step = round_step((to - from).abs(), most);
        let exponent = scale_exponent(from.abs().max(to.abs()));
        Self { from, to, ticks: multiples(from.min(to), from.max(to), step), step, exponent }
    }

    /// Around all `values` with 6 % of air at both ends; around zero where there is nothing else.
    pub fn around(values: impl IntoIterator<Item = f64>, most: usize) -> Self {
        let ends = values
            .into_iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        let (low, high) = if ends.0 <= ends.1 { ends } else { (0.0, 0.0) };
        // Round-off is not a range.
        if high - low <= 1e-9 * high.abs().max(low.abs()) {
            return Self::exact(low, low, most);
        }
        let air = 0.06 * (high - low);
        Self::exact(low - air, high + air, most)
    }

    /// Its left or lower end and its right or upper one.
    pub fn ends(&self) -> [f64; 2] {
        [self.from, self.to]
    }

    /// Place along the axis, 0 at its start and 1 at its end.
    fn place(&self, value: f64) -> f64 {
        (value - self.from) / (self.to - self.from)
    }

    fn label(&self, tick: f64) -> String {
        let unit = 10f64.powi(self.exponent);
        tick_label(tick / unit, self.step / unit)
    }

    /// The title, with the power of ten that the labels leave out.
    fn titled(&self, title: &[Span]) -> Vec<Span> {
        let mut spans = title.to_vec();
        if self.exponent != 0 {
            spans.push(Span::plain("  (\u{d7}10"));
            spans.push(Span::Super(self.exponent.to_string().replace('-', "\u{2212}")));
            spans.push(Span::plain(")"));
        }
        spans
    }
}

/// Whether ticks have labels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Labels {
    Shown,
    Hidden,
}

/// A frame with two scales.
pub struct Axes {
    pub frame: Frame,
    pub x: Axis,
    pub y: Axis,
}

impl Axes {
    /// Where the point (x, y) is on the picture.
    pub fn at(&self, x: f64, y: f64) -> [f64; 2] {
        [
            self.frame.left + self.x.place(x) * self.frame.width,
            self.frame.bottom() - self.y.place(y) * self.frame.height,
        ]
    }

    /// Grid lines, the zero line of y a little stronger. Drawn before the data.
    pub fn draw_grid(&self, svg: &mut Svg) {
        let quiet = Stroke::solid(LIGHT, 0.8);
        for &tick in &self.x.ticks {
            let [x, _] = self.at(tick, self.y.from);
            svg.polyline("grid", &[[x, self.frame.top], [x, self.frame.bottom()]], &quiet);
        }
        for &tick in &self.y.ticks {
            let [_, y] = self.at(self.x.from, tick);
            let stroke = if tick == 0.0 { Stroke::solid("#b0b0b0", 1.0) } else { quiet.clone() };
            svg.polyline("grid", &[[self.frame.left, y], [self.frame.right(), y]], &stroke);
        }
    }

    /// Begins the data: what leaves the frame is cut off.
    pub fn clip(&self, svg: &mut Svg) {
        svg.clip(self.frame.rectangle());
    }

    /// Frame, ticks and their labels. Drawn after the data; an empty title leaves it out, on the x axis with the
    /// labels: another panel below has them.
    pub fn draw_frame(&self, svg: &mut Svg, x_title: &[Span], y_title: &[Span]) {
        svg.rectangle(self.frame.rectangle(), "none", INK);
        self.draw_x_ticks(svg, if x_title.is_empty() { Labels::Hidden } else { Labels::Shown });
        let tick_style = TextStyle { size: 12.0, anchor: Anchor::End, colour: INK, weight: "normal" };
        let mut widest: usize = 0;
        for &tick in &self.y.ticks {
            let [_, y] = self.at(self.x.from, tick);
            let label = self.y.label(tick);
            widest = widest.max(label.chars().count());
            svg.polyline(
                "tick",
                &[[self.frame.left - 4.0, y], [self.frame.left, y]],
                &Stroke::solid(INK, 1.0),
            );
            svg.text([self.frame.left - 8.0, y + 4.2], &[Span::Plain(label)], tick_style);
        }
        let title = TextStyle { size: 13.0, anchor: Anchor::Middle, colour: INK, weight: "normal" };
        if !x_title.is_empty() {
            let middle = self.frame.left + 0.5 * self.frame.width;
            svg.text([middle, self.frame.bottom() + 40.0], &self.x.titled(x_title), title);
        }
        if !y_title.is_empty() {
            let middle = self.frame.top + 0.5 * self.frame.height;
            let beside = self.frame.left - 20.0 - 7.0 * widest as f64;
            svg.text(
                [beside, middle],
                &self.y.titled(y_title),
                TextStyle { anchor: Anchor::Upwards, ..title },
            );
        }
    }

    fn draw_x_ticks(&self, svg: &mut Svg, labels: Labels) {
        let style = TextStyle { size: 12.0, anchor: Anchor::Middle, colour: INK, weight: "normal" };
        let bottom = self.frame.bottom();
        for &tick in &self.x.ticks {
            let [x, _] = self.at(tick, self.y.from);
            svg.polyline("tick", &[[x, bottom], [x, bottom + 4.0]], &Stroke::solid(INK, 1.0));
            if labels == Labels::Shown {
                svg.text([x, bottom + 18.0], &[Span::Plain(self.x.label(tick))], style);
            }
        }
    }

    /// A small label on a light ground inside the upper left corner.
    pub fn note(&self, svg: &mut Svg, text: &str) {
        let style = TextStyle { size: 11.0, anchor: Anchor::Start, colour: INK, weight: "normal" };
        let (x, y) = (self.frame.left + 5.0, self.frame.top + 5.0);
        svg.rectangle([x, y, 6.6 * text.chars().count() as f64 + 8.0, 16.0], "#ffffff", "none");
        svg.text([x + 4.0, y + 12.0], &[Span::plain(text)], style);
    }
}
