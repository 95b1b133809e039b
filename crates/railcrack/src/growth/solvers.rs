//! The passages of one step by the contact solvers, those of several wheels side by side.

use super::face_load::FaceLoad;
use super::mix::Beside;
use super::stabilise::passages_under;
use super::{
    GrowthError, Observer, PassageError, PassageSettings, RailLoad, StabilisedPassage, Warning, WarningKind,
};
use crate::contact::ContactSolver;
use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};

/// The solvers of a step.
#[derive(Clone, Copy)]
pub(super) struct Solvers<'a> {
    pub first: &'a dyn ContactSolver,
    /// Takes over where the first one fails.
    pub second: &'a dyn ContactSolver,
    pub step: usize,
}

/// A load with its passages.
type Load<'a> = (RailLoad<'a>, &'a PassageSettings);

impl Solvers<'_> {
    /// The passages, by the first solver or, where it fails, by the other one.
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
            // Groups are for Newton's method alone.
            Err(PassageError::NotConverged { .. }) if face_load.problem.body().blocks.is_none() => {
                let second = by(self.second);
                if let (Err(failure), Ok(_)) = (&first, &second) {
                    let text = format!("the other contact solver did this step, since: {failure}");
                    warnings.push(Warning { step, kind: WarningKind::ContactFallback, text });
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

    /// The passages of every wheel of a mix on the same body: wheels know nothing of each other.
    pub fn side_by_side(
        &self,
        face_loads: &[&FaceLoad],
        loads: &[Load],
        observer: &dyn Observer,
        warnings: &mut Vec<Warning>,
    ) -> Result<Vec<StabilisedPassage>, GrowthError> {
        let beside = Beside(observer);
        let of_wheel = |(wheel, (face_load, load)): (usize, (&&FaceLoad, &Load))| {
            let mut warnings = Vec::new();
            let observer = if wheel == 0 { observer } else { &beside };
            let passage = self.stabilise(face_load, *load, observer, &mut warnings);
            let named = |w: Warning| Warning { text: format!("wheel {}, {}", wheel + 1, w.text), ..w };
            (passage, warnings.into_iter().map(named).collect::<Vec<_>>())
        };
        let all: Vec<_> = face_loads.par_iter().zip(loads).enumerate().map(of_wheel).collect();
        let mut passages = Vec::with_capacity(all.len());
        for (passage, told) in all {
            warnings.extend(told);
            passages.push(passage?);
        }
        Ok(passages)
    }
}
