//! Inspection interval: the traffic from a detectable crack to the failure of the rail, divided by
//! a safety factor.
//!
//! A head check that breaks the rail has two stages, a shallow crack until it turns down and a
//! transverse one from there to failure, each with its own inspection.

use super::act_on::RiskAtInterval;
use super::course::FailureMode;
use super::failure::Nominal;
use super::path::{GrowthPath, PathPoint};
use super::rows::{DecisionRow, depth_at};
use railcrack::growth::Axles;
use railcrack_case::Inspection;
use serde::{Deserialize, Serialize};

/// Growth from a detectable crack to the failure of the rail.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct InspectionSummary {
    /// Depth (mm) from which the crack is detected; null where its length is what is detected.
    pub detectable_depth_mm: Option<f64>,
    /// Million gross tonnes until then, for the last time before the failure: a crack that turns up
    /// or is ground may hide again. Null if the run does not reach it.
    pub mgt_to_detectable: Option<f64>,
    /// Million gross tonnes until it is first detectable.
    #[serde(default)]
    pub mgt_first_detectable: Option<f64>,
    /// The longest stretch (million gross tonnes) in which it hides after it was detectable.
    #[serde(default)]
    pub longest_hidden_mgt: Option<f64>,
    /// The first critical condition; null if the run reaches none.
    pub critical_by: Option<FailureMode>,
    /// Million gross tonnes until then.
    pub mgt_to_critical: Option<f64>,
    /// Million gross tonnes from detectable to critical, or until it hides again before.
    pub mgt_detectable_to_critical: Option<f64>,
    /// Safety factor.
    pub safety_factor: f64,
    /// The interval, million gross tonnes: that from detectable to critical divided by the safety
    /// factor; null where a crack is missed more often at it than the factor stands for
    /// ([`Self::most_missed`]).
    pub interval_mgt: Option<f64>,
}

impl InspectionSummary {
    /// The `inspection` of a run; a crack that is detected by its length has the depth in `rows`
    /// then.
    pub(crate) fn of(nominal: &Nominal, inspection: &Inspection, rows: &[DecisionRow]) -> Self {
        let found = || nominal.detected.and_then(|mgt| depth_at(rows, mgt));
        let (to_detectable, to_critical) = (nominal.detected, nominal.failure.mgt);
        let window = nominal.window;
        let way = window.filter(|_| to_critical.is_some()).map(|window| window.length());
        Self {
            detectable_depth_mm: inspection.detectable_depth.or_else(found),
            mgt_to_detectable: to_detectable,
            mgt_first_detectable: window.map(|window| window.first),
            longest_hidden_mgt: window.map(|window| window.hidden).filter(|mgt| mgt.is_finite()),
            critical_by: nominal.failure.mode,
            mgt_to_critical: to_critical,
            mgt_detectable_to_critical: way,
            safety_factor: inspection.safety_factor,
            interval_mgt: way.map(|way| way / inspection.safety_factor),
        }
    }

    /// The same without an interval at which cracks are missed more often, as `at` says, than the
    /// safety factor stands for.
    pub(super) fn judged(self, at: Option<RiskAtInterval>) -> Self {
        let is_kept = at.is_none_or(|at| at.probability <= self.most_missed());
        Self { interval_mgt: self.interval_mgt.filter(|_| is_kept), ..self }
    }

    /// The probability of missing a crack that the safety factor n stands for: n inspections within
    /// the window miss it with 2^(−n) where each of them finds it more often than not.
    #[must_use]
    pub fn most_missed(&self) -> f64 {
        0.5f64.powf(self.safety_factor)
    }
}

/// The stages of the tip that is followed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StagesSummary {
    /// Angle of the path below the surface (degrees) from which the crack is transverse.
    pub turned_deg: f64,
    /// Million gross tonnes until it turns, and is not flatter any more; 0 where it had turned
    /// before the run.
    pub mgt_to_turn: f64,
    /// Depth of the tip then, mm.
    pub turn_depth_mm: f64,
    /// Length of the crack then, mm.
    pub turn_length_mm: f64,
    /// Until it turns, inspected by eddy current; none where it had turned before the run.
    pub head_check: Option<StageSummary>,
    /// From the turn to failure, inspected by ultrasonics.
    pub transverse: StageSummary,
}

