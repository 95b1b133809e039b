//! What a run remembers of its finished steps beyond the tables.

use super::fields::FieldFile;
use super::residual::ResidualSummary;
use railcrack::crack::{Crack, Junction};
use railcrack::growth::{PhaseTimes, Piece, RunStop, SolverCounts, StepRecord, TipRecord, Warning};
use serde::{Deserialize, Serialize};

/// One finished step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct StepDigest {
    pub step: usize,
    pub load_cycles: f64,
    pub tips: Vec<TipRecord>,
    pub dofs: usize,
    pub face_points: usize,
    pub counts: SolverCounts,
    pub times: PhaseTimes,
    pub stop: Option<RunStop>,
}

/// All finished steps.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct Story {
    /// The cracks of step 0.
    pub initial_cracks: Vec<Crack>,
    /// The cracks of the last finished step.
    pub cracks: Vec<Crack>,
    /// Where they have joined each other.
    pub junctions: Vec<Junction>,
    pub steps: Vec<StepDigest>,
    /// Pieces of the rail that were enclosed.
    pub pieces: Vec<Piece>,
    pub warnings: Vec<Warning>,
    /// The residual stress of the rail.
    pub residual: Option<ResidualSummary>,
    /// The field files.
    pub fields: Vec<FieldFile>,
    /// Wall time of the finished steps, resumptions counted, seconds.
    pub wall_s: f64,
    /// Part of it that went into writing, seconds.
    pub output_s: f64,
    /// The most memory held so far, resumptions counted, MB.
    pub peak_memory_mb: Option<f64>,
}

impl Story {
    /// Takes up a finished step.
    pub(crate) fn add(&mut self, record: &StepRecord) {
        if self.steps.is_empty() {
            self.initial_cracks.clone_from(&record.cracks);
        }
        self.cracks.clone_from(&record.cracks);
        self.junctions.clone_from(&record.junctions);
        self.pieces.extend(record.pieces.iter().cloned());
        self.warnings.extend(record.warnings.iter().cloned());
        self.steps.push(StepDigest {
            step: record.step,
            load_cycles: record.load_cycles,
            tips: record.tips.clone(),
            dofs: record.dofs,
            face_points: record.faces.points.len(),
            counts: record.counts,
            times: record.times,
            stop: record.stop,
        });
    }
}
