//! The decision block of `summary.json`.

use super::companions::{Companions, FrictionLife, PathLives, slowed};
use super::course::{Course, FailureMode};
use super::failure::{FailureSummary, Nominal, Question};
use super::family::Family;
use super::inspection::InspectionSummary;
use super::maintenance::MaintenanceSummary;
use super::nominal_course::{course_of, question};
use super::path::{GrowthPath, PathPoint};
use super::risk_summary::{RiskInputs, RiskSummary};
use super::row::DecisionRow;
use super::row_part::RowPartSummary;
use super::sampler::Sampling;
use super::scatter::{CourseAccuracy, Lives, Quantiles, ScatterSummary, sampled};
use super::stages::{StageLimits, StagesSummary};
use super::tonnage::TonnageWords;
use super::verdict::{Reason, Verdict};
use super::wheels::WheelSummary;
use crate::log::{Companion, RunInfo, RunLog};
use serde::{Deserialize, Serialize};

/// From growth to a decision: key `decision` of `summary.json`, and the first block of the page.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Decision {
    /// The verdict, with its reasons.
    pub verdict: Verdict,
    /// The first failure over all cracks, tips and modes.
    pub failure: FailureSummary,
    /// The failure of another mode that follows first.
    pub second: FailureSummary,
    /// Crack of the tip that is followed, from 1: that of the failure, or where the rail does not
    /// fail the one that has grown most.
    pub crack: usize,
    /// The tip within its crack, from 1.
    pub tip: usize,
    /// Mean load of an axle, t.
    pub axle_load_t: f64,
    /// Million gross tonnes in a year, where the case gives them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mgt_per_year: Option<f64>,
    /// The crack from step to step.
    pub rows: Vec<DecisionRow>,
    /// Growth against wear and grinding, where the case has them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub maintenance: Option<MaintenanceSummary>,
    /// Growth of the tip that is followed into the depth, the mean from detectable to failure or
    /// over the run, mm per 10 million gross tonnes; null where there is none.
    pub rate_mm_per_10_mgt: Option<f64>,
    /// How well absolute rates are known: by how many sites the case has been calibrated, or that
    /// it has not.
    #[serde(default)]
    pub calibration: String,
    /// Lives along three paths; null where they were not computed.
    #[serde(default)]
    pub paths: Option<PathLives>,
    /// Lives with other frictions between the faces, where one value is given for all cracks and
    /// the rest scatters.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub frictions: Vec<FrictionLife>,
    /// The cracks of a long row with which the lives along other paths and the samples were
    /// computed; none where all were.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub part_of_row: Option<RowPartSummary>,
    /// The inspection interval, where the case asks for one; null where the verdict is `stop` or
    /// `outside`.
    pub inspection: Option<InspectionSummary>,
    /// The two stages of a head check that turns down in the run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stages: Option<StagesSummary>,
    /// Risk between inspections of the run or its samples: its keys are those of the block.
    #[serde(flatten)]
    pub risk: RiskSummary,
    /// The wheels of a mix.
    #[serde(default)]
    pub wheels: Vec<WheelSummary>,
    /// Scatter, where the case gives it and the run has ended.
    pub scatter: Option<ScatterSummary>,
}

