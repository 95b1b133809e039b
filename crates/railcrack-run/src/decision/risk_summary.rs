//! Risk over the inspection interval, and the interval for a target risk, in `summary.json`.

use super::act_on::{Accepted, IntervalToActOn, RiskAtInterval};
use super::failure::{Nominal, NominalRun};
use super::inspection::InspectionSummary;
use super::risk::{DetectionCurve, IntervalForTarget, Life, Risk, Stored};
use super::scatter::SampledLife;
use crate::log::RunInfo;
use railcrack_case::InspectionRisk;
use serde::{Deserialize, Serialize};

/// Probability of failure before detection by interval.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct RiskSummary {
    /// The probability for a series of intervals; empty where nothing fails, and where the verdict
    /// is `stop` or `outside`.
    #[serde(default)]
    pub risk: Vec<RiskAtInterval>,
    /// The probability at the inspection interval of the decision.
    #[serde(default)]
    pub risk_at_interval: Option<RiskAtInterval>,
    /// The probability that is accepted, where the case gives it.
    #[serde(default)]
    pub target_risk: Option<f64>,
    /// The largest interval that keeps it, million gross tonnes; null where there is none, and
    /// without a target.
    #[serde(default)]
    pub interval_for_target_mgt: Option<f64>,
    /// The same in months, where the case gives the traffic of a year.
    #[serde(default)]
    pub interval_for_target_months: Option<f64>,
    /// Whether there is such an interval.
    #[serde(default)]
    pub target_kept: Option<TargetKept>,
    /// The interval to act on; null where there is none.
    #[serde(default)]
    pub act_on: Option<IntervalToActOn>,
}

/// Whether inspections keep a target risk.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TargetKept {
    /// By intervals up to the one given.
    UpToInterval,
    /// By every interval: it is kept without inspections.
    AtAnyInterval,
    /// Not even by a thousand inspections during the life.
    Never,
    /// Too many samples outlive what is computed.
    NotKnown,
}

impl<'a> Life<'a, f32> {
    /// The life of a sample.
    fn of(sample: &'a SampledLife) -> Self {
        Self { failure: sample.failure, depths: &sample.depths, found_from: sample.found_from }
    }
}

/// Intervals in the series, of each decade.
const SERIES: [f64; 6] = [1.0, 1.5, 2.0, 3.0, 5.0, 7.0];
/// The shortest interval of the series, over the life.
const SHORTEST: f64 = 0.02;

/// The inputs of the risk besides the lives.
#[derive(Debug, Clone, Copy)]
struct RiskInputs<'a> {
    /// The detection and the accepted risk.
    asked: &'a InspectionRisk,
    /// Depth (mm) from which cracks are found where the case gives no probability of detection.
    detectable_depth: f64,
    /// Million gross tonnes per year, where they are given.
    mgt_per_year: Option<f64>,
    /// Million gross tonnes up to which intervals are tried: those to failure, or where the run
    /// does not fail to its end.
    life: f64,
    /// Million gross tonnes between inspections by the decision.
    interval: Option<f64>,
    /// The largest probability of missing a crack that the safety factor stands for.
    most_missed: f64,
    /// Share of the lives of which it is not known whether they fail before `life`.
    unknown: f64,
}

impl RiskSummary {
    /// The risk of the crack of `run` under its `inspection`, or of its samples where `lives` has
    /// them; the run ends after `longest` million gross tonnes. None where the case does not ask
    /// for it, or nothing fails.
    pub(super) fn of_inspection(
        info: &RunInfo,
        run: &NominalRun,
        inspection: Option<&InspectionSummary>,
        lives: Option<&[SampledLife]>,
        longest: f64,
    ) -> Option<Self> {
        let NominalRun { course, nominal, question, .. } = run;
        let inspection = inspection?;
        let failure = nominal.failure.mgt;
        // Never detectable: no inspection finds it.
        let never = || nominal.detected.is_none().then_some(f64::INFINITY);
        let inputs = RiskInputs {
            asked: info.inspection_risk.as_ref()?,
            detectable_depth: inspection.detectable_depth_mm.or_else(never)?,
            mgt_per_year: info.mgt_per_year,
            life: failure.unwrap_or(longest),
            interval: inspection.interval_mgt,
            most_missed: inspection.most_missed(),
            unknown: 0.0,
        };
        if let Some(samples) = lives {
            let is_unknown = |sample: &&SampledLife| sample.outlives < inputs.life * (1.0 - 1e-9);
            let unknown = samples.iter().filter(is_unknown).count() as f64 / samples.len().max(1) as f64;
            let inputs = RiskInputs { unknown, ..inputs };
            let lives: Vec<Life<f32>> = samples.iter().map(Life::of).collect();
            return Some(Self::of(&lives, inputs));
        }
        let depths = Nominal::depths(course, question);
        Some(Self::of(&[Life { failure: failure?, depths: &depths, found_from: None }], inputs))
    }

