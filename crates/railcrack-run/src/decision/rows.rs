//! The crack that is followed, from step to step, and its growth against the removal of the
//! surface.

use super::failure::Nominal;
use super::path::{GrowthPath, PathPoint};
use railcrack::growth::{Mgt, SurfaceRemoval};
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

/// Growth against wear and grinding.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MaintenanceSummary {
    /// Wear, mm per million gross tonnes.
    pub wear_mm_per_mgt: f64,
    /// Depth of each grinding, mm.
    pub grinding_mm: Option<f64>,
    /// Million gross tonnes between grindings.
    pub grinding_interval_mgt: Option<f64>,
    /// Removal of the surface by both in the mean, mm per million gross tonnes.
    pub removal_mm_per_mgt: f64,
    /// Removed up to the last step, mm.
    pub removed_mm: f64,
    /// Growth into the depth over the removal, at the beginning and in the last step; above one the
    /// crack gets deeper. Null for a buried crack, or where nothing is removed.
    pub growth_over_removal: Option<[f64; 2]>,
    /// Depth (mm) at which growth and removal are in balance: the crack that is less deep is worn
    /// away where the deeper one grows. Null where the run does not pass it.
    pub balance_depth_mm: Option<f64>,
    /// Million gross tonnes until nothing of the crack is left; null where something stays.
    pub mgt_to_worn_away: Option<f64>,
    /// Removed depth (mm) at which the rail is replaced, where the case gives it.
    #[serde(default)]
    pub wear_limit_mm: Option<f64>,
    /// Million gross tonnes until then, by wear and grinding alone: the crack may fail before.
    #[serde(default)]
    pub mgt_to_wear_limit: Option<f64>,
}

impl MaintenanceSummary {
    /// The balance of `removal` for the crack of `path`, whose `rows` are given.
    pub(super) fn of(removal: &SurfaceRemoval<Mgt>, rows: &[DecisionRow], path: &GrowthPath) -> Self {
        let mean = removal.mean_rate();
        let ratio =
            |row: &DecisionRow| Some(row.balance_mm_per_mgt? / mean).filter(|ratio| ratio.is_finite());
        let ends = rows.first().and_then(ratio).zip(rows.last().and_then(ratio));
        Self {
            wear_mm_per_mgt: removal.wear,
            grinding_mm: removal.grinding.map(|grinding| grinding.depth),
            grinding_interval_mgt: removal.grinding.map(|grinding| grinding.interval.0),
            removal_mm_per_mgt: mean,
            removed_mm: path.points.last().map_or(0.0, |last| last.removed),
            growth_over_removal: ends.map(|(first, last)| [first, last]),
            balance_depth_mm: rows.windows(2).find_map(|pair| balance(pair, ratio)),
            mgt_to_worn_away: rows.last().filter(|_| path.is_worn_away).map(|last| last.mgt),
            wear_limit_mm: removal.limit,
            mgt_to_wear_limit: removal.replacement().map(|Mgt(mgt)| mgt),
        }
    }
}

/// Where the ratio of growth to removal passes one between two rows.
fn balance(pair: &[DecisionRow], ratio: impl Fn(&DecisionRow) -> Option<f64>) -> Option<f64> {
    let (from, to) = (ratio(&pair[0])? - 1.0, ratio(&pair[1])? - 1.0);
    let share = from / (from - to);
    (from * to < 0.0).then(|| pair[0].depth_mm + share * (pair[1].depth_mm - pair[0].depth_mm))
}
