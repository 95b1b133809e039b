//! Run log: the finished growth steps as far as the tables do not have them.

use super::field_files::FieldFileEntry;
use super::residual::ResidualSummary;
use railcrack::crack::{Crack, Junction};
use railcrack::growth::{PhaseTimes, Piece, RunStop, SolverCounts, StepRecord, TipRecord, Warning};
use serde::{Deserialize, Serialize};

/// A finished growth step: an entry of the run log, appended once and never changed.
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
    /// Pieces of the rail that were enclosed.
    pub pieces: Vec<Piece>,
    pub warnings: Vec<Warning>,
    pub fields: Vec<FieldFileEntry>,
}

/// The run after its last finished growth step: replaced with every step.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct Present {
    /// The cracks of step 0.
    pub initial_cracks: Vec<Crack>,
    /// The cracks of the last finished step.
    pub cracks: Vec<Crack>,
    /// Where they have joined each other.
    pub junctions: Vec<Junction>,
    /// The residual stress of the rail.
    pub residual: Option<ResidualSummary>,
    /// Wall time of the finished steps, resumptions counted, seconds.
    pub wall_s: f64,
    /// Part of it that went into writing, seconds.
    pub output_s: f64,
    /// The most memory held so far, resumptions counted, MB.
    pub peak_memory_mb: Option<f64>,
}

/// All finished growth steps.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct RunLog {
    pub steps: Vec<StepDigest>,
    pub now: Present,
}

impl RunLog {
    /// Takes up a finished step with its field files.
    pub(crate) fn add(&mut self, record: &StepRecord, fields: Vec<FieldFileEntry>) {
        if self.steps.is_empty() {
            self.now.initial_cracks.clone_from(&record.cracks);
        }
        self.now.cracks.clone_from(&record.cracks);
        self.now.junctions.clone_from(&record.junctions);
        self.steps.push(StepDigest {
            step: record.step,
            load_cycles: record.load_cycles,
            tips: record.tips.clone(),
            dofs: record.dofs,
            face_points: record.faces.points.len(),
            counts: record.counts,
            times: record.times,
            stop: record.stop,
            pieces: record.pieces.clone(),
            warnings: record.warnings.clone(),
            fields,
        });
    }

    pub(crate) fn pieces(&self) -> impl Iterator<Item = &Piece> {
        self.steps.iter().flat_map(|step| &step.pieces)
    }

    pub(crate) fn warnings(&self) -> impl Iterator<Item = &Warning> {
        self.steps.iter().flat_map(|step| &step.warnings)
    }

    pub(crate) fn fields(&self) -> impl Iterator<Item = &FieldFileEntry> {
        self.steps.iter().flat_map(|step| &step.fields)
    }
}
