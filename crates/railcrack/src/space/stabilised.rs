//! The stabilised passage over a crack in space.

use super::body::{FrontSif, SpaceBody};
use super::contact::SpaceContactError;
use super::history::{SpaceHistory, SpacePassageSettings};
use super::passage::SpacePassages;
use super::states::SpaceFaces;
use crate::contact::StepControl;
use crate::growth::{GroupsError, Memory, PassageSettings, Repeats, SolverCounts, until_repeated};
use crate::linear::LinearError;
use std::rc::Rc;

/// Largest number of times that two intervals between output positions are halved.
const HALVINGS: usize = 8;

/// Passages computed until the history repeats.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct StabilisedSpace {
    /// All passages, the stabilised one last.
    pub passages: Vec<SpaceHistory>,
    /// K after the last passage, without the wheel, MPa √mm.
    pub between: Vec<FrontSif>,
    /// Effort of all passages.
    pub counts: SolverCounts,
    /// Change of K between the last two passages, relative to its peak; `None` after a single one.
    pub last_change: Option<f64>,
    /// The estimated error of K, where cracks are solved for in groups.
    pub groups: Option<GroupsError>,
}

/// Passages over cracks that are solved for together or in groups.
pub(super) trait Passages {
    /// The largest K (MPa √mm) in a trial passage over virgin faces, which is not counted.
    ///
    /// Errors: contact that does not converge; an interruption.
    fn trial(&mut self, settings: &SpacePassageSettings) -> Result<f64, SpaceContactError>;

    /// A passage over the faces `faces`, which are updated to their state after it, without the
    /// wheel.
    ///
    /// Errors: contact that does not converge; an interruption.
    fn pass(
        &mut self,
        settings: &SpacePassageSettings,
        faces: &mut SpaceFaces,
    ) -> Result<SpaceHistory, SpaceContactError>;

    /// The estimated error of K; none where all cracks are solved for together.
    ///
    /// Errors: matrices whose shapes do not match.
    fn error(&self) -> Result<Option<GroupsError>, LinearError>;
}

impl Passages for SpacePassages<'_> {
    fn trial(&mut self, settings: &SpacePassageSettings) -> Result<f64, SpaceContactError> {
        Ok(Self::pass(self, settings, &mut self.virgin())?.peak())
    }

    fn pass(
        &mut self,
        settings: &SpacePassageSettings,
        faces: &mut SpaceFaces,
    ) -> Result<SpaceHistory, SpaceContactError> {
        Self::pass(self, settings, faces)
    }

    fn error(&self) -> Result<Option<GroupsError>, LinearError> {
        Ok(None)
    }
}

/// Computes passages over the faces of `body`, with friction in the cracks or without any, until K
/// changes by less than the tolerance.
///
/// The step control is scaled by the peak of K in a trial passage with one step between positions.
///
/// Errors: contact that does not converge; an interruption.
pub(super) fn stabilised_space_passage(
    body: &SpaceBody,
    memory: Memory,
    passages: &mut impl Passages,
    settings: &PassageSettings,
) -> Result<StabilisedSpace, SpaceContactError> {
    let mut faces = SpaceFaces::virgin(body.points().len());
    let coarse = SpacePassageSettings { tolerance: f64::INFINITY, halvings: 0 };
    let fine = match settings.step_control {
        StepControl::Fixed => coarse,
        StepControl::Adaptive => {
            let guarded = SpacePassageSettings { halvings: HALVINGS, ..coarse };
            let peak = match passages.trial(&coarse) {
                Err(SpaceContactError::NotConverged { .. }) => passages.trial(&guarded),
                peak => peak,
            }?;
            let tolerance = (settings.step_tolerance * peak).max(f64::MIN_POSITIVE);
            SpacePassageSettings { tolerance, halvings: HALVINGS }
        }
    };
    let repeated = until_repeated(settings, memory, |_, _| passages.pass(&fine, &mut faces).map(Rc::new))?;
    drop(repeated.last);
    let histories: Vec<SpaceHistory> = repeated.records.into_iter().map(Rc::unwrap_or_clone).collect();
    let outputs = settings.passage.positions;
    let counts = histories.iter().fold(SolverCounts::default(), |sum, history| {
        let one = SolverCounts {
            passages: 0,
            substeps: history.steps.saturating_sub(outputs + 2),
            solves: history.steps,
            iterations: history.iterations,
            iterations_max: history.iterations_max,
            complementarity_max: history.violation,
        };
        sum.and(one)
    });
    Ok(StabilisedSpace {
        between: body.sifs_of_jumps(&faces.jumps),
        counts: SolverCounts { passages: histories.len(), ..counts },
        passages: histories,
        last_change: repeated.change,
        groups: passages.error()?,
    })
}

impl Repeats for Rc<SpaceHistory> {
    type Record = Self;

    fn record(&self) -> Self {
        Self::clone(self)
    }

    fn change_from(&self, before: &Self) -> f64 {
        self.difference(before) / self.peak().max(f64::MIN_POSITIVE)
    }
}
