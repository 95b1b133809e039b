//! Grinding plans: the same cracks under depths and intervals of grinding, computed in memory.

use super::companions::APART;
use super::error::RunError;
use super::job::{Job, Stage, case_files};
use super::observer::RunObserver;
use super::run::Simulation;
use crate::decision::{
    Draw, Draws, FailureMode, Judged, Sampler, Sampling, Track, VerdictLevel, calibration, judged, question,
};
use crate::disk::{FolderLock, VERSION};
use crate::error::OutputError;
use crate::log::{Companion, RunInfo, RunLog};
use crate::planner::{LeastGrinding, PlanOutcome, PlanSummary, PlannedGrinding, civil, write_plan};
use crate::run_folder::{Existing, begin};
use crate::summary::validity;
use railcrack::growth::{GrowthState, RunStop, StressMoves, TipStop};
use railcrack_case::{Case, MaintenancePlan};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::path::Path;
use std::time::{Instant, SystemTime, UNIX_EPOCH};

/// Depths and intervals of grinding that are tried, and how far the rail is followed.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PlanRequest {
    /// Depths of each grinding, mm; empty for those about the case.
    pub depths: Vec<f64>,
    /// Million gross tonnes between grindings; empty for those about the case.
    pub intervals: Vec<f64>,
    /// Million gross tonnes; none for a multiple of the life without grinding.
    pub horizon: Option<f64>,
}

/// Steps of a run at most.
const MOST_STEPS: usize = 3000;
/// The horizon over the life without grinding, and where the rail does not fail without grinding,
/// million gross tonnes.
const LIVES: f64 = 5.0;
const LONGEST: f64 = 1000.0;
/// Depths of grinding (mm) where the case has none, and intervals over the life without grinding.
const DEPTHS: [f64; 4] = [0.1, 0.2, 0.3, 0.5];
const OF_LIFE: [f64; 3] = [1.0 / 12.0, 1.0 / 6.0, 1.0 / 3.0];
/// Depths and intervals over those of the case, where it has grinding.
const DEPTHS_OF_CASE: [f64; 4] = [0.5, 1.0, 1.5, 2.0];
const INTERVALS_OF_CASE: [f64; 3] = [0.5, 1.0, 2.0];
/// Probability of failure before the horizon up to which a plan holds, where the case has scatter
/// and no target risk.
const USUAL_TARGET: f64 = 0.05;
/// Samples of each plan at most.
const MOST_SAMPLES: usize = 5000;

impl Simulation<'_> {
    /// Computes what becomes of the rail of the case under the grinding plans of `request`, into
    /// `folder`.
    ///
    /// Errors: the case has no axle loads, or nothing in it is a failure; a run cannot be computed;
    /// the folder cannot be written; an interruption.
    pub fn plan_in(
        &self,
        folder: &Path,
        existing: Existing,
        request: &PlanRequest,
    ) -> Result<PlanSummary, RunError> {
        let Some(tonnes) = self.case.axle_load else {
            return Err(RunError::Plan(
                "plans count in million gross tonnes, and the case gives no axle load: add a [traffic] section with axle_load_t, or axle_load_t to every [[wheel]]".to_owned(),
            ));
        };
        let fails = self.case.inspection.is_some_and(|inspection| inspection.critical_depth.is_some());
        if !fails && self.case.growth.critical_length.is_none() && self.case.fracture.is_none() {
            return Err(RunError::Plan(
                "no failure is given that grinding could prevent: add critical_depth_mm to [inspection], critical_length_mm to [growth], or [fracture]".to_owned(),
            ));
        }
        let started = Instant::now();
        if !folder.exists() {
            std::fs::create_dir_all(folder).map_err(OutputError::io("create the folder", folder))?;
        }
        let _lock = folder.is_dir().then(|| FolderLock::take(folder)).transpose()?;
        let files = case_files(self.case);
        begin(folder, &files, existing)?;
        let planning = Planning { simulation: *self, folder, tonnes, info: Job::of(self.case).info };
        let summary = write_plan(folder, planning.computed(request, started)?)?;
        self.presentation.plan(folder)?;
        self.observer.close();
        Ok(summary)
    }
}

