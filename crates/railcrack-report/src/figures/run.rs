//! The plots of a run.

use super::faces::{CrackMap, FaceMap, face_map};
use super::plot::Plot;
use super::sif::Mode;
use super::wheel_passage::near;
use super::{paths, row, sif};
use crate::page_data::{CrackFaces, PageData, StepFaces};
use crate::row::{CrackRow, NamedCrack, is_many, named};
use railcrack::words::Choice;
use railcrack_run::Summary;
use railcrack_run::csv::{TipRow, deferred_growth};
use railcrack_run::run_folder::History;

/// Maximum number of steps shown for a single tip; for several tips only the first and the last
/// step are shown.
const DRAWN_STEPS: usize = 5;

/// The plots of a run from its `summary`, the rows of `growth.csv`, what a page shows of the other
/// tables, and the half-widths of the contacts of its wheels (mm). A run without a finished step
/// has none.
pub(crate) fn run_plots(
    summary: &Summary,
    growth: &[TipRow],
    page_data: &PageData,
    half_widths: &[f64],
) -> Vec<Plot> {
    if summary.steps_recorded == 0 {
        return Vec::new();
    }
    let model = format!(
        "{}, engine {}, contact {}",
        summary.boundary.word(),
        summary.engine.word(),
        summary.contact.word()
    );
    let row = is_many(summary.cracks.len()).then(|| CrackRow::of(&summary.cracks, growth)).flatten();
    let named: Option<Vec<NamedCrack>> = row.as_ref().map(named);
    let named = named.as_deref();
    let steps = chosen_steps(&page_data.steps(), page_data.histories(0).len());
    let histories: Vec<&History> = steps.into_iter().flat_map(|step| page_data.histories(step)).collect();
    let mut plots: Vec<Plot> =
        Mode::BOTH.iter().map(|&mode| sif::plot(summary, &model, &histories, named, mode)).collect();
    plots.extend(sif::fluid(summary, &model, &histories, named));
    plots.extend(sif::under_wheels(summary, &model, growth, page_data, half_widths));
    plots.push(match &row {
        Some(row) => paths::strips(summary, row, &model),
        None => paths::plot(summary, &model),
    });
    plots.push(paths::lengths(summary, growth, named, &model));
    if let Some((row, named)) = row.as_ref().zip(named) {
        plots.push(row::plot(summary, row, named, &model));
    }
    for (file, (step, faces)) in ["faces.svg", "faces-last.svg"].into_iter().zip(page_data.end_faces()) {
        plots.push(Plot::picture(
            file,
            face_map(&summary.title, &model, &map(summary, step, faces, growth, page_data, named)),
        ));
    }
    plots
}

/// Selection of the steps `shown`: evenly spaced for a single tip, first and last for several.
fn chosen_steps(shown: &[usize], tips: usize) -> Vec<usize> {
    let last = shown.len().saturating_sub(1);
    let count = if tips > 1 { 2 } else { DRAWN_STEPS };
    let parts = (count - 1).min(last).max(1);
    let mut places: Vec<usize> = (0..=parts).map(|part| (part * last + parts / 2) / parts).collect();
    places.dedup();
    places.into_iter().filter_map(|place| shown.get(place).copied()).collect()
}

/// The `faces` in `step`, whose positions and lengths are those of `shown` and `growth`.
fn map<'a>(
    summary: &Summary,
    step: usize,
    faces: &'a StepFaces,
    growth: &[TipRow],
    page_data: &'a PageData,
    named: Option<&[NamedCrack]>,
) -> FaceMap<'a> {
    let of_crack = |faces: &'a CrackFaces| {
        let rows = || growth.iter().filter(|row| row.step == step && row.crack == faces.crack);
        let deferred: f64 = rows().map(|row| deferred_growth(growth, row)).sum();
        // A crack that has joined others at all its ends has no row; its extent is slightly more
        // than its last point.
        let last = || faces.s.last().copied().unwrap_or(0.0);
        CrackMap { length: rows().next().map_or_else(last, |row| row.length - deferred), faces }
    };
    let is_named =
        |faces: &&CrackFaces| named.is_none_or(|named| named.iter().any(|named| named.crack == faces.crack));
    let xc_over_a: &[f64] = page_data.histories(step).first().map_or(&[], |history| &history.xc_over_a);
    FaceMap {
        step,
        xc_over_a,
        near: near(summary, xc_over_a),
        of: summary.cracks.len(),
        cracks: faces.cracks.iter().filter(is_named).map(of_crack).collect(),
    }
}
