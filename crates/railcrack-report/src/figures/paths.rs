//! Crack paths to scale.

use super::sif::tip_colour;
use super::{HEADING, draw_heading};
use crate::svg::{
    Anchor, Axes, Axis, Entry, Frame, INK, Mark, ORANGE, Span, Stroke, Svg, TextStyle, coordinate,
    draw_legend, legend_width,
};
use railcrack_run::{CrackSummary, PieceSummary, Summary};

const WIDTH: f64 = 620.0;
const HEIGHTS: (f64, f64) = (150.0, 560.0);
/// Fill of a piece that is enclosed: a light orange.
const PIECE: &str = "#fbe8c6";

pub(super) fn paths(summary: &Summary) -> String {
    let increments = summary
        .cracks
        .iter()
        .map(|crack| crack.points_mm.len().saturating_sub(crack.initial_points_mm.len()))
        .sum();
    let entries = entries(summary, increments);
    let axes = equal_axes(&summary.cracks);
    let frame = axes.frame;
    let width = frame.right() + 20.0 + legend_width(&entries);
    let height = (frame.bottom() + 56.0).max(HEADING + 20.0 + 18.0 * entries.len() as f64);
    let mut svg = Svg::new(width, height);
    draw_heading(&mut svg, frame.left, width - frame.left, summary, &[Span::plain("Crack paths to scale")]);
    draw_rail(&mut svg, &axes);
    axes.draw_grid(&mut svg);
    axes.clip(&mut svg);
    for piece in &summary.pieces {
        draw_piece(&mut svg, &axes, piece);
    }
    for (place, crack) in summary.cracks.iter().enumerate() {
        draw_crack(&mut svg, &axes, crack, &tip_colour(place, summary.cracks.len()));
    }
    svg.unclip();
    let [_, surface] = axes.at(0.0, 0.0);
    let line = [[frame.left, surface], [frame.right(), surface]];
    svg.polyline("surface", &line, &Stroke::solid(INK, 2.2));
    if summary.cracks.len() > 1 {
        let style = TextStyle { size: 11.0, anchor: Anchor::Middle, colour: INK, weight: "normal" };
        let every = summary.cracks.len().div_ceil(20);
        for (i, crack) in summary.cracks.iter().enumerate().step_by(every) {
            if let Some([mouth, _]) = crack.initial_points_mm.first() {
                let [x, _] = axes.at(*mouth, 0.0);
                svg.text([x, surface - 7.0], &[Span::Plain((i + 1).to_string())], style);
            }
        }
    }
    axes.draw_frame(&mut svg, &[Span::Italic("x"), Span::plain("  (mm)")], &[Span::plain("Depth  (mm)")]);
    draw_legend(&mut svg, [frame.right() + 16.0, frame.top], &entries);
    svg.finish(&format!("Crack paths: {}", summary.title))
}

/// Axes around all paths with the same scale both ways, depth downwards.
pub(super) fn equal_axes(cracks: &[CrackSummary]) -> Axes {
    let points = || cracks.iter().flat_map(|crack| &crack.points_mm);
    let bounds = |c: usize| {
        let all = points().map(|point| point[c]);
        let ends = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        if ends.0 <= ends.1 { ends } else { (0.0, 0.0) }
    };
    let ((left, right), (bottom, _)) = (bounds(0), bounds(1));
    let across = (right - left).max(1e-6);
    let deep = (-bottom).max(1e-6);
    let air = 0.12 * across.max(deep);
    // The room above the surface takes the numbers of the cracks.
    let above = 0.6 * air;
    let (x_span, y_span) = (across + 2.0 * air, deep + air + above);
    let scale = (WIDTH / x_span).min(HEIGHTS.1 / y_span);
    let height = (scale * y_span).max(HEIGHTS.0);
    let (x_span, middle) = (WIDTH / scale, 0.5 * (left + right));
    let frame = Frame { left: 72.0, top: HEADING, width: WIDTH, height };
    let pixels_per_tick = 55.0;
    Axes {
        frame,
        x: Axis::exact(middle - 0.5 * x_span, middle + 0.5 * x_span, (WIDTH / pixels_per_tick) as usize),
        y: Axis::exact(height / scale - above, -above, (height / pixels_per_tick) as usize + 2),
    }
}

pub(super) fn draw_rail(svg: &mut Svg, axes: &Axes) {
    let frame = axes.frame;
    let [_, surface] = axes.at(0.0, 0.0);
    svg.rectangle([frame.left, surface, frame.width, frame.bottom() - surface], "#f6f5f2", "none");
}

/// A piece that is enclosed: filled, with its outline dashed where no crack runs.
fn draw_piece(svg: &mut Svg, axes: &Axes, piece: &PieceSummary) {
    let corners: Vec<[f64; 2]> = piece.outline_mm.iter().map(|[x, y]| axes.at(*x, -y)).collect();
    let mut path = String::new();
    for (i, [x, y]) in corners.iter().enumerate() {
        let command = if i == 0 { "M" } else { "L" };
        path.push_str(&format!("{command}{} {}", coordinate(*x), coordinate(*y)));
    }
    path.push('Z');
    svg.area("piece", &path, PIECE);
    let closed: Vec<[f64; 2]> = corners.iter().chain(corners.first()).copied().collect();
    svg.polyline("outline", &closed, &Stroke { dashes: "4 3", ..Stroke::solid(ORANGE, 1.2) });
}

/// The initial crack in a thick dark line, what grew in colour with a dot at the end of every increment.
fn draw_crack(svg: &mut Svg, axes: &Axes, crack: &CrackSummary, colour: &str) {
    let at = |points: &[[f64; 2]]| -> Vec<[f64; 2]> { points.iter().map(|[x, y]| axes.at(*x, -y)).collect() };
    let grown = at(&crack.points_mm);
    svg.polyline("series", &grown, &Stroke::solid(colour, 1.8));
    let initial = &crack.initial_points_mm;
    svg.polyline("initial", &at(initial), &Stroke::solid(INK, 3.2));
    for (point, place) in crack.points_mm.iter().zip(grown) {
        if !initial.contains(point) {
            svg.dot(place, 2.3, colour);
        }
    }
}

fn entries(summary: &Summary, increments: usize) -> Vec<Entry> {
    let mut entries =
        vec![Entry { mark: Mark::Line(Stroke::solid(INK, 3.2)), words: "initial crack".to_owned() }];
    for piece in &summary.pieces {
        let words = format!("{}, {:.3} mm\u{b2}", piece.kind.name(), piece.area_mm2);
        entries.push(Entry { mark: Mark::Box(PIECE.to_owned()), words });
    }
    if increments == 0 {
        return entries;
    }
    let count = summary.cracks.len();
    let every = count.div_ceil(18).max(1);
    for i in (0..count).step_by(every) {
        let mark = Mark::Dotted(Stroke::solid(&tip_colour(i, count), 1.8));
        let words = match count {
            1 => format!("growth, {} steps", summary.steps),
            _ => format!("crack {}", i + 1),
        };
        entries.push(Entry { mark, words });
    }
    entries
}
