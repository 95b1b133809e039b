//! A table of wheels as a case uses it.

use crate::files::{TableWheel, WheelTableFile};
use railcrack::load::{Contact, Travel};

/// A table of wheels as a case uses it.
#[derive(Debug, Clone, PartialEq)]
pub struct WheelTable {
    /// The file.
    pub file: WheelTableFile,
    /// Lateral place of the cracks on the running surface, mm.
    pub lateral: f64,
    /// Direction of travel.
    pub travel: Travel,
    /// The wheels that pass: all of the table, or those at one place.
    pub wheels: Vec<TabledWheel>,
    /// Number in the mix, from 0, of its first wheel.
    pub first: usize,
    /// Its wheels in the mix that load the cracks.
    pub representatives: usize,
    /// Share of the axles whose patches miss the cracks.
    pub missed: f64,
    /// Error of the mean growth rate of the representatives by the surrogate, a coarse crack.
    pub error: f64,
    /// The error that is accepted.
    pub accepted: f64,
}

/// A wheel of a table that passes.
#[derive(Debug, Clone, PartialEq)]
pub struct TabledWheel {
    /// As given.
    pub wheel: TableWheel,
    /// Share of the axles.
    pub share: f64,
    /// Its load of the cracks; none where its patches miss them.
    pub contact: Option<Contact>,
    /// The wheel of the mix, from 0, that represents it.
    pub represented_by: usize,
}
