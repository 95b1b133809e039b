//! K_I and K_II against the wheel position.

use super::{HEADING, draw_heading, wheel_position};
use crate::svg::{
    Axes, Axis, CATEGORIES, Entry, Frame, Mark, Span, Stroke, Svg, draw_legend, legend_width, sequence,
};
use railcrack_run::Summary;
use railcrack_run::histories::History;

/// The most entries of a legend: further tips are told by their colour's place in the order.
const LEGEND_ENTRIES: usize = 18;

pub(super) fn mode_1(summary: &Summary, histories: &[&History]) -> String {
    sif_plot(summary, histories, "I", |history| &history.ki)
}

pub(super) fn mode_2(summary: &Summary, histories: &[&History]) -> String {
    sif_plot(summary, histories, "II", |history| &history.kii)
}

/// A line of the plot and its words in the legend.
struct Curve<'a> {
    history: &'a History,
    stroke: Stroke,
    words: String,
}

fn sif_plot(
    summary: &Summary,
    histories: &[&History],
    mode: &'static str,
    k: fn(&History) -> &[f64],
) -> String {
    let curves = curves(histories);
    let entries = entries(&curves);
    let frame = Frame { left: 72.0, top: HEADING, width: 600.0, height: 360.0 };
    let width = frame.right() + 18.0 + legend_width(&entries).max(40.0);
    let height = (frame.bottom() + 56.0).max(HEADING + 20.0 + 18.0 * entries.len() as f64);
    let mut svg = Svg::new(width, height);
    let symbol = [Span::Italic("K"), Span::Sub(mode)];
    let mut shows = symbol.to_vec();
    shows.push(Span::plain(" of the stabilised passage"));
    draw_heading(&mut svg, frame.left, width - frame.left, summary, &shows);
    let (first, last) = ends(histories);
    let axes = Axes {
        frame,
        x: Axis::exact(first, last, 13),
        y: Axis::around(histories.iter().flat_map(|history| k(history).iter().copied()).chain([0.0]), 8),
    };
    axes.draw_grid(&mut svg);
    axes.clip(&mut svg);
    for curve in &curves {
        let points: Vec<[f64; 2]> =
            curve.history.xc_over_a.iter().zip(k(curve.history)).map(|(&x, &k)| axes.at(x, k)).collect();
        svg.polyline("series", &points, &curve.stroke);
    }
    svg.unclip();
    let mut y_title = symbol.to_vec();
    y_title.push(Span::plain("  (MPa\u{221a}m)"));
    axes.draw_frame(&mut svg, &wheel_position(), &y_title);
    draw_legend(&mut svg, [frame.right() + 16.0, frame.top], &entries);
    svg.finish(&format!("K_{mode} against the wheel position: {}", summary.title))
}

/// One colour per step for a single tip; for several tips one colour per tip, the last step dashed.
fn curves<'a>(histories: &[&'a History]) -> Vec<Curve<'a>> {
    let initial: Vec<(usize, usize)> =
        histories.iter().filter(|h| h.step == 0).map(|h| (h.crack, h.tip)).collect();
    let has_two_tips = histories.iter().any(|h| h.tip > 1);
    let steps: Vec<usize> = {
        let mut steps: Vec<usize> = histories.iter().map(|h| h.step).collect();
        steps.dedup();
        steps
    };
    let named = |history: &History| -> (Stroke, String) {
        let History { step, crack, tip, .. } = history;
        if initial.len() <= 1 {
            let place = steps.iter().position(|s| s == step).unwrap_or(0) as f64 / steps.len().max(2) as f64;
            let colour = sequence(place * 1.1);
            let words = if *step == 0 { "initial crack".to_owned() } else { format!("step {step}") };
            return (Stroke::solid(&colour, 1.8), words);
        }
        let place = initial.iter().position(|tip| *tip == (history.crack, history.tip)).unwrap_or(0);
        let colour = tip_colour(place, initial.len());
        let dashes = if *step == 0 { "" } else { "6 4" };
        let name = if has_two_tips { format!("crack {crack}, tip {tip}") } else { format!("crack {crack}") };
        let words = if *step == 0 { name } else { format!("{name}, step {step}") };
        (Stroke { dashes, ..Stroke::solid(&colour, 1.6) }, words)
    };
    let curve = |(history, (stroke, words))| Curve { history, stroke, words };
    histories.iter().map(|&history| (history, named(history))).map(curve).collect()
}

/// The colour of tip or crack `place` of `count`: distinct colours for a few, an ordered scale for many.
pub(super) fn tip_colour(place: usize, count: usize) -> String {
    if count <= CATEGORIES.len() {
        CATEGORIES[place.min(CATEGORIES.len() - 1)].to_owned()
    } else {
        sequence(place as f64 / (count - 1) as f64)
    }
}

/// All curves where they are few; otherwise the initial ones, evenly thinned, and a line that explains the dashes.
fn entries(curves: &[Curve]) -> Vec<Entry> {
    let entry = |curve: &Curve| Entry { mark: Mark::Line(curve.stroke.clone()), words: curve.words.clone() };
    let solid: Vec<&Curve> = curves.iter().filter(|curve| curve.stroke.dashes.is_empty()).collect();
    let Some(dashed) = curves.iter().find(|curve| !curve.stroke.dashes.is_empty()) else {
        return curves.iter().map(entry).collect();
    };
    let every = solid.len().div_ceil(LEGEND_ENTRIES).max(1);
    let mut entries: Vec<Entry> = solid.into_iter().step_by(every).map(entry).collect();
    let grey = |dashes| Mark::Line(Stroke { dashes, ..Stroke::solid("#444444", 1.6) });
    entries.push(Entry { mark: grey(""), words: "initial".to_owned() });
    entries.push(Entry { mark: grey("6 4"), words: format!("step {}", dashed.history.step) });
    entries
}

/// The smallest and largest x_c/a.
fn ends(histories: &[&History]) -> (f64, f64) {
    let all = histories.iter().flat_map(|history| history.xc_over_a.iter().copied());
    let ends = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    if ends.0 <= ends.1 { ends } else { (0.0, 0.0) }
}
