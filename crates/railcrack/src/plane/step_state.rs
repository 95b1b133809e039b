//! The state of the cracks at the start of a step, and their prospective increments.

use crate::crack::{Crack, CrackTip, Junction};
use crate::growth::{BreakOut, DeferredGrowth, Jump, Mover, StepStart, TipCourse, TipDemand, TipStop};
use crate::math::{RailBox, Vec2};

/// Direction and rate of growth of a tip, with its state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TipDrive {
    /// The tip.
    pub tip: CrackTip,
    /// The chosen kink, radians, counter-clockwise; `None` for a tip without any loading.
    pub kink: Option<f64>,
    /// da/dN of the actual tip, mm per cycle: zero at or below the threshold.
    pub rate: f64,
    /// The largest k1 of a virtual kink during the passage, MPa √mm; 0 where none opens.
    pub largest_k1: f64,
    /// Why its path kinks here, if it does.
    pub jump: Option<Jump>,
    /// Decrease of its best kink per radian of turn.
    pub kink_slope: f64,
    /// Direction of its path relative to the chord of its crack from the other end, radians.
    pub lean: f64,
    /// How its path turned in the previous step.
    pub course: TipCourse,
    /// Its growth in earlier steps that has not been added to the crack yet.
    pub deferred: DeferredGrowth,
    /// Why it stopped in an earlier step, if it did.
    pub stopped: Option<TipStop>,
}

impl TipDrive {
    /// Its loading, as far as stops depend on it.
    pub fn demand(&self) -> TipDemand {
        let Self { rate, largest_k1, stopped, .. } = *self;
        TipDemand { rate, largest_k1, stopped }
    }
}

/// The state of a run at the start of a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct StepState<'a> {
    /// Progress of the run.
    pub at: StepStart<'a>,
    /// The cracks.
    pub cracks: &'a [Crack],
    /// Junctions between the cracks.
    pub junctions: &'a [Junction],
    /// Tips that broke out in earlier steps.
    pub break_outs: &'a [BreakOut],
    /// All tips of the cracks.
    pub tips: &'a [TipDrive],
    /// The rail.
    pub rail: RailBox,
    /// The length that the engine resolves, mm: its element size.
    pub resolution: f64,
}

impl StepState<'_> {
    /// The length of crack `crack` (from 0), including the deferred growth of its tips, mm.
    pub fn length(&self, crack: usize) -> f64 {
        let own = self.tips.iter().filter(|tip| tip.tip.crack == crack);
        self.cracks[crack].length() + own.map(|tip| tip.deferred.length).sum::<f64>()
    }

    /// The greatest length that crack `crack` (from 0) has had, mm.
    pub(super) fn longest(&self, crack: usize) -> f64 {
        self.at.worn.longest_of(crack, self.length(crack))
    }

    /// Whether cracks meet at `point`.
    pub(super) fn is_junction(&self, point: Vec2) -> bool {
        self.junctions.iter().any(|junction| {
            let crack = &self.cracks[junction.joining.crack];
            crack.tip(junction.joining.end) == point
        })
    }

    /// The mover at `tip`.
    pub(super) fn mover(&self, tip: &TipDrive) -> Mover {
        let CrackTip { crack, tip: index, .. } = tip.tip;
        Mover { crack, index, rate: tip.rate, length: self.length(crack) }
    }

    /// Whether crack `crack` (from 0) is worn away completely.
    pub(super) fn is_worn_away(&self, crack: usize) -> bool {
        self.tips.iter().any(|tip| tip.tip.crack == crack && tip.stopped == Some(TipStop::WornAway))
    }
}

/// A prospective increment of a tip. Where it turns smoothly, it follows the tangents at both ends,
/// so that the last segment of the crack is tangential to the path at the tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Step {
    /// The tip.
    pub tip: CrackTip,
    /// Its present position.
    pub from: Vec2,
    /// The point at which the two tangents meet; `None` for a straight increment.
    pub via: Option<Vec2>,
    /// Its position after the increment.
    pub to: Vec2,
    /// The share of the increment that was deferred in earlier steps.
    pub deferred: f64,
}
