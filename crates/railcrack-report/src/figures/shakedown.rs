//! The plots of a stabilised plastic state.

use super::lines::{Dots, Line, LinePicture};
use super::rolled_field::rolled_field;
use crate::LineChart;
use crate::svg::{Axis, CATEGORIES, Span, Stroke};
use railcrack_run::shakedown::{BoundsRow, LayerRow, PassRow, ShakedownFolder};

/// A plot: a chart of lines, or a picture.
pub(crate) struct ShakedownPlot {
    name: &'static str,
    svg: String,
    chart: Option<LineChart>,
}

impl ShakedownPlot {
    /// Name and text of its file.
    pub(crate) fn file(&self) -> (&'static str, String) {
        (self.name, self.svg.clone())
    }

    /// The same for a page; none where it is a picture only.
    pub(crate) fn chart(&self) -> Option<&LineChart> {
        self.chart.as_ref()
    }
}

/// Every plot, in the order of reading.
pub(crate) fn shakedown_plots(state: &ShakedownFolder) -> Vec<ShakedownPlot> {
    let lines = |name: &'static str, picture: LinePicture| {
        let shows: String = super::lines::markup(&picture.shows);
        let id = name.trim_end_matches(".svg");
        ShakedownPlot { name, svg: picture.draw(), chart: Some(picture.chart(id, &shows)) }
    };
    vec![
        lines("residual-stress.svg", residual_stress(state)),
        lines("plastic-strain.svg", plastic_strain(state)),
        lines("dang-van.svg", dang_van(state)),
        lines("passes.svg", passes(state)),
        lines("passes-change.svg", passes_change(state)),
        lines("bounds.svg", bounds(state)),
        lines("shakedown-map.svg", map(state)),
        ShakedownPlot { name: "field.svg", svg: rolled_field(state), chart: None },
    ]
}

fn stroke(colour: usize, dashes: &'static str) -> Stroke {
    Stroke { dashes, ..Stroke::solid(CATEGORIES[colour], 1.8) }
}

/// A solid line without dots.
fn line(points: Vec<[f64; 2]>, colour: usize, words: &str) -> Line {
    Line { points, stroke: stroke(colour, ""), words: words.into(), dots: Dots::Hidden }
}

fn plain(text: &str) -> Vec<Span> {
    vec![Span::plain(text)]
}

/// How far down plots go: a little below the plastic layers.
fn shown_depth(state: &ShakedownFolder) -> f64 {
    let flown = |layer: &&LayerRow| layer.strain.equivalent() > 0.0;
    let deepest = state.profile.iter().rfind(flown).map_or(0.0, |layer| layer.depth);
    (1.2 * deepest).max(2.0 * state.summary.half_width_mm)
}

/// Values along x, depth downwards.
fn by_depth<'a>(
    state: &'a ShakedownFolder,
    shows: &str,
    x_title: Vec<Span>,
    lines: Vec<Line>,
) -> LinePicture<'a> {
    let depth = shown_depth(state);
    let values = lines.iter().flat_map(|line| &line.points).filter(|p| p[1] <= depth).map(|p| p[0]);
    LinePicture {
        title: &state.summary.title,
        shows: plain(&format!("{shows} · {}", state.summary.state.name())),
        x_title,
        y_title: plain("Depth  (mm)"),
        x: Axis::around(values.chain([0.0]), 8),
        y: Axis::exact(depth, 0.0, 10),
        size: [460.0, 420.0],
        lines,
    }
}

fn of_layers(state: &ShakedownFolder, value: impl Fn(&LayerRow) -> f64) -> Vec<[f64; 2]> {
    state.profile.iter().map(|layer| [value(layer), layer.depth]).collect()
}

fn residual_stress(state: &ShakedownFolder) -> LinePicture<'_> {
    let mut lines = vec![
        line(of_layers(state, |layer| layer.stress.xx), 0, "σxx, along the rail"),
        line(of_layers(state, |layer| layer.stress.zz), 1, "σzz, out of plane"),
    ];
    if let Some(other) = &state.summary.direct_against_pass_by_pass {
        let sxx = other.profile.iter().map(|point| [point.sxx_mpa, point.depth_mm]).collect();
        let szz = other.profile.iter().map(|point| [point.szz_mpa, point.depth_mm]).collect();
        for (points, colour, words) in [(sxx, 0, "σxx, pass by pass"), (szz, 1, "σzz, pass by pass")] {
            lines.push(Line { stroke: stroke(colour, "6 4"), ..line(points, colour, words) });
        }
    }
    if let Some(initial) = &state.summary.initial_residual {
        let points = initial.iter().map(|point| [point.sxx_mpa, point.depth_mm]).collect();
        lines.push(Line { stroke: stroke(2, "2 3"), ..line(points, 2, "σxx of manufacturing") });
    }
    by_depth(state, "Residual stress", plain("Residual stress  (MPa)"), lines)
}

fn plastic_strain(state: &ShakedownFolder) -> LinePicture<'_> {
    let lines = vec![
        line(of_layers(state, |layer| 1e3 * layer.strain.xx), 0, "εp xx"),
        line(of_layers(state, |layer| 1e3 * layer.strain.yy), 1, "εp yy"),
        line(of_layers(state, |layer| 1e3 * layer.strain.zz), 2, "εp zz"),
        line(of_layers(state, |layer| 1e3 * layer.strain.xy), 3, "εp xy"),
        Line {
            stroke: stroke(6, "6 4"),
            ..line(of_layers(state, |layer| 1e3 * layer.plastic_per_pass), 6, "path per passage")
        },
    ];
    by_depth(state, "Plastic strain", plain("Plastic strain  (10⁻³)"), lines)
}

