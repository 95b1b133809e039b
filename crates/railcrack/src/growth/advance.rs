//! The transition from one step to the next.

use super::{EarlierStep, Geometry, Interval, Piece, RunStop, Warning};

/// The transition to the next step.
#[derive(Debug, Clone, PartialEq)]
pub struct Advance {
    /// The cracks of the next step; where the run ends, only their stops change.
    pub geometry: Geometry,
    /// Pieces of the rail that this step encloses.
    pub pieces: Vec<Piece>,
    /// Cycles, growth and removal until the next step.
    pub progress: StepProgress,
    /// Why the run ends with this step, if it does; no further cycles then pass.
    pub stop: Option<RunStop>,
    /// Warnings that arise from the transition.
    pub warnings: Vec<Warning>,
}

/// Cycles, growth and removal from one step to the next; none by default.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StepProgress {
    /// Load cycles, as predicted at the start of the step.
    pub cycles: f64,
    /// Increment of the fastest mover as a fraction of the length of its crack.
    pub share: f64,
    /// This step as the next one sees it.
    pub earlier: Option<EarlierStep>,
    /// The increment that set the pace, from which the cycles follow once the rate at its end is
    /// known; `None` where no cycles pass.
    pub interval: Option<Interval>,
    /// Removal of the running surface during the step, mm.
    pub removal: f64,
    /// Whether the surface is ground at the end of the step.
    pub ground: bool,
    /// Whether it is a grinding, or was cut to end at one or at another event: such a step does not
    /// count towards the number of increments.
    pub is_cut: bool,
}
