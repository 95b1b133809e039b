//! Run log: the data of the finished growth steps that are not in the tables.

use super::companion::Companion;
use super::digest::StepDigest;
use super::residual::ResidualSummary;
use crate::disk::Seal;
use crate::fields::FieldFileEntry;
use railcrack::crack::{Crack, Junction};
use railcrack::fatigue::LargestK1;
use railcrack::fracture::SifHistory;
use railcrack::growth::{Piece, StepRecord, TipRecord, Warning};
use railcrack::math::Vec2;
use serde::{Deserialize, Serialize};

/// The run after its last finished growth step: replaced with every step.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct Present {
    /// The cracks of step 0.
    pub initial_cracks: Vec<Crack>,
    /// The whole path of each crack, what is removed of it included, in the coordinates of the
    /// initial surface; empty as long as nothing is.
    pub paths: Vec<Vec<Vec2>>,
    /// The cracks of the last finished step.
    pub cracks: Vec<Crack>,
    /// Where they have joined each other.
    pub junctions: Vec<Junction>,
    /// The residual stress of the rail.
    pub residual: Option<ResidualSummary>,
    /// Its table.
    pub residual_table: Option<Seal>,
    /// Other runs of the same cracks that the decision needs; none before the run has ended.
    pub companions: Option<Vec<Companion>>,
    /// The case with more steps with which the run went on after its end; none of another run.
    pub longer_case: Option<String>,
    /// Wall time of the finished steps, resumptions counted, seconds.
    pub wall_s: f64,
    /// Part of it that went into writing, seconds.
    pub output_s: f64,
    /// Peak memory so far, including resumptions, MB.
    pub peak_memory_mb: Option<f64>,
}

/// For the tip whose largest k1 is nearest to the toughness, the nearest output position of the
/// stabilised passage: k1 itself is evaluated at every load step.
fn largest_k1_at(record: &StepRecord) -> Option<f64> {
    let k1 = TipRecord::compared_k1;
    let (tip, opened) = record.tips.iter().enumerate().max_by(|a, b| k1(a.1).total_cmp(&k1(b.1)))?;
    let other = opened.opened_by.checked_sub(1).and_then(|i| record.other_wheels.get(i));
    let passage = other.unwrap_or(&record.passages).last()?;
    let samples = passage.sifs.get(tip)?.clone();
    passage.xc.get(LargestK1::of(&SifHistory { samples })?.sample).copied()
}

/// The path of `crack` below a surface that has come down by `removed` (mm), from the mouth that it
/// had at first: what is above its mouth is taken from the path `before`.
fn whole_path(before: &[Vec2], crack: &Crack, removed: f64) -> Vec<Vec2> {
    let lowered = crack.points().iter().map(|point| Vec2::new(point.x, point.y - removed));
    let above = before.iter().take_while(|point| crack.is_surface_breaking() && point.y > -removed);
    let above: Vec<Vec2> = above.copied().collect();
    // The current mouth is not a vertex of the path but the point where it is cut.
    let mouth = usize::from(!above.is_empty());
    above.into_iter().chain(lowered.skip(mouth)).collect()
}

/// All finished growth steps.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct RunLog {
    pub steps: Vec<StepDigest>,
    pub now: Present,
}

impl RunLog {
    /// Adds a finished step with its field files.
    pub(crate) fn add(&mut self, record: &StepRecord, fields: Vec<FieldFileEntry>) {
        if self.steps.is_empty() {
            self.now.initial_cracks = record.cracks().to_vec();
        }
        if record.removed > 0.0 {
            let before = |i: usize| match self.now.paths.get(i) {
                Some(path) => &path[..],
                None => self.now.cracks.get(i).map_or(&[][..], Crack::points),
            };
            let whole = |(i, crack): (usize, &Crack)| whole_path(before(i), crack, record.removed);
            self.now.paths = record.cracks().iter().enumerate().map(whole).collect();
        }
        self.now.cracks = record.cracks().to_vec();
        self.now.junctions = record.junctions().to_vec();
        self.steps.push(StepDigest {
            step: record.step,
            load_cycles: record.load_cycles,
            cycles_error: record.cycles_error,
            removed: record.removed,
            tips: record.tips.clone(),
            largest_k1_at: largest_k1_at(record),
            dofs: record.dofs,
            face_points: record.faces.points.len(),
            unfelt_opening: record.unfelt_opening,
            counts: record.counts,
            times: record.times,
            stop: record.stop,
            pop_in_test: record.pop_in_test,
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