/// Words of the legend and what of a passage they are for.
type Named = (&'static str, fn(&PassRow) -> f64);

fn over_passes<'a>(
    state: &'a ShakedownFolder,
    shows: &str,
    y_title: &str,
    named: &[Named],
) -> LinePicture<'a> {
    let passes = &state.passes;
    let of = |(colour, (words, value)): (usize, &Named)| Line {
        dots: Dots::Shown,
        ..line(passes.iter().map(|pass| [pass.pass as f64, value(pass)]).collect(), colour, words)
    };
    let lines: Vec<Line> = named.iter().enumerate().map(of).collect();
    let values = lines.iter().flat_map(|line| &line.points).map(|p| p[1]);
    LinePicture {
        title: &state.summary.title,
        shows: plain(&format!("{shows} · {}", state.summary.state.name())),
        x_title: plain("Passage"),
        y_title: plain(y_title),
        x: Axis::exact(0.0, passes.len() as f64 + 1.0, 12),
        y: Axis::around(values, 8),
        size: [560.0, 340.0],
        lines,
    }
}

fn passes(state: &ShakedownFolder) -> LinePicture<'_> {
    over_passes(
        state,
        "Plastic strain over the passages, largest over depth",
        "Equivalent plastic strain  (10⁻³)",
        &[
            ("kept so far", |pass| 1e3 * pass.largest_strain),
            ("along the way", |pass| 1e3 * pass.plastic_path),
        ],
    )
}

/// The smallest change that is drawn, MPa: beyond lies round-off, and the logarithm of zero.
const SMALLEST: f64 = 1e-6;

fn passes_change(state: &ShakedownFolder) -> LinePicture<'_> {
    over_passes(
        state,
        "Change of the residual stress by each passage",
        "log10 of the change  (MPa)",
        &[("σxx or σzz", |pass| pass.stress_change.max(SMALLEST).log10())],
    )
}

fn bounds(state: &ShakedownFolder) -> LinePicture<'_> {
    let rows = &state.summary.bounds_by_depth;
    let ratio = state.summary.p0_over_k;
    // Far down everything is borne: no more of it than makes the scale readable.
    let most = 2.5 * ratio.max(3.0);
    let curve = |value: fn(&BoundsRow) -> f64| -> Vec<[f64; 2]> {
        rows.iter().map(|b| [value(b).min(most), b.depth_mm]).collect()
    };
    let deepest = rows.last().map_or(state.summary.half_width_mm, |b| b.depth_mm);
    let lines = vec![
        line(curve(|b| b.first_yield_p0_over_k), 4, "first yield"),
        line(curve(|b| b.shakedown_p0_over_k), 0, "limit of elastic shakedown"),
        Line {
            stroke: stroke(1, "6 4"),
            ..line(vec![[ratio, 0.0], [ratio, deepest]], 1, "p0/k of the case")
        },
    ];
    LinePicture {
        title: &state.summary.title,
        shows: plain(
            "What each depth bears: elastic left of first yield, shakedown possible left of the limit",
        ),
        x_title: vec![Span::Italic("p"), Span::Sub("0"), Span::plain(" / "), Span::Italic("k")],
        y_title: plain("Depth  (mm)"),
        x: Axis::exact(0.0, most, 10),
        y: Axis::exact(deepest, 0.0, 10),
        size: [460.0, 420.0],
        lines,
    }
}

fn map(state: &ShakedownFolder) -> LinePicture<'_> {
    let here = [state.summary.friction.abs(), state.summary.p0_over_k];
    let most = state.summary.map.last().map_or(0.5, |point| point.friction);
    let lines = vec![
        line(
            state.summary.map.iter().map(|p| [p.friction, p.first_yield_p0_over_k]).collect(),
            4,
            "first yield",
        ),
        line(
            state.summary.map.iter().map(|p| [p.friction, p.shakedown_p0_over_k]).collect(),
            0,
            "limit of elastic shakedown",
        ),
        Line { dots: Dots::Shown, ..line(vec![here], 1, "the case") },
    ];
    let highest = state.summary.map.iter().map(|p| p.shakedown_p0_over_k).fold(here[1], f64::max);
    LinePicture {
        title: &state.summary.title,
        shows: plain("Shakedown map: elastic, elastic shakedown, plastic shakedown from below"),
        x_title: vec![Span::plain("Friction |"), Span::Italic("μ"), Span::Sub("w"), Span::plain("|")],
        y_title: vec![Span::Italic("p"), Span::Sub("0"), Span::plain(" / "), Span::Italic("k")],
        x: Axis::exact(0.0, most, 10),
        y: Axis::exact(0.0, 1.15 * highest, 10),
        size: [520.0, 380.0],
        lines,
    }
}

fn dang_van(state: &ShakedownFolder) -> LinePicture<'_> {
    let limit = state.summary.dang_van.b_mpa;
    let depth = shown_depth(state);
    let surface = [state.summary.dang_van.surface.value_mpa, 0.0];
    let layers = state.profile.iter().map(|layer| [layer.dang_van, layer.depth]);
    let values = std::iter::once(surface).chain(layers).collect();
    let lines = vec![
        Line { dots: Dots::Hidden, ..line(values, 0, "largest of the cycle") },
        Line {
            stroke: stroke(1, "6 4"),
            ..line(vec![[limit, 0.0], [limit, depth]], 1, "b: beyond it a crack starts")
        },
    ];
    let title = vec![Span::plain("τ + a "), Span::Italic("p"), Span::Sub("h"), Span::plain("  (MPa)")];
    by_depth(state, "Dang Van criterion", title, lines)
}
