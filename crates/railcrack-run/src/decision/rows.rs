//! The crack that is followed, from step to step.

use super::failure::Nominal;
use super::path::{GrowthPath, PathPoint};
use serde::{Deserialize, Serialize};

/// The crack at the start of a growth step.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct DecisionRow {
    /// Length, mm.
    pub length_mm: f64,
    /// Depth of the tip, mm.
    pub depth_mm: f64,
    /// Axles so far.
    pub axles: f64,
    /// Million gross tonnes so far.
    pub mgt: f64,
    /// Growth of the length, mm per million gross tonnes.
    pub length_mm_per_mgt: f64,
    /// Growth of the depth until the next step, mm per million gross tonnes; null in the last.
    pub depth_mm_per_mgt: Option<f64>,
    /// Removal of the surface by wear or grinding (mm per million gross tonnes) that takes as much
    /// from the mouth as the tip grows; null for a crack that is not open to the surface.
    pub balance_mm_per_mgt: Option<f64>,
}

/// The crack of `path` from step to step, under axles of `tonnes`.
pub(super) fn rows_of(path: &GrowthPath, tonnes: f64) -> Vec<DecisionRow> {
    let per_mgt = 1e6 / tonnes;
    let points = path.points.iter();
    let next = path.points.iter().skip(1).map(Some).chain([None]);
    let row = |(point, next): (&PathPoint, Option<&PathPoint>)| {
        let deepening = |next: &PathPoint| {
            let passed = (next.axles - point.axles) / per_mgt;
            (passed > 0.0).then(|| (next.depth - point.depth) / passed)
        };
        DecisionRow {
            length_mm: point.length,
            depth_mm: point.depth,
            axles: point.axles,
            mgt: point.axles / per_mgt,
            length_mm_per_mgt: point.rate * per_mgt,
            depth_mm_per_mgt: next.and_then(deepening),
            balance_mm_per_mgt: point.mouth_sine.map(|sine| point.rate * per_mgt * sine),
        }
    };
    points.zip(next).map(row).collect()
}

/// Depth (mm) of the crack of `rows` at `mgt`.
pub(super) fn depth_at(rows: &[DecisionRow], mgt: f64) -> Option<f64> {
    let next = rows.iter().position(|row| row.mgt >= mgt)?;
    let after = &rows[next];
    let Some(before) = next.checked_sub(1).map(|i| &rows[i]) else { return Some(after.depth_mm) };
    let share = (mgt - before.mgt) / (after.mgt - before.mgt);
    Some(before.depth_mm + share * (after.depth_mm - before.depth_mm))
}

/// Growth of the crack of `rows` into the depth from detectable to failure, or over the run, mm per
/// 10 MGT.
pub(super) fn rate_per_10_mgt(rows: &[DecisionRow], nominal: &Nominal) -> Option<f64> {
    let (first, last) = (rows.first()?, rows.last()?);
    let from = nominal.detected.filter(|_| nominal.failure.mgt.is_some()).unwrap_or(first.mgt);
    let to = nominal.failure.mgt.map_or(last.mgt, |mgt| mgt.min(last.mgt));
    let deeper = depth_at(rows, to)? - depth_at(rows, from)?;
    (to > from).then(|| 10.0 * deeper / (to - from))
}
