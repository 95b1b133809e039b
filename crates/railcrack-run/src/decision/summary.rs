//! The decision block of `summary.json`.

use super::companions::{Companions, FrictionLife, PathLives, RowPartSummary, Speeds};
use super::failure::{FailureSummary, NominalRun, Question};
use super::family::Family;
use super::governing::{DecisionPath, Governing};
use super::inspection::{InspectionSummary, StageLimits, StagesSummary};
use super::path::GrowthPath;
use super::risk_summary::RiskSummary;
use super::rows::{DecisionRow, MaintenanceSummary, rate_per_10_mgt, rows_of};
use super::sampler::Sampling;
use super::scatter::{Lives, Quantiles, SampledLife, ScatterSummary, sampled, tonnages};
use super::tonnage::{TonnageWords, three_digits};
use super::tornado::{TornadoBar, tornado};
use super::verdict::Verdict;
use super::wheels::WheelSummary;
use crate::log::{RunInfo, RunLog};
use railcrack_case::{CalibrationPrior, Scatter};
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
    /// The path with the shortest life: verdict, inspection and risk are those along it.
    #[serde(default)]
    pub governed_by: DecisionPath,
    /// Lives with other frictions between the faces, where one value is given for all cracks and
    /// the rest scatters.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub frictions: Vec<FrictionLife>,
    /// Lives with other values of what is seldom known, the widest quantity first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tornado: Vec<TornadoBar>,
    /// The cracks of a long row with which the lives along other paths and the samples were
    /// computed; none where all were.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub part_of_row: Option<RowPartSummary>,
    /// The inspection interval, where the case asks for one; null where the verdict is `unknown`,
    /// `stop` or `outside`.
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
        let run = NominalRun::of(&log.steps, Question::of(info)?)?;
        let path = GrowthPath::of(&log.steps, run.failing_tip())?;
        let (question, nominal) = (run.question, run.nominal);
        let rows = rows_of(&path, question.tonnes);
        let last = rows.last().map_or(0.0, |last| last.mgt);
        let all = log.now.companions.as_deref().unwrap_or_default();
        let companions = Companions { all, question, found: path.tip.0 - 1 };
        let governing = Governing::of(&run, &log.steps, &companions);
        let verdict = Verdict::along(info, log, &run, &governing);
        let inspected = governing.inspected(info);
        let has_ended = log.steps.last().is_some_and(|step| step.stop.is_some());
        let gives_intervals = verdict.gives_intervals();
        let samples = Samples { info, run: &run, gives_intervals, inspected };
        let (scatter, lives) = info
            .scatter
            .as_ref()
            .filter(|_| is_sampled && has_ended && path.points.len() > 1)
            .map(|scatter| samples.along(&governing, scatter, &companions.speeds(), last))
            .unzip();
        let inspection = inspected.filter(|_| gives_intervals);
        let risk =
            RiskSummary::of_inspection(info, &governing.run, inspection.as_ref(), lives.as_deref(), last);
        let risk = risk.unwrap_or_default();
        let inspection = inspection.map(|given| given.judged(risk.risk_at_interval));
        let verdict = verdict.with_risk(&risk, TonnageWords::of_year(info));
        let limits = StageLimits {
            inspection: info.inspection.as_ref(),
            detected: nominal.detected,
            failure: nominal.failure.mgt,
            gives_intervals: verdict.gives_intervals(),
        };
        Some(Self {
            stages: StagesSummary::of(&path, question.tonnes, &limits),
            rate_mm_per_10_mgt: rate_per_10_mgt(&rows, &nominal),
            calibration: calibration(info.calibration, info.inspection.and_then(|of| of.critical_depth)),
            paths: companions.paths(nominal.failure.mgt),
            governed_by: governing.path,
            frictions: info.scatter.map_or_else(Vec::new, |_| companions.frictions()),
            tornado: tornado(info, log, &run, &companions),
            part_of_row: RowPartSummary::of(info, log),
            maintenance: info.maintenance.map(|removal| MaintenanceSummary::of(&removal, &rows, &path)),
            wheels: WheelSummary::of(info.mix(), &path),
            verdict,
            failure: nominal.failure,
            second: nominal.second,
            crack: path.tip.0,
            tip: path.tip.1,
            axle_load_t: question.tonnes,
            mgt_per_year: info.mgt_per_year,
            rows,
            risk,
            inspection,
            scatter,
        })
    }
}

