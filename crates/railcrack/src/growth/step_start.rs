//! The start of a step.

use super::{EarlierStep, Turn, WornSurface};

/// Progress of a run at the start of a step.
#[derive(Debug, Clone, Copy)]
pub struct StepStart<'a> {
    /// Step number, from 0.
    pub step: usize,
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
