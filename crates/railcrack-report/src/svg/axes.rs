//! Axes: a frame, two scales, ticks at round numbers.

use super::element::{Anchor, Span, Svg, TextStyle, coordinate};
use super::palette::{INK, LIGHT, ZERO};
use crate::numbers::short;
use serde_json::{Value, json};
use std::ops::RangeInclusive;

/// Where all ticks of a logarithmic axis lie, they are written without powers of ten.
const PLAIN: RangeInclusive<f64> = 0.01..=1000.0;

/// The rectangle inside the axes, pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Frame {
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) width: f64,
    pub(crate) height: f64,
}

impl Frame {
    pub(crate) fn bottom(self) -> f64 {
        self.top + self.height
    }

    pub(crate) fn right(self) -> f64 {
        self.left + self.width
    }

    fn rectangle(self) -> [f64; 4] {
        [self.left, self.top, self.width, self.height]
    }
}

/// Layout of values along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Layout {
    Linear,
    Logarithmic,
}

/// One scale, from its left or lower end to its right or upper end (`from` > `to` runs backwards).
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Axis {
    from: f64,
    to: f64,
    layout: Layout,
    ticks: Vec<f64>,
    step: f64,
    exponent: i32,
}

impl Axis {
    /// Exactly from `from` to `to`, with about `most` ticks at most; an empty range is widened.
    pub(crate) fn exact(from: f64, to: f64, most: usize) -> Self {
        let (from, to) = if from == to {
            let half = 0.5 * from.abs().max(1.0);
            (from - half, to + half)
        } else {
            (from, to)
        };
        let step = round_step((to - from).abs(), most);
        let exponent = scale_exponent(from.abs().max(to.abs()));
        let ticks = multiples(from.min(to), from.max(to), step);
        Self { from, to, layout: Layout::Linear, ticks, step, exponent }
    }

    /// Exactly between two positive values by their logarithm, with ticks at powers of ten, over
    /// less than three decades also at 2 and 5 times these; with fewer than two of them between the
    /// values, from the one below to the one above.
    pub(crate) fn logarithmic(from: f64, to: f64) -> Self {
        let (from, to) = if from < to { (from, to) } else { (0.5 * from, 2.0 * to) };
        let digits: &[f64] = if to < 1e3 * from { &[1.0, 2.0, 5.0] } else { &[1.0] };
        let decades = from.log10().floor() as i32..=to.log10().ceil() as i32;
        let round = decades.flat_map(|decade| digits.iter().map(move |digit| digit * 10f64.powi(decade)));
        let round: Vec<f64> = round.collect();
        let between =
            |from: f64, to: f64| round.iter().copied().filter(move |tick| (from..=to).contains(tick));
        let (from, to) = match between(from, to).count() {
            0 | 1 => {
                (between(0.0, from).next_back().unwrap_or(from), between(to, f64::MAX).next().unwrap_or(to))
            }
            _ => (from, to),
        };
        let ticks = between(from, to).collect();
        Self { from, to, layout: Layout::Logarithmic, ticks, step: 0.0, exponent: 0 }
    }

    /// Place along the axis, 0 at its start and 1 at its end.
    fn place(&self, value: f64) -> f64 {
        match self.layout {
            Layout::Linear => (value - self.from) / (self.to - self.from),
            Layout::Logarithmic => (value / self.from).ln() / (self.to / self.from).ln(),
        }
    }

    fn label(&self, tick: f64) -> Vec<Span> {
        if self.layout == Layout::Linear {
            let unit = 10f64.powi(self.exponent);
            return vec![Span::Plain(tick_label(tick / unit, self.step / unit))];
        }
        let exponent = (tick.log10() + 1e-9).floor();
        if self.ticks.iter().all(|tick| PLAIN.contains(tick)) {
            return vec![Span::Plain(tick_label(tick, 10f64.powf(exponent)))];
        }
        let digit = (tick / 10f64.powf(exponent)).round();
        let factor = if digit == 1.0 { String::new() } else { format!("{digit}\u{b7}") };
        let power = exponent.to_string().replace('-', "\u{2212}");
        vec![Span::Plain(format!("{factor}10")), Span::Super(power)]
    }

    /// The axis with ticks from zero on only: above the running surface there is no depth.
    pub(crate) fn starting_at_zero(mut self) -> Self {
        self.ticks.retain(|tick| *tick >= 0.0);
        self
    }

    /// The axis without ticks: its rows have names.
    pub(crate) fn without_ticks(mut self) -> Self {
        self.ticks.clear();
        self
    }

    /// Letters of the longest label.
    pub(crate) fn widest(&self) -> f64 {
        let letters = |&tick: &f64| self.label(tick).iter().map(Span::letters).sum();
        self.ticks.iter().map(letters).max().unwrap_or(0usize) as f64
    }

