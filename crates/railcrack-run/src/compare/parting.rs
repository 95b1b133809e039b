//! Where two paths part.

use super::stored::{StoredRun, TipKey};
use railcrack::growth::NEAR_TIE;
use serde::{Deserialize, Serialize};

/// Kinks farther apart than this (degrees) are different choices: a secondary maximum is at least
/// 15° away, and where two runs choose alike their kinks differ by a fraction of a degree. Paths
/// that drift apart by such fractions do not part; the distance of their tips shows the drift.
const PARTED_DEG: f64 = 5.0;

/// The first step at which two runs choose different directions.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Parting {
    /// The step.
    pub step: usize,
    /// The crack.
    pub crack: usize,
    /// The tip of the crack.
    pub tip: usize,
    /// Difference of the kinks, degrees.
    pub apart_deg: f64,
    /// Kink of each run, degrees from straight ahead.
    pub kink_angle_deg: [Option<f64>; 2],
    /// Growth rate at the secondary maximum over that at the chosen angle, of each run.
    pub rival_ratio: [Option<f64>; 2],
    /// Whether one of the runs had to choose between directions of nearly equal rate.
    pub near_tie: bool,
}

/// The first parting of two runs among `keys`, which are in the order of steps.
pub(super) fn parting<'a>(
    runs: [&StoredRun; 2],
    keys: impl IntoIterator<Item = &'a TipKey>,
) -> Option<Parting> {
    keys.into_iter().find_map(|&key| {
        let [first, second] = runs.map(|run| run.growth.get(&key));
        let rows = [first?, second?];
        let kinks = rows.map(|row| row.kink_deg);
        let apart_deg = (kinks[0]? - kinks[1]?).abs();
        let rival_ratio = rows.map(|row| row.rival_ratio);
        let (step, crack, tip) = key;
        (apart_deg > PARTED_DEG).then(|| Parting {
            step,
            crack,
            tip,
            apart_deg,
            kink_angle_deg: kinks,
            rival_ratio,
            near_tie: rival_ratio.into_iter().flatten().any(|ratio| ratio > NEAR_TIE),
        })
    })
}
