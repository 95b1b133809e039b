//! The start of a step: progress of the run, the previous step, and all that moves the cracks.

use super::{Turn, WornSurface};
use serde::{Deserialize, Serialize};

/// Progress of a run at the start of a step.
#[derive(Debug, Clone, Copy)]
pub struct StepStart<'a> {
    /// Step number, from 0.
    pub step: usize,
    /// Steps so far that count: not grindings, nor increments that were cut to end at an event.
    pub counted: usize,
    /// Load cycles so far.
    pub load_cycles: f64,
    /// The running surface as wear and grinding have left it.
    pub worn: &'a WornSurface,
    /// Load cycles of the previous step.
    pub passed: f64,
    /// The previous step, if any.
    pub earlier: Option<&'a EarlierStep>,
    /// Increment of the fastest mover as a fraction of the length of its crack.
    pub share: f64,
    /// The most cycles that the step may take.
    pub cycles_at_most: f64,
    /// Turns of tips of the limit path, where they are known already.
    pub turns: &'a [Turn],
}

impl<'a> StepStart<'a> {
    /// A step in which nothing has happened before.
    pub(crate) fn standing(worn: &'a WornSurface) -> Self {
        Self {
            step: 0,
            counted: 0,
            load_cycles: 0.0,
            worn,
            passed: 0.0,
            earlier: None,
            share: 0.0,
            cycles_at_most: f64::INFINITY,
            turns: &[],
        }
    }
}

/// The previous step as the next one sees it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EarlierStep {
    /// The movers at its start.
    pub movers: Vec<Mover>,
    /// For each of them, its growth until the start of the step less all its increments up to the
    /// end of it, mm: negative by the growth of the step itself.
    pub balance: Vec<f64>,
    /// For each of them, its predicted growth during the step, mm.
    pub growth: Vec<f64>,
    /// Its cycles as they were predicted.
    pub cycles: f64,
    /// Where its cycles followed from an increment, the mover that made it and its growth, mm.
    pub leader: Option<(Mover, f64)>,
    /// Whether the prediction used the rates of two steps.
    pub is_extrapolated: bool,
    /// Whether the rates vary smoothly from its start to its end: not where a crack kinked at its
    /// start or where it was a grinding.
    pub is_smooth: bool,
}

impl EarlierStep {
    /// The predicted growth (mm) of `mover` during the step.
    pub(super) fn growth_of(&self, mover: &Mover) -> Option<f64> {
        self.movers.iter().position(|own| own.is(mover)).map(|i| self.growth[i])
    }
}

/// A tip of a crack in the plane, or a motion of the front of a crack in space, with its rate.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Mover {
    /// The crack, from 0.
    pub crack: usize,
    /// Index of the tip (from 0) in the crack, or the motion ([`FrontMotion`](super::FrontMotion)
    /// as a number).
    pub index: usize,
    /// Its rate, mm per cycle.
    pub rate: f64,
    /// Length of its crack, mm.
    pub length: f64,
}

impl Mover {
    /// Whether both are the same tip or motion.
    #[must_use]
    pub fn is(&self, other: &Self) -> bool {
        (self.crack, self.index) == (other.crack, other.index)
    }
}
