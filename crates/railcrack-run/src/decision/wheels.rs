//! Share of each wheel of a mix in the growth.

use super::path::{GrowthPath, PathPoint};
use crate::log::WheelInfo;
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
    /// The wheels of `mix` at the tip of `path`.
    pub(crate) fn of(mix: &[WheelInfo], path: &GrowthPath) -> Vec<Self> {
        let points = &path.points;
        let grown: f64 = points.iter().map(|point| point.increment.max(0.0)).sum();
        let of = |(i, wheel): (usize, &WheelInfo)| {
            let share = |point: &PathPoint| point.shares.values().get(i).copied().unwrap_or(0.0);
            let weighted: f64 = points.iter().map(|point| point.increment.max(0.0) * share(point)).sum();
            // Without any increment, the initial crack.
            let first = points.first().map_or(0.0, share);
            Self {
                name: wheel.name.clone(),
                share_of_axles: wheel.share,
                share_of_growth: if grown > 0.0 { weighted / grown } else { first },
                turns_in_steps: points.iter().filter(|point| point.turned_by == Some(i)).count(),
            }
        };
        mix.iter().enumerate().map(of).collect()
    }
}
