//! The plots of a run.

mod compare_paths;
mod compare_sif;
mod cycles;
mod faces;
mod lines;
mod paths;
mod rolled_field;
mod shakedown;
mod sif;
mod study;

use crate::shown::{CrackFaces, ShownRun, StepFaces};
use crate::svg::{Anchor, GREY, INK, Span, Svg, TextStyle};
use faces::{CrackMap, FaceMap};
use railcrack_run::Summary;
use railcrack_run::Word;
use railcrack_run::csv::{TipRow, deferred_growth};
use railcrack_run::histories::History;

pub(crate) use compare_paths::compared_paths;
pub(crate) use compare_sif::{ComparedTip, compared_sifs};
pub(crate) use study::{STUDY_PLOTS, study_plots};

pub(crate) use shakedown::{ShakedownPlot, shakedown_plots};

/// The plots of a run (file name and SVG): its `summary`, the rows of `growth.csv`, and what is `shown` of the rest. A run without a finished step
/// has none.
pub(crate) fn run_plots(
    summary: &Summary,
    growth: &[TipRow],
    shown: &ShownRun,
) -> Vec<(&'static str, String)> {
    if summary.steps_recorded == 0 {
        return Vec::new();
    }
    let steps = chosen_steps(&shown.steps(), shown.histories(0).len());
    let histories: Vec<&History> = steps.into_iter().flat_map(|step| shown.histories(step)).collect();
    let maps = ["faces.svg", "faces-last.svg"].into_iter().zip(shown.end_faces());
    let map = |(file, (step, faces))| (file, faces::face_map(summary, &face_map(step, faces, growth, shown)));
    let mut plots = vec![
        ("ki.svg", sif::mode_1(summary, &histories)),
        ("kii.svg", sif::mode_2(summary, &histories)),
        ("paths.svg", paths::paths(summary)),
        ("length-cycles.svg", cycles::length_against_cycles(summary, growth)),
    ];
    plots.extend(maps.map(map));
    plots
}

/// The steps whose histories are drawn: evenly spaced ones of those that are `shown` for a single tip, first and last for several.
fn chosen_steps(shown: &[usize], tips: usize) -> Vec<usize> {
    let last = shown.len().saturating_sub(1);
    let count = if tips > 1 { 2 } else { DRAWN_STEPS };
    let parts = (count - 1).min(last).max(1);
    let mut places: Vec<usize> = (0..=parts).map(|part| (part * last + parts / 2) / parts).collect();
    places.dedup();
    places.into_iter().filter_map(|place| shown.get(place).copied()).collect()
}

/// The `faces` at `step`, whose positions and lengths are those of `shown` and `growth`.
fn face_map<'a>(step: usize, faces: &'a StepFaces, growth: &[TipRow], shown: &'a ShownRun) -> FaceMap<'a> {
    let of_crack = |faces: &'a CrackFaces| {
        let rows = || growth.iter().filter(|row| row.step == step && row.crack == faces.crack);
        let waiting: f64 = rows().map(|row| deferred_growth(growth, row)).sum();
        // A crack that has joined others at all its ends has no row: it reaches to a little beyond its last point.
        let last = || faces.s.last().copied().unwrap_or(0.0);
        CrackMap { length: rows().next().map_or_else(last, |row| row.length - waiting), faces }
    };
    FaceMap {
        step,
        xc_over_a: shown.histories(step).first().map_or(&[], |history| &history.xc_over_a),
        cracks: faces.cracks.iter().map(of_crack).collect(),
    }
}

/// Steps at which the histories of a single tip are drawn, at most.
const DRAWN_STEPS: usize = 5;

/// Height of the heading.
const HEADING: f64 = 58.0;

/// The title of the case and, below it, what the picture shows and for which model.
fn draw_heading(svg: &mut Svg, left: f64, room: f64, summary: &Summary, shows: &[Span]) {
    let (engine, contact, boundary) =
        (summary.engine.name(), summary.contact.name(), summary.boundary.word());
    let mut spans = shows.to_vec();
    spans.push(Span::Plain(format!(" \u{b7} {boundary}, engine {engine}, contact {contact}")));
    draw_title(svg, left, room, &summary.title, &spans);
}

/// The title of the case and, below it, what the picture shows.
fn draw_title(svg: &mut Svg, left: f64, room: f64, title: &str, shows: &[Span]) {
    let bold = TextStyle { size: 15.0, anchor: Anchor::Start, colour: INK, weight: "bold" };
    let quiet = TextStyle { size: 12.0, anchor: Anchor::Start, colour: GREY, weight: "normal" };
    svg.text([left, 24.0], &[Span::Plain(shortened(title, room / 8.6))], bold);
    svg.text([left, 43.0], shows, quiet);
}

/// `text` cut to about `letters` letters.
fn shortened(text: &str, letters: f64) -> String {
    let most = letters.max(8.0) as usize;
    if text.chars().count() <= most {
        return text.to_owned();
    }
    let mut short: String = text.chars().take(most - 1).collect();
    short.truncate(short.trim_end().len());
    short.push('\u{2026}');
    short
}

/// `x_c / a`, from the mouth of the first crack.
fn wheel_position() -> Vec<Span> {
    vec![
        Span::plain("Wheel position  "),
        Span::Italic("x"),
        Span::Sub("c"),
        Span::plain(" / "),
        Span::Italic("a"),
        Span::plain("  (from the mouth of the first crack)"),
    ]
}
