//! The plots of a stabilised plastic state.

use super::lines::{Dots, Line, LinePicture};
use super::rolled_field::rolled_field;
use crate::output::ShakedownResults;
use crate::output::plot::{Axis, CATEGORIES, Span, Stroke};
use crate::shakedown::{DepthBounds, LayerState, PassRecord};

/// Every plot with its file name.
pub(crate) fn shakedown_plots(results: &ShakedownResults) -> Vec<(&'static str, String)> {
    vec![
        ("residual-stress.svg", residual_stress(results)),
        ("plastic-strain.svg", plastic_strain(results)),
        ("passes.svg", passes(results)),
        ("passes-change.svg", passes_change(results)),
        ("bounds.svg", bounds(results)),
        ("shakedown-map.svg", map(results)),
        ("dang-van.svg", dang_van(results)),
        ("field.svg", rolled_field(results)),
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
fn shown_depth(results: &ShakedownResults) -> f64 {
    let flown = |layer: &&LayerState| layer.strain.equivalent() > 0.0;
    let deepest = results.stabilised.profile.iter().rfind(flown).map_or(0.0, |layer| layer.depth);
    (1.2 * deepest).max(2.0 * results.rail.contact.half_width)
}

/// Values along x, depth downwards.
fn by_depth(results: &ShakedownResults, shows: &str, x_title: Vec<Span>, lines: Vec<Line>) -> String {
    let depth = shown_depth(results);
    let values = lines.iter().flat_map(|line| &line.points).filter(|p| p[1] <= depth).map(|p| p[0]);
    LinePicture {
        title: &results.title,
        shows: plain(&format!("{shows} · {}", results.stabilised.state.name())),
        x_title,
        y_title: plain("Depth  (mm)"),
        x: Axis::around(values.chain([0.0]), 8),
        y: Axis::exact(depth, 0.0, 10),
        size: [460.0, 420.0],
        lines,
    }
    .draw()
}

fn of_layers(results: &ShakedownResults, value: impl Fn(&LayerState) -> f64) -> Vec<[f64; 2]> {
    results.stabilised.profile.iter().map(|layer| [value(layer), layer.depth]).collect()
}

fn residual_stress(results: &ShakedownResults) -> String {
    let mut lines = vec![
        line(of_layers(results, |layer| layer.stress.xx), 0, "σxx, along the rail"),
        line(of_layers(results, |layer| layer.stress.zz), 1, "σzz, out of plane"),
    ];
    if let Some(other) = &results.pass_by_pass {
        for (component, colour, words) in [(0, 0, "σxx, pass by pass"), (1, 1, "σzz, pass by pass")] {
            let point = |layer: &LayerState| [[layer.stress.xx, layer.stress.zz][component], layer.depth];
            let points = other.profile.iter().map(point).collect();
            lines.push(Line { stroke: stroke(colour, "6 4"), ..line(points, colour, words) });
        }
    }
    if results.rail.initial.is_some() {
        let initial = |layer: &LayerState| results.rail.initial_stress(layer.depth);
        let points = of_layers(results, |layer| initial(layer).xx);
        lines.push(Line { stroke: stroke(2, "2 3"), ..line(points, 2, "σxx of manufacturing") });
    }
    by_depth(results, "Residual stress", plain("Residual stress  (MPa)"), lines)
}

fn plastic_strain(results: &ShakedownResults) -> String {
    let lines = vec![
        line(of_layers(results, |layer| 1e3 * layer.strain.xx), 0, "εp xx"),
        line(of_layers(results, |layer| 1e3 * layer.strain.yy), 1, "εp yy"),
        line(of_layers(results, |layer| 1e3 * layer.strain.zz), 2, "εp zz"),
        line(of_layers(results, |layer| 1e3 * layer.strain.xy), 3, "εp xy"),
        Line {
            stroke: stroke(6, "6 4"),
            ..line(of_layers(results, |layer| 1e3 * layer.plastic_per_pass), 6, "path per passage")
        },
    ];
    by_depth(results, "Plastic strain", plain("Plastic strain  (10⁻³)"), lines)
}

/// Words of the legend and what of a passage they are for.
type Named = (&'static str, fn(&PassRecord) -> f64);

fn over_passes(results: &ShakedownResults, shows: &str, y_title: &str, named: &[Named]) -> String {
    let passes = &results.stabilised.passes;
    let of = |(colour, (words, value)): (usize, &Named)| Line {
        dots: Dots::Shown,
        ..line(passes.iter().map(|pass| [pass.pass as f64, value(pass)]).collect(), colour, words)
    };
    let lines: Vec<Line> = named.iter().enumerate().map(of).collect();
    let values = lines.iter().flat_map(|line| &line.points).map(|p| p[1]);
    LinePicture {
        title: &results.title,
        shows: plain(&format!("{shows} · {}", results.stabilised.state.name())),
        x_title: plain("Passage"),
        y_title: plain(y_title),
        x: Axis::exact(0.0, passes.len() as f64 + 1.0, 12),
        y: Axis::around(values, 8),
        size: [560.0, 340.0],
        lines,
    }
    .draw()
}

fn passes(results: &ShakedownResults) -> String {
    over_passes(
        results,
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

fn passes_change(results: &ShakedownResults) -> String {
    over_passes(
        results,
        "Change of the residual stress by each passage",
        "log10 of the change  (MPa)",
        &[("σxx or σzz", |pass| pass.stress_change.max(SMALLEST).log10())],
    )
}

fn bounds(results: &ShakedownResults) -> String {
    let a = results.rail.contact.half_width;
    let ratio = results.rail.pressure_ratio();
    // Far down everything is borne: no more of it than makes the scale readable.
    let most = 2.5 * ratio.max(3.0);
    let curve = |value: fn(&DepthBounds) -> f64| -> Vec<[f64; 2]> {
        results.bounds.iter().map(|b| [value(b).min(most), b.depth_over_a * a]).collect()
    };
    let deepest = results.bounds.last().map_or(a, |b| b.depth_over_a * a);
    let lines = vec![
        line(curve(|b| b.first_yield), 4, "first yield"),
        line(curve(|b| b.shakedown), 0, "limit of elastic shakedown"),
        Line {
            stroke: stroke(1, "6 4"),
            ..line(vec![[ratio, 0.0], [ratio, deepest]], 1, "p0/k of the case")
        },
    ];
    LinePicture {
        title: &results.title,
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
    .draw()
}

fn map(results: &ShakedownResults) -> String {
    let here = [results.rail.contact.friction.abs(), results.rail.pressure_ratio()];
    let most = results.map.last().map_or(0.5, |point| point.friction);
    let lines = vec![
        line(results.map.iter().map(|p| [p.friction, p.first_yield]).collect(), 4, "first yield"),
        line(
            results.map.iter().map(|p| [p.friction, p.shakedown]).collect(),
            0,
            "limit of elastic shakedown",
        ),
        Line { dots: Dots::Shown, ..line(vec![here], 1, "the case") },
    ];
    let highest = results.map.iter().map(|p| p.shakedown).fold(here[1], f64::max);
    LinePicture {
        title: &results.title,
        shows: plain("Shakedown map: elastic, elastic shakedown, plastic shakedown from below"),
        x_title: vec![Span::plain("Friction |"), Span::Italic("μ"), Span::Sub("w"), Span::plain("|")],
        y_title: vec![Span::Italic("p"), Span::Sub("0"), Span::plain(" / "), Span::Italic("k")],
        x: Axis::exact(0.0, most, 10),
        y: Axis::exact(0.0, 1.15 * highest, 10),
        size: [520.0, 380.0],
        lines,
    }
    .draw()
}

fn dang_van(results: &ShakedownResults) -> String {
    let limit = results.dang_van.limit;
    let depth = shown_depth(results);
    let values = results.initiation.by_depth.iter().map(|at| [at.worst.value, at.depth]).collect();
    let lines = vec![
        Line { dots: Dots::Hidden, ..line(values, 0, "largest τ + a p_h") },
        Line { stroke: stroke(1, "6 4"), ..line(vec![[limit, 0.0], [limit, depth]], 1, "b") },
    ];
    by_depth(results, "Dang Van criterion", plain("τ + a p_h  (MPa)"), lines)
}
