//! The state of a run between two steps.

use super::{Advance, EarlierRates, Geometry, Interval, Mover, PlaneGeometry, RunStop, WornSurface};
use crate::crack::CrackNetwork;
use serde::{Deserialize, Serialize};

/// State of a run after a step: all that it needs, with the case, to go on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GrowthState {
    /// The step to compute next.
    pub step: usize,
    /// The cracks at its start.
    pub geometry: Geometry,
    /// Load cycles at the start of the step before it.
    pub load_cycles: f64,
    /// The increment from there on, whose cycles its rate decides.
    pub interval: Option<Interval>,
    /// The running surface as wear and grinding have left it.
    pub worn: WornSurface,
    /// Set when the run has ended.
    pub ended: Option<RunStop>,
}

impl GrowthState {
    /// The beginning of a run in the plane with `cracks`.
    #[must_use]
    pub fn initial(cracks: &CrackNetwork) -> Self {
        Self::beginning(Geometry::Plane(PlaneGeometry::initial(cracks)))
    }

    /// The beginning of a run with `geometry`.
    #[must_use]
    pub fn beginning(geometry: Geometry) -> Self {
        Self {
            step: 0,
            geometry,
            load_cycles: 0.0,
            interval: None,
            worn: WornSurface::default(),
            ended: None,
        }
    }

    /// Takes up what `advance` removes of the surface, before its cracks are taken; `movers` are
    /// those of this step.
    pub(super) fn wear(&mut self, advance: &Advance, movers: &[Mover]) {
        let lengths = self.geometry.lengths().into_iter().enumerate();
        let longest = lengths.map(|(i, l)| self.worn.longest.get(i).map_or(l, |&before| l.max(before)));
        let longest = longest.collect();
        let before = EarlierRates { movers: movers.to_vec(), cycles: advance.cycles };
        self.worn = WornSurface {
            removed: self.worn.removed + advance.removal,
            grindings: self.worn.grindings + usize::from(advance.ground),
            longest,
            before: (!advance.ground && advance.cycles > 0.0).then_some(before),
        };
    }
}
