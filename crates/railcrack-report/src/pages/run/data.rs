//! Data of the passage explorer.

use super::stored::RunFolder;
use crate::figures::{near, window};
use crate::numbers::{number, numbers};
use crate::row::NamedCrack;
use crate::shown::{Deflated, Quantised, ShownRun};
use railcrack::contact::{FluidModel, PressureProfile};
use railcrack::growth::{RunStop, TipStop};
use railcrack::plane::CrackFluid;
use railcrack::words::Choice;
use railcrack_run::csv::TipRow;
use railcrack_run::run_folder::History;
use serde_json::{Value, json};
use std::ops::Range;

/// Maximum number of values of K of many cracks on a page (tips × positions × steps), of about
/// three bytes each.
const VALUES: usize = 200_000;

/// The data of the explorer. For many cracks, K at wheel positions near each of them, and the faces
/// of the `named` ones.
pub(super) fn explorer(run: &RunFolder, shown: &ShownRun, named: Option<&[NamedCrack]>) -> Value {
    let summary = &run.summary;
    let windows = named.map(|_| windows(run, shown));
    let steps: Vec<Value> = explored_steps(run, shown, named)
        .into_iter()
        .map(|step| {
            let faces = match (named, &windows) {
                (Some(named), Some(windows)) => {
                    json!(shown.faces_of(step, &told_windows(named, windows)))
                }
                _ => json!(shown.faces(step)),
            };
            json!({
                "step": step,
                "cracks": polylines(run, step),
                "lines": worn(run, step, Until::Now),
                "whole": worn(run, step, Until::Last),
                "tips": tips(run, shown.histories(step), windows.as_deref(), step),
                "faces": faces,
                "contact": shown.contact(step),
            })
        })
        .collect();
    let xc_over_a: &[f64] = shown.histories(0).first().map_or(&[], |history| &history.xc_over_a);
    let near = near(summary, xc_over_a);
    let last_of = |window: &Range<usize>| json!([window.start, window.end.saturating_sub(1)]);
    json!({
        "windows": windows.as_ref().map(|windows| windows.iter().map(last_of).collect::<Vec<_>>()),
        "named": named.map(|named| named.iter().map(|named| named.crack).collect::<Vec<_>>()),
        "half_width": summary.half_width_mm,
        "origin": summary.cracks.first().and_then(|crack| crack.initial_points_mm.first()).map_or(0.0, |p| p[0]),
        "is_coupled": run.case.wheel.coupling.is_some(),
        "peak_pressure": number(run.case.wheel.contact().peak_pressure()),
        "friction": run.case.wheel.contact().adhesion(),
        "axle_load": run.case.axle_load,
        "near": [near.start, near.end.saturating_sub(1)],
        "xc_over_a": numbers(xc_over_a.iter().copied()),
        "face_stride": shown.face_stride(),
        "last_step": summary.steps_recorded.saturating_sub(1),
        "cracks": summary.cracks.iter().map(|crack| json!({
            "points": crack.points_mm.iter().map(|p| numbers(*p)).collect::<Vec<_>>(),
        })).collect::<Vec<_>>(),
        "fluid_falls": fluid_falls(run),
        "pieces": pieces(run),
        "junctions": junctions(run),
        "residual": (!run.residual.is_empty()).then(|| json!({
            "depth": numbers(run.residual.iter().map(|row| row[0])),
            "sxx": numbers(run.residual.iter().map(|row| row[1])),
        })),
        "steps": steps,
    })
}

/// Wheel positions near each crack of a row.
fn windows(run: &RunFolder, shown: &ShownRun) -> Vec<Range<usize>> {
    let xc_over_a: &[f64] = shown.histories(0).first().map_or(&[], |history| &history.xc_over_a);
    (1..=run.summary.cracks.len()).map(|crack| window(&run.summary, crack, xc_over_a)).collect()
}

/// The windows of the `named` cracks, by number.
fn told_windows(named: &[NamedCrack], windows: &[Range<usize>]) -> Vec<(usize, Range<usize>)> {
    let of = |named: &NamedCrack| Some((named.crack, windows.get(named.crack.checked_sub(1)?)?.clone()));
    named.iter().filter_map(of).collect()
}

