//! Computation of the passages of one wheel by the contact solvers.

use super::face_load::FaceLoad;
use super::rail_load::RailLoad;
use super::stabilise::passages_under;
use crate::contact::{ContactSolver, Rescued};
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