    /// The risk at the interval of the decision, or without one at the longest of the series, and
    /// the target, where it exceeds the target.
    pub(super) fn exceeds_target(&self) -> Option<(RiskAtInterval, f64)> {
        let target = self.target_risk?;
        let at = self.risk_at_interval.as_ref().or(self.risk.last())?;
        (at.probability > target).then_some((*at, target))
    }

    /// The risk of `lives`.
    fn of<T: Stored>(lives: &[Life<'_, T>], inputs: RiskInputs<'_>) -> Self {
        let RiskInputs { asked, detectable_depth, mgt_per_year, life, .. } = inputs;
        let curve = asked.detection.as_ref().map(DetectionCurve::from);
        let risk = Risk::of(lives, curve.unwrap_or(DetectionCurve::Step(detectable_depth)));
        let at = |interval: f64| RiskAtInterval {
            interval_mgt: interval,
            probability: risk.probability(interval),
        };
        // Those of which nothing is known may fail.
        let most = asked.target.map(|target| target - inputs.unknown);
        let kept = most.filter(|most| *most > 0.0).map(|most| risk.interval_for(most));
        let by_safety = inputs.interval.filter(|interval| *interval > 0.0).map(at);
        let accepted = Accepted { target: asked.target, most_missed: inputs.most_missed };
        let act_on = IntervalToActOn::of(&risk, accepted, by_safety, kept);
        let interval = match kept {
            Some(IntervalForTarget::Mgt(interval)) => Some(interval),
            _ => None,
        };
        Self {
            risk: series(life).into_iter().map(at).collect(),
            risk_at_interval: by_safety,
            target_risk: asked.target,
            interval_for_target_mgt: interval,
            interval_for_target_months: interval.zip(mgt_per_year).map(|(mgt, year)| 12.0 * mgt / year),
            target_kept: asked.target.map(|_| match kept {
                None => TargetKept::NotKnown,
                Some(IntervalForTarget::Any) => TargetKept::AtAnyInterval,
                Some(IntervalForTarget::Mgt(_)) => TargetKept::UpToInterval,
                Some(IntervalForTarget::None) => TargetKept::Never,
            }),
            act_on: act_on.map(|act_on| act_on.in_months(mgt_per_year)),
        }
    }
}

/// Round intervals (million gross tonnes) up to `life`.
fn series(life: f64) -> Vec<f64> {
    if !(life > 0.0 && life.is_finite()) {
        return Vec::new();
    }
    let decade = (SHORTEST * life).log10().floor() as i32;
    let all = (decade..decade + 4).flat_map(|power| SERIES.map(|step| rounded(step, power)));
    all.filter(|interval| (SHORTEST * life..=life).contains(interval)).collect()
}

/// `step` times a power of ten, as the number closest to its decimal text.
fn rounded(step: f64, power: i32) -> f64 {
    if power < 0 { step / 10f64.powi(-power) } else { step * 10f64.powi(power) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decision::DepthCurve;

    #[test]
    fn round_intervals_up_to_the_life() {
        assert_eq!(series(100.0), [2.0, 3.0, 5.0, 7.0, 10.0, 15.0, 20.0, 30.0, 50.0, 70.0, 100.0]);
        assert_eq!(series(0.3), [0.007, 0.01, 0.015, 0.02, 0.03, 0.05, 0.07, 0.1, 0.15, 0.2, 0.3]);
        assert!(series(0.0).is_empty() && series(f64::INFINITY).is_empty());
    }

    #[test]
    fn the_risk_of_a_step_and_its_target() {
        let depths = DepthCurve::through([(0.0, 0.0), (100.0, 10.0)]);
        let lives = [Life { failure: 50.0, depths: &depths, found_from: None }];
        let asked = InspectionRisk { target: Some(0.25), detection: None };
        let inputs = RiskInputs {
            most_missed: 0.125,
            unknown: 0.0,
            asked: &asked,
            detectable_depth: 2.0,
            mgt_per_year: Some(20.0),
            life: 50.0,
            interval: Some(30.0),
        };
        let of = RiskSummary::of(&lives, inputs);
        assert_eq!(of.risk_at_interval.map(|at| at.probability), Some(0.0));
        let at = |mgt: f64| of.risk.iter().find(|at| at.interval_mgt == mgt).unwrap().probability;
        assert!((at(50.0) - 0.4).abs() < 1e-12 && at(30.0) == 0.0, "{of:?}");
        let interval = of.interval_for_target_mgt.unwrap();
        assert!((interval / 40.0 - 1.0).abs() < 1.1e-3 && of.target_kept == Some(TargetKept::UpToInterval));
        assert!((of.interval_for_target_months.unwrap() - 0.6 * interval).abs() < 1e-12);
    }
}
