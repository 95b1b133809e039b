//! Outcomes of grinding plans: what becomes of the rail under each of them, and the least that
//! holds.

use super::plan::{AllFollowed, Followed, PlanSamples, Planning};
use crate::decision::{FailureMode, VerdictLevel, calibration};
use crate::disk::VERSION;
use crate::planner::{PlanOutcome, PlanSummary, PlannedGrinding, civil, today};
use crate::summary::validity;
use railcrack::growth::{Axles, Mgt, RunStop, TipStop};
use std::collections::BTreeMap;
use std::time::Instant;

/// Probability of failure before the horizon up to which a plan holds, where the case has scatter
/// and no target risk.
const USUAL_TARGET: f64 = 0.05;

impl Planning<'_> {
    /// All runs in numbers, before the least grinding is found.
    pub(super) fn summary(&self, all: &AllFollowed, started: Instant) -> PlanSummary {
        let case = self.simulation.case;
        let samples = self.samples_of_each();
        let mut sampled = all.samples.iter();
        PlanSummary {
            version: VERSION.to_owned(),
            title: case.title.clone(),
            date: civil(today()),
            case_checksum: String::new(),
            calibration: calibration(
                case.calibration,
                case.inspection.and_then(|inspection| inspection.critical_depth),
            ),
            axle_load_t: self.tonnes,
            mgt_per_year: case.mgt_per_year,
            horizon_mgt: all.horizon.0,
            wear_mm_per_mgt: case.maintenance.map_or(0.0, |removal| removal.wear),
            wear_limit_mm: case.maintenance.and_then(|removal| removal.limit),
            target_risk: samples.map(|_| self.target()),
            samples,
            seed: case.scatter.map(|scatter| scatter.seed),
            first_grinding_mgt: case.maintenance.and_then(|removal| Some(removal.grinding?.first?.0)),
            grinding_mm: all.depths.clone(),
            grinding_interval_mgt: all.intervals.clone(),
            without_grinding: self.outcome(&all.alone, all.horizon, None),
            plans: all.plans.iter().map(|plan| self.outcome(plan, all.horizon, sampled.next())).collect(),
            least: None,
            least_by_interval: vec![None; all.intervals.len()],
            runs: all.runs,
            wall_s: started.elapsed().as_secs_f64(),
            assumptions: Vec::new(),
            warnings: warnings(&all.alone),
            checksums: BTreeMap::new(),
            verdict: all.alone.verdict.clone(),
        }
    }

    /// The probability of failure up to which a plan holds.
    fn target(&self) -> f64 {
        self.simulation.case.inspection_risk.as_ref().and_then(|risk| risk.target).unwrap_or(USUAL_TARGET)
    }

    /// Outcome of `plan`, with its `samples`.
    fn outcome(&self, plan: &Followed, horizon: Mgt, samples: Option<&PlanSamples>) -> PlannedGrinding {
        let case = self.simulation.case;
        let (outcome, mgt) = self.end(plan, horizon);
        let course = &plan.run.course;
        let until =
            course.points.iter().filter(|point| Axles(point.axles).mgt(self.tonnes).0 <= mgt * (1.0 + 1e-9));
        let critical = case.inspection.and_then(|inspection| inspection.critical_depth);
        let reached = critical.filter(|_| outcome == PlanOutcome::Fails(FailureMode::Depth)).unwrap_or(0.0);
        let (mut deepest, mut removed) = (reached, 0.0);
        for point in until {
            deepest = f64::max(deepest, point.depth);
            removed = f64::max(removed, point.removed);
        }
        let level = match plan.verdict.level {
            // The run goes on beyond the horizon.
            VerdictLevel::Stop | VerdictLevel::Outside => plan.verdict.level,
            _ if outcome.is_failure() => VerdictLevel::Act,
            _ if outcome == PlanOutcome::Unknown => VerdictLevel::Unknown,
            _ => VerdictLevel::Ok,
        };
        // A sample whose fate is not known may fail.
        let keeps = samples.is_none_or(|samples| samples.fails + samples.not_known <= self.target());
        let months = |mgt: f64| case.mgt_per_year.map(|year| 12.0 * mgt / year);
        let removal = plan.run.question.removal;
        let replacement = removal.replacement().map(|Mgt(mgt)| mgt);
        PlannedGrinding {
            grinding_mm: plan.grinding.map_or(0.0, |grinding| grinding.depth),
            grinding_interval_mgt: plan.grinding.map(|grinding| grinding.interval.0),
            removal_mm_per_mgt: removal.mean_rate(),
            outcome,
            mgt,
            months: months(mgt),
            largest_depth_mm: deepest,
            removed_mm: removed,
            level,
            probability_of_failure: samples.map(|samples| samples.fails),
            piece_thickness_mm: plan.log.pieces().last().map(|piece| piece.thickness),
            probability_not_known: samples.map(|samples| samples.not_known),
            holds: outcome.is_safe() && level < VerdictLevel::Stop && keeps,
            mgt_to_wear_limit: replacement,
            months_to_wear_limit: replacement.and_then(months),
        }
    }

    /// How the rail ends under `plan` before `horizon`, and million gross tonnes until then.
    fn end(&self, plan: &Followed, Mgt(horizon): Mgt) -> (PlanOutcome, f64) {
        let nominal = &plan.run.nominal;
        let last = plan.log.steps.last();
        let end = last.map_or(0.0, |step| step.mgt(self.tonnes));
        let stop = last.and_then(|step| step.stop);
        let rests = [TipStop::Arrest, TipStop::Coalescence, TipStop::BreakOut];
        let is_at_rest = matches!(stop, Some(RunStop::NoTipGrows(stop)) if rests.contains(&stop));
        let by = |mgt: Option<f64>| mgt.filter(|mgt| *mgt <= horizon);
        let failure = nominal.failure.mode.zip(by(nominal.failure.mgt));
        match (failure, by(nominal.worn), by(nominal.replaced)) {
            (Some((mode, mgt)), ..) => (PlanOutcome::Fails(mode), mgt),
            (_, Some(mgt), _) => (PlanOutcome::WornAway, mgt),
            (_, _, Some(mgt)) => (PlanOutcome::WearLimit, mgt),
            _ if is_at_rest => (PlanOutcome::Arrest, end.min(horizon)),
            _ if end >= horizon * (1.0 - 1e-9) => (PlanOutcome::Holds, horizon),
            _ => (PlanOutcome::Unknown, end),
        }
    }

    /// Assumptions of the plans, a sentence each.
    pub(super) fn assumptions(&self, summary: &PlanSummary) -> Vec<String> {
        let case = self.simulation.case;
        let mut all = vec![
            format!(
                "Traffic is counted by a mean axle load of {} t{}.",
                summary.axle_load_t,
                case.mgt_per_year.map_or_else(
                    || "; the traffic of a year is not given, so that there are no months".to_owned(),
                    |year| format!(", {year} million gross tonnes in a year")
                )
            ),
            match case.wheels.len() {
                0 | 1 => "One wheel stands for all traffic.".to_owned(),
                wheels => format!("{wheels} wheels of given shares stand for all traffic."),
            },
            "The cracks are those of the case at the beginning, and grow as a plane rail by the growth law of the case.".to_owned(),
            format!("The surface wears by {} mm per million gross tonnes at all times.", summary.wear_mm_per_mgt),
            match summary.first_grinding_mgt {
                Some(0.0) => "The first grinding is done at once in every plan, the others follow at the interval.".to_owned(),
                Some(first) => format!("The first grinding is due after {first} million gross tonnes in every plan, the others follow at the interval."),
                None => "The first grinding is due after one interval.".to_owned(),
            },
            "A grinding takes the same depth everywhere and leaves the shape of the contact as it is.".to_owned(),
            format!("The rail is followed up to {:.1} million gross tonnes.", summary.horizon_mgt),
        ];
        if let Some(depth) = case.inspection.and_then(|inspection| inspection.critical_depth) {
            all.push(format!("A tip at a depth of {depth} mm below the present surface is a failure."));
        }
        if let Some(length) = case.growth.critical_length {
            all.push(format!("A crack of a length of {length} mm is a failure."));
        }
        if let Some(fracture) = &case.fracture {
            all.push(format!("The rail breaks by a toughness of {} MPa√m.", fracture.at_rail));
        }
        if let Some(limit) = summary.wear_limit_mm {
            all.push(format!("The rail is replaced when wear and grinding have removed {limit} mm."));
        }
        if let (Some(samples), Some(scatter)) = (summary.samples, case.scatter) {
            all.push(format!(
                "Probabilities are shares of {samples} samples about each plan with standard deviations of {} of ln C, {} of the exponent and {} mm per million gross tonnes of the wear; inspections are not counted. A plan holds where at most {} of the samples fail or are not known, {}.",
                scatter.c_log_std,
                scatter.m_std,
                scatter.wear_std,
                self.target(),
                if case.inspection_risk.as_ref().is_some_and(|risk| risk.target.is_some()) {
                    "the target_risk of the case"
                } else {
                    "since the case gives no target_risk"
                }
            ));
        } else {
            all.push("Nothing scatters: the case has no [scatter], and the coefficient of the growth law is known to a factor only.".to_owned());
        }
        all
    }
}

/// Warnings on the case and on its cracks without grinding, each once.
fn warnings(alone: &Followed) -> Vec<String> {
    let of_case = alone.info.warnings.iter().map(|warning| warning.text.clone());
    let of_steps = validity::of_steps(&alone.info, &alone.log).into_iter().map(|warning| warning.text);
    let mut all: Vec<String> = Vec::new();
    for text in of_case.chain(of_steps) {
        if !all.contains(&text) {
            all.push(text);
        }
    }
    all
}