/// The samples of a run.
#[derive(Clone, Copy)]
struct Samples<'a> {
    info: &'a RunInfo,
    run: &'a NominalRun,
    /// Whether the verdict gives intervals.
    gives_intervals: bool,
    /// The inspection, where the case has one.
    inspected: Option<InspectionSummary>,
}

impl Samples<'_> {
    /// The samples with `scatter` of the run, as in [`Samples::of`], and their lives along the path
    /// that governs.
    fn along(
        self,
        governing: &Governing,
        scatter: &Scatter,
        speeds: &Speeds,
        longest: f64,
    ) -> (ScatterSummary, Vec<SampledLife>) {
        if governing.path == DecisionPath::Nominal {
            return self.of(scatter, speeds, longest, self.kept());
        }
        let (summary, _) = self.of(scatter, speeds, longest, Lives::Dropped);
        let other = Samples { run: &governing.run, ..self };
        let family = Family::alone(&other.run.course);
        let sampling = Sampling::of_run(self.info, other.run.question, &family, scatter);
        (summary, sampled(sampling, Vec::new(), None, other.kept()).1)
    }

    /// Whether the lives of the samples are asked for.
    fn kept(&self) -> Lives {
        if self.inspected.is_some() && self.gives_intervals { Lives::Kept } else { Lives::Dropped }
    }

    /// The samples with `scatter` between the run, of `longest` million gross tonnes, and those at
    /// other `speeds`; and their lives.
    fn of(
        &self,
        scatter: &Scatter,
        speeds: &Speeds,
        longest: f64,
        kept: Lives,
    ) -> (ScatterSummary, Vec<SampledLife>) {
        let NominalRun { question, course, nominal, .. } = self.run;
        let family = speeds.family(course);
        let until = nominal.failure.mgt.unwrap_or(longest).max(MOST_BEFORE * longest);
        let interval = self.inspected.and_then(|inspected| inspected.interval_mgt);
        let sampling = Sampling::of_run(self.info, *question, &family, scatter);
        let (mut summary, lives) = sampled(sampling, tonnages(until, scatter), interval, kept);
        summary.between_runs = speeds.accuracy(course, question);
        if !self.gives_intervals {
            summary.mgt_detectable_to_critical = Quantiles::NONE;
            summary.probability_critical_before_inspection = None;
        }
        (summary, lives)
    }
}

/// How well absolute rates are known, in words, by what a case has been calibrated with; `deepest`
/// is the depth (mm) that its decision goes to.
pub(crate) fn calibration(by: CalibrationPrior, deepest: Option<f64>) -> String {
    let Some(sites) = by.sites else { return UNCALIBRATED.to_owned() };
    let sites = if sites == 1 { "1 measured site".to_owned() } else { format!("{sites} measured sites") };
    let mut text = format!("the growth law is calibrated by {sites}");
    if let Some([least, greatest]) = by.depths {
        text.push_str(&format!(", {least} to {greatest} mm"));
        let beyond = deepest.filter(|deepest| *deepest > FARTHEST_MEASURED * greatest);
        text.extend(beyond.map(|deepest| {
            format!(
                "; to {} mm nothing was measured, and rates there are known to a factor of about ten either way",
                three_digits(deepest)
            )
        }));
    }
    text
}

/// Depth over the greatest that was measured from which on a calibration says nothing.
const FARTHEST_MEASURED: f64 = 1.3;

/// Absolute rates without a calibration: by the public record of growth in track (`railcrack
/// validate`).
const UNCALIBRATED: &str = "not calibrated: growth rates in track are known to a factor of about ten either way; use them for ranking, and calibrate before planning (railcrack calibrate)";

/// Quantiles of the depth are given over this fraction of the run at least.
const MOST_BEFORE: f64 = 0.1;
