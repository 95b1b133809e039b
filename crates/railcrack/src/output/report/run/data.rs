//! What the passage explorer of the page works with.

use super::faces::packed_faces;
use super::stored::RunFolder;
use crate::output::OutputError;
use crate::output::csv::TipRow;
use crate::output::figures::{History, read_histories};
use crate::output::report::numbers::{number, numbers};
use crate::output::report::pack::packed_singles;
use serde_json::{Value, json};
use std::collections::BTreeSet;

/// The most values of K in the page (tips × positions × steps). The page then stays below 3 MB.
const K_VALUES: usize = 300_000;
/// The most face states in the page (points × positions × steps): about two bytes each.
const FACE_STATES: usize = 1_000_000;
/// Faces are given at this many positions at least before steps are left out.
const FACE_POSITIONS: usize = 61;

/// What of the run is in the page.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Shown {
    /// Steps.
    pub steps: Vec<usize>,
    /// Every how many positions the faces are given.
    pub face_stride: usize,
}

impl Shown {
    /// As much as fits: all steps and positions where they do, else every n-th position of the faces, then evenly spaced
    /// steps.
    pub(super) fn of(steps: usize, tips: usize, positions: usize, face_points: usize) -> Self {
        let states = |positions: usize| steps * positions * face_points.max(1);
        let most = (positions / FACE_POSITIONS).max(1);
        let face_stride = states(positions).div_ceil(FACE_STATES).clamp(1, most);
        let by_faces = FACE_STATES / (positions.div_ceil(face_stride) * face_points.max(1)).max(1);
        let by_k = K_VALUES / (tips * positions).max(1);
        Self { steps: evenly(steps, by_faces.min(by_k).max(2)), face_stride }
    }
}

/// At most `most` of the numbers below `count`, the first and the last among them.
fn evenly(count: usize, most: usize) -> Vec<usize> {
    if count <= most {
        return (0..count).collect();
    }
    let mut chosen: Vec<usize> = (0..most).map(|i| (i * (count - 1) + (most - 1) / 2) / (most - 1)).collect();
    chosen.dedup();
    chosen
}

/// The data of the explorer, and what of the run is in it.
///
/// Errors: a table is damaged; the system refuses.
pub(super) fn explorer(run: &RunFolder) -> Result<(Value, Shown), OutputError> {
    let summary = &run.summary;
    let first_step = read_histories(&run.path, &[0])?;
    let positions = first_step.first().map_or(0, |history| history.xc_over_a.len());
    let shown = Shown::of(summary.steps_recorded, first_step.len(), positions, summary.face_points);
    let histories = read_histories(&run.path, &shown.steps)?;
    let stride = shown.face_stride;
    // The last position is kept whatever the stride: the wheel has left.
    let kept = |position: usize| (position - 1).is_multiple_of(stride) || position == positions;
    let wanted: BTreeSet<usize> = shown.steps.iter().copied().collect();
    let mut faces = packed_faces(&run.path, &wanted, kept)?;
    let steps: Vec<Value> = shown
        .steps
        .iter()
        .map(|&step| {
            json!({
                "step": step,
                "cracks": polylines(run, step),
                "tips": tips(run, &histories, step),
                "faces": faces.remove(&step),
            })
        })
        .collect();
    let xc_over_a: &[f64] = first_step.first().map_or(&[], |history| &history.xc_over_a);
    let data = json!({
        "half_width": summary.half_width_mm,
        "origin": summary.cracks.first().and_then(|crack| crack.initial_points_mm.first()).map_or(0.0, |p| p[0]),
        "peak_pressure": run.peak_pressure().map(number),
        "friction": run.number("contact.friction"),
        "axle_load": run.axle_load(),
        "xc_over_a": numbers(xc_over_a.iter().copied()),
        "face_stride": stride,
        "last_step": summary.steps_recorded.saturating_sub(1),
        "cracks": summary.cracks.iter().map(|crack| json!({
            "points": crack.points_mm.iter().map(|p| numbers(*p)).collect::<Vec<_>>(),
        })).collect::<Vec<_>>(),
        "pieces": pieces(run),
        "junctions": junctions(run),
        "residual": (!run.residual.is_empty()).then(|| json!({
            "depth": numbers(run.residual.iter().map(|row| row[0])),
            "sxx": numbers(run.residual.iter().map(|row| row[1])),
        })),
        "steps": steps,
    });
    Ok((data, shown))
}

/// Of every crack the first and the last of its final points that it has in `step`. An end without a tip is that of the final crack: a
/// mouth, or where the crack has joined another one.
fn polylines(run: &RunFolder, step: usize) -> Value {
    let of_crack = |(i, crack): (usize, &crate::output::CrackSummary)| {
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

/// The pieces that are enclosed and the cracks that have joined others, with the first step that has them.
fn pieces(run: &RunFolder) -> Value {
    let piece = |piece: &crate::output::PieceSummary| {
        json!({
            "kind": piece.kind,
            "crack": piece.crack,
            "step": piece.step + 1,
            "area": number(piece.area_mm2),
            "outline": piece.outline_mm.iter().map(|p| numbers(*p)).collect::<Vec<_>>(),
        })
    };
    run.summary.pieces.iter().map(piece).collect()
}

fn junctions(run: &RunFolder) -> Value {
    let junction = |junction: &crate::output::JunctionSummary| {
        let last = run.growth.iter().filter(|row| row.crack == junction.crack && row.stop == "meets-crack");
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

fn nearest(points: &[[f64; 2]], place: [f64; 2]) -> usize {
    let distance = |point: &[f64; 2]| (point[0] - place[0]).hypot(point[1] - place[1]);
    let all = points.iter().enumerate();
    all.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1))).map_or(0, |(i, _)| i)
}

/// State and histories of every tip in `step`.
fn tips(run: &RunFolder, histories: &[History], step: usize) -> Vec<Value> {
    let tip = |row: &TipRow| {
        let history = histories.iter().find(|h| (h.step, h.crack, h.tip) == (step, row.crack, row.tip));
        let packed = |k: fn(&History) -> &[f64]| history.map(|history| packed_singles(k(history)));
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
            "stop": row.stop,
            "ki": packed(|history| &history.ki),
            "kii": packed(|history| &history.kii),
        })
    };
    run.growth.iter().filter(|row| row.step == step).map(tip).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_is_shown_where_it_fits() {
        let shown = Shown::of(26, 1, 241, 120);
        assert_eq!((shown.steps.len(), shown.face_stride), (26, 1));
    }

    #[test]
    fn positions_of_faces_go_first_then_steps() {
        let shown = Shown::of(26, 9, 241, 500);
        assert_eq!((shown.steps.len(), shown.face_stride), (24, 3), "{shown:?}");
        assert_eq!((shown.steps[0], shown.steps[23]), (0, 25));
        let long = Shown::of(10_001, 1, 241, 100);
        assert!(long.steps.len() * 241usize.div_ceil(long.face_stride) * 100 <= FACE_STATES);
        assert_eq!((long.steps[0], *long.steps.last().unwrap()), (0, 10_000));
        let fine = Shown::of(2, 1, 100_000, 100);
        assert_eq!(fine.steps, [0, 1]);
    }
}
