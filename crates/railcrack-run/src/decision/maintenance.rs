//! Growth of a crack against the removal of the surface by wear and grinding.

use super::rows::DecisionRow;
use railcrack::growth::{Mgt, SurfaceRemoval};
use serde::{Deserialize, Serialize};

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
    /// The balance for the crack of `rows`, which is gone at the last of them if it `is_worn_away`,
    /// after `removed` (mm) of the surface.
    pub(super) fn of(
        removal: &SurfaceRemoval<Mgt>,
        rows: &[DecisionRow],
        is_worn_away: bool,
        removed: f64,
    ) -> Self {
        let mean = removal.mean_rate();
        let ratio =
            |row: &DecisionRow| Some(row.balance_mm_per_mgt? / mean).filter(|ratio| ratio.is_finite());
        let ends = rows.first().and_then(ratio).zip(rows.last().and_then(ratio));
        Self {
            wear_mm_per_mgt: removal.wear,
            grinding_mm: removal.grinding.map(|grinding| grinding.depth),
            grinding_interval_mgt: removal.grinding.map(|grinding| grinding.interval.0),
            removal_mm_per_mgt: mean,
            removed_mm: removed,
            growth_over_removal: ends.map(|(first, last)| [first, last]),
            balance_depth_mm: rows.windows(2).find_map(|pair| balance(pair, ratio)),
            mgt_to_worn_away: rows.last().filter(|_| is_worn_away).map(|last| last.mgt),
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
