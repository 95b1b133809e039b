//! A table of wheels as a case uses it, and the groups of its wheels.

use super::traffic_wheel::TrafficWheel;
use crate::files::{TableWheel, WheelTableFile};
use railcrack::load::Travel;
use serde::{Deserialize, Serialize};

/// A table of wheels as a case uses it.
#[derive(Debug, Clone, PartialEq)]
pub struct WheelTable {
    /// The file.
    pub file: WheelTableFile,
    /// Lateral place of the cracks on the running surface, mm; in space, of the first one.
    pub lateral: f64,
    /// Whether whole patches load the cracks, not their strips.
    pub is_whole: bool,
    /// Direction of travel.
    pub travel: Travel,
    /// The wheels that pass: all of the table, or those at one place.
    pub wheels: Vec<TabledWheel>,
    /// Number, from 0, of its first wheel among those of the case, of which its wheels are the
    /// last.
    pub first: usize,
    /// Largest number of its wheels that a run computes for those that load the cracks.
    pub most: usize,
    /// Error of the mean growth rate of the representatives that is accepted.
    pub accepted: f64,
    /// The groups whose representatives are the wheels of the case; none where all of its wheels
    /// are.
    pub groups: Option<WheelGroups>,
}

/// Wheels of a table in groups, each with a representative.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WheelGroups {
    /// The representatives, indices of the wheels of the table.
    pub representatives: Vec<usize>,
    /// The group of each wheel, an index of `representatives`; none of a wheel that misses the
    /// cracks.
    pub group_of: Vec<Option<usize>>,
    /// Error of the mean growth rate of the representatives by the surrogate, a coarse crack.
    pub error: f64,
}

impl WheelTable {
    /// The words for the surrogate by which lateral places are compared.
    #[must_use]
    pub fn compared_by(&self) -> &'static str {
        if self.is_whole { "the coarse crack" } else { "the open crack" }
    }

    /// Share of the axles whose patches miss the cracks, in `groups` of its wheels.
    #[must_use]
    pub fn missed(&self, groups: &WheelGroups) -> f64 {
        let all = self.wheels.iter().zip(&groups.group_of);
        all.filter(|(_, group)| group.is_none()).map(|(wheel, _)| wheel.share).sum()
    }

    /// Number of wheels that a run computes, at most, of a case with `wheels`.
    pub(super) fn computed_wheels(&self, wheels: &[TrafficWheel]) -> usize {
        if self.groups.is_some() {
            return wheels.len();
        }
        let own = wheels.len() - self.first;
        let loading = wheels.iter().skip(self.first).filter(|wheel| wheel.wheel.contact().is_some()).count();
        self.first + loading.min(self.most) + usize::from(loading < own)
    }
}

/// A wheel of a table that passes.
#[derive(Debug, Clone, PartialEq)]
pub struct TabledWheel {
    /// As given.
    pub wheel: TableWheel,
    /// Share of the axles.
    pub share: f64,
}
