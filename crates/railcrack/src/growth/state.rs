//! The state of a run between two steps.

use super::{
    Advance, Course, EarlierStep, Geometry, Interval, PlaneGeometry, RunStop, StepProgress, StepStart,
    WornSurface,
};
use crate::crack::CrackNetwork;
use serde::{Deserialize, Serialize};

/// State of a run after a step: with the case, all that is needed to continue it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GrowthState {
    /// The step to compute next.
    pub step: usize,
    /// Steps so far that count towards the number of increments.
    #[serde(default)]
    pub counted: usize,
    /// The cracks at its start.
    pub geometry: Geometry,
    /// Load cycles at the start of the step before it.
    pub load_cycles: f64,
    /// The last increment, whose cycles depend on the rate at the start of the next step.
    pub interval: Option<Interval>,
    /// The previous step, from which rates are extrapolated.
    pub earlier: Option<EarlierStep>,
    /// Increments and their estimated error so far.
    pub course: Course,
    /// The running surface after wear and grinding.
    pub worn: WornSurface,
    /// The largest k1 (MPa √mm) for which a kink has been tested; 0 before the first test.
    pub tested_k1: f64,
    /// Why the run has ended; `None` while it continues.
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
            counted: 0,
            geometry,
            load_cycles: 0.0,
            interval: None,
            earlier: None,
            course: Course::default(),
            worn: WornSurface::default(),
            tested_k1: 0.0,
            ended: None,
        }
    }

    /// The start of its step, before the cycles of the previous one are known.
    pub(super) fn start(&self) -> StepStart<'_> {
        StepStart {
            step: self.step,
            counted: self.counted,
            load_cycles: self.load_cycles,
            earlier: self.earlier.as_ref(),
            ..StepStart::standing(&self.worn)
        }
    }

    /// The state after `advance` from this one, whose step began at `load_cycles`.
    pub(super) fn after(&self, advance: &Advance, load_cycles: f64) -> Self {
        let StepProgress { interval, earlier, removal, ground, .. } = &advance.progress;
        let lengths = self.geometry.lengths().into_iter().enumerate();
        let longest = lengths.map(|(i, length)| self.worn.longest_of(i, length)).collect();
        Self {
            step: self.step + 1,
            counted: self.counted + usize::from(!advance.progress.is_cut),
            geometry: advance.geometry.clone(),
            load_cycles,
            interval: *interval,
            earlier: earlier.clone(),
            course: self.course,
            worn: WornSurface {
                removed: self.worn.removed + removal,
                grindings: self.worn.grindings + usize::from(*ground),
                longest,
            },
            tested_k1: self.tested_k1,
            ended: advance.stop,
        }
    }
}
