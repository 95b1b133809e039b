//! The crack paths of two runs to scale.

use super::paths::{draw_rail, equal_axes};
use super::shortened;
use crate::svg::{
    Anchor, BLUE, Entry, GREY, INK, Mark, Span, Stroke, Svg, TextStyle, draw_legend, legend_width,
};
use railcrack_run::CrackSummary;

/// Vermilion: told from blue by any eye.
pub(super) const SECOND: &str = "#d55e00";

/// Paths of the two runs called `names`; every run has its own cracks.
pub(crate) fn compared_paths(names: &[String; 2], cracks: [&[CrackSummary]; 2]) -> String {
    let all: Vec<CrackSummary> = cracks.concat();
    let axes = equal_axes(&all);
    let frame = axes.frame;
    let [first, second] = strokes();
    let entries = [
        Entry { mark: Mark::Line(Stroke::solid(INK, 3.2)), words: "initial crack".to_owned() },
        Entry { mark: Mark::Dotted(first.clone()), words: shortened(&names[0], 40.0) },
        Entry { mark: Mark::Dotted(second.clone()), words: shortened(&names[1], 40.0) },
    ];
    let width = frame.right() + 20.0 + legend_width(&entries);
    let mut svg = Svg::new(width, frame.bottom() + 56.0);
    draw_compared_heading(
        &mut svg,
        frame.left,
        "Crack paths of two runs",
        "to scale, a dot at the end of each increment",
    );
    draw_rail(&mut svg, &axes);
    axes.draw_grid(&mut svg);
    axes.clip(&mut svg);
    let at = |points: &[[f64; 2]]| -> Vec<[f64; 2]> { points.iter().map(|[x, y]| axes.at(*x, -y)).collect() };
    for ((cracks, stroke), radius) in cracks.into_iter().zip([&first, &second]).zip([3.0, 1.8]) {
        for crack in cracks {
            let grown = at(&crack.points_mm);
            svg.polyline("series", &grown, stroke);
            for (point, place) in crack.points_mm.iter().zip(grown) {
                if !crack.initial_points_mm.contains(point) {
                    svg.dot(place, radius, &stroke.colour);
                }
            }
        }
    }
    for crack in &all {
        svg.polyline("initial", &at(&crack.initial_points_mm), &Stroke::solid(INK, 3.2));
    }
    svg.unclip();
    let [_, surface] = axes.at(0.0, 0.0);
    let line = [[frame.left, surface], [frame.right(), surface]];
    svg.polyline("surface", &line, &Stroke::solid(INK, 2.2));
    axes.draw_frame(&mut svg, &[Span::Italic("x"), Span::plain("  (mm)")], &[Span::plain("Depth  (mm)")]);
    draw_legend(&mut svg, [frame.right() + 16.0, frame.top], &entries);
    svg.finish(&format!("Crack paths: {} and {}", names[0], names[1]))
}

/// Lines of the first and the second run: the first is seen below the second where they agree.
fn strokes() -> [Stroke; 2] {
    [Stroke::solid(BLUE, 3.4), Stroke { dashes: "6 4", ..Stroke::solid(SECOND, 1.6) }]
}

/// What a plot of two runs shows, and how.
pub(super) fn draw_compared_heading(svg: &mut Svg, left: f64, shows: &str, how: &str) {
    let bold = TextStyle { size: 15.0, anchor: Anchor::Start, colour: INK, weight: "bold" };
    let quiet = TextStyle { size: 12.0, anchor: Anchor::Start, colour: GREY, weight: "normal" };
    svg.text([left, 24.0], &[Span::plain(shows)], bold);
    svg.text([left, 43.0], &[Span::plain(how)], quiet);
}