impl Decision {
    /// The decision block of a run so far, with samples where it `is_sampled` and has ended; none
    /// without axle loads or finished steps.
    pub(crate) fn of(info: &RunInfo, log: &RunLog, is_sampled: bool) -> Option<Self> {
        let tonnes = info.axle_load?;
        let question = question(info, tonnes);
        let (course, nominal) = course_of(info, log, tonnes)?;
        let path = GrowthPath::of(&log.steps, followed(&nominal))?;
        let per_mgt = 1e6 / tonnes;
        let mgt = |axles: f64| axles / per_mgt;
        let row = |(i, point): (usize, &PathPoint)| {
            let next = path.points.get(i + 1);
            let until = |next: &PathPoint| {
                let passed = mgt(next.axles - point.axles);
                (passed > 0.0).then(|| (next.depth - point.depth) / passed)
            };
            DecisionRow {
                length_mm: point.length,
                depth_mm: point.depth,
                axles: point.axles,
                mgt: mgt(point.axles),
                length_mm_per_mgt: point.rate * per_mgt,
                depth_mm_per_mgt: next.and_then(until),
                balance_mm_per_mgt: point.mouth_sine.map(|sine| point.rate * per_mgt * sine),
            }
        };
        let rows: Vec<DecisionRow> = path.points.iter().enumerate().map(row).collect();
        let removed = log.steps.last().map_or(0.0, |step| step.removed);
        let maintenance = info.maintenance.as_ref();
        let maintenance =
            maintenance.map(|plan| MaintenanceSummary::of(plan, &rows, path.is_worn_away, removed));
        let has_ended = log.steps.last().is_some_and(|step| step.stop.is_some());
        let verdict = Verdict::of(info, log, &nominal, tonnes, info.inspection.is_some());
        let inspection = info.inspection.as_ref().map(|inspection| {
            let found = inspection.detectable_depth.is_none().then_some(nominal.detected).flatten();
            InspectionSummary::of(&nominal, inspection, found.and_then(|mgt| depth_at(&rows, mgt)))
        });
        let all = log.now.companions.as_deref().unwrap_or_default();
        let companions = Companions { all, question, found: path.tip.0 - 1 };
        let can_scatter = is_sampled && has_ended && path.points.len() > 1;
        let scatter = info.scatter.as_ref().filter(|_| can_scatter);
        let scatter = scatter.map(|scatter| {
            let speeds = companions.speeds();
            let family = family_of(&course, &speeds);
            let interval = inspection.as_ref().and_then(|inspection| inspection.interval_mgt);
            let of = Sampling {
                family: &family,
                question,
                scatter,
                mix: &info.mix,
                arrest_rate: if info.maintenance.is_some() { 0.0 } else { info.arrest_rate },
                has_own_toughness: scatter.toughness_std > 0.0,
            };
            let longest = course.points.last().map_or(0.0, |last| mgt(last.axles));
            let until = nominal.failure.mgt.unwrap_or(longest).max(MOST_BEFORE * longest);
            let is_asked = inspection.is_some() && verdict.gives_intervals();
            let kept = if is_asked { Lives::Kept } else { Lives::Dropped };
            let (summary, lives) = sampled(of, until, interval, kept);
            let between_runs = accuracy(&course, &speeds, &question);
            (ScatterSummary { between_runs, ..summary }, lives)
        });
        let (mut scatter, lives) = scatter.unzip();
        let inspection = inspection.filter(|_| verdict.gives_intervals());
        if !verdict.gives_intervals()
            && let Some(scatter) = &mut scatter
        {
            scatter.mgt_detectable_to_critical = Quantiles::NONE;
            scatter.probability_critical_before_inspection = None;
        }
        let asked = info.inspection_risk.as_ref();
        let risk = inspection.as_ref().zip(asked).and_then(|(inspection, asked)| {
            let detectable_depth = inspection.detectable_depth_mm.or_else(|| {
                // Never detectable: no inspection finds it.
                nominal.detected.is_none().then_some(f64::INFINITY)
            })?;
            let of = RiskInputs { asked, detectable_depth, mgt_per_year: info.mgt_per_year };
            let interval = inspection.interval_mgt;
            match (&lives, nominal.failure.mgt) {
                (Some(lives), failure) => {
                    let life =
                        failure.unwrap_or_else(|| path.points.last().map_or(0.0, |last| mgt(last.axles)));
                    Some(RiskSummary::of_samples(lives, life, interval, of))
                }
                (None, Some(failure)) => {
                    Some(RiskSummary::of_run(&Nominal::depths(&course, &question), failure, interval, of))
                }
                (None, None) => None,
            }
        });
        let risk = risk.unwrap_or_default();
        let verdict = match risk.exceeds_target() {
            Some((at, target)) => {
                verdict.with(Reason::of_risk(at, target, TonnageWords { mgt_per_year: info.mgt_per_year }))
            }
            None => verdict,
        };
        let limits = StageLimits {
            inspection: info.inspection.as_ref(),
            detected: nominal.detected,
            failure: nominal.failure.mgt,
            gives_intervals: verdict.gives_intervals(),
        };
        Some(Self {
            stages: StagesSummary::of(&log.steps, (path.tip.0 - 1, path.tip.1 - 1), tonnes, &limits),
            rate_mm_per_10_mgt: rate(&rows, &nominal),
            calibration: calibration(info.calibrated_sites),
            paths: companions.paths(nominal.failure.mgt),
            frictions: companions.frictions(),
            part_of_row: RowPartSummary::of(info, log),
            verdict,
            failure: nominal.failure,
            second: nominal.second,
            crack: path.tip.0,
            tip: path.tip.1,
            axle_load_t: tonnes,
            mgt_per_year: info.mgt_per_year,
            rows,
            maintenance,
            risk,
            inspection,
            wheels: WheelSummary::of(&info.mix, &path, &log.steps),
            scatter,
        })
    }
}

/// How well absolute rates are known, in words, by the number of measured sites.
pub(crate) fn calibration(sites: Option<usize>) -> String {
    match sites {
        Some(1) => "the growth law is calibrated by one measured site".to_owned(),
        Some(sites) => format!("the growth law is calibrated by {sites} measured sites"),
        None => UNCALIBRATED.to_owned(),
    }
}