    /// The axis between the pixels `from` and `to`, for the script of a page.
    pub(crate) fn placed(&self, from: f64, to: f64) -> String {
        let kind = if self.layout == Layout::Logarithmic { " log" } else { "" };
        format!("{} {} {} {}{kind}", self.from, self.to, coordinate(from), coordinate(to))
    }

    /// The axis with about `most` ticks at most, for a script that draws it.
    pub(crate) fn data(&self, most: usize) -> Value {
        let every = self.ticks.len().div_ceil(most).max(1);
        let ticks = self.ticks.iter().step_by(every);
        json!({
            "from": self.from,
            "to": self.to,
            "log": self.layout == Layout::Logarithmic,
            "ticks": ticks.map(|&tick| json!([tick, short(tick)])).collect::<Vec<_>>(),
        })
    }

    /// The power of ten that the labels leave out.
    pub(crate) fn exponent(&self) -> i32 {
        self.exponent
    }
}

/// The range of `values` with a margin of 6 %; zeros without values.
pub(crate) fn around(values: impl IntoIterator<Item = f64>) -> [f64; 2] {
    let [low, high] = ends(values);
    // Round-off is not a range.
    if high - low <= 1e-9 * high.abs().max(low.abs()) {
        return [low, low];
    }
    let air = 0.06 * (high - low);
    [low - air, high + air]
}

/// The smallest and the largest of `values`; zeros without values.
pub(crate) fn ends(values: impl IntoIterator<Item = f64>) -> [f64; 2] {
    let ends = values
        .into_iter()
        .filter(|value| value.is_finite())
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)]);
    if ends[0] <= ends[1] { ends } else { [0.0, 0.0] }
}

/// A frame with two scales.
pub(crate) struct Axes {
    pub(crate) frame: Frame,
    pub(crate) x: Axis,
    pub(crate) y: Axis,
}

impl Axes {
    /// Position of the point (x, y) on the picture.
    pub(crate) fn at(&self, x: f64, y: f64) -> [f64; 2] {
        [
            self.frame.left + self.x.place(x) * self.frame.width,
            self.frame.bottom() - self.y.place(y) * self.frame.height,
        ]
    }

    /// Grid lines, the zero line of y a little stronger. Drawn before the data.
    pub(crate) fn draw_grid(&self, svg: &mut Svg) {
        let Frame { left, top, .. } = self.frame;
        let across =
            |y: f64| format!("M{} {}H{}", coordinate(left), coordinate(y), coordinate(self.frame.right()));
        let xs = self.x.ticks.iter().map(|&tick| coordinate(self.at(tick, self.y.from)[0]));
        let up = xs.map(|x| format!("M{x} {}V{}", coordinate(top), coordinate(self.frame.bottom())));
        let ys = self.y.ticks.iter().map(|&tick| across(self.at(self.x.from, tick)[1]));
        svg.lines("grid", &up.chain(ys).collect::<String>(), LIGHT, 0.8);
        if self.y.ticks.contains(&0.0) {
            svg.lines("zero", &across(self.at(self.x.from, 0.0)[1]), ZERO, 1.0);
        }
    }

    /// Begins the data, which are clipped at the frame.
    pub(crate) fn clip(&self, svg: &mut Svg, of: &str) {
        svg.clip(of, self.frame.rectangle());
    }

    /// Frame, ticks and their labels. Drawn after the data; without a title the x axis has no
    /// labels either: another panel below has them.
    pub(crate) fn draw_frame(&self, svg: &mut Svg, x_title: &[Span], y_title: &[Span]) {
        svg.rectangle(self.frame.rectangle(), "none", INK);
        let labels = TextStyle { size: 12.0, anchor: Anchor::Middle, colour: INK, weight: "normal" };
        let title = TextStyle { size: 13.0, ..labels };
        let (left, bottom) = (self.frame.left, self.frame.bottom());
        let xs: Vec<f64> = self.x.ticks.iter().map(|&tick| self.at(tick, self.y.from)[0]).collect();
        let ys: Vec<f64> = self.y.ticks.iter().map(|&tick| self.at(self.x.from, tick)[1]).collect();
        let down = xs.iter().map(|x| format!("M{} {}v4", coordinate(*x), coordinate(bottom)));
        let out = ys.iter().map(|y| format!("M{} {}h-4", coordinate(left), coordinate(*y)));
        svg.lines("ticks", &down.chain(out).collect::<String>(), INK, 1.0);
        if !x_title.is_empty() {
            let all =
                xs.iter().zip(&self.x.ticks).map(|(x, tick)| ([*x, bottom + 18.0], self.x.label(*tick)));
            svg.labels("x-axis tick label", &all.collect::<Vec<_>>(), labels);
            let middle = [left + 0.5 * self.frame.width, bottom + 40.0];
            svg.labels("x-axis label", &[(middle, x_title.to_vec())], title);
        }
        let all = ys.iter().zip(&self.y.ticks).map(|(y, tick)| ([left - 8.0, y + 4.2], self.y.label(*tick)));
        svg.labels(
            "y-axis tick label",
            &all.collect::<Vec<_>>(),
            TextStyle { anchor: Anchor::End, ..labels },
        );
        if !y_title.is_empty() {
            let beside = [left - 20.0 - 7.0 * self.y.widest(), self.frame.top + 0.5 * self.frame.height];
            let upwards = TextStyle { anchor: Anchor::Upwards, ..title };
            svg.labels("y-axis label", &[(beside, y_title.to_vec())], upwards);
        }
    }