/// Common part of all runs of the plans.
struct Planning<'a> {
    simulation: Simulation<'a>,
    folder: &'a Path,
    tonnes: f64,
    info: RunInfo,
}

/// A run under one plan.
struct Followed {
    /// Depth and interval of grinding; none without grinding.
    grinding: Option<(f64, f64)>,
    info: RunInfo,
    log: RunLog,
    judged: Judged,
    /// Runs at other speeds, between which its samples are made: those of a decision under this
    /// grinding.
    speeds: Vec<Companion>,
}

/// Passes on only whether to stop.
struct AskedAlone<'a>(&'a dyn RunObserver);

impl RunObserver for AskedAlone<'_> {
    fn interrupted(&self) -> bool {
        self.0.interrupted()
    }
}

impl Planning<'_> {
    fn computed(&self, request: &PlanRequest, started: Instant) -> Result<PlanSummary, RunError> {
        let case = self.simulation.case;
        let stopped = case.growth.stop_after_cycles.map(|cycles| 1e-6 * self.tonnes * cycles);
        let asked = request.horizon.or(stopped);
        self.simulation.observer.stage("the rail without grinding");
        let (alone, state) = self.followed(None, None, asked.unwrap_or(LIVES * LONGEST))?;
        let alone_fails = alone.judged.nominal.failure.mgt;
        let horizon = asked.unwrap_or_else(|| alone_fails.map_or(LONGEST, |mgt| LIVES * mgt));
        let (depths, intervals) = self.tried(request, alone_fails.unwrap_or(horizon));
        // A sample at the horizon has a run on both sides.
        let farthest = if case.scatter.is_some() { horizon * APART.exp() } else { horizon };
        let plans: Vec<(f64, f64)> = depths
            .iter()
            .flat_map(|depth| intervals.iter().map(move |interval| (*depth, *interval)))
            .collect();
        self.simulation.observer.stage(&format!("{} grinding plans", plans.len()));
        let all = self.all(&plans, &state, farthest)?;
        let runs = 1 + all.iter().map(|run| 1 + run.speeds.len()).sum::<usize>();
        let draws = self.draws();
        let outcomes: Vec<PlannedGrinding> =
            all.iter().map(|run| self.outcome(run, horizon, &draws)).collect();
        let without = self.outcome(&alone, horizon, &[]);
        let verdict = alone.judged.verdict.clone();
        let today = today();
        let mut summary = PlanSummary {
            version: VERSION.to_owned(),
            title: case.title.clone(),
            date: civil(today),
            case_checksum: String::new(),
            calibration: calibration(case.calibration.sites),
            axle_load_t: self.tonnes,
            mgt_per_year: case.mgt_per_year,
            horizon_mgt: horizon,
            wear_mm_per_mgt: case.maintenance.map_or(0.0, |plan| plan.wear),
            wear_limit_mm: case.maintenance.and_then(|plan| plan.wear_limit),
            target_risk: (!draws.is_empty()).then(|| self.target()),
            samples: Some(draws.len()).filter(|count| *count > 0),
            seed: case.scatter.map(|scatter| scatter.seed),
            grinding_mm: depths.clone(),
            grinding_interval_mgt: intervals.clone(),
            without_grinding: without,
            plans: outcomes,
            least: None,
            least_by_interval: vec![None; intervals.len()],
            runs,
            wall_s: started.elapsed().as_secs_f64(),
            assumptions: Vec::new(),
            warnings: self.warnings(&alone),
            checksums: BTreeMap::new(),
            verdict,
        };
        if summary.verdict.level < VerdictLevel::Stop {
            summary.least_by_interval = (0..intervals.len()).map(|i| least_at(&summary, i, today)).collect();
            let all = summary.least_by_interval.iter().flatten().cloned();
            let of_grinding =
                all.reduce(|a, b| if b.removal_mm_per_mgt < a.removal_mm_per_mgt { b } else { a });
            let without = Some(&summary.without_grinding).filter(|plan| plan.holds);
            summary.least = without.map(|plan| LeastGrinding::of(plan, today)).or(of_grinding);
        }
        summary.assumptions = self.assumptions(&summary);
        Ok(summary)
    }

    /// Depths and intervals, ascending; `life` is that without grinding.
    fn tried(&self, request: &PlanRequest, life: f64) -> (Vec<f64>, Vec<f64>) {
        let given = self.simulation.case.maintenance.and_then(|plan| plan.grinding);
        let depths = match (request.depths.is_empty(), given) {
            (false, _) => request.depths.clone(),
            (true, Some((depth, _))) => DEPTHS_OF_CASE.map(|of| rounded(of * depth)).to_vec(),
            (true, None) => DEPTHS.to_vec(),
        };
        let intervals = match (request.intervals.is_empty(), given) {
            (false, _) => request.intervals.clone(),
            (true, Some((_, interval))) => INTERVALS_OF_CASE.map(|of| rounded(of * interval)).to_vec(),
            (true, None) => OF_LIFE.map(|of| rounded(of * life)).to_vec(),
        };
        let ordered = |mut all: Vec<f64>| {
            all.sort_by(f64::total_cmp);
            all.dedup();
            all
        };
        (ordered(depths), ordered(intervals))
    }

    /// The case with `grinding`.
    fn case(&self, grinding: Option<(f64, f64)>, horizon: f64) -> Case {
        let mut case = self.simulation.case.clone();
        let given = case.maintenance.unwrap_or(MaintenancePlan {
            wear: 0.0,
            grinding: None,
            first_grinding: None,
            wear_limit: None,
            stress: StressMoves::WithMetal,
        });
        // The first grinding of the case is one of its own interval.
        let first_grinding = given.first_grinding.filter(|_| grinding.is_some());
        let plan = MaintenancePlan { grinding, first_grinding, ..given };
        let is_removed = plan.removal() > 0.0;
        case.maintenance = is_removed.then_some(plan);
        case.growth.maintenance = case.maintenance.map(|plan| plan.per_axle(self.tonnes));
        case.growth.steps = MOST_STEPS;
        case.growth.stop_after_cycles = Some(1e6 * horizon / self.tonnes);
        case
    }

    /// The run under `grinding` up to `horizon` (million gross tonnes) or its failure.
    fn followed(
        &self,
        grinding: Option<(f64, f64)>,
        state: Option<&GrowthState>,
        horizon: f64,
    ) -> Result<(Followed, GrowthState), RunError> {
        let case = self.case(grinding, horizon);
        let asked = AskedAlone(self.simulation.observer);
        let simulation = Simulation { case: &case, observer: &asked, has_variants: false, ..self.simulation };
        let stage = Stage {
            folder: self.folder,
            observer: if state.is_some() { &asked } else { self.simulation.observer },
            presentation: self.simulation.presentation,
            shared: self.simulation.shared,
            state: state.cloned(),
        };
        let mut log = RunLog::default();
        let critical = case.inspection.and_then(|inspection| inspection.critical_depth);
        let state = simulation.follow(&stage, &mut log, critical.unwrap_or(f64::INFINITY))?;
        let info = RunInfo { maintenance: case.maintenance, ..self.info.clone() };
        let judged = judged(&info, &log, self.tonnes)
            .ok_or_else(|| RunError::Plan("the case has no crack that could grow".to_owned()))?;
        let speeds = match grinding {
            Some(_) => simulation.companions(&info, &log, &state, self.folder)?.unwrap_or_default(),
            None => Vec::new(),
        };
        Ok((Followed { grinding, info, log, judged, speeds }, state))
    }

    fn all(
        &self,
        wanted: &[(f64, f64)],
        state: &GrowthState,
        horizon: f64,
    ) -> Result<Vec<Followed>, RunError> {
        let of = |plan: &(f64, f64)| Ok(self.followed(Some(*plan), Some(state), horizon)?.0);
        // The finite elements of several bodies at once may not fit into the memory.
        if self.simulation.case.engine == railcrack_case::Engine::Dislocation {
            wanted.par_iter().map(of).collect()
        } else {
            wanted.iter().map(of).collect()
        }
    }

    /// The probability of failure up to which a plan holds.
    fn target(&self) -> f64 {
        self.simulation.case.inspection_risk.as_ref().and_then(|risk| risk.target).unwrap_or(USUAL_TARGET)
    }

    fn draws(&self) -> Vec<Draw> {
        let Some(scatter) = &self.simulation.case.scatter else { return Vec::new() };
        let mut draws = Draws::of(scatter, &self.info.mix);
        (0..scatter.samples.min(MOST_SAMPLES)).map(|_| draws.next()).collect()
    }

    /// Outcome of `run`.
    fn outcome(&self, run: &Followed, horizon: f64, draws: &[Draw]) -> PlannedGrinding {
        let case = self.simulation.case;
        let nominal = &run.judged.nominal;
        let last = run.log.steps.last();
        let end = last.map_or(0.0, |step| 1e-6 * self.tonnes * step.load_cycles);
        let stop = last.and_then(|step| step.stop);
        let is_at_rest = matches!(stop, Some(RunStop::NoTipGrows(TipStop::Arrest | TipStop::Coalescence)));
        let by = |mgt: Option<f64>| mgt.filter(|mgt| *mgt <= horizon);
        let failure = nominal.failure.mode.zip(by(nominal.failure.mgt));
        let (outcome, mgt) = match (failure, by(nominal.worn), by(nominal.replaced)) {
            (Some((mode, mgt)), ..) => (PlanOutcome::Fails(mode), mgt),
            (_, Some(mgt), _) => (PlanOutcome::WornAway, mgt),
            (_, _, Some(mgt)) => (PlanOutcome::WearLimit, mgt),
            _ if is_at_rest => (PlanOutcome::Arrest, end.min(horizon)),
            _ if end >= horizon * (1.0 - 1e-9) => (PlanOutcome::Holds, horizon),
            _ => (PlanOutcome::Unknown, end),
        };
        let until = run
            .judged
            .course
            .points
            .iter()
            .filter(|point| 1e-6 * self.tonnes * point.axles <= mgt * (1.0 + 1e-9));
        let critical = case.inspection.and_then(|inspection| inspection.critical_depth);
        let reached = critical.filter(|_| outcome == PlanOutcome::Fails(FailureMode::Depth)).unwrap_or(0.0);
        let (mut deepest, mut removed) = (reached, 0.0);
        for point in until {
            deepest = f64::max(deepest, point.depth);
            removed = f64::max(removed, point.removed);
        }
        let level = match run.judged.verdict.level {
            // The run goes on beyond the horizon.
            VerdictLevel::Ok | VerdictLevel::Act if outcome.is_failure() => VerdictLevel::Act,
            VerdictLevel::Ok | VerdictLevel::Act => VerdictLevel::Ok,
            level => level,
        };
        let (probability, not_known) = self.probability(run, horizon, draws).unzip();
        // A sample whose fate is not known may fail.
        let keeps = probability.is_none_or(|found| found + not_known.unwrap_or(0.0) <= self.target());
        let months = |mgt: f64| case.mgt_per_year.map(|year| 12.0 * mgt / year);
        let replacement = run.info.maintenance.and_then(|plan| plan.replacement());
        PlannedGrinding {
            grinding_mm: run.grinding.map_or(0.0, |(depth, _)| depth),
            grinding_interval_mgt: run.grinding.map(|(_, interval)| interval),
            removal_mm_per_mgt: run.info.maintenance.map_or(0.0, |plan| plan.removal()),
            outcome,
            mgt,
            months: months(mgt),
            largest_depth_mm: deepest,
            removed_mm: removed,
            level,
            probability_of_failure: probability,
            probability_not_known: not_known,
            holds: outcome.is_safe() && level < VerdictLevel::Stop && keeps,
            mgt_to_wear_limit: replacement,
            months_to_wear_limit: replacement.and_then(months),
        }
    }

    /// The share of samples that fail before `horizon`, and of those of which it is not known.
    fn probability(&self, run: &Followed, horizon: f64, draws: &[Draw]) -> Option<(f64, f64)> {
        let scatter = self.simulation.case.scatter.as_ref().filter(|_| !draws.is_empty())?;
        let question = question(&run.info, self.tonnes);
        let family = run.judged.family(question, &run.speeds);
        let sampler = Sampler::of(Sampling {
            family: &family,
            question,
            scatter,
            mix: &self.info.mix,
            arrest_rate: if run.info.maintenance.is_some() { 0.0 } else { run.info.arrest_rate },
            has_own_toughness: scatter.toughness_std > 0.0,
        });
        let ends: Vec<(f64, f64)> = draws
            .par_chunks(CHUNK)
            .flat_map_iter(|draws| {
                let mut track = Track::default();
                let of_one = |draw| {
                    let sample = sampler.sample(draw, &mut track);
                    (sample.to_critical, sample.outlives)
                };
                draws.iter().map(of_one).collect::<Vec<_>>()
            })
            .collect();
        let count = ends.len() as f64;
        let share = |is_it: &dyn Fn(&(f64, f64)) -> bool| ends.iter().filter(|end| is_it(end)).count() as f64;
        Some((share(&|end| end.0 <= horizon) / count, share(&|end| end.1 < horizon) / count))
    }

    fn warnings(&self, alone: &Followed) -> Vec<String> {
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

    /// Assumptions of the plans, a sentence each.
    fn assumptions(&self, summary: &PlanSummary) -> Vec<String> {
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
            match case.mix.len() {
                0 | 1 => "One wheel stands for all traffic.".to_owned(),
                wheels => format!("{wheels} wheels of given shares stand for all traffic."),
            },
            "The cracks are those of the case at the beginning, and grow as a plane rail by the growth law of the case.".to_owned(),
            format!("The surface wears by {} mm per million gross tonnes at all times.", summary.wear_mm_per_mgt),
            match case.maintenance.and_then(|plan| plan.first_grinding) {
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

/// Samples that one thread makes at a time.
const CHUNK: usize = 128;

/// The least depth that holds at interval `i`.
fn least_at(summary: &PlanSummary, i: usize, today: i64) -> Option<LeastGrinding> {
    let depths = 0..summary.grinding_mm.len();
    // Deeper grinding must hold as well: a rail that one depth saves by chance is not safe.
    let holds = |depth: usize| summary.plan(depth, i).is_some_and(|plan| plan.holds);
    let first = depths.clone().find(|depth| (*depth..depths.end).all(holds))?;
    summary.plan(first, i).map(|plan| LeastGrinding::of(plan, today))
}

/// `value` to two significant digits.
fn rounded(value: f64) -> f64 {
    if !(value > 0.0 && value.is_finite()) {
        return value;
    }
    let text = format!("{value:.1e}");
    text.parse().unwrap_or(value)
}

/// Days from 1970-01-01 to today (UTC).
fn today() -> i64 {
    let seconds = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
    (seconds / 86_400) as i64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_digits() {
        assert_eq!([0.30000000000000004, 11.17, 134.6, 5.0].map(rounded), [0.3, 11.0, 130.0, 5.0]);
    }
}
