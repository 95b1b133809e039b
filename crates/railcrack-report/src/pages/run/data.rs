//! Data of the passage explorer.

use super::stored::RunFolder;
use super::wheels::{PassedWheel, wheels};
use crate::figures::origin;
use crate::numbers::{number, numbers};
use crate::page_data::{CrackWindows, PageData, Quantised};
use crate::row::NamedCrack;
use railcrack::growth::{RunStop, TipStop};
use railcrack::words::Choice;
use railcrack_run::csv::TipRow;
use railcrack_run::run_folder::History;
use serde_json::{Value, json};
use std::ops::Range;

/// Maximum number of values of K of many cracks on a page (tips × positions × steps), of about
/// three bytes each; twice as many of a mix.
const VALUES: usize = 200_000;

/// The data of the explorer. For many cracks, K at wheel positions near each of them, and the faces
/// of the `named` ones.
pub(super) fn explorer(run: &RunFolder, page_data: &PageData, named: Option<&[NamedCrack]>) -> Value {
    let summary = &run.summary;
    let wheels = wheels(run, page_data, named);
    let seen: Option<Vec<CrackWindows>> =
        named.map(|named| wheels.iter().map(|wheel| wheel.windows_of(named)).collect());
    let others = page_data.other_faces(seen.as_deref());
    let faces = |wheel: usize, step: usize| match (wheel, seen.as_ref().and_then(|seen| seen.first())) {
        (0, Some(windows)) => json!(page_data.faces_of(step, windows)),
        (0, None) => json!(page_data.faces(step)),
        _ => json!(others.under(wheel, step)),
    };
    let steps: Vec<Value> = explored_steps(run, page_data, named)
        .into_iter()
        .map(|step| {
            let of_wheel = |(number, wheel): (usize, &PassedWheel)| {
                json!({
                    "histories": histories(run, page_data, (number, wheel), step),
                    "faces": faces(number, step),
                    "contact": page_data.contact(number, step),
                })
            };
            json!({
                "step": step,
                "cracks": polylines(run, step),
                "lines": worn(run, step, Until::Now),
                "whole": worn(run, step, Until::Last),
                "tips": tips(run, step),
                "wheels": wheels.iter().enumerate().map(of_wheel).collect::<Vec<_>>(),
            })
        })
        .collect();
    let stride = |number: usize| if number == 0 { page_data.face_stride() } else { others.stride };
    json!({
        "wheels": wheels.iter().enumerate().map(|(i, wheel)| wheel.page_data(stride(i))).collect::<Vec<_>>(),
        "named": named.map(|named| named.iter().map(|named| named.crack).collect::<Vec<_>>()),
        "origin": origin(summary),
        "axle_load": run.case.axle_load,
        "last_step": summary.steps_recorded.saturating_sub(1),
        "cracks": (1..=summary.cracks.len()).map(|crack| json!({
            "points": with_tips(run, crack).iter().map(|p| numbers(*p)).collect::<Vec<_>>(),
        })).collect::<Vec<_>>(),
        "mouths": numbers((1..=summary.cracks.len()).map(|crack| mouth(run, crack))),
        "pieces": pieces(run),
        "junctions": junctions(run),
        "steps": steps,
    })
}

/// Where a crack begins along the rail, mm.
pub(super) fn mouth(run: &RunFolder, crack: usize) -> f64 {
    crate::figures::mouth(&run.summary, crack).unwrap_or(0.0)
}

/// The steps of the explorer: those `shown`, or as many of them as fit for many cracks.
pub(super) fn explored_steps(
    run: &RunFolder,
    page_data: &PageData,
    named: Option<&[NamedCrack]>,
) -> Vec<usize> {
    let steps = page_data.steps();
    if named.is_none() {
        return steps;
    }
    let wheels = wheels(run, page_data, named);
    let of_tip = |wheel: &PassedWheel, crack: usize| wheel.window(crack).map_or(0, Range::len);
    let all = wheels.iter().zip(page_data.by_wheel(0));
    let values: usize =
        all.flat_map(|(wheel, histories)| histories.iter().map(|history| of_tip(wheel, history.crack))).sum();
    let most = wheels.len().clamp(1, 2) * VALUES;
    let mut every = 1;
    while steps.len().div_ceil(every) * values > most && every < steps.len() {
        every *= 2;
    }
    let is_shown = |place: &usize| place.is_multiple_of(every) || place + 1 == steps.len();
    (0..steps.len()).filter(is_shown).map(|place| steps[place]).collect()
}

