//! A wheel over cracks in the plane, and its stabilised passage by the contact solvers.

use super::face_load::{FaceLoad, RailLoad};
use super::passage::passages_of_all;
use super::sweeps::passages_by_groups;
use crate::contact::{ContactSolver, CrackFluid, FaceProblem, Rescued};
use crate::coupling::WheelCoupling;
use crate::field::{StressField, Wheel};
use crate::growth::{
    GrowthError, Observer, PassageError, PassageSettings, StabilisedPassage, Warning, WarningKind,
};

/// The solvers of a step.
#[derive(Clone, Copy)]
pub(super) struct Solvers<'a> {
    pub first: &'a dyn ContactSolver,
    /// Solver that takes over where the first one fails: for single load steps, or for all.
    pub second: &'a dyn ContactSolver,
    pub step: usize,
}

/// A load with its passages.
type Load<'a> = (RailLoad<'a>, &'a PassageSettings);

impl Solvers<'_> {
    /// The passages, computed by the first solver; where it fails, by the first one but for the
    /// load steps in which it fails; and where this fails, by the second one.
    pub fn stabilise(
        &self,
        face_load: &FaceLoad,
        (load, settings): Load,
        observer: &dyn Observer,
        warnings: &mut Vec<Warning>,
    ) -> Result<StabilisedPassage, GrowthError> {
        let step = self.step;
        let by = |solver: &dyn ContactSolver| passages_under(face_load, load, solver, settings, observer);
        let first = by(self.first);
        let result = match first {
            // Only Newton's method supports groups.
            Err(PassageError::NotConverged { .. }) if face_load.problem.body().blocks.is_none() => {
                let rescued = by(&Rescued { first: self.first, second: self.second });
                let second = if rescued.is_ok() { rescued } else { by(self.second) };
                if let (Err(failure), Ok(_)) = (&first, &second) {
                    let text = format!(
                        "the other contact solver computed this step, because the first one failed: {failure}"
                    );
                    warnings.push(Warning { step, kind: WarningKind::ContactFallback, text, severity: None });
                }
                if matches!(second, Err(PassageError::NotConverged { .. })) { first } else { second }
            }
            other => other,
        };
        result.map_err(|source| match source {
            PassageError::Interrupted => GrowthError::Interrupted { step },
            source => GrowthError::Passage { step, source },
        })
    }
}

/// The stabilised passage over fixed cracks. Residual stress is ramped up on virgin faces; then the
/// wheel passes until the histories of K of two consecutive passages agree. Faces without friction
/// have no memory, and one passage is enough. The wheel arrives from infinity and leaves to
/// infinity; in a rail with ends, its load is ramped up at the first position and down at the last.
///
/// Where the wheel bends the rail, the passage and its output positions extend as far as the
/// deflection of the beam.
///
/// In a body built by groups, each crack is followed with its neighbours, in sweeps until K is
/// within `network_tolerance`.
///
/// Errors: inadmissible settings; a wheel that leaves the rail; contact that does not converge; an
/// interruption by `observer`.
pub fn stabilised_passage(
    problem: &FaceProblem,
    solver: &dyn ContactSolver,
    load: RailLoad,
    settings: &PassageSettings,
    observer: &dyn Observer,
) -> Result<StabilisedPassage, PassageError> {
    settings.check()?;
    let ends = problem.body().ends.as_ref().map(|rail| load.at_ends(rail, settings)).transpose()?;
    let face_load = FaceLoad::new(problem, load, ends.as_deref())?;
    passages_under(&face_load, load, solver, settings, observer)
}

/// [`stabilised_passage`] under a known load on the faces.
pub(super) fn passages_under(
    face_load: &FaceLoad,
    load: RailLoad,
    solver: &dyn ContactSolver,
    settings: &PassageSettings,
    observer: &dyn Observer,
) -> Result<StabilisedPassage, PassageError> {
    match &face_load.problem.body().blocks {
        Some(blocks) => passages_by_groups(face_load, blocks, load, solver, settings, observer),
        None => passages_of_all(face_load, load, solver, settings, observer),
    }
}

/// A wheel over cracks in the plane, with its own stress state, fluid, passages and toughness.
pub struct PlaneWheel {
    /// Its field.
    pub wheel: Box<dyn Wheel>,
    /// Share of the axles; the shares of all wheels of a rail add up to 1.
    pub share: f64,
    /// Stress of the rail that is present with and without the wheel, balanced, including thermal
    /// stress.
    pub residual: Option<Box<dyn StressField>>,
    /// Fluid in the cracks while it passes; `None` for dry cracks.
    pub fluid: Option<CrackFluid>,
    /// How it feels the cracks; `None` for the contact on the uncracked rail.
    pub coupling: Option<WheelCoupling>,
    /// Its passages.
    pub passages: PassageSettings,
    /// K_Ic (MPa √mm) at its temperature; `None` for that of the growth settings.
    pub toughness: Option<f64>,
}

impl PlaneWheel {
    /// The only wheel of a rail without residual stress, over dry cracks that it does not feel.
    #[must_use]
    pub fn new(wheel: Box<dyn Wheel>) -> Self {
        Self {
            wheel,
            share: 1.0,
            residual: None,
            fluid: None,
            coupling: None,
            passages: PassageSettings::default(),
            toughness: None,
        }
    }
}
