//! A finished growth step as the run log keeps it.

use crate::fields::FieldFileEntry;
use railcrack::growth::{
    Axles, Mgt, PhaseTimes, Piece, PopInTest, RunStop, SolverCounts, TipRecord, Warning,
};
use serde::{Deserialize, Serialize};

/// A finished growth step: an entry of the run log, appended once and never changed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct StepDigest {
    pub step: usize,
    pub load_cycles: f64,
    /// Their estimated error by the increments.
    pub cycles_error: f64,
    /// Removed of the running surface so far, mm.
    pub removed: f64,
    pub tips: Vec<TipRecord>,
    /// x_c (mm) of the output position at which k1 of the step is largest.
    pub largest_k1_at: Option<f64>,
    pub dofs: usize,
    pub face_points: usize,
    /// Largest opening of the faces (mm) under wheels that do not feel the cracks, with fluid.
    pub unfelt_opening: f64,
    pub counts: SolverCounts,
    pub times: PhaseTimes,
    pub stop: Option<RunStop>,
    /// The test of a kink in a rail whose toughness is not given.
    pub pop_in_test: Option<PopInTest>,
    /// Pieces of the rail that were enclosed.
    pub pieces: Vec<Piece>,
    pub warnings: Vec<Warning>,
    pub fields: Vec<FieldFileEntry>,
}

impl StepDigest {
    /// Million gross tonnes so far, of axles of `tonnes`.
    pub fn mgt(&self, tonnes: f64) -> f64 {
        let Mgt(mgt) = Axles(self.load_cycles).mgt(tonnes);
        mgt
    }
}
