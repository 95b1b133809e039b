//! Crack length against load cycles.

use super::sif::tip_colour;
use super::{HEADING, draw_heading};
use crate::svg::{Axes, Axis, Entry, Frame, Mark, Span, Stroke, Svg, draw_legend, legend_width};
use railcrack_run::Summary;
use railcrack_run::csv::TipRow;

pub(super) fn length_against_cycles(summary: &Summary, growth: &[TipRow]) -> String {
    // Both tips of a buried crack share its length: the first one stands for the crack.
    let cracks: Vec<usize> =
        growth.iter().filter(|row| row.step == 0 && row.tip == 1).map(|row| row.crack).collect();
    let stroke = |place| Stroke::solid(&tip_colour(place, cracks.len()), 1.8);
    let every = cracks.len().div_ceil(18).max(1);
    let entries: Vec<Entry> = if cracks.len() > 1 {
        let named = cracks.iter().enumerate().step_by(every);
        named
            .map(|(i, crack)| Entry { mark: Mark::Dotted(stroke(i)), words: format!("crack {crack}") })
            .collect()
    } else {
        Vec::new()
    };
    let frame = Frame { left: 76.0, top: HEADING, width: 600.0, height: 360.0 };
    let beside = if entries.is_empty() { 6.0 } else { legend_width(&entries) };
    let width = frame.right() + 20.0 + beside;
    let height = (frame.bottom() + 56.0).max(HEADING + 20.0 + 18.0 * entries.len() as f64);
    let mut svg = Svg::new(width, height);
    draw_heading(&mut svg, frame.left, width - frame.left, summary, &[Span::plain("Crack length")]);
    let last = growth.iter().map(|row| row.load_cycles).fold(0.0, f64::max);
    let axes = Axes {
        frame,
        x: if last > 0.0 { Axis::exact(0.0, 1.04 * last, 8) } else { Axis::exact(-1.0, 1.0, 2) },
        y: Axis::around(growth.iter().map(|row| row.length), 8),
    };
    axes.draw_grid(&mut svg);
    axes.clip(&mut svg);
    for (place, &crack) in cracks.iter().enumerate() {
        let stroke = stroke(place);
        let rows = growth.iter().filter(|row| row.crack == crack && row.tip == 1);
        let points: Vec<[f64; 2]> = rows.map(|row| axes.at(row.load_cycles, row.length)).collect();
        svg.polyline("series", &points, &stroke);
        for point in points {
            svg.dot(point, 2.6, &stroke.colour);
        }
    }
    svg.unclip();
    let title = |text| [Span::plain(text)];
    axes.draw_frame(&mut svg, &title("Load cycles (axles)"), &title("Crack length  (mm)"));
    draw_legend(&mut svg, [frame.right() + 16.0, frame.top], &entries);
    svg.finish(&format!("Crack length against load cycles: {}", summary.title))
}