/// One stage.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct StageSummary {
    /// Million gross tonnes of the stage; null where the run ends within it.
    pub mgt: Option<f64>,
    /// Depth (mm) from which its inspection finds the crack; null where its length is what is
    /// detected.
    pub detectable_depth_mm: Option<f64>,
    /// Million gross tonnes from the start of the run until its inspection finds the crack; null
    /// where it does not within the stage.
    pub mgt_to_detectable: Option<f64>,
    /// Million gross tonnes from then to the end of the stage.
    pub mgt_detectable_to_end: Option<f64>,
    /// That divided by the safety factor; null where the verdict gives no intervals.
    pub interval_mgt: Option<f64>,
}

/// Angle of the path below the surface from which a crack counts as transverse: between head
/// checks, at 15 to 35°, and transverse cracks, at 60 to 90°.
const TURNED_DEG: f64 = 45.0;

/// An inspection that finds a crack after this fraction of its life finds it too late: the life is
/// not known as well.
const LATEST: f64 = 0.99;

/// Inspection and failure, by which the stages are judged.
pub(super) struct StageLimits<'a> {
    /// The inspection of the case.
    pub inspection: Option<&'a Inspection>,
    /// Million gross tonnes until the crack is detectable by the first inspection.
    pub detected: Option<f64>,
    /// Million gross tonnes until the rail fails.
    pub failure: Option<f64>,
    /// Whether the verdict gives intervals.
    pub gives_intervals: bool,
}

/// A tip at the start of a step.
#[derive(Clone, Copy)]
struct State {
    mgt: f64,
    depth: f64,
    length: f64,
    removed: f64,
    grown: f64,
}

impl StagesSummary {
    /// The stages of the tip of `path` under axles of `tonnes`; none where it is transverse from
    /// its mouth on, or does not turn.
    pub(super) fn of(path: &GrowthPath, tonnes: f64, limits: &StageLimits) -> Option<Self> {
        let state = |point: &PathPoint| State {
            mgt: Axles(point.axles).mgt(tonnes).0,
            depth: point.depth,
            length: point.length,
            removed: point.removed,
            grown: point.increment,
        };
        let states: Vec<State> = path.points.iter().map(state).collect();
        let in_run = turn(&states);
        let head_check = in_run.map(|turn| {
            let found = limits.detected.filter(|found| *found < turn.mgt);
            let depth = limits.inspection.and_then(|inspection| inspection.detectable_depth);
            limits.stage((0.0, Some(turn.mgt)), depth, found)
        });
        let mouth_sine = path.points.first().and_then(|point| point.mouth_sine);
        let turn = in_run.or_else(|| states.first().copied().filter(|_| has_turned(mouth_sine, &states)))?;
        let transverse = {
            let depth = limits.inspection.map(|inspection| inspection.ultrasonic_depth);
            let reached = depth.and_then(|depth| reaches(&states, depth)).map(|mgt| mgt.max(turn.mgt));
            let in_time = |found: &f64| limits.failure.is_none_or(|failure| *found < LATEST * failure);
            let found = reached.filter(in_time);
            limits.stage((turn.mgt, limits.failure), depth, found)
        };
        Some(Self {
            turned_deg: TURNED_DEG,
            mgt_to_turn: turn.mgt,
            turn_depth_mm: turn.depth,
            turn_length_mm: turn.length,
            head_check,
            transverse,
        })
    }
}

impl StageLimits<'_> {
    fn stage(
        &self,
        (from, to): (f64, Option<f64>),
        detectable_depth_mm: Option<f64>,
        found: Option<f64>,
    ) -> StageSummary {
        let left = to.zip(found).map(|(to, found)| (to - found).max(0.0));
        let safety =
            self.inspection.filter(|_| self.gives_intervals).map(|inspection| inspection.safety_factor);
        StageSummary {
            mgt: to.map(|to| (to - from).max(0.0)),
            detectable_depth_mm,
            mgt_to_detectable: found,
            mgt_detectable_to_end: left,
            interval_mgt: left.zip(safety).map(|(left, safety)| left / safety),
        }
    }
}

/// Where the path becomes as steep as a transverse crack, and remains so; none where it always is,
/// or is not at the end.
fn turn(states: &[State]) -> Option<State> {
    let wanted = TURNED_DEG.to_radians().sin();
    let directions = directions(states);
    let last_flat = directions.iter().rposition(|(_, sine)| *sine < wanted)?;
    let ((from, flat), (to, steep)) = (directions[last_flat], *directions.get(last_flat + 1)?);
    Some(between(from, to, (wanted - flat) / (steep - flat)))
}

