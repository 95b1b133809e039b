//! What the growth loop asks of a cracked rail, in the plane or in space.

use super::{
    Advance, FieldRecord, GrowthError, GrowthSettings, GrowthState, Mover, Observer, PassageSettings,
    StabilisedPassage, TipRecord, Warning, WornSurface,
};
use crate::body::BodyTimes;
use crate::interruption::Interruption;
use crate::math::OutOfRange;

/// A rail with cracks under its wheels: how bodies are made, passages are computed, and cracks move.
/// Everything else is done once, in [`Growth`](super::Growth).
pub trait CrackedRail {
    /// The cracks of a step as a body.
    type Body;

    /// Growth law, increments, stops.
    fn settings(&self) -> &GrowthSettings;

    /// The wheels, at least one; the shares of a mix add up to 1.
    fn wheels(&self) -> Vec<WheelOfRail<'_>>;

    /// The settings of the engine that resolve K better, for a warning.
    fn refinement(&self) -> &'static str;

    /// The body of the cracks of `state`.
    ///
    /// Errors: cracks of the other geometry; the engine cannot represent them; an interruption.
    fn body(
        &mut self,
        state: &GrowthState,
        interruption: Interruption<'_>,
    ) -> Result<Self::Body, GrowthError>;

    /// Size and cost of `body`, and remarks of the engine on it.
    fn report(&self, body: &Self::Body) -> BodyReport;

    /// The stabilised passage of every wheel over `body`, in the order of [`CrackedRail::wheels`].
    ///
    /// Errors: contact does not converge; an interruption.
    fn passages(
        &mut self,
        body: &Self::Body,
        at: &StepStart<'_>,
        observer: &dyn Observer,
        warnings: &mut Vec<Warning>,
    ) -> Result<Vec<StabilisedPassage>, GrowthError>;

    /// The fields around the cracks under the stabilised `passage` of the first wheel, in the steps
    /// in which they are wanted.
    ///
    /// Errors: the engine cannot compute them.
    fn fields(
        &mut self,
        body: &Self::Body,
        at: &StepStart<'_>,
        passage: &StabilisedPassage,
    ) -> Result<Option<FieldRecord>, GrowthError>;

    /// State and demand of every tip under the passages of all wheels, without increments.
    fn demands(&self, body: &Self::Body, passages: &[StabilisedPassage]) -> Vec<TipRecord>;

    /// Everything that moves a crack, with its rate.
    fn movers(&self, body: &Self::Body, tips: &[TipRecord]) -> Vec<Mover>;

    /// The cracks of the next step. Increments and stops are written into `tips`.
    fn advance(
        &self,
        body: &Self::Body,
        at: &StepStart<'_>,
        tips: &mut [TipRecord],
        movers: &[Mover],
    ) -> Advance;

    /// Gives up what is only needed for further bodies.
    fn forget(&mut self) {}
}

/// A wheel of a rail.
#[derive(Debug, Clone, Copy)]
pub struct WheelOfRail<'a> {
    /// Share of the axles.
    pub share: f64,
    /// K_Ic (MPa √mm) at its temperature; none where the rail does not break.
    pub toughness: Option<f64>,
    /// Its passages.
    pub passages: &'a PassageSettings,
}

/// Size and cost of a body.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BodyReport {
    /// Number of displacement unknowns.
    pub dofs: usize,
    /// Wall times, as far as the engine measures them.
    pub times: BodyTimes,
    /// How the engine represents the cracks, where that matters for the results.
    pub remarks: Vec<String>,
}

/// Where a run stands at the start of a step.
#[derive(Debug, Clone, Copy)]
pub struct StepStart<'a> {
    /// Step number, from 0.
    pub step: usize,
    /// Load cycles so far.
    pub load_cycles: f64,
    /// The running surface as wear and grinding have left it.
    pub worn: &'a WornSurface,
}

/// Checks the settings of growth and of the passages of every wheel of `rail`.
///
/// Errors: settings under which nothing can be computed.
pub(super) fn check(rail: &impl CrackedRail) -> Result<(), OutOfRange> {
    rail.wheels().iter().try_for_each(|wheel| wheel.passages.check())?;
    rail.settings().check()
}
