//! The part of a passage that is near the cracks, and the far part of a rail that bends.

use crate::svg::ends;
use railcrack_run::Summary;
use std::ops::Range;

/// Round-off of a position that is an end of the passage, over a.
pub(super) const ROUND_OFF: f64 = 1e-6;

/// The passage of a wheel over the cracks of a run.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WheelPassage<'a> {
    summary: &'a Summary,
    /// Half-width a of its contact, mm.
    half_width: f64,
    /// Its ends, mm, where a rail bends and there are positions beyond.
    ends: Option<[f64; 2]>,
}

impl<'a> WheelPassage<'a> {
    /// Of the first wheel.
    pub(crate) fn first(summary: &'a Summary) -> Self {
        Self { summary, half_width: summary.half_width_mm, ends: summary.passage_mm }
    }

    /// Of another wheel with the half-width `half_width` and a passage between `ends`, mm.
    pub(crate) fn other(summary: &'a Summary, half_width: f64, ends: [f64; 2]) -> Self {
        Self { summary, half_width, ends: summary.passage_mm.map(|_| ends) }
    }

    /// Half-width a of the contact, mm.
    pub(crate) fn half_width(&self) -> f64 {
        self.half_width
    }

    /// Output positions among `xc_over_a` within `[passage]` of the case; all of them unless the
    /// rail bends.
    pub(crate) fn near(&self, xc_over_a: &[f64]) -> Range<usize> {
        let all = 0..xc_over_a.len();
        let Some(ends) = self.ends else { return all };
        let [from, to] = ends.map(|xc| self.over_a(xc));
        let (low, high) = (from.min(to) - ROUND_OFF, from.max(to) + ROUND_OFF);
        let is_near = |x: &f64| (low..=high).contains(x);
        match (xc_over_a.iter().position(is_near), xc_over_a.iter().rposition(is_near)) {
            (Some(first), Some(last)) => first..last + 1,
            _ => all,
        }
    }

    /// Output positions among `xc_over_a` that are as close to `crack` (from 1), one of many in a
    /// row, as the passage extends beyond the whole row.
    pub(crate) fn window(&self, crack: usize, xc_over_a: &[f64]) -> Range<usize> {
        let near = self.near(xc_over_a);
        let mouth_of = |crack: usize| mouth(self.summary, crack).map_or(0.0, |mouth| self.over_a(mouth));
        let [low, high] = ends((1..=self.summary.cracks.len()).map(mouth_of));
        let [from, to] = ends(xc_over_a[near.clone()].iter().copied());
        let mouth = mouth_of(crack);
        let (before, after) =
            (mouth + (from - low).min(0.0) - ROUND_OFF, mouth + (to - high).max(0.0) + ROUND_OFF);
        let is_inside = |x: &f64| (before..=after).contains(x);
        let inside = |place: &usize| is_inside(&xc_over_a[*place]);
        match (near.clone().find(inside), near.clone().rev().find(inside)) {
            (Some(first), Some(last)) => first..last + 1,
            _ => near,
        }
    }

    fn over_a(&self, xc: f64) -> f64 {
        (xc - origin(self.summary)) / self.half_width
    }
}

/// Output positions among `xc_over_a` of the first wheel within `[passage]` of the case; all of
/// them unless the rail bends.
pub(crate) fn near(summary: &Summary, xc_over_a: &[f64]) -> Range<usize> {
    WheelPassage::first(summary).near(xc_over_a)
}

/// Origin of x/a, mm.
pub(crate) fn origin(summary: &Summary) -> f64 {
    summary.cracks.first().and_then(|crack| crack.initial_points_mm.first()).map_or(0.0, |point| point[0])
}

/// Start of `crack` (from 1) in x/a: its mouth, or the first end of a buried crack.
pub(crate) fn mouth_over_a(summary: &Summary, crack: usize) -> f64 {
    mouth(summary, crack).map_or(0.0, |mouth| WheelPassage::first(summary).over_a(mouth))
}

/// Abscissa of the start of `crack` (from 1), mm.
pub(crate) fn mouth(summary: &Summary, crack: usize) -> Option<f64> {
    let crack = summary.cracks.get(crack.checked_sub(1)?)?;
    Some(crack.initial_points_mm.first()?[0])
}
