//! Interface between the growth loop, its observer and a cracked rail, in the plane or in space.

use super::{
    Advance, FieldRecord, Geometry, GrowthError, GrowthSettings, GrowthState, Mover, PassageSettings,
    StabilisedPassage, StepStart, TipRecord, Warning,
};
use crate::body::BodyTimes;
use crate::fracture::SifHistory;
use crate::interruption::Interruption;
use crate::math::OutOfRange;
use std::fmt::Debug;

/// A rail with cracks under its wheels: how to build bodies, compute passages and advance cracks.
/// Everything else is common to plane and space and is done by [`Growth`](super::Growth).
pub trait CrackedRail {
    /// The cracks of a step as a body.
    type Body;
    /// The cracks of a step, as far as their increments depend on them.
    type Site: Clone;

    /// Growth law, increments and stops.
    fn settings(&self) -> &GrowthSettings;

    /// The wheels, at least one; their shares add up to 1.
    fn wheels(&self) -> Vec<WheelOfRail<'_>>;

    /// The engine settings that would resolve K better, named in a warning.
    fn refinement(&self) -> &'static str;

    /// The body with the cracks of `state`.
    ///
    /// Errors: cracks of the other geometry; cracks that the engine cannot represent; an
    /// interruption.
    fn body(
        &mut self,
        state: &GrowthState,
        interruption: Interruption<'_>,
    ) -> Result<Self::Body, GrowthError>;

    /// Size and cost of `body`, with the engine's remarks on it.
    fn report(&self, body: &Self::Body) -> BodyReport;

    /// The stabilised passage of every wheel over `body`, in the order of [`CrackedRail::wheels`].
    ///
    /// Errors: contact that does not converge; an interruption.
    fn passages(
        &mut self,
        body: &Self::Body,
        at: &StepStart<'_>,
        observer: &dyn Observer,
        warnings: &mut Vec<Warning>,
    ) -> Result<Vec<StabilisedPassage>, GrowthError>;

    /// The fields around the cracks under the stabilised `passage` of the first wheel, in the steps
    /// for which they are requested.
    ///
    /// Errors: fields that the engine cannot compute.
    fn fields(
        &mut self,
        body: &Self::Body,
        at: &StepStart<'_>,
        passage: &StabilisedPassage,
    ) -> Result<Option<FieldRecord>, GrowthError>;

    /// State and loading of every tip under the passages of all wheels, without increments.
    fn demands(&self, body: &Self::Body, passages: &[StabilisedPassage]) -> Vec<TipRecord>;

    /// Everything that moves the cracks, with its rate.
    fn movers(&self, body: &Self::Body, tips: &[TipRecord]) -> Vec<Mover>;

    /// The part of `body` from which increments are made.
    fn site(&self, body: &Self::Body) -> Self::Site;

    /// The transition to the next step; increments and stops are written into `tips`.
    fn advance(
        &self,
        site: &Self::Site,
        at: &StepStart<'_>,
        tips: &mut [TipRecord],
        movers: &[Mover],
    ) -> Advance;

    /// The largest k1 of `tip` over the toughness under the wheel that causes it; 0 where the tip
    /// cannot break the rail.
    fn hazard(&self, site: &Self::Site, tip: &TipRecord) -> f64;

    /// The cracks of `site` with a kink of `length` (mm) at each of `tips`, in the direction of its
    /// largest k1; `None` where cracks cannot be kinked.
    fn popped_in(&self, site: &Self::Site, tips: &[&TipRecord], length: f64) -> Option<Geometry>;

    /// Drops whatever is needed only to build further bodies.
    fn forget(&mut self) {}
}

/// A wheel of a rail.
#[derive(Debug, Clone, Copy)]
pub struct WheelOfRail<'a> {
    /// Share of the axles.
    pub share: f64,
    /// K_Ic (MPa √mm) at its temperature; `None` where fracture is not considered.
    pub toughness: Option<f64>,
    /// Its passages.
    pub passages: &'a PassageSettings,
}

/// Size and cost of a body.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BodyReport {
    /// Number of displacement unknowns.
    pub dofs: usize,
    /// Wall times, where the engine measures them.
    pub times: BodyTimes,
    /// Remarks on the engine's representation of the cracks, where it affects the results.
    pub remarks: Vec<String>,
}

/// Checks the settings of growth and of the passages of every wheel of `rail`.
///
/// Errors: inadmissible settings.
pub(super) fn check(rail: &impl CrackedRail) -> Result<(), OutOfRange> {
    rail.wheels().iter().try_for_each(|wheel| wheel.passages.check())?;
    rail.settings().check()
}

/// A judge of tips, which replaces the direction criterion and the growth law of the settings.
pub trait TipJudge: Debug + Send + Sync {
    /// Judges a tip by `history`, K through its stabilised passage (MPa √mm). The record of the
    /// `tip` contains its state and loading, and the direction and rate given by the settings,
    /// which may be overwritten.
    fn judge(&self, history: &SifHistory, tip: &mut TipRecord);
}

/// An observer of a step that is being computed, which may interrupt it.
pub trait Observer: Sync {
    /// Receives the completed fraction (0 to 1) of the current passage.
    fn progress(&self, fraction: f64);
    /// Whether to abandon the current step now.
    fn interrupted(&self) -> bool;
}

/// No observer: the step runs to its end without reporting progress.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Unobserved;

impl Observer for Unobserved {
    fn progress(&self, _: f64) {}

    fn interrupted(&self) -> bool {
        false
    }
}
