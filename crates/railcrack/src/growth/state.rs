//! The state of a run between two steps.

use super::{BreakOut, DeferredGrowth, Interval, RunStop, TipStop};
use crate::crack::{Crack, CrackNetwork, Junction};
use serde::{Deserialize, Serialize};

/// State of a run after a step: all that it needs to go on, beside the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GrowthState {
    /// The step to compute next.
    pub step: usize,
    /// The cracks at its start.
    pub cracks: Vec<Crack>,
    /// Where they have joined each other.
    pub junctions: Vec<Junction>,
    /// Tips that have broken out.
    pub break_outs: Vec<BreakOut>,
    /// Load cycles at the start of the step before it.
    pub load_cycles: f64,
    /// The increment from there on, whose cycles its rate decides.
    pub interval: Option<Interval>,
    /// `stopped[crack][tip]`: why a tip no longer grows; the tips of a crack are its ends below the
    /// surface, joined ones counted.
    pub stopped: Vec<Vec<Option<TipStop>>>,
    /// `deferred[crack][tip]`: growth that is not in the cracks yet.
    pub deferred: Vec<Vec<DeferredGrowth>>,
    /// Set when the run has ended.
    pub ended: Option<RunStop>,
}

impl GrowthState {
    /// The beginning of a run with `cracks`.
    #[must_use]
    pub fn initial(cracks: &CrackNetwork) -> Self {
        let tips = || cracks.cracks().iter().map(|crack| crack.tips().len());
        Self {
            step: 0,
            cracks: cracks.cracks().to_vec(),
            junctions: cracks.junctions().to_vec(),
            break_outs: Vec::new(),
            load_cycles: 0.0,
            interval: None,
            stopped: tips().map(|tips| vec![None; tips]).collect(),
            deferred: tips().map(|tips| vec![DeferredGrowth::default(); tips]).collect(),
            ended: None,
        }
    }

    /// Growth at the tips of crack `crack` (from 0) that is not in it yet, mm.
    pub(super) fn deferred_at(&self, crack: usize) -> f64 {
        self.deferred[crack].iter().map(|deferred| deferred.length).sum()
    }
}
