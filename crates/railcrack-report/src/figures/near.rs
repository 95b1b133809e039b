//! The part of a passage that is near the cracks, and the far part of a rail that bends.

use railcrack_run::Summary;
use std::ops::Range;

/// Round-off of a position that is an end of the passage, over a.
pub(super) const ROUND_OFF: f64 = 1e-6;

/// Output positions among `xc_over_a` within `[passage]` of the case; all of them unless the rail
/// bends.
pub(crate) fn near(summary: &Summary, xc_over_a: &[f64]) -> Range<usize> {
    let all = 0..xc_over_a.len();
    let Some(ends) = summary.passage_mm else { return all };
    let [from, to] = ends.map(|xc| over_a(summary, xc));
    let (low, high) = (from.min(to) - ROUND_OFF, from.max(to) + ROUND_OFF);
    let is_near = |x: &f64| (low..=high).contains(x);
    match (xc_over_a.iter().position(is_near), xc_over_a.iter().rposition(is_near)) {
        (Some(first), Some(last)) => first..last + 1,
        _ => all,
    }
}

/// Origin of x/a, mm.
pub(crate) fn origin(summary: &Summary) -> f64 {
    summary.cracks.first().and_then(|crack| crack.initial_points_mm.first()).map_or(0.0, |point| point[0])
}

/// Start of `crack` (from 1) in x/a: its mouth, or the first end of a buried crack.
pub(crate) fn mouth_over_a(summary: &Summary, crack: usize) -> f64 {
    let crack = crack.checked_sub(1).and_then(|place| summary.cracks.get(place));
    crack.and_then(|crack| crack.initial_points_mm.first()).map_or(0.0, |mouth| over_a(summary, mouth[0]))
}

/// Output positions among `xc_over_a` that are as close to `crack` (from 1), one of many in a row,
/// as the passage extends beyond the whole row.
pub(crate) fn window(summary: &Summary, crack: usize, xc_over_a: &[f64]) -> Range<usize> {
    let near = near(summary, xc_over_a);
    let mouths = (1..=summary.cracks.len()).map(|crack| mouth_over_a(summary, crack));
    let (low, high) =
        mouths.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    let ends = xc_over_a[near.clone()].iter();
    let (from, to) =
        ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &x| (low.min(x), high.max(x)));
    let mouth = mouth_over_a(summary, crack);
    let (before, after) =
        (mouth + (from - low).min(0.0) - ROUND_OFF, mouth + (to - high).max(0.0) + ROUND_OFF);
    let is_inside = |x: &f64| (before..=after).contains(x);
    let inside = |place: &usize| is_inside(&xc_over_a[*place]);
    match (near.clone().find(inside), near.clone().rev().find(inside)) {
        (Some(first), Some(last)) => first..last + 1,
        _ => near,
    }
}

fn over_a(summary: &Summary, xc: f64) -> f64 {
    (xc - origin(summary)) / summary.half_width_mm
}