/// Of every crack the first and the last of its final points that it has in `step`. An end without
/// a tip is that of the final crack: a mouth, or where the crack has joined another one.
fn polylines(run: &RunFolder, step: usize) -> Value {
    let of_crack = |(i, crack): (usize, &railcrack_run::CrackSummary)| {
        let points = with_tips(run, i + 1);
        let mut ends = [0, points.len().saturating_sub(1)];
        for row in run.growth.iter().filter(|row| (row.step, row.crack) == (step, i + 1)) {
            let first = run.history(row.crack, row.tip).next().unwrap_or(row);
            // Which end of the crack is the tip's, the initial crack says.
            let end = usize::from(nearest(&crack.initial_points_mm, first.place) > 0);
            ends[end] = nearest(&points, row.place);
        }
        ends
    };
    run.summary.cracks.iter().enumerate().map(of_crack).map(|ends| json!(ends)).collect()
}

/// The final path of `crack` with a point at its tip of every step: a path that goes straight ahead
/// has none there.
fn with_tips(run: &RunFolder, crack: usize) -> Vec<[f64; 2]> {
    let Some(summary) = run.summary.cracks.get(crack - 1) else { return Vec::new() };
    let mut points = summary.path_mm.as_ref().unwrap_or(&summary.points_mm).clone();
    for row in run.growth.iter().filter(|row| row.crack == crack) {
        // A path under wear is that below the surface as it was at the beginning.
        let removed = row.removed.filter(|_| summary.path_mm.is_some()).unwrap_or(0.0);
        let tip = [row.place[0], row.place[1] - removed];
        let on = points.windows(2).position(|ends| passes(ends, tip));
        points.splice(on.map_or(0..0, |at| at + 1..at + 1), on.map(|_| tip));
    }
    points
}

/// Whether the segment between two points passes a `place` that is neither of them.
fn passes(ends: &[[f64; 2]], place: [f64; 2]) -> bool {
    let &[from, to] = ends else { return false };
    let along = [to[0] - from[0], to[1] - from[1]];
    let off = [place[0] - from[0], place[1] - from[1]];
    let length = along[0].hypot(along[1]);
    let s = (off[0] * along[0] + off[1] * along[1]) / length;
    let away = (off[0] * along[1] - off[1] * along[0]).abs() / length;
    away < ON_PATH && s > ON_PATH && s < length - ON_PATH
}

/// Distance (mm) from a path up to which a point lies on it: the digits of its file.
const ON_PATH: f64 = 1e-6;

/// Extent of a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Until {
    /// To its tip in the step.
    Now,
    /// To that of the last step.
    Last,
}

/// Every crack below the worn surface of `step`; null without wear.
fn worn(run: &RunFolder, step: usize, until: Until) -> Option<Vec<Vec<Value>>> {
    let removed = run.growth.iter().find(|row| row.step == step)?.removed?;
    run.summary.cracks.iter().any(|crack| crack.path_mm.is_some()).then_some(())?;
    let of_crack = |crack: usize| {
        let path: Vec<[f64; 2]> = with_tips(run, crack).into_iter().map(|[x, y]| [x, y + removed]).collect();
        let row = run.growth.iter().rfind(|row| (row.step, row.crack) == (step, crack));
        let row = row.filter(|_| until == Until::Now);
        let last = row.map_or(path.len() - 1, |row| nearest(&path, row.place));
        let below = |i: usize| path[i][1] < 0.0;
        let from = (0..=last).find(|&i| below(i)).unwrap_or(last);
        let mouth = from.checked_sub(1).map(|above| {
            let (a, b) = (path[above], path[from]);
            let share = if a[1] == b[1] { 1.0 } else { a[1] / (a[1] - b[1]) };
            [a[0] + share * (b[0] - a[0]), 0.0]
        });
        let points = mouth.into_iter().chain(path[from..=last].iter().copied());
        points.map(|p| json!(numbers(p))).collect()
    };
    Some((1..=run.summary.cracks.len()).map(of_crack).collect())
}

