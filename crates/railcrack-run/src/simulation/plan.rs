//! Grinding plans: the same cracks under depths and intervals of grinding, computed in memory.

use super::companions::APART;
use super::each::of_each;
use super::error::RunError;
use super::job::{Job, Stage, case_files};
use super::observer::{AskedAlone, RunObserver};
use super::residual_stress::carrying_rail;
use super::run::Simulation;
use crate::decision::{NominalRun, Question, Verdict, VerdictLevel};
use crate::log::{Companion, RunInfo, RunLog};
use crate::planner::{PlanSummary, write_plan};
use crate::run_folder::{Existing, OF_A_RUN, ResultFolder, begin};
use crate::setup::represented;
use railcrack::growth::{Axles, Grinding, GrowthState, Mgt, SurfaceRemoval};
use railcrack_case::Case;
use std::path::Path;
use std::time::Instant;

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

/// The samples of a plan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PlanSamples {
    /// Share that fails before the horizon.
    pub fails: f64,
    /// Share whose fate before it is not known.
    pub not_known: f64,
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
        let case = represented(self.case);
        let Some(tonnes) = case.axle_load else {
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
        let entered = ResultFolder::enter(folder, &OF_A_RUN, existing)?;
        entered.mark()?;
        let known = self.known_straight();
        let simulation = Simulation { case: &case, known: known.as_ref(), ..*self };
        let planning = Planning { simulation, folder, tonnes, info: Job::of(&case).info };
        let planned = planning.written(request);
        self.observer.close();
        entered.end(planned, RunError::is_interruption)
    }
}

/// Common part of all runs of the plans.
pub(super) struct Planning<'a> {
    pub simulation: Simulation<'a>,
    pub folder: &'a Path,
    /// Mean load of an axle, t.
    pub tonnes: f64,
    pub info: RunInfo,
}

/// A run under one plan.
pub(super) struct Followed {
    /// None without grinding.
    pub grinding: Option<Grinding<Mgt>>,
    pub info: RunInfo,
    pub log: RunLog,
    pub run: NominalRun,
    pub verdict: Verdict,
    /// Traffic up to which it is followed.
    pub until: Mgt,
}

/// All runs of the plans.
pub(super) struct AllFollowed {
    /// The rail without grinding.
    pub alone: Followed,
    /// Depths that are tried, ascending, mm.
    pub depths: Vec<f64>,
    /// Million gross tonnes between grindings, ascending.
    pub intervals: Vec<f64>,
    /// The rail under each of them, by depth and then by interval.
    pub plans: Vec<Followed>,
    /// The samples of each of them; none without scatter.
    pub samples: Vec<PlanSamples>,
    /// Number of all runs.
    pub runs: usize,
    /// Traffic up to which the rail is followed.
    pub horizon: Mgt,
}

