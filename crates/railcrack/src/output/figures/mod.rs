//! The plots of a run, built from its folder alone.

mod compare_paths;
mod compare_sif;
mod cycles;
mod faces;
mod lines;
mod paths;
mod rolled_field;
mod shakedown;
mod sif;
mod stored;
mod study;

use super::csv::read_growth;
use super::folder::{SUMMARY_FILE, read_if_there};
use super::plot::{Anchor, GREY, INK, Span, Svg, TextStyle};
use super::report::write_plots;
use super::{OutputError, Summary};
use rayon::prelude::*;
use std::path::Path;
use stored::{chosen_steps, read_faces};

pub(crate) use compare_paths::compared_paths;
pub(crate) use compare_sif::{ComparedTip, compared_sifs};
pub(crate) use stored::{History, read_histories};
pub(crate) use study::{STUDY_PLOTS, study_plots};

pub(crate) const PLOTS_FOLDER: &str = "plots";

pub(crate) use shakedown::{ShakedownPlot, shakedown_plots};

/// Every file that [`run_plots`] and [`shakedown_plots`] may write.
pub(crate) const PLOT_FILES: [&str; 14] = [
    "ki.svg",
    "kii.svg",
    "paths.svg",
    "length-cycles.svg",
    "faces.svg",
    "faces-last.svg",
    "residual-stress.svg",
    "plastic-strain.svg",
    "passes.svg",
    "passes-change.svg",
    "bounds.svg",
    "shakedown-map.svg",
    "dang-van.svg",
    "field.svg",
];

/// The plots of the run in `folder` (file name and SVG), from its tables and `summary.json`, for the steps that the
/// summary counts. A run without a finished step has none.
///
/// Errors: no run in the folder; a file of it is damaged; the system refuses.
pub(crate) fn run_plots(folder: &Path) -> Result<Vec<(&'static str, String)>, OutputError> {
    let path = folder.join(SUMMARY_FILE);
    let Some(text) = read_if_there(&path)? else {
        return Err(OutputError::NoRun { folder: folder.to_path_buf() });
    };
    let summary: Summary =
        serde_json::from_slice(&text).map_err(|reason| OutputError::damaged(&path, reason.to_string()))?;
    if summary.steps_recorded == 0 {
        return Ok(Vec::new());
    }
    let growth = read_growth(folder, summary.steps_recorded)?;
    let steps = chosen_steps(&growth);
    let histories = read_histories(folder, &steps)?;
    let last = summary.steps_recorded - 1;
    let mut plots = vec![
        ("ki.svg", sif::mode_1(&summary, &histories)),
        ("kii.svg", sif::mode_2(&summary, &histories)),
        ("paths.svg", paths::paths(&summary)),
        ("length-cycles.svg", cycles::length_against_cycles(&summary, &growth)),
    ];
    let shown =
        if last > 0 { vec![("faces.svg", 0), ("faces-last.svg", last)] } else { vec![("faces.svg", 0)] };
    let maps: Result<Vec<_>, OutputError> = shown
        .into_par_iter()
        .map(|(file, step)| {
            let map = read_faces(folder, step, &histories, &growth)?;
            Ok((file, faces::face_map(&summary, &map)))
        })
        .collect();
    plots.extend(maps?);
    Ok(plots)
}

/// Builds the plots of the run in `folder` and writes them to `plots/`.
///
/// Errors: no run in the folder; a file of it is damaged; the system refuses.
pub fn rebuild_plots(folder: &Path) -> Result<(), OutputError> {
    write_plots(&folder.join(PLOTS_FOLDER), &run_plots(folder)?)
}

/// Height of the heading.
const HEADING: f64 = 58.0;

/// The title of the case and, below it, what the picture shows and for which model.
fn draw_heading(svg: &mut Svg, left: f64, room: f64, summary: &Summary, shows: &[Span]) {
    let Summary { engine, contact, boundary, .. } = summary;
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
