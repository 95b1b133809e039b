//! Evolution of K at the tips over the load steps.

use crate::body::FacePoint;
use crate::contact::{FaceProblem, FaceSolution, PointStatus};
use crate::crack::End;
use crate::fracture::{Sif, SifHistory};

/// K of every tip. A tip that sticks keeps its K.
///
/// K is determined by the jump next to the tip: while the faces stick there, K cannot change,
/// however much the rest of the crack slips. An engine that integrates K over the elements around
/// the tip also sees their neighbourhood, and its K drifts by up to 3 % as the slip zone
/// approaches, before the tip itself slips. K of a tip whose nearest face point does not slip is
/// therefore held; when that point slips, K_II is released as soon as it changes in the direction
/// of the slip.
#[derive(Debug, Clone)]
pub(super) struct TipSifs {
    tips: Vec<TipSif>,
}

/// Slip below this share of the largest slip so far counts as zero: a hundred times the tolerance
/// of the solvers, which is relative to the largest jump of all points.
const STILL: f64 = 1e-6;

/// Differences of K below this share of its peak count as zero.
const ALIKE: f64 = 1e-6;

/// K at a position of a passage.
pub(super) struct TipMark {
    /// K of each tip, and whether it is held.
    tips: Vec<(Sif, bool)>,
    /// Length of the histories.
    samples: usize,
}

impl TipMark {
    /// Samples of the histories so far.
    pub fn samples(&self) -> usize {
        self.samples
    }
}

#[derive(Debug, Clone)]
struct TipSif {
    /// The face point next to the tip.
    point: usize,
    /// Its slip when K was last updated, and the largest slip so far, mm.
    slip: f64,
    largest: f64,
    sif: Sif,
    /// Whether K_II is still held from when the point stuck.
    held: bool,
    /// K at the beginning of the passage and after each of its load steps.
    history: SifHistory,
}

impl TipSifs {
    /// The unloaded tips of virgin faces.
    pub fn virgin(problem: &FaceProblem) -> Self {
        let body = problem.body();
        let points = &body.faces.points;
        let nearest = |crack: usize, end: End| {
            let own = |point: &FacePoint| point.crack == crack;
            let place =
                if end == End::First { points.iter().position(own) } else { points.iter().rposition(own) };
            // A crack has at least one face point.
            place.unwrap_or(0)
        };
        let tip = |point: usize| TipSif {
            point,
            slip: 0.0,
            largest: 0.0,
            sif: Sif::default(),
            held: true,
            history: SifHistory::default(),
        };
        Self { tips: body.tips.iter().map(|tip_end| tip(nearest(tip_end.crack, tip_end.end))).collect() }
    }

    /// Begins the histories of a passage.
    pub fn begin(&mut self) {
        for tip in &mut self.tips {
            tip.history.samples = vec![tip.sif];
        }
    }

    /// Updates K for the next load step, with its `solution` under the nodal forces `load` (N/mm).
    pub fn follow(&mut self, problem: &FaceProblem, solution: &FaceSolution, load: &[f64]) {
        for (tip, sif) in self.tips.iter_mut().zip(solution.sifs(problem.body(), load)) {
            let slip = solution.jump[2 * tip.point];
            let moved = slip - tip.slip;
            tip.largest = tip.largest.max(slip.abs());
            let closed = solution.status[tip.point] != PointStatus::Open && problem.friction(tip.point) > 0.0;
            // The status is no criterion: a point that sticks at the end of a step may have slipped
            // during it.
            if closed && moved.abs() <= STILL * tip.largest {
                tip.held = true;
            } else {
                tip.held &= closed && (sif.kii - tip.sif.kii) * moved < 0.0;
                tip.sif = if tip.held { Sif { kii: tip.sif.kii, ..sif } } else { sif };
                tip.slip = slip;
            }
            tip.history.samples.push(tip.sif);
        }
    }

    /// K of each tip, MPa √mm.
    pub fn sifs(&self) -> impl Iterator<Item = Sif> + '_ {
        self.tips.iter().map(|tip| tip.sif)
    }

    /// A mark of the present state of the tips.
    pub fn mark(&self) -> TipMark {
        let samples = self.tips.first().map_or(0, |tip| tip.history.samples.len());
        TipMark { tips: self.tips.iter().map(|tip| (tip.sif, tip.held)).collect(), samples }
    }

    /// Whether K of all tips equals that of `mark`, and is held for the same tips.
    pub fn is_like(&self, mark: &TipMark) -> bool {
        self.tips.iter().zip(&mark.tips).all(|(tip, (sif, held))| {
            let near = |one: f64, other: f64| (one - other).abs() <= ALIKE * tip.history.peak();
            tip.held == *held && near(tip.sif.ki, sif.ki) && near(tip.sif.kii, sif.kii)
        })
    }

    /// The history of each tip over the passage, including the unloaded ends.
    pub fn histories(&self) -> Vec<SifHistory> {
        self.tips.iter().map(|tip| tip.history.clone()).collect()
    }
}