impl Planning<'_> {
    /// Computes the plans and writes case, tables, summary and page to the folder, which is
    /// entered.
    fn written(&self, request: &PlanRequest) -> Result<PlanSummary, RunError> {
        let started = Instant::now();
        let simulation = self.simulation;
        begin(self.folder, &case_files(simulation.case), Existing::Entered)?;
        let stage = self.stage(simulation.observer, None);
        let rail = carrying_rail(simulation.case, simulation.case.engine(), &stage)?;
        let simulation = Simulation { shared: rail.as_ref().or(simulation.shared), ..simulation };
        let carrying = Planning { simulation, info: self.info.clone(), ..*self };
        let summary = write_plan(self.folder, carrying.computed(request, started)?)?;
        simulation.presentation.plan(self.folder)?;
        Ok(summary)
    }

    /// The start of a run from `state`, watched by `observer`.
    fn stage<'a>(&'a self, observer: &'a dyn RunObserver, state: Option<&GrowthState>) -> Stage<'a> {
        let Simulation { presentation, shared, .. } = self.simulation;
        Stage { folder: self.folder, observer, presentation, shared, state: state.cloned() }
    }

    fn computed(&self, request: &PlanRequest, started: Instant) -> Result<PlanSummary, RunError> {
        let first = self.simulation.case.maintenance.and_then(|removal| removal.grinding?.first);
        let mut summary = self.summary(&self.all(request, first)?, started);
        summary.find_least();
        // Where none of them holds, the question is whether grinding at once still helps.
        if summary.lacks_a_plan() && first.is_none() {
            let at_once = self.all(request, Some(Mgt(0.0)))?;
            summary = PlanSummary { first_grinding_mgt: Some(0.0), ..self.summary(&at_once, started) };
            summary.find_least();
        }
        summary.assumptions = self.assumptions(&summary);
        Ok(summary)
    }

    /// The rail without grinding and under all plans of `request`, the first grinding after the
    /// traffic `first` or after an interval. A rail that the model does not describe without
    /// grinding has no plans.
    fn all(&self, request: &PlanRequest, first: Option<Mgt>) -> Result<AllFollowed, RunError> {
        let case = self.simulation.case;
        let stopped = case.growth.stop_after_cycles.map(|cycles| Axles(cycles).mgt(self.tonnes).0);
        let asked = request.horizon.or(stopped);
        self.simulation.observer.stage("the rail without grinding");
        let (alone, state) = self.followed(None, None, Mgt(asked.unwrap_or(LIVES * LONGEST)))?;
        let alone_fails = alone.run.nominal.failure.mgt;
        let horizon = asked.unwrap_or_else(|| alone_fails.map_or(LONGEST, |mgt| LIVES * mgt));
        let is_outside = alone.verdict.level == VerdictLevel::Outside;
        let (depths, intervals) = match is_outside {
            true => (Vec::new(), Vec::new()),
            false => self.tried(request, alone_fails.unwrap_or(horizon)),
        };
        // A sample at the horizon has a run on both sides.
        let farthest = Mgt(if case.scatter.is_some() { horizon * APART.exp() } else { horizon });
        let wanted: Vec<Grinding<Mgt>> = depths
            .iter()
            .flat_map(|&depth| intervals.iter().map(move |&interval| (depth, Mgt(interval))))
            .map(|(depth, interval)| Grinding { depth, interval, first })
            .collect();
        self.simulation.observer.stage(&format!("{} grinding plans", wanted.len()));
        let of = |grinding: &Grinding<Mgt>| Ok(self.followed(Some(*grinding), Some(&state), farthest)?.0);
        let (plans, horizon) = (of_each(&wanted, case.engine(), of)?, Mgt(horizon));
        let (samples, at_speeds) = self.samples(&alone, &plans, &state, horizon)?;
        let runs = 1 + plans.len() + at_speeds;
        Ok(AllFollowed { alone, depths, intervals, plans, samples, runs, horizon })
    }

    /// Depths and intervals, ascending; `life` is that without grinding.
    fn tried(&self, request: &PlanRequest, life: f64) -> (Vec<f64>, Vec<f64>) {
        let given = self.simulation.case.maintenance.and_then(|removal| removal.grinding);
        let depths = match (request.depths.is_empty(), given) {
            (false, _) => request.depths.clone(),
            (true, Some(given)) => DEPTHS_OF_CASE.map(|of| rounded(of * given.depth)).to_vec(),
            (true, None) => DEPTHS.to_vec(),
        };
        let intervals = match (request.intervals.is_empty(), given) {
            (false, _) => request.intervals.clone(),
            (true, Some(given)) => INTERVALS_OF_CASE.map(|of| rounded(of * given.interval.0)).to_vec(),
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
    fn case(&self, grinding: Option<Grinding<Mgt>>, horizon: Mgt) -> Case {
        let mut case = self.simulation.case.clone();
        let given = case.maintenance.unwrap_or(SurfaceRemoval::NONE);
        let removal = SurfaceRemoval { grinding, ..given };
        case.set_maintenance(Some(removal).filter(|removal| removal.mean_rate() > 0.0));
        case.growth.steps = MOST_STEPS;
        case.growth.answer = None;
        case.growth.stop_after_cycles = Some(horizon.axles(self.tonnes).0);
        case
    }

    /// The run under `grinding` up to `horizon` or its failure.
    fn followed(
        &self,
        grinding: Option<Grinding<Mgt>>,
        state: Option<&GrowthState>,
        horizon: Mgt,
    ) -> Result<(Followed, GrowthState), RunError> {
        let case = self.case(grinding, horizon);
        let asked = AskedAlone(self.simulation.observer);
        let simulation = Simulation { case: &case, observer: &asked, has_variants: false, ..self.simulation };
        let stage = self.stage(if state.is_some() { &asked } else { self.simulation.observer }, state);
        let mut log = RunLog::default();
        let critical = case.inspection.and_then(|inspection| inspection.critical_depth);
        let state = simulation.follow(&stage, &mut log, critical.unwrap_or(f64::INFINITY))?;
        let info = RunInfo { maintenance: case.maintenance, ..self.info.clone() };
        let run = Question::of(&info)
            .and_then(|question| NominalRun::of(&log.steps, question))
            .ok_or_else(|| RunError::Plan("the case has no crack that could grow".to_owned()))?;
        let verdict = Verdict::of(&info, &log, &run);
        Ok((Followed { grinding, info, log, run, verdict, until: horizon }, state))
    }

    /// The first runs of `plan` at other speeds, for the samples of it and of others.
    ///
    /// Errors: an interruption.
    pub(super) fn first_speeds(
        &self,
        plan: &Followed,
        state: &GrowthState,
    ) -> Result<Vec<Companion>, RunError> {
        self.beside(plan, |simulation| simulation.first_speeds(&plan.info, &plan.log, state, self.folder))
    }

    /// Runs of `plan` at other speeds, between which its samples are made: those of a decision.
    ///
    /// Errors: an interruption.
    pub(super) fn speeds(&self, plan: &Followed, state: &GrowthState) -> Result<Vec<Companion>, RunError> {
        let all = |simulation: &Simulation| simulation.companions(&plan.info, &plan.log, state, self.folder);
        Ok(self.beside(plan, all)?.unwrap_or_default())
    }

    /// The result of `of` for the run of `plan`.
    fn beside<T>(&self, plan: &Followed, of: impl FnOnce(&Simulation) -> T) -> T {
        let case = self.case(plan.grinding, plan.until);
        let observer = &AskedAlone(self.simulation.observer);
        of(&Simulation { case: &case, observer, has_variants: false, ..self.simulation })
    }
}

/// `value` to two significant digits.
fn rounded(value: f64) -> f64 {
    if !(value > 0.0 && value.is_finite()) {
        return value;
    }
    let text = format!("{value:.1e}");
    text.parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_digits() {
        assert_eq!([0.30000000000000004, 11.17, 134.6, 5.0].map(rounded), [0.3, 11.0, 130.0, 5.0]);
    }
}
