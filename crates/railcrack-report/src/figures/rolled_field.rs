//! Stress and plastic strain around the contact.

use super::cells::{CellMap, level_colour, level_words};
use crate::chart::{HEADING, draw_heading};
use crate::svg::{
    Anchor, Axes, Axis, Entry, Frame, INK, Mark, Svg, TextStyle, draw_legend, quantity, round_step, text,
};
use railcrack_run::shakedown::{CycleField, ShakedownFolder};
use std::ops::Range;

/// Half-widths on each side of the contact.
const AROUND: f64 = 2.5;
/// Depth over the half-width.
const DEPTH: f64 = 2.5;
/// Maximum number of classes of a panel.
const LEVELS: usize = 9;

/// One panel: a value of every column and layer.
struct Panel {
    name: &'static str,
    unit: &'static str,
    value: fn(&CycleField, usize) -> f64,
}

const PANELS: [Panel; 2] = [
    Panel {
        name: "Von Mises stress",
        unit: "MPa",
        value: |cycle, at| {
            let s = cycle.stress[at].deviator();
            (1.5 * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2])).sqrt()
        },
    },
    Panel {
        name: "Equivalent plastic strain",
        unit: "10^{\u{2212}3}",
        value: |cycle, at| 1e3 * cycle.strain[at].equivalent(),
    },
];

pub(super) fn rolled_field(state: &ShakedownFolder) -> String {
    let a = state.summary.half_width_mm;
    let cycle = &state.cycle;
    let layers = cycle.depths.len().saturating_sub(1);
    let (depths, borders) = (&cycle.depths, &cycle.borders);
    let columns = shown_columns(borders, AROUND * a);
    let (left, width, height, gap) = (72.0, 400.0, 200.0, 78.0);
    let mut svg = Svg::new(left + width + 240.0, HEADING + 20.0 + 2.0 * (height + gap));
    draw_heading(
        &mut svg,
        left,
        width + 220.0,
        &state.summary.title,
        "Around the contact in the last passage",
    );
    for (place, panel) in PANELS.iter().enumerate() {
        let top = HEADING + 20.0 + place as f64 * (height + gap);
        let frame = Frame { left, top, width, height };
        let axes =
            Axes { frame, x: Axis::exact(-AROUND * a, AROUND * a, 10), y: Axis::exact(DEPTH * a, 0.0, 6) };
        let value = |i: usize, j: usize| (panel.value)(cycle, i * layers + j);
        let most = columns.clone().flat_map(|i| (0..layers).map(move |j| (i, j))).map(|(i, j)| value(i, j));
        let step = round_step(most.fold(0.0, f64::max).max(f64::MIN_POSITIVE), LEVELS);
        let class = |i: usize, j: usize| ((value(i, j) / step) as usize).min(LEVELS);
        let map = CellMap {
            axes: &axes,
            columns: borders,
            shown: columns.clone(),
            rows: depths,
            classes: LEVELS + 1,
        };
        let colour = |level: usize| level_colour(level, LEVELS);
        let there = map.draw(&mut svg, class, colour);
        axes.draw_frame(&mut svg, &quantity("x from the contact centre (mm)"), &text("Depth (mm)"));
        let style = TextStyle { size: 12.5, anchor: Anchor::Start, colour: INK, weight: "bold" };
        svg.text([left, top - 7.0], &text(&format!("{} ({})", panel.name, panel.unit)), style);
        let entry =
            |&level: &usize| Entry { mark: Mark::Box(colour(level)), words: level_words(level, step) };
        let entries: Vec<Entry> = there.iter().rev().map(entry).collect();
        draw_legend(&mut svg, [frame.right() + 16.0, top], &entries);
    }
    svg.finish(&format!("Stress and plastic strain around the contact: {}", state.summary.title))
}

/// Columns that lie at least in part within `reach` of the contact.
fn shown_columns(borders: &[f64], reach: f64) -> Range<usize> {
    let first = borders.iter().skip(1).take_while(|&&right| right <= -reach).count();
    let last = borders.iter().take(borders.len().saturating_sub(1)).take_while(|&&left| left < reach).count();
    first..last.max(first)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_are_raised_not_letters_that_fonts_lack() {
        for Panel { unit, .. } in PANELS {
            assert!(!unit.chars().any(|letter| ('\u{2070}'..='\u{209f}').contains(&letter)), "{unit}");
        }
    }
}