    /// A small label on a light ground inside the upper left corner.
    pub(crate) fn note(&self, svg: &mut Svg, text: &str) {
        let style = TextStyle { size: 11.0, anchor: Anchor::Start, colour: INK, weight: "normal" };
        let (x, y) = (self.frame.left + 5.0, self.frame.top + 5.0);
        svg.rectangle([x, y, 6.6 * text.chars().count() as f64 + 8.0, 16.0], "#ffffff", "none");
        svg.text([x + 4.0, y + 12.0], &[Span::plain(text)], style);
    }
}

/// The smallest 1, 2 or 5 times a power of ten that divides `span` into at most `most` steps.
pub(crate) fn round_step(span: f64, most: usize) -> f64 {
    let least = span / most.max(1) as f64;
    if !(least > 0.0 && least.is_finite()) {
        return 1.0;
    }
    let decade = 10f64.powf(least.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|digit| digit * decade);
    // A span that is a whole number of steps up to round-off keeps its step.
    steps.into_iter().find(|&step| step >= least * (1.0 - 1e-9)).unwrap_or(10.0 * decade)
}

/// Multiples of `step` from `low` to `high`, ends included.
pub(crate) fn multiples(low: f64, high: f64, step: f64) -> Vec<f64> {
    let first = (low / step - 1e-9).ceil() as i64;
    let last = (high / step + 1e-9).floor() as i64;
    (first..=last).map(|i| i as f64 * step).collect()
}

/// The power of ten, a multiple of three, that scales values up to `largest` to between 1 and 10⁴;
/// 0 for values that need no scaling.
pub(crate) fn scale_exponent(largest: f64) -> i32 {
    if !(largest > 0.0 && largest.is_finite()) || (1e-2..1e4).contains(&largest) {
        return 0;
    }
    (largest.log10() / 3.0).floor() as i32 * 3
}

/// Decimals that multiples of `step` need.
pub(crate) fn decimals_of(step: f64) -> usize {
    (-step.log10() - 1e-9).ceil().clamp(0.0, 12.0) as usize
}

/// `value` with the decimals that multiples of `step` need; a true minus sign.
pub(crate) fn tick_label(value: f64, step: f64) -> String {
    let decimals = decimals_of(step);
    // No "-0".
    let value = if value.abs() < 1e-9 * step { 0.0 } else { value };
    format!("{value:.decimals$}").replace('-', "\u{2212}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_round_and_few() {
        let cases = [(12.0, 6, 2.0), (12.0, 8, 2.0), (1.0, 5, 0.2), (3.7e6, 6, 1e6), (0.031, 7, 0.005)];
        for (span, most, want) in cases {
            let step = round_step(span, most);
            assert!((step / want - 1.0).abs() < 1e-12, "{span}: {step}");
        }
        assert_eq!(round_step(0.0, 5), 1.0);
    }

    #[test]
    fn ticks_include_the_ends() {
        assert_eq!(multiples(-6.0, 6.0, 2.0), [-6.0, -4.0, -2.0, 0.0, 2.0, 4.0, 6.0]);
        assert_eq!(multiples(0.05, 0.42, 0.1).len(), 4);
    }

    #[test]
    fn labels_carry_the_decimals_of_the_step() {
        assert_eq!(tick_label(-2.0, 2.0), "\u{2212}2");
        assert_eq!(tick_label(0.1 + 0.2, 0.05), "0.30");
        assert_eq!(tick_label(-1e-17, 0.5), "0.0");
        let labels = |axis: Axis| axis.ticks.iter().map(|tick| axis.label(*tick)).collect::<Vec<_>>();
        let plain = ["0.2", "0.5", "1", "2", "5"].map(|text| vec![Span::Plain(text.to_owned())]);
        assert_eq!(labels(Axis::logarithmic(0.2, 8.0)), plain);
        let small = labels(Axis::logarithmic(2e-3, 0.1));
        assert_eq!(small[0], [Span::Plain("2\u{b7}10".to_owned()), Span::Super("\u{2212}3".to_owned())]);
        assert_eq!((scale_exponent(3.7e6), scale_exponent(900.0), scale_exponent(2e-7)), (6, 0, -9));
    }
}
