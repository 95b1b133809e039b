//! The map of a stabilised plastic state across the rail.

use super::cells::{CellMap, level_colour};
use crate::chart::{HEADING, draw_heading};
use crate::svg::{
    Anchor, Axes, Axis, Entry, Frame, INK, Mark, Svg, TextStyle, decimals_of, draw_legend, quantity,
    round_step, text,
};
use railcrack_run::shakedown::{SectionRow, ShakedownFolder};

/// Depth shown over the smaller half-width of the contact.
const DEPTH: f64 = 2.5;
/// Maximum number of classes of a panel.
const LEVELS: usize = 9;

/// One panel: a value of every row and layer.
struct Panel {
    name: &'static str,
    unit: &'static str,
    value: fn(&SectionRow) -> f64,
}

const PANELS: [Panel; 4] = [
    Panel { name: "Residual stress along the rail", unit: "MPa", value: |row| row.stress.xx },
    Panel { name: "Residual stress across the rail", unit: "MPa", value: |row| row.stress.yy },
    Panel {
        name: "Equivalent plastic strain",
        unit: "10^{\u{2212}3}",
        value: |row| 1e3 * row.strain.equivalent(),
    },
    Panel { name: "Dang Van, largest τ + a p_{h}", unit: "MPa", value: |row| row.dang_van },
];

/// The section of `state`; none under a line contact.
pub(super) fn section_map(state: &ShakedownFolder) -> Option<String> {
    let laterals: Vec<f64> =
        state.section.chunk_by(|a, b| a.lateral == b.lateral).map(|rows| rows[0].lateral).collect();
    let spacing = laterals.get(1)? - laterals[0];
    let borders: Vec<f64> = laterals
        .iter()
        .map(|y| y - 0.5 * spacing)
        .chain(laterals.last().map(|y| y + 0.5 * spacing))
        .collect();
    let layers = state.section.len() / laterals.len();
    let depths = &state.cycle.depths;
    let smaller = state.summary.half_width_mm.min(state.summary.lateral_half_width_mm.unwrap_or(f64::MAX));
    let (left, width, height, gap) = (72.0, 400.0, 170.0, 78.0);
    let panels = PANELS.len() as f64;
    let mut svg = Svg::new(left + width + 240.0, HEADING + 20.0 + panels * (height + gap));
    draw_heading(&mut svg, left, width + 220.0, &state.summary.title, "Across the rail, unloaded");
    let (first, last) = (borders[0], borders[borders.len() - 1]);
    for (place, panel) in PANELS.iter().enumerate() {
        let top = HEADING + 20.0 + place as f64 * (height + gap);
        let frame = Frame { left, top, width, height };
        let axes = Axes { frame, x: Axis::exact(first, last, 10), y: Axis::exact(DEPTH * smaller, 0.0, 6) };
        let value = |m: usize, l: usize| (panel.value)(&state.section[m * layers + l]);
        let values = || state.section.iter().map(panel.value);
        let (least, most) = (values().fold(0.0, f64::min), values().fold(0.0, f64::max));
        let step = round_step((most - least).max(f64::MIN_POSITIVE), LEVELS);
        let lowest = (least / step).floor();
        let class = |m: usize, l: usize| (((value(m, l) / step).floor() - lowest) as usize).min(LEVELS + 1);
        let classes = LEVELS + 2;
        let map = CellMap { axes: &axes, columns: &borders, shown: 0..laterals.len(), rows: depths, classes };
        let colour = |level: usize| level_colour(level, LEVELS + 1);
        let there = map.draw(&mut svg, class, colour);
        axes.draw_frame(&mut svg, &quantity("Lateral place (mm)"), &text("Depth (mm)"));
        let style = TextStyle { size: 12.5, anchor: Anchor::Start, colour: INK, weight: "bold" };
        svg.text([left, top - 7.0], &text(&format!("{} ({})", panel.name, panel.unit)), style);
        let decimals = decimals_of(step);
        let entry = |&level: &usize| {
            let from = (lowest + level as f64) * step;
            let words = format!("{from:.decimals$} to {:.decimals$}", from + step);
            Entry { mark: Mark::Box(colour(level)), words }
        };
        let entries: Vec<Entry> = there.iter().rev().map(entry).collect();
        draw_legend(&mut svg, [frame.right() + 16.0, top], &entries);
    }
    Some(svg.finish(&format!("Residual stress and plastic strain across the rail: {}", state.summary.title)))
}
