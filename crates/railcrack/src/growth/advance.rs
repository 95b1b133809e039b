//! The transition from one step to the next.

use super::{Geometry, Interval, Piece, RunStop, Warning};

/// The transition to the next step.
#[derive(Debug, Clone, PartialEq)]
pub struct Advance {
    /// The cracks of the next step; unchanged but for their stops where the run ends.
    pub geometry: Geometry,
    /// Pieces of the rail that this step encloses.
    pub pieces: Vec<Piece>,
    /// Load cycles to the next step, by the rates at the start of this one.
    pub cycles: f64,
    /// The increment that set the pace, from which the cycles follow once the rate at its end is
    /// known; none where no cycles pass.
    pub interval: Option<Interval>,
    /// Removal of the running surface until then, mm.
    pub removal: f64,
    /// Whether it is ground then.
    pub ground: bool,
    /// Why the run ends with this step, if it does; no cycles pass then.
    pub stop: Option<RunStop>,
    /// What the reader must know of it.
    pub warnings: Vec<Warning>,
}
