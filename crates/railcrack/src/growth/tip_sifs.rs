//! K of the tips from load step to load step.

use crate::body::FacePoint;
use crate::contact::{FaceProblem, FaceSolution, PointStatus};
use crate::crack::End;
use crate::fracture::{Sif, SifHistory};

/// K of every tip. A tip that sticks keeps its K.
///
/// K is given by the jump next to the tip: while the faces stick there, K cannot change, however
/// far the rest of the crack slips. An engine that integrates K over the elements around the tip
/// also sees their neighbourhood, and its K drifts by up to 3 % as the slip zone approaches, before
/// the tip itself slips. K of a tip whose nearest face point does not slip is therefore held; when
/// that point slips, K_II is released as soon as it changes in the direction of the slip.
#[derive(Debug, Clone)]
pub(super) struct TipSifs {
    tips: Vec<TipSif>,
}

/// A slip over the largest so far that is none: a hundred times the tolerance of the solvers, whose
/// measure is the largest jump of all points.
const STILL: f64 = 1e-6;

/// A difference of K over its peak that is none.
const ALIKE: f64 = 1e-6;

/// K at some position of a passage.
#[derive(Debug, Clone)]
pub(super) struct TipMark {
    tips: Vec<MarkedTip>,
}

/// K of a tip, whether it is held, and the length of its history.
#[derive(Debug, Clone, Copy)]
struct MarkedTip {
    sif: Sif,
    held: bool,
    samples: usize,
}

impl TipMark {
    /// Samples of the history of each tip so far.
    pub fn samples(&self) -> impl Iterator<Item = usize> + '_ {
        self.tips.iter().map(|tip| tip.samples)
    }

    /// K of each tip, MPa √mm.
    pub fn sifs(&self) -> impl Iterator<Item = Sif> + '_ {
        self.tips.iter().map(|tip| tip.sif)
    }

    /// Whether K of all tips is that of `other`, and held if it is there; `tips` have the peaks.
    pub fn is_like(&self, other: &Self, tips: &TipSifs) -> bool {
        self.tips.iter().zip(&other.tips).zip(&tips.tips).all(|((one, other), tip)| {
            let peak = tip.history.peak();
            let near = |one: f64, other: f64| (one - other).abs() <= ALIKE * peak;
            one.held == other.held && near(one.sif.ki, other.sif.ki) && near(one.sif.kii, other.sif.kii)
        })
    }

    /// Whether K of all tips differs by less than `share` of its peak from that of `other`.
    pub fn is_within(&self, share: f64, other: &Self, tips: &TipSifs) -> bool {
        self.tips.iter().zip(&other.tips).zip(&tips.tips).all(|((one, other), tip)| {
            let near = |one: f64, other: f64| (one - other).abs() <= share * tip.history.peak();
            near(one.sif.ki, other.sif.ki) && near(one.sif.kii, other.sif.kii)
        })
    }

    /// Takes tip `tip` from `other`.
    pub fn take(&mut self, tip: usize, other: &Self) {
        self.tips[tip] = other.tips[tip];
    }
}

#[derive(Debug, Clone)]
struct TipSif {
    /// The face point next to the tip.
    point: usize,
    /// Its slip when K was last taken, and the largest so far, mm.
    slip: f64,
    largest: f64,
    sif: Sif,
    /// Whether K_II is that of a time when the point stuck.
    held: bool,
    /// K at the beginning of the passage and after each of its load steps.
    history: SifHistory,
    /// Of a place to return to, the length of the history.
    samples: usize,
}

impl TipSifs {
    /// Unloaded tips of virgin faces.
    pub fn virgin(problem: &FaceProblem) -> Self {
        let body = problem.body();
        let points = &body.faces.points;
        let nearest = |crack: usize, end: End| {
            let own = |point: &FacePoint| point.crack == crack;
            let place =
                if end == End::First { points.iter().position(own) } else { points.iter().rposition(own) };
            // A crack has a face point at least.
            place.unwrap_or(0)
        };
        let tip = |point: usize| TipSif {
            point,
            slip: 0.0,
            largest: 0.0,
            sif: Sif::default(),
            held: true,
            history: SifHistory::default(),
            samples: 0,
        };
        Self { tips: body.tips.iter().map(|tip_end| tip(nearest(tip_end.crack, tip_end.end))).collect() }
    }

    /// Begins the histories of a passage.
    pub fn begin(&mut self) {
        for tip in &mut self.tips {
            tip.history.samples = vec![tip.sif];
        }
    }

    /// Takes up the next load step: its `solution` under the nodal forces `load` (N/mm).
    pub fn follow(&mut self, problem: &FaceProblem, solution: &FaceSolution, load: &[f64]) {
        for (tip, sif) in solution.sifs(problem.body(), load).into_iter().enumerate() {
            let point = self.tips[tip].point;
            let closed = solution.status[point] != PointStatus::Open && problem.friction(point) > 0.0;
            self.follow_one(tip, sif, solution.jump[2 * point], closed);
        }
    }

    /// Takes up the next load step of tip `tip`: its K, the slip (mm) of the point next to it, and
    /// whether that point is `closed` with friction.
    pub fn follow_one(&mut self, tip: usize, sif: Sif, slip: f64, closed: bool) {
        let tip = &mut self.tips[tip];
        let moved = slip - tip.slip;
        tip.largest = tip.largest.max(slip.abs());
        // Not by the status: a point that sticks at the end of a step may have slipped in it.
        if closed && moved.abs() <= STILL * tip.largest {
            tip.held = true;
        } else {
            tip.held &= closed && (sif.kii - tip.sif.kii) * moved < 0.0;
            tip.sif = if tip.held { Sif { kii: tip.sif.kii, ..sif } } else { sif };
            tip.slip = slip;
        }
        tip.history.samples.push(tip.sif);
    }

    /// K of each tip, MPa √mm.
    pub fn sifs(&self) -> impl Iterator<Item = Sif> + '_ {
        self.tips.iter().map(|tip| tip.sif)
    }

    /// Where the tips are, to return to.
    pub fn place(&self) -> Self {
        let without = |tip: &TipSif| TipSif {
            history: SifHistory::default(),
            samples: tip.history.samples.len(),
            ..*tip
        };
        Self { tips: self.tips.iter().map(without).collect() }
    }

    /// Returns to `place`.
    pub fn return_to(&mut self, place: &Self) {
        for (tip, place) in self.tips.iter_mut().zip(&place.tips) {
            let mut history = std::mem::take(&mut tip.history);
            history.samples.truncate(place.samples);
            *tip = TipSif { history, ..*place };
        }
    }

    /// Where the tips are in their passage.
    pub fn mark(&self) -> TipMark {
        let tip =
            |tip: &TipSif| MarkedTip { sif: tip.sif, held: tip.held, samples: tip.history.samples.len() };
        TipMark { tips: self.tips.iter().map(tip).collect() }
    }

    /// Whether K of all tips is that of `mark`, and held if it was there.
    pub fn is_like(&self, mark: &TipMark) -> bool {
        self.mark().is_like(mark, self)
    }

    /// The history of each tip up to `mark`.
    pub fn histories_until(&self, mark: &TipMark) -> Vec<SifHistory> {
        let mut histories = self.histories();
        histories.iter_mut().zip(mark.samples()).for_each(|(tip, samples)| tip.samples.truncate(samples));
        histories
    }

    /// The history of each tip through the passage, unloaded ends included.
    pub fn histories(&self) -> Vec<SifHistory> {
        self.tips.iter().map(|tip| tip.history.clone()).collect()
    }
}
