//! A table of wheels as a case uses it.

use super::rolling_patch::placed_patches;
use crate::files::{TableWheel, WheelTableFile};
use railcrack::load::{Contact, Travel};
use railcrack::space::WheelPatch;

/// A table of wheels as a case uses it.
#[derive(Debug, Clone, PartialEq)]
pub struct WheelTable {
    /// The file.
    pub file: WheelTableFile,
    /// Lateral place of the cracks on the running surface, mm; in space, of the first one.
    pub lateral: f64,
    /// Whether the whole patches load cracks in space.
    pub in_space: bool,
    /// Direction of travel.
    pub travel: Travel,
    /// The wheels that pass: all of the table, or those at one place.
    pub wheels: Vec<TabledWheel>,
    /// Number in the mix, from 0, of its first wheel.
    pub first: usize,
    /// Its wheels in the mix that load the cracks.
    pub representatives: usize,
    /// The wheels, indices of `wheels`, that are these representatives.
    pub chosen: Vec<usize>,
    /// Share of the axles whose patches miss the cracks.
    pub missed: f64,
    /// Error of the mean growth rate of the representatives by the surrogate, a coarse crack.
    pub error: f64,
    /// The error that is accepted.
    pub accepted: f64,
}

impl WheelTable {
    /// The words for the surrogate by which lateral places are compared.
    #[must_use]
    pub fn compared_by(&self) -> &'static str {
        if self.in_space { "the coarse crack" } else { "the open crack" }
    }

    /// The whole patches of the representatives, in space.
    pub(super) fn patches(&self) -> Vec<Option<WheelPatch>> {
        let of = |wheel: &usize| placed_patches(&self.wheels[*wheel].wheel.over(0.0), self.travel);
        self.chosen.iter().map(of).collect()
    }
}

/// A wheel of a table that passes.
#[derive(Debug, Clone, PartialEq)]
pub struct TabledWheel {
    /// As given.
    pub wheel: TableWheel,
    /// Share of the axles.
    pub share: f64,
    /// Its load of the cracks; none where its patches miss them. In space, the middle strip of its
    /// heaviest patch.
    pub contact: Option<Contact>,
    /// The wheel of the mix, from 0, that represents it.
    pub represented_by: usize,
}