/// The steps of the explorer: those `shown`, or as many of them as fit for many cracks.
pub(super) fn explored_steps(run: &RunFolder, shown: &ShownRun, named: Option<&[NamedCrack]>) -> Vec<usize> {
    let steps = shown.steps();
    if named.is_none() {
        return steps;
    }
    let windows = windows(run, shown);
    let of_tip = |history: &History| {
        history.crack.checked_sub(1).and_then(|place| windows.get(place)).map_or(0, Range::len)
    };
    let values: usize = shown.histories(0).iter().map(of_tip).sum();
    let mut every = 1;
    while steps.len().div_ceil(every) * values > VALUES && every < steps.len() {
        every *= 2;
    }
    let is_shown = |place: &usize| place.is_multiple_of(every) || place + 1 == steps.len();
    (0..steps.len()).filter(is_shown).map(|place| steps[place]).collect()
}

/// Whether the pressure of the fluid falls from the mouth to the tip, as far as cracks of their own
/// show it.
fn fluid_falls(run: &RunFolder) -> bool {
    let fluid = run.case.fluid.as_ref();
    let falls = |fluid: &CrackFluid| {
        matches!(fluid.model, FluidModel::Mouth { .. }) && fluid.profile == PressureProfile::Linear
    };
    fluid.is_some_and(falls) && run.summary.junctions.is_empty()
}

/// Of every crack the first and the last of its final points that it has in `step`. An end without
/// a tip is that of the final crack: a mouth, or where the crack has joined another one.
fn polylines(run: &RunFolder, step: usize) -> Value {
    let of_crack = |(i, crack): (usize, &railcrack_run::CrackSummary)| {
        let mut ends = [0, crack.points_mm.len().saturating_sub(1)];
        for row in run.growth.iter().filter(|row| (row.step, row.crack) == (step, i + 1)) {
            let first = run.history(row.crack, row.tip).next().unwrap_or(row);
            // Which end of the crack is the tip's, the initial crack says.
            let end = usize::from(nearest(&crack.initial_points_mm, first.place) > 0);
            ends[end] = nearest(&crack.points_mm, row.place);
        }
        ends
    };
    run.summary.cracks.iter().enumerate().map(of_crack).map(|ends| json!(ends)).collect()
}

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
    let of_crack = |(i, crack): (usize, &railcrack_run::CrackSummary)| {
        let path: Vec<[f64; 2]> = crack
            .path_mm
            .as_ref()
            .unwrap_or(&crack.points_mm)
            .iter()
            .map(|p| [p[0], p[1] + removed])
            .collect();
        let row = run.growth.iter().rfind(|row| (row.step, row.crack) == (step, i + 1));
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
    Some(run.summary.cracks.iter().enumerate().map(of_crack).collect())
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

/// State and histories of every tip in `step`, these within the `windows` of their cracks.
fn tips(run: &RunFolder, histories: &[History], windows: Option<&[Range<usize>]>, step: usize) -> Vec<Value> {
    let tip = |row: &TipRow| {
        let history = histories.iter().find(|h| (h.crack, h.tip) == (row.crack, row.tip));
        let window = windows.and_then(|windows| windows.get(row.crack.checked_sub(1)?));
        let packed = |k: fn(&History) -> &[f64]| {
            let values = k(history?);
            Some(match window.and_then(|window| values.get(window.clone())) {
                Some(near) => json!(Quantised::of(near, near.len())),
                None => json!(Deflated::singles(values)),
            })
        };
        let is_wet = history.is_some_and(|history| !history.pressure.is_empty());
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
            "rival": row.rival_deg.map(number),
            "ratio": row.rival_ratio.map(number),
            "stop": row.stop_word(),
            "ki": packed(|history| &history.ki),
            "kii": packed(|history| &history.kii),
            "fluid": is_wet.then(|| [packed(|history| &history.pressure), packed(|history| &history.volume)]),
        })
    };
    run.growth.iter().filter(|row| row.step == step).map(tip).collect()
}