/// Whether a path that is a transverse crack throughout comes from a flat mouth.
fn has_turned(mouth_sine: Option<f64>, states: &[State]) -> bool {
    let wanted = TURNED_DEG.to_radians().sin();
    let directions = directions(states);
    let steep = !directions.is_empty() && directions.iter().all(|(_, sine)| *sine >= wanted);
    steep && mouth_sine.is_some_and(|sine| sine < wanted)
}

/// The sines of the angles of the path below the surface, where they belong: in the middles of the
/// increments.
fn directions(states: &[State]) -> Vec<(State, f64)> {
    let sine = |pair: &[State]| {
        let deeper = pair[1].depth - pair[0].depth + pair[1].removed - pair[0].removed;
        (pair[0].grown > 0.0).then(|| deeper / pair[0].grown)
    };
    states.windows(2).filter_map(|pair| Some((between(pair[0], pair[1], 0.5), sine(pair)?))).collect()
}

/// Million gross tonnes until the tip is `depth` (mm) deep.
fn reaches(states: &[State], depth: f64) -> Option<f64> {
    if states.first()?.depth >= depth {
        return states.first().map(|first| first.mgt);
    }
    let pair = states.windows(2).find(|pair| pair[0].depth < depth && pair[1].depth >= depth)?;
    let share = (depth - pair[0].depth) / (pair[1].depth - pair[0].depth);
    Some(between(pair[0], pair[1], share).mgt)
}

fn between(from: State, to: State, share: f64) -> State {
    let mean = |a: f64, b: f64| a + share * (b - a);
    State {
        mgt: mean(from.mgt, to.mgt),
        depth: mean(from.depth, to.depth),
        length: mean(from.length, to.length),
        removed: mean(from.removed, to.removed),
        grown: from.grown,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A path at 30° for 4 mm, then at 60°, in increments of 1 mm and one MGT, of which the surface
    /// loses 0.1 mm each.
    fn states() -> Vec<State> {
        let mut all = vec![State { mgt: 0.0, depth: 1.0, length: 2.0, removed: 0.0, grown: 1.0 }];
        for i in 0..10 {
            let before = all[i];
            let sine = if i < 4 { 0.5 } else { 0.75f64.sqrt() };
            all.push(State {
                mgt: before.mgt + 1.0,
                depth: before.depth + sine - 0.1,
                length: before.length + 0.8,
                removed: before.removed + 0.1,
                grown: 1.0,
            });
        }
        all
    }

    #[test]
    fn the_turn_is_where_the_path_is_steep() {
        let states = states();
        let found = turn(&states).unwrap();
        // Between the middles of the fourth and the fifth increment.
        let share = (0.5f64.sqrt() - 0.5) / (0.75f64.sqrt() - 0.5);
        assert!((found.mgt - (3.5 + share)).abs() < 1e-12, "{}", found.mgt);
        assert!(turn(&states[..4]).is_none() && turn(&states[5..]).is_none());
        // The steep rest has turned where its mouth is flat.
        let turned = [(Some(0.5), true), (Some(0.9), false), (None, false)];
        for (mouth_sine, wanted) in turned {
            assert_eq!(has_turned(mouth_sine, &states[5..]), wanted);
            assert!(!has_turned(mouth_sine, &states) && !has_turned(mouth_sine, &states[5..6]));
        }
        // A path that is steep for a while only does not turn.
        let mut back = states.clone();
        back.extend((1..4).map(|i| State { mgt: 10.0 + f64::from(i), ..states[10] }));
        assert!(turn(&back).is_none());
        assert!((reaches(&states, 2.2).unwrap() - 3.0).abs() < 1e-12);
        assert_eq!(reaches(&states, 50.0), None);
    }

    #[test]
    fn each_stage_has_its_inspection() {
        let inspection = Inspection {
            detectable_depth: Some(1.4),
            ultrasonic_depth: 5.0,
            safety_factor: 2.0,
            ..Inspection::default()
        };
        let limits = StageLimits {
            inspection: Some(&inspection),
            detected: Some(1.0),
            failure: Some(9.0),
            gives_intervals: true,
        };
        let first = limits.stage((0.0, Some(4.0)), Some(1.4), Some(1.0));
        assert_eq!(
            (first.mgt, first.mgt_detectable_to_end, first.interval_mgt),
            (Some(4.0), Some(3.0), Some(1.5))
        );
        let unfound = limits.stage((4.0, Some(9.0)), Some(5.0), None);
        assert_eq!((unfound.mgt, unfound.interval_mgt), (Some(5.0), None));
        let silent = StageLimits { gives_intervals: false, ..limits };
        assert_eq!(silent.stage((0.0, Some(4.0)), Some(1.4), Some(1.0)).interval_mgt, None);
    }
}
