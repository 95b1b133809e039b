//! The part of a passage that is near the cracks, and the far part of a rail that bends.

use railcrack_run::Summary;
use std::ops::Range;

/// Round-off of a position that is an end of the passage, over a.
const ROUND_OFF: f64 = 1e-6;

/// Of output positions `xc_over_a`, those within `[passage]` of the case: all, but where the rail
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

/// Where x/a counts from, mm.
pub(crate) fn origin(summary: &Summary) -> f64 {
    summary.cracks.first().and_then(|crack| crack.initial_points_mm.first()).map_or(0.0, |point| point[0])
}

fn over_a(summary: &Summary, xc: f64) -> f64 {
    (xc - origin(summary)) / summary.half_width_mm
}
