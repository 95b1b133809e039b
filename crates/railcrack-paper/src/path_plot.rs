//! Paths to scale: both bodies, both ways of travel.

use super::figure::Figure;
use super::sif_plot::main_setups;
use super::{CURVES, CrackGrowth, Results};
use railcrack_report::svg::{
    Anchor, Axes, Axis, CATEGORIES, Entry, Frame, GREY, INK, Mark, Span, Stroke, Svg, TextStyle, draw_legend,
    legend_width,
};

const WIDTH: f64 = 430.0;
const LEFT: f64 = 66.0;
const TOP: f64 = 78.0;
const GAP: [f64; 2] = [66.0, 66.0];

struct Line<'a> {
    words: &'static str,
    colour: &'static str,
    crack: &'a CrackGrowth,
}

/// The picture of `figure`.
pub(super) fn draw(figure: &Figure, results: &Results) -> String {
    let panels: Vec<(&'static str, Vec<Line>)> = main_setups()
        .filter_map(|name| {
            let lines = lines(figure, results, name);
            (!lines.is_empty()).then_some((name, lines))
        })
        .collect();
    let mut entries =
        vec![Entry { mark: Mark::Line(Stroke::solid(INK, 3.0)), words: "initial crack".into() }];
    for line in panels.iter().flat_map(|(_, lines)| lines) {
        if !entries.iter().any(|entry| entry.words == line.words) {
            let mark = Mark::Dotted(Stroke::solid(line.colour, 1.6));
            entries.push(Entry { mark, words: line.words.to_owned() });
        }
    }
    let points = || panels.iter().flat_map(|(_, lines)| lines).flat_map(|line| &line.crack.points);
    let (low, high) =
        points().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| (l.min(p[0]), h.max(p[0])));
    let (low, high) = if low < high { (low - 1.0, high + 1.0) } else { (-1.0, 1.0) };
    let deep = points().fold(1.0, |deep: f64, p| deep.max(p[1])) + 1.0;
    const ABOVE: f64 = 0.4;
    let height = WIDTH * (deep + ABOVE) / (high - low);
    let rows = panels.len().div_ceil(2).max(1);
    let right = LEFT + 2.0 * WIDTH + GAP[0];
    let bottom = TOP + rows as f64 * (height + GAP[1]) - GAP[1];
    let legend_height = TOP + 20.0 + 18.0 * entries.len() as f64;
    let mut svg = Svg::new(right + 24.0 + legend_width(&entries), (bottom + 56.0).max(legend_height));
    let bold = TextStyle { size: 15.0, anchor: Anchor::Start, colour: INK, weight: "bold" };
    let quiet = TextStyle { size: 12.0, anchor: Anchor::Start, colour: GREY, weight: "normal" };
    let text = format!("Trollé et al. (2014), Fig. {} recomputed: {}", figure.number, figure.title);
    svg.text([LEFT, 24.0], &[Span::Plain(text)], bold);
    for (i, (name, lines)) in panels.iter().enumerate() {
        let frame = Frame {
            left: LEFT + (i % 2) as f64 * (WIDTH + GAP[0]),
            top: TOP + (i / 2) as f64 * (height + GAP[1]),
            width: WIDTH,
            height,
        };
        let ticks = (height / 40.0) as usize + 2;
        let axes = Axes { frame, x: Axis::exact(low, high, 9), y: Axis::exact(deep, -ABOVE, ticks) };
        let arrow =
            if name.ends_with("against") { "wheel runs to the left" } else { "wheel runs to the right" };
        let title = format!("{}: {arrow}", name.split(',').next().unwrap_or(name));
        svg.text([frame.left, frame.top - 10.0], &[Span::Plain(title)], quiet);
        panel(&mut svg, &axes, lines);
    }
    draw_legend(&mut svg, [right + 16.0, TOP], &entries);
    svg.finish(&format!("Fig. {}: {}", figure.number, figure.title))
}

fn lines<'a>(figure: &Figure, results: &'a Results, setup: &str) -> Vec<Line<'a>> {
    let Some(r) = results.setup(setup) else { return Vec::new() };
    let mut lines = Vec::new();
    for (place, name) in figure.curves.iter().enumerate() {
        let (Some(curve), Some(run)) = (CURVES.iter().find(|curve| curve.name == *name), r.grown(name))
        else {
            continue;
        };
        let words = figure.words(curve);
        let colour = CATEGORIES[place % CATEGORIES.len()];
        lines.extend(run.cracks.iter().map(|crack| Line { words, colour, crack }));
    }
    lines
}

fn panel(svg: &mut Svg, axes: &Axes, lines: &[Line]) {
    let frame = axes.frame;
    let [_, surface] = axes.at(0.0, 0.0);
    svg.rectangle([frame.left, surface, frame.width, frame.bottom() - surface], "#f6f5f2", "none");
    axes.draw_grid(svg);
    axes.clip(svg);
    for line in lines {
        let at =
            |points: &[[f64; 2]]| -> Vec<[f64; 2]> { points.iter().map(|p| axes.at(p[0], p[1])).collect() };
        svg.polyline(
            "initial",
            &at(&line.crack.points[..line.crack.initial_points]),
            &Stroke::solid(INK, 3.0),
        );
    }
    for line in lines {
        let grown: Vec<[f64; 2]> =
            line.crack.points[line.crack.initial_points - 1..].iter().map(|p| axes.at(p[0], p[1])).collect();
        svg.polyline("series", &grown, &Stroke::solid(line.colour, 1.6));
        for &point in &grown[1..] {
            svg.dot(point, 1.8, line.colour);
        }
    }
    svg.unclip();
    svg.polyline("surface", &[[frame.left, surface], [frame.right(), surface]], &Stroke::solid(INK, 2.0));
    axes.draw_frame(svg, &[Span::Italic("x"), Span::plain("  (mm)")], &[Span::plain("Depth  (mm)")]);
}

/// The columns of a table of paths.
pub const PATH_FIGURE_COLUMNS: &str = "setup,curve,crack,point,x_mm,depth_mm";

/// The table of `figure`: every path that it shows in every set-up.
pub(super) fn table(figure: &Figure, results: &Results) -> String {
    let mut text = format!("{PATH_FIGURE_COLUMNS}\n");
    for r in results.setups() {
        for name in figure.curves {
            let Some(run) = r.grown(name) else { continue };
            for (i, crack) in run.cracks.iter().enumerate() {
                for (p, [x, depth]) in crack.points.iter().enumerate() {
                    text.push_str(&format!("\"{}\",{name},{},{p},{x:?},{depth:?}\n", r.setup().name, i + 1));
                }
            }
        }
    }
    text
}