/// The enclosed pieces and the cracks that have joined others, with the first step in which they
/// occur.
pub(super) fn pieces(run: &RunFolder) -> Value {
    let piece = |piece: &railcrack_run::PieceSummary| {
        json!({
            "kind": piece.kind.word(),
            "crack": piece.crack,
            "step": piece.step + 1,
            "area": number(piece.area_mm2),
            "outline": piece.outline_mm.iter().map(|p| numbers(*p)).collect::<Vec<_>>(),
        })
    };
    run.summary.pieces.iter().map(piece).collect()
}

fn junctions(run: &RunFolder) -> Value {
    let junction = |junction: &railcrack_run::JunctionSummary| {
        let last = run.growth.iter().filter(|row| {
            row.crack == junction.crack && row.stop == Some(RunStop::NoTipGrows(TipStop::Coalescence))
        });
        json!({
            "crack": junction.crack,
            "onto": junction.onto,
            "x": number(junction.x_mm),
            "y": number(junction.y_mm),
            "step": last.map(|row| row.step + 1).max().unwrap_or(0),
        })
    };
    run.summary.junctions.iter().map(junction).collect()
}

/// The place among `points` of the one nearest to `place`.
pub(super) fn nearest(points: &[[f64; 2]], place: [f64; 2]) -> usize {
    let distance = |point: &[f64; 2]| (point[0] - place[0]).hypot(point[1] - place[1]);
    let all = points.iter().enumerate();
    all.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1))).map_or(0, |(i, _)| i)
}

/// State of every tip in `step`.
fn tips(run: &RunFolder, step: usize) -> Vec<Value> {
    let tip = |row: &TipRow| {
        json!({
            "crack": row.crack,
            "tip": row.tip,
            "x": number(row.place[0]),
            "y": number(row.place[1]),
            "length": number(row.length),
            "cycles": row.load_cycles,
            "delta_keq": number(row.delta_keq),
            "rate": number(row.rate),
            "kink": row.kink_deg.map(number),
            "turn": row.turn_deg.map(number),
            "stop": row.stop_word(),
        })
    };
    run.growth.iter().filter(|row| row.step == step).map(tip).collect()
}

/// Histories under a wheel of the tips in `step`, in the order of [`tips`]; of many cracks within
/// their windows.
fn histories(
    run: &RunFolder,
    page_data: &PageData,
    (number, wheel): (usize, &PassedWheel),
    step: usize,
) -> Vec<Value> {
    let histories = page_data.by_wheel(step).get(number).map_or(&[][..], Vec::as_slice);
    let of_tip = |row: &TipRow| {
        let history = histories.iter().find(|h| (h.crack, h.tip) == (row.crack, row.tip));
        let window = wheel.window(row.crack);
        let packed = |k: fn(&History) -> &[f64]| {
            let values = k(history?);
            let near = window.and_then(|window| values.get(window.clone())).unwrap_or(values);
            Some(Quantised::of(near, near.len()))
        };
        let is_wet = history.is_some_and(|history| !history.pressure.is_empty());
        json!({
            "ki": packed(|history| &history.ki),
            "kii": packed(|history| &history.kii),
            "fluid": is_wet.then(|| [packed(|history| &history.pressure), packed(|history| &history.volume)]),
        })
    };
    run.growth.iter().filter(|row| row.step == step).map(of_tip).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_path_passes_the_tips_of_its_steps() {
        let ends = [[0.0, 0.0], [4.0, -3.0]];
        assert!(passes(&ends, [2.0, -1.5]));
        assert!(
            ![[0.0, 0.0], [4.0, -3.0], [2.0, -1.6], [8.0, -6.0]].into_iter().any(|tip| passes(&ends, tip))
        );
    }
}
