//! The plots of a stabilised plastic state.

use super::plot::Plot;
use super::rolled_field::rolled_field;
use crate::chart::{Chart, ChartAxis, ChartRange, ChartSheet, Curve, CurveColour, CurveDots, CurveLook};
use crate::svg::around;
use railcrack::words::Choice;
use railcrack_run::shakedown::{BoundsRow, LayerRow, PassRow, ShakedownFolder};

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
    .map(of)
    .collect();
    plots.push(Plot::picture("field.svg", rolled_field(state)));
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
