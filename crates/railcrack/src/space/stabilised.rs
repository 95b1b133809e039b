//! The stabilised passage over a crack in space.

use super::body::FrontSif;
use super::contact::{SpaceContact, SpaceContactError};
use super::passage::{SpaceHistory, SpaceLoad, SpacePassageSettings, SpacePassages};
use crate::contact::StepControl;
use crate::growth::{Memory, Observer, PassageSettings, Repeats, SolverCounts, until_repeated};
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
}

/// Computes passages over the faces of `contact` until K changes by less than the tolerance.
///
/// The step control is scaled by the peak of K in a trial passage with one step between positions,
/// which is not counted.
///
/// Errors: contact that does not converge; an interruption by `observer`.
pub(super) fn stabilised_space_passage(
    contact: &SpaceContact,
    load: &SpaceLoad,
    settings: &PassageSettings,
    observer: &dyn Observer,
) -> Result<StabilisedSpace, SpaceContactError> {
    let passages = SpacePassages::new(contact, load, settings.passage, observer)?;
    let mut faces = contact.virgin();
    let coarse = SpacePassageSettings { tolerance: f64::INFINITY, halvings: 0 };
    let fine = match settings.step_control {
        StepControl::Fixed => coarse,
        StepControl::Adaptive => {
            let guarded = SpacePassageSettings { halvings: HALVINGS, ..coarse };
            let peak = match passages.pass(&coarse, &mut contact.virgin()) {
                Err(SpaceContactError::NotConverged { .. }) => passages.pass(&guarded, &mut contact.virgin()),
                peak => peak,
            }?
            .peak();
            let tolerance = (settings.step_tolerance * peak).max(f64::MIN_POSITIVE);
            SpacePassageSettings { tolerance, halvings: HALVINGS }
        }
    };
    let memory = if contact.friction.iter().any(|&mu| mu > 0.0) { Memory::Friction } else { Memory::None };
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
        between: contact.body.sifs_of_jumps(&faces.jumps),
        counts: SolverCounts { passages: histories.len(), ..counts },
        passages: histories,
        last_change: repeated.change,
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
