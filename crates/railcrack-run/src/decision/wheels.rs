//! Share of each wheel of a mix in the growth.

use super::path::GrowthPath;
use crate::log::{MixInfo, StepDigest};
use serde::{Deserialize, Serialize};

/// A wheel of a mix over the whole run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WheelSummary {
    /// Its name.
    pub name: String,
    /// Share of the axles.
    pub share_of_axles: f64,
    /// Share of the growth of the deepest tip, the mean over its length.
    pub share_of_growth: f64,
    /// Number of steps in which the crack would have changed direction without this wheel, and by
    /// more than without any other.
    pub turns_in_steps: usize,
}

impl WheelSummary {
    /// The wheels of `mix` in `steps`, at the tip of `path`.
    pub(crate) fn of(mix: &[MixInfo], path: &GrowthPath, steps: &[StepDigest]) -> Vec<Self> {
        let tips: Vec<&railcrack::growth::TipRecord> = steps
            .iter()
            .filter_map(|step| step.tips.iter().find(|tip| (tip.tip.crack + 1, tip.tip.tip + 1) == path.tip))
            .collect();
        // A single wheel has the whole growth.
        let alone = if mix.len() == 1 { 1.0 } else { 0.0 };
        let grown: f64 = tips.iter().map(|tip| tip.increment.max(0.0)).sum();
        let of = |(i, wheel): (usize, &MixInfo)| {
            let share =
                |tip: &&railcrack::growth::TipRecord| tip.shares.values().get(i).copied().unwrap_or(alone);
            let weighted: f64 = tips.iter().map(|tip| tip.increment.max(0.0) * share(tip)).sum();
            // Without any increment, the initial crack.
            let first = tips.first().map_or(0.0, share);
            Self {
                name: wheel.name.clone(),
                share_of_axles: wheel.share,
                share_of_growth: if grown > 0.0 { weighted / grown } else { first },
                turns_in_steps: tips
                    .iter()
                    .filter(|tip| tip.plane().and_then(|plane| plane.turned_by) == Some(i))
                    .count(),
            }
        };
        mix.iter().enumerate().map(of).collect()
    }
}
