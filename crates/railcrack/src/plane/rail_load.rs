//! The load of the uncracked rail.

use crate::field::{EndField, EndsError, RailEnds, StressField, Wheel};
use crate::growth::PassageSettings;
use crate::load::Passage;
use std::sync::Arc;

/// Load of the uncracked rail: a passing wheel and residual stress.
#[derive(Clone, Copy)]
pub struct RailLoad<'a> {
    /// The wheel.
    pub wheel: &'a dyn Wheel,
    /// Balanced residual stress.
    pub residual: Option<&'a dyn StressField>,
}

impl RailLoad<'_> {
    /// The field that the ends of a `rail` add to that of the wheel during its passage.
    ///
    /// Errors: a wheel that leaves the rail or comes too close to an end.
    pub(super) fn at_ends(
        &self,
        rail: &Arc<dyn RailEnds>,
        settings: &PassageSettings,
    ) -> Result<Arc<dyn EndField>, EndsError> {
        let Passage { from, to, .. } = settings.passage;
        Arc::clone(rail).under(self.wheel, from.min(to)..=from.max(to))
    }
}
