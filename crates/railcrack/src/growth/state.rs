//! The state of a run between two steps.

use super::{
    Advance, BreakOut, DeferredGrowth, EarlierRates, FrontState, Interval, RunStop, TipDrive, TipStop,
    WornSurface,
};
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
    /// The running surface as wear and grinding have left it.
    pub worn: WornSurface,
    /// The cracks in space, of a run there.
    pub front: Option<FrontState>,
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
            worn: WornSurface::default(),
            front: None,
            ended: None,
        }
    }

    /// Takes up what the way to the next step removes of the surface. To be called before the
    /// cracks of that step are taken; `drives` are the tips of this one.
    pub(super) fn wear(&mut self, way: &Advance, drives: &[TipDrive]) {
        let lengths = (0..self.cracks.len()).map(|i| self.cracks[i].length() + self.deferred_at(i));
        let longest =
            lengths.enumerate().map(|(i, l)| self.worn.longest.get(i).map_or(l, |&before| l.max(before)));
        let longest = longest.collect();
        let rates = drives.iter().map(|drive| (drive.tip, drive.rate)).collect();
        let before = EarlierRates { rates, cycles: way.cycles };
        self.worn = WornSurface {
            removed: self.worn.removed + way.removal,
            grindings: self.worn.grindings + usize::from(way.ground),
            longest,
            before: (!way.ground && way.cycles > 0.0).then_some(before),
        };
    }

    /// Growth at the tips of crack `crack` (from 0) that is not in it yet, mm.
    pub(super) fn deferred_at(&self, crack: usize) -> f64 {
        self.deferred[crack].iter().map(|deferred| deferred.length).sum()
    }
}