/// Absolute rates without a calibration: by the public record of growth in track (`railcrack
/// validate`).
const UNCALIBRATED: &str = "not calibrated: growth rates in track are known to a factor of about ten either way; use them for ranking, and calibrate before planning (railcrack calibrate)";

/// Quantiles of the depth are given over this fraction of the run at least.
const MOST_BEFORE: f64 = 0.1;

/// A run with its failures and the verdict on it.
pub(crate) struct Judged {
    /// The run.
    pub course: Course,
    /// Its failures.
    pub nominal: Nominal,
    /// The verdict.
    pub verdict: Verdict,
}

impl Judged {
    /// The courses among which samples of the run are made; `companions` are its runs at other
    /// speeds.
    pub(crate) fn family(&self, question: Question, companions: &[Companion]) -> Family {
        let found = self.nominal.failure.crack.map_or(0, |crack| crack - 1);
        family_of(&self.course, &Companions { all: companions, question, found }.speeds())
    }
}

/// The run of `log` under axles of `tonnes`; none without steps.
pub(crate) fn judged(info: &RunInfo, log: &RunLog, tonnes: f64) -> Option<Judged> {
    let (course, nominal) = course_of(info, log, tonnes)?;
    let verdict = Verdict::of(info, log, &nominal, tonnes, info.inspection.is_some());
    Some(Judged { course, nominal, verdict })
}

/// The tip of the failure, from 0.
fn followed(nominal: &Nominal) -> Option<(usize, usize)> {
    let FailureSummary { mode, crack, tip, .. } = nominal.failure;
    // A length is that of a crack, at any of its tips.
    let tip = tip.filter(|_| mode != Some(FailureMode::Length));
    Some((crack? - 1, tip? - 1))
}

/// The courses among which samples of the run `course` are made; `speeds` are those at other
/// speeds, the fastest first.
fn family_of(course: &Course, speeds: &[(f64, Course)]) -> Family {
    let of = |is_it: &dyn Fn(f64) -> bool| -> Vec<&Course> {
        speeds.iter().filter(|(speed, _)| is_it(*speed)).map(|(_, course)| course).collect()
    };
    let nominal = of(&|speed| speed == 1.0).first().copied().unwrap_or(course);
    Family::of(nominal, &of(&|speed| speed > 1.0), &of(&|speed| speed < 1.0))
}

/// How well samples between the run `course` and those at other `speeds` (the fastest first) repeat
/// each of these that lies between two others; none without any.
fn accuracy(course: &Course, speeds: &[(f64, Course)], question: &Question) -> Option<CourseAccuracy> {
    let others = || speeds.iter().filter(|(speed, _)| *speed != 1.0);
    let runs = others().count() + 1;
    let inner = others().skip(1).take(runs.saturating_sub(3));
    let error = |(speed, left_out): &(f64, Course)| {
        let rest: Vec<(f64, Course)> = speeds.iter().filter(|(other, _)| other != speed).cloned().collect();
        let family = family_of(course, &rest);
        let slowed = question.maintenance.map(|plan| slowed(plan, *speed));
        let own = Nominal::of(left_out, &Question { maintenance: slowed.as_ref(), ..*question });
        let found = Nominal::mgt_at_speed(&family, *speed, question)?;
        Some(100.0 * (found * speed / own.failure.mgt? - 1.0).abs())
    };
    let left_out_percent = inner.filter_map(error).reduce(f64::max);
    (runs > 1).then_some(CourseAccuracy { runs, left_out_percent })
}

/// Depth (mm) of the crack of `rows` at `mgt`.
fn depth_at(rows: &[DecisionRow], mgt: f64) -> Option<f64> {
    let next = rows.iter().position(|row| row.mgt >= mgt)?;
    let after = &rows[next];
    let Some(before) = next.checked_sub(1).map(|i| &rows[i]) else { return Some(after.depth_mm) };
    let share = (mgt - before.mgt) / (after.mgt - before.mgt);
    Some(before.depth_mm + share * (after.depth_mm - before.depth_mm))
}

/// Growth into the depth from detectable to failure, or over the run, mm per 10 MGT.
fn rate(rows: &[DecisionRow], nominal: &Nominal) -> Option<f64> {
    let (first, last) = (rows.first()?, rows.last()?);
    let from = nominal.detected.filter(|_| nominal.failure.mgt.is_some()).unwrap_or(first.mgt);
    let to = nominal.failure.mgt.map_or(last.mgt, |mgt| mgt.min(last.mgt));
    let deeper = depth_at(rows, to)? - depth_at(rows, from)?;
    (to > from).then(|| 10.0 * deeper / (to - from))
}
