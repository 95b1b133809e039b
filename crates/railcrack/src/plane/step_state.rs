//! The state of the cracks at the start of a step, their prospective increments, wear and stops.

use crate::crack::{Crack, CrackTip, Junction};
use crate::growth::{
    self, BreakOut, DeferredGrowth, GrowthSettings, Jump, Mover, StepStart, TipCourse, TipDemand, TipStop,
    least_length,
};
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

/// The smallest ligament to the running surface (mm) that a tip of `crack` may leave; `resolution`
/// (mm) is the length that the engine resolves.
pub(super) fn spent_ligament(crack: &Crack, resolution: f64) -> f64 {
    growth::spent_ligament(crack.length(), resolution)
}

/// Stop of a tip independent of other cracks: its increment would leave the rail, or use up the
/// ligament to the running surface.
///
/// The ligament is the depth of the new tip below the surface after the removal of `removal` (mm);
/// only a rising tip can use it up.
pub(super) fn stop_of_one(
    step: &Step,
    crack: &Crack,
    rail: RailBox,
    resolution: f64,
    removal: f64,
) -> Option<TipStop> {
    let rises = step.to.y > step.from.y;
    let depth = -step.to.y - removal;
    if step.to.y >= 0.0 || (rises && depth < spent_ligament(crack, resolution)) {
        return Some(TipStop::BreakOut);
    }
    let inside = 0.5 * rail.width - (step.to.x - rail.centre).abs() > resolution
        && rail.depth + step.to.y > resolution;
    (!inside).then_some(TipStop::LeavesRail)
}

/// Whether a tip is loaded and not slower than the arrest rate.
pub(super) fn grows(tip: &TipDrive, settings: &GrowthSettings) -> bool {
    tip.kink.is_some() && tip.rate > 0.0 && tip.rate >= settings.arrest_rate
}

/// Stop of a tip that runs away or no longer grows.
pub(super) fn standstill(tip: &TipDrive, settings: &GrowthSettings) -> Option<TipStop> {
    growth::standstill(tip.demand().runs_away(), grows(tip, settings), settings)
}

/// A crack after the surface above it has been removed.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Worn {
    /// It remains, with its mouth further down. Ends that only a spent ligament separates from the
    /// surface are marked as broken out.
    Left {
        /// The crack.
        crack: Crack,
        /// Whether the first and the last end have broken out; a mouth does not count.
        broken_out: [bool; 2],
    },
    /// It is worn away; only a stub remains, since the body still contains it.
    Away(Crack),
}

/// `crack` after `depth` (mm) of the surface has been removed. `deferred` (mm) is the deferred
/// growth of its tips, `longest` (mm) its greatest length so far, `resolution` (mm) the length that
/// the engine resolves.
pub(super) fn worn(crack: &Crack, depth: f64, deferred: f64, longest: f64, resolution: f64) -> Worn {
    let lifted: Vec<Vec2> = crack.points().iter().map(|p| Vec2::new(p.x, p.y + depth)).collect();
    let ligament = spent_ligament(crack, resolution);
    let deepest = (0..lifted.len()).min_by(|&i, &j| lifted[i].y.total_cmp(&lifted[j].y)).unwrap_or(0);
    let mouth_at = if crack.is_surface_breaking() { 0.0 } else { -ligament };
    let (mut before, first) = up_to(lifted[..=deepest].iter().rev(), mouth_at);
    let (behind, last) = up_to(lifted[deepest..].iter(), -ligament);
    before.reverse();
    before.extend_from_slice(behind.get(1..).unwrap_or_default());
    let mut points = before;
    if crack.is_surface_breaking() {
        settle_mouth(&mut points, resolution);
    }
    let least = least_length(longest, resolution);
    let left = lifted[deepest].y < -ligament && points.len() > 1;
    let left = left.then(|| Crack::polyline(points).ok()).flatten();
    match left.filter(|left| left.length() + deferred > least) {
        Some(left) => {
            let broken_out = [first && !crack.is_surface_breaking(), last];
            Worn::Left { crack: left, broken_out }
        }
        None => Worn::Away(stub(crack, least)),
    }
}

/// The points of `walk`, which begins at the deepest one, as far as they lie below `limit` (mm),
/// with the point at which it rises to the limit, and whether it does so. An end that lies on the
/// surface is kept.
fn up_to<'a>(walk: impl Iterator<Item = &'a Vec2>, limit: f64) -> (Vec<Vec2>, bool) {
    let mut below: Vec<Vec2> = Vec::new();
    for &point in walk {
        if point.y < limit {
            below.push(point);
            continue;
        }
        if let Some(&last) = below.last() {
            let share = (limit - last.y) / (point.y - last.y);
            below.push(Vec2::new(last.x + share * (point.x - last.x), limit));
        }
        return (below, true);
    }
    (below, false)
}

/// Removes a first segment that is shorter than the resolution.
fn settle_mouth(points: &mut Vec<Vec2>, resolution: f64) {
    if points.len() > 2 && (points[1] - points[0]).length() < resolution {
        points.remove(1);
    }
}

/// The first `length` (mm) of a crack that is worn away, since a body cannot contain a crack of
/// zero length.
fn stub(crack: &Crack, length: f64) -> Crack {
    let (from, to) = crack.segment(0);
    let segment = to - from;
    let end = from + segment * f64::min(1.0, length / segment.length());
    Crack::polyline(vec![from, end]).unwrap_or_else(|_| crack.clone())
}

/// Whether the removal of `depth` (mm) takes a junction of `cracks` to the surface, or so close to
/// it that the ligament is spent.
pub(super) fn reaches_junction(
    cracks: &[Crack],
    junctions: &[Junction],
    depth: f64,
    resolution: f64,
) -> bool {
    junctions.iter().any(|junction| {
        let crack = &cracks[junction.joining.crack];
        crack.tip(junction.joining.end).y + depth > -spent_ligament(crack, resolution)
    })
}

/// Sine of the angle of `crack` at its mouth; `None` for a buried crack.
pub(super) fn mouth_sine(crack: &Crack) -> Option<f64> {
    let (mouth, next) = crack.segment(0);
    let segment = next - mouth;
    crack.is_surface_breaking().then(|| -segment.y / segment.length())
}

#[cfg(test)]
#[path = "worn_tests.rs"]
mod tests;
