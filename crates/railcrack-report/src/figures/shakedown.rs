//! The plots of a stabilised plastic state.

use super::cells::{CellMap, level_colour, level_words};
use super::plot::Plot;
use super::section::section_map;
use crate::chart::{
    Chart, ChartAxis, ChartRange, ChartSheet, Curve, CurveColour, CurveDots, CurveLook, HEADING, draw_heading,
};
use crate::svg::{
    Anchor, Axes, Axis, Entry, Frame, INK, Mark, Svg, TextStyle, around, draw_legend, quantity, round_step,
    text,
};
use railcrack::words::Choice;
use railcrack_run::shakedown::{BoundsRow, CycleField, LayerRow, PassRow, ShakedownFolder};
use std::ops::Range;

/// Every plot, in the order of reading.
pub(crate) fn shakedown_plots(state: &ShakedownFolder) -> Vec<Plot> {
    let of = |(file, subtitle, chart): (&'static str, &str, Chart)| {
        let caption = format!("{subtitle}.");
        let chart = Chart { id: file.trim_end_matches(".svg").to_owned(), caption, ..chart };
        let subtitle = format!("{subtitle} · {}", state.summary.state.word());
        Plot::sheet(file, ChartSheet::of(&state.summary.title, &subtitle, chart))
    };
    let strain_over_passes = over_passes(
        state,
        ChartAxis::linear("Equivalent plastic strain", "10^{−3}"),
        &[
            ("at the end of the passage", |pass| 1e3 * pass.largest_strain),
            ("accumulated in the passage", |pass| 1e3 * pass.plastic_path),
        ],
    );
    let change_over_passes = over_passes(
        state,
        ChartAxis::logarithmic("Change of σ_{xx} or σ_{zz}", "MPa"),
        &[("", |pass| pass.stress_change.max(SMALLEST))],
    );
    let mut plots: Vec<Plot> = [
        ("residual-stress.svg", "Residual stress by depth", residual_stress(state)),
        ("plastic-strain.svg", "Plastic strain by depth", plastic_strain(state)),
        ("dang-van.svg", "Dang Van criterion by depth", dang_van(state)),
        ("passes.svg", "Plastic strain after each passage, maximum over depth", strain_over_passes),
        ("passes-change.svg", "Largest change of the residual stress in each passage", change_over_passes),
        ("bounds.svg", "Peak pressure at first yield and at the shakedown limit, by depth", bounds(state)),
        ("shakedown-map.svg", "Shakedown map", map(state)),
    ]
    .into_iter()
    .filter(|(file, ..)| *file != "shakedown-map.svg" || !state.summary.map.is_empty())
    .map(of)
    .collect();
    plots.push(Plot::picture("field.svg", rolled_field(state)));
    plots.extend(section_map(state).map(|map| Plot::picture("section.svg", map)));
    plots
}

/// A solid line in colour number `colour`.
fn line(points: Vec<[f64; 2]>, colour: usize, words: &str) -> Curve {
    Curve::line(words, points).with_colour(CurveColour::Category(colour))
}

fn dashed(points: Vec<[f64; 2]>, colour: usize, words: &str) -> Curve {
    line(points, colour, words).with_look(CurveLook::Dashed)
}

/// Depth range of the plots: slightly more than the plastic layers.
fn shown_depth(state: &ShakedownFolder) -> f64 {
    let flown = |layer: &&LayerRow| layer.strain.equivalent() > 0.0;
    let deepest = state.profile.iter().rfind(flown).map_or(0.0, |layer| layer.depth);
    (1.2 * deepest).max(2.0 * state.summary.half_width_mm)
}

/// Values along x, depth downwards.
fn by_depth(state: &ShakedownFolder, x: ChartAxis, curves: Vec<Curve>) -> Chart {
    let depth = shown_depth(state);
    let values = curves.iter().flat_map(|curve| &curve.points).filter(|p| p[1] <= depth).map(|p| p[0]);
    let range = ChartRange::Exact(around(values.chain([0.0])));
    let y = ChartAxis::depth().over(ChartRange::Exact([0.0, depth]));
    Chart { x: x.over(range), y, curves, ..Chart::default() }
}

fn of_layers(state: &ShakedownFolder, value: impl Fn(&LayerRow) -> f64) -> Vec<[f64; 2]> {
    state.profile.iter().map(|layer| [value(layer), layer.depth]).collect()
}

fn residual_stress(state: &ShakedownFolder) -> Chart {
    let mut curves = vec![
        line(of_layers(state, |layer| layer.stress.xx), 0, "σ_{xx}, along the rail"),
        line(of_layers(state, |layer| layer.stress.zz), 1, "σ_{zz}, out of plane"),
    ];
    if let Some(other) = &state.summary.direct_against_pass_by_pass {
        let sxx = other.profile.iter().map(|point| [point.sxx_mpa, point.depth_mm]).collect();
        let szz = other.profile.iter().map(|point| [point.szz_mpa, point.depth_mm]).collect();
        curves.push(dashed(sxx, 0, "σ_{xx}, pass by pass"));
        curves.push(dashed(szz, 1, "σ_{zz}, pass by pass"));
    }
    if let Some(initial) = &state.summary.initial_residual {
        let points = initial.iter().map(|point| [point.sxx_mpa, point.depth_mm]).collect();
        curves.push(line(points, 2, "σ_{xx} before the first passage").with_look(CurveLook::FineDashed));
    }
    by_depth(state, ChartAxis::linear("Residual stress", "MPa"), curves)
}

