//! Predicted over measured of named entries, one row each.

use crate::svg::{Anchor, Axes, Axis, CATEGORIES, Frame, GREY, INK, LIGHT, Stroke, Svg, TextStyle};
use crate::svg::{quantity, text};

/// A row of the picture: an entry, or the heading of those below.
#[derive(Debug, Clone, PartialEq)]
pub struct ForestRow {
    /// The prediction.
    pub name: String,
    /// Predicted over measured; none in a heading.
    pub ratios: Vec<ForestRatio>,
}

/// Predicted over measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ForestRatio {
    /// 2.5 %, median and 97.5 % of the samples over the measured value.
    pub predicted: [f64; 3],
    /// The ends of the measured range over its middle.
    pub measured: [f64; 2],
    /// Number of its colour: of the geometry, or of what is not scored.
    pub category: usize,
}

/// Pixels: of a row, of the names, of the inside, around it.
const ROW: f64 = 21.0;
const NAMES: f64 = 300.0;
const INSIDE: f64 = 360.0;
const ABOVE: f64 = 24.0;
const BELOW: f64 = 50.0;
/// Letters of a name.
const LETTERS: usize = 42;
/// Half of the thickness of the bar of a measured range, pixels.
const BAR: f64 = 6.0;
/// Ratios that are marked.
const MARKED: [(f64, &str); 5] = [(0.2, "1/5"), (0.5, "1/2"), (1.0, "equal"), (2.0, "2"), (5.0, "5")];

/// The picture of `rows`.
pub fn forest(description: &str, rows: &[ForestRow]) -> String {
    let all = rows.iter().flat_map(|row| &row.ratios);
    let ends = all.flat_map(|ratio| ratio.predicted.into_iter().chain(ratio.measured));
    let ends = ends.filter(|ratio| ratio.is_finite() && *ratio > 0.0);
    let (low, high) = ends.fold((0.15, 7.0), |(low, high): (f64, f64), at| (low.min(at), high.max(at)));
    let height = ROW * rows.len() as f64;
    let axes = Axes {
        frame: Frame { left: NAMES, top: ABOVE, width: INSIDE, height },
        x: Axis::logarithmic(0.8 * low, high / 0.8).without_ticks(),
        // The rows have names, and the ratios their words.
        y: Axis::exact(-(rows.len() as f64), 0.0, 1).without_ticks(),
    };
    let mut svg = Svg::new(NAMES + INSIDE + 16.0, ABOVE + height + BELOW);
    let name = TextStyle { size: 12.0, anchor: Anchor::Start, colour: INK, weight: "normal" };
    let mark = TextStyle { size: 11.0, anchor: Anchor::Middle, colour: GREY, ..name };
    for (ratio, words) in MARKED {
        let [x, top] = axes.at(ratio, 0.0);
        let dashes = if ratio == 1.0 { "" } else { "4 3" };
        let line = [[x, top], [x, top + height]];
        svg.polyline("mark", &line, &Stroke { dashes, ..Stroke::solid(GREY, 1.0) });
        svg.text([x, ABOVE - 8.0], &text(words), mark);
    }
    for (place, row) in rows.iter().enumerate() {
        let middle = axes.at(1.0, -(place as f64) - 0.5)[1];
        let weight = if row.ratios.is_empty() { "bold" } else { "normal" };
        svg.text([4.0, middle + 4.0], &text(&shortened(&row.name)), TextStyle { weight, ..name });
        for (number, ratio) in row.ratios.iter().enumerate() {
            let shift = 6.0 * (number as f64 - 0.5 * (row.ratios.len() as f64 - 1.0));
            draw(&mut svg, &axes, (middle, shift), ratio);
        }
    }
    axes.draw_frame(&mut svg, &quantity("Predicted over measured"), &[]);
    svg.finish(description)
}

/// The range that is measured, the samples, and their median, about the `middle` of the row.
fn draw(svg: &mut Svg, axes: &Axes, (middle, shift): (f64, f64), ratio: &ForestRatio) {
    let x = |value: f64| axes.at(value, 0.0)[0];
    let [from, to] = ratio.measured.map(x);
    if shift <= 0.0 {
        svg.rectangle([from, middle - BAR, to - from, 2.0 * BAR], LIGHT, "none");
    }
    let colour = CATEGORIES[ratio.category % CATEGORIES.len()];
    let [low, median, high] = ratio.predicted.map(x);
    let y = middle + shift;
    svg.polyline("samples", &[[low, y], [high, y]], &Stroke::solid(colour, 1.5));
    svg.dot([median, y], 3.2, colour);
}

/// The beginning of a long `name`.
fn shortened(name: &str) -> String {
    if name.chars().count() <= LETTERS {
        return name.to_owned();
    }
    let start: String = name.chars().take(LETTERS - 1).collect();
    format!("{}…", start.trim_end())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_entry_has_its_name_and_its_median() {
        let ratio = ForestRatio { predicted: [0.5, 1.0, 3.0], measured: [0.8, 1.25], category: 0 };
        let rows = [
            ForestRow { name: "Track".into(), ratios: Vec::new() },
            ForestRow { name: "T1".into(), ratios: vec![ratio, ForestRatio { category: 2, ..ratio }] },
        ];
        let svg = forest("entries", &rows);
        assert!(svg.contains(">Track<") && svg.contains(">T1<"), "{svg}");
        assert_eq!(svg.matches("<circle").count(), 2);
        assert!(!svg.contains("NaN"), "{svg}");
    }
}
