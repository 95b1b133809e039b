//! K_I and K_II of two runs against the wheel position, and their differences.

use super::compare_paths::{SECOND, draw_compared_heading};
use super::sif::tip_colour;
use super::{HEADING, shortened, wheel_position};
use crate::svg::{Axes, Axis, BLUE, Entry, Frame, INK, Mark, Span, Stroke, Svg, draw_legend, legend_width};
use railcrack_run::compare::Aligned;

/// A tip of both runs, K at common positions.
pub(crate) struct ComparedTip<'a> {
    /// From 1.
    pub crack: usize,
    /// From 1 within its crack.
    pub tip: usize,
    /// K of both.
    pub aligned: &'a Aligned,
}

const PANEL: (f64, f64) = (420.0, 230.0);
/// Room between panels, for ticks and titles.
const GAPS: (f64, f64) = (92.0, 28.0);
const LEFT: f64 = 72.0;

/// The most entries of a legend: further tips are told by their colour's place in the order.
const LEGEND_TIPS: usize = 18;

/// K of the runs called `names` at `step`: K_I above, K_II below; on the right second minus first.
pub(crate) fn compared_sifs(step: usize, names: &[String; 2], tips: Vec<ComparedTip>) -> String {
    let entries = entries(names, &tips);
    let frame = |column: f64, row: f64| Frame {
        left: LEFT + column * (PANEL.0 + GAPS.0),
        top: HEADING + row * (PANEL.1 + GAPS.1),
        width: PANEL.0,
        height: PANEL.1,
    };
    let last = frame(1.0, 1.0);
    let width = last.right() + 18.0 + legend_width(&entries);
    let height = (last.bottom() + 56.0).max(HEADING + 20.0 + 18.0 * entries.len() as f64);
    let mut svg = Svg::new(width, height);
    let heading = format!("K of the stabilised passage at step {step}, two runs");
    draw_compared_heading(&mut svg, LEFT, &heading, "left: K of both; right: second minus first");
    for (row, mode, k) in [
        (0.0, "I", (|aligned| &aligned.ki) as fn(&Aligned) -> &[Vec<f64>; 2]),
        (1.0, "II", |aligned| &aligned.kii),
    ] {
        let symbol = [Span::Italic("K"), Span::Sub(mode), Span::plain("  (MPa\u{221a}m)")];
        let difference =
            [Span::Italic("K"), Span::Sub(mode), Span::plain(", second \u{2212} first  (MPa\u{221a}m)")];
        let x_title = if row > 0.0 { wheel_position() } else { Vec::new() };
        draw_panel(&mut svg, frame(0.0, row), [&x_title, &symbol], &both(&tips, k));
        draw_panel(&mut svg, frame(1.0, row), [&x_title, &difference], &differences(&tips, k));
    }
    draw_legend(&mut svg, [last.right() + 16.0, HEADING], &entries);
    svg.finish(&format!("K at step {step}: {} and {}", names[0], names[1]))
}

/// A line of a panel.
struct Curve<'a> {
    x: &'a [f64],
    y: Vec<f64>,
    stroke: Stroke,
}

/// The stroke of a tip in the first and in the second run. A single tip has a colour for each run; of several, each has
/// its colour, dashed in the second run.
fn strokes(place: usize, count: usize) -> [Stroke; 2] {
    if count == 1 {
        return [Stroke::solid(BLUE, 3.2), Stroke { dashes: "6 4", ..Stroke::solid(SECOND, 1.6) }];
    }
    let colour = tip_colour(place, count);
    [Stroke::solid(&colour, 1.6), Stroke { dashes: "6 4", ..Stroke::solid(&colour, 1.6) }]
}

fn both<'a>(tips: &'a [ComparedTip], k: fn(&Aligned) -> &[Vec<f64>; 2]) -> Vec<Curve<'a>> {
    let curves = tips.iter().enumerate().flat_map(|(place, tip)| {
        let runs = k(tip.aligned).iter().zip(strokes(place, tips.len()));
        runs.map(|(k, stroke)| Curve { x: &tip.aligned.xc_over_a, y: k.clone(), stroke })
    });
    curves.collect()
}

fn differences<'a>(tips: &'a [ComparedTip], k: fn(&Aligned) -> &[Vec<f64>; 2]) -> Vec<Curve<'a>> {
    let curve = |(place, tip): (usize, &'a ComparedTip)| {
        let [first, second] = k(tip.aligned);
        let y = first.iter().zip(second).map(|(first, second)| second - first).collect();
        let colour = if tips.len() == 1 { INK.to_owned() } else { tip_colour(place, tips.len()) };
        Curve { x: &tip.aligned.xc_over_a, y, stroke: Stroke::solid(&colour, 1.6) }
    };
    tips.iter().enumerate().map(curve).collect()
}

fn draw_panel(svg: &mut Svg, frame: Frame, [x_title, y_title]: [&[Span]; 2], curves: &[Curve]) {
    let all = curves.iter().flat_map(|curve| curve.x.iter().copied());
    let ends = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    let (low, high) = if ends.0 <= ends.1 { ends } else { (0.0, 0.0) };
    let axes = Axes {
        frame,
        x: Axis::exact(low, high, 9),
        y: Axis::around(curves.iter().flat_map(|curve| curve.y.iter().copied()).chain([0.0]), 6),
    };
    axes.draw_grid(svg);
    axes.clip(svg);
    for curve in curves {
        let points: Vec<[f64; 2]> = curve.x.iter().zip(&curve.y).map(|(&x, &y)| axes.at(x, y)).collect();
        svg.polyline("series", &points, &curve.stroke);
    }
    svg.unclip();
    axes.draw_frame(svg, x_title, y_title);
}

fn entries(names: &[String; 2], tips: &[ComparedTip]) -> Vec<Entry> {
    let runs = if tips.len() > 1 {
        let grey = Stroke::solid("#444444", 1.6);
        [grey.clone(), Stroke { dashes: "6 4", ..grey }]
    } else {
        strokes(0, 1)
    };
    let run =
        |(stroke, name): (Stroke, &String)| Entry { mark: Mark::Line(stroke), words: shortened(name, 40.0) };
    let mut entries: Vec<Entry> = runs.into_iter().zip(names).map(run).collect();
    if tips.len() > 1 {
        let every = tips.len().div_ceil(LEGEND_TIPS);
        entries.extend(tips.iter().enumerate().step_by(every).map(|(place, tip)| Entry {
            mark: Mark::Line(Stroke::solid(&tip_colour(place, tips.len()), 1.6)),
            words: format!("crack {}, tip {}", tip.crack, tip.tip),
        }));
    }
    entries
}