fn plastic_strain(state: &ShakedownFolder) -> Chart {
    let curves = vec![
        line(of_layers(state, |layer| 1e3 * layer.strain.xx), 0, "ε_{p,xx}"),
        line(of_layers(state, |layer| 1e3 * layer.strain.yy), 1, "ε_{p,yy}"),
        line(of_layers(state, |layer| 1e3 * layer.strain.zz), 2, "ε_{p,zz}"),
        line(of_layers(state, |layer| 1e3 * layer.strain.xy), 3, "ε_{p,xy}"),
        dashed(of_layers(state, |layer| 1e3 * layer.plastic_per_pass), 6, "accumulated in the last passage"),
    ];
    by_depth(state, ChartAxis::linear("Plastic strain", "10^{−3}"), curves)
}

/// Words of the legend and the value of a passage that they stand for.
type Named = (&'static str, fn(&PassRow) -> f64);

fn over_passes(state: &ShakedownFolder, y: ChartAxis, named: &[Named]) -> Chart {
    let passes = &state.passes;
    let of = |(colour, (words, value)): (usize, &Named)| {
        let points = passes.iter().map(|pass| [pass.pass as f64, value(pass)]).collect();
        line(points, colour, words).with_dots(CurveDots::All)
    };
    let x = ChartAxis::linear("Passage", "").over(ChartRange::Exact([0.0, passes.len() as f64 + 1.0]));
    Chart { x, y, curves: named.iter().enumerate().map(of).collect(), ..Chart::default() }
}

/// Smallest change shown, MPa; smaller ones are round-off.
const SMALLEST: f64 = 1e-6;

fn bounds(state: &ShakedownFolder) -> Chart {
    let rows = &state.summary.bounds_by_depth;
    let ratio = state.summary.p0_over_k;
    // The limits grow without bound with depth and are cut off where the scale stays readable.
    let most = 2.5 * ratio.max(3.0);
    let curve = |value: fn(&BoundsRow) -> f64| -> Vec<[f64; 2]> {
        cut_at(most, rows.iter().map(|row| [value(row), row.depth_mm]))
    };
    let deepest = rows.last().map_or(state.summary.half_width_mm, |row| row.depth_mm);
    Chart {
        x: ChartAxis::linear("p_{0}/k", "").over(ChartRange::Exact([0.0, most])),
        y: ChartAxis::depth().over(ChartRange::Exact([0.0, deepest])),
        curves: vec![
            line(curve(|row| row.first_yield_p0_over_k), 4, "first yield"),
            line(curve(|row| row.shakedown_p0_over_k), 0, "shakedown limit"),
            dashed(vec![[ratio, 0.0], [ratio, deepest]], 1, "p_{0}/k of the case"),
        ],
        ..Chart::default()
    }
}

/// The part of a curve with x ≤ `most`, its ends on that line.
fn cut_at(most: f64, points: impl Iterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
    let mut cut = Vec::new();
    let mut last: Option<[f64; 2]> = None;
    for point in points {
        if let Some(last) = last.filter(|last| (last[0] <= most) != (point[0] <= most)) {
            let share = (most - last[0]) / (point[0] - last[0]);
            // An end at infinity is met at once.
            let share = if share.is_finite() { share } else { 0.0 };
            cut.push([most, last[1] + share * (point[1] - last[1])]);
        }
        if point[0] <= most {
            cut.push(point);
        }
        last = Some(point);
    }
    cut
}

fn map(state: &ShakedownFolder) -> Chart {
    let summary = &state.summary;
    let here = [summary.friction.abs(), summary.p0_over_k];
    let most = summary.map.last().map_or(0.5, |point| point.friction);
    let highest = summary.map.iter().map(|p| p.shakedown_p0_over_k).fold(here[1], f64::max);
    let first_yield = summary.map.iter().map(|p| [p.friction, p.first_yield_p0_over_k]).collect();
    let shakedown = summary.map.iter().map(|p| [p.friction, p.shakedown_p0_over_k]).collect();
    Chart {
        x: ChartAxis::linear("Wheel–rail friction |μ_{w}|", "").over(ChartRange::Exact([0.0, most])),
        y: ChartAxis::linear("p_{0}/k", "").over(ChartRange::Exact([0.0, 1.15 * highest])),
        curves: vec![
            line(first_yield, 4, "first yield: elastic below"),
            line(shakedown, 0, "shakedown limit: elastic shakedown below"),
            line(vec![here], 1, "the case").with_look(CurveLook::Dots),
        ],
        ..Chart::default()
    }
}

fn dang_van(state: &ShakedownFolder) -> Chart {
    let limit = state.summary.dang_van.b_mpa;
    let surface = [state.summary.dang_van.surface.value_mpa, 0.0];
    let layers = state.profile.iter().map(|layer| [layer.dang_van, layer.depth]);
    let curves = vec![
        line(std::iter::once(surface).chain(layers).collect(), 0, "maximum over the cycle"),
        dashed(vec![[limit, 0.0], [limit, shown_depth(state)]], 1, "b: initiation limit"),
    ];
    by_depth(state, ChartAxis::linear("τ + a p_{h}", "MPa"), curves)
}

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
