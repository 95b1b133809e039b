//! Samples of grinding plans.
//!
//! The plans are runs of one rail that is ground in different ways, and the samples of each are
//! made between all of them. Where these do not repeat the life of a plan that is left out, end
//! before its samples, or say nothing of the fast ones, runs of it at other speeds join them, and
//! where that does not help, the plan has as many of its own as a decision.

use super::each::of_each;
use super::error::RunError;
use super::plan::{Followed, PlanSamples, Planning};
use crate::decision::{Companions, Course, Draw, Draws, Family, Nominal, NominalRun, Sampler, Sampling};
use crate::log::{Companion, StepDigest};
use railcrack::growth::{Grinding, GrowthState, Mgt};
use railcrack_case::Scatter;

/// Samples of each plan at most.
const MOST_SAMPLES: usize = 5000;
/// Error of the life of a plan that is left out up to which samples are made between the others: as
/// at the speeds of a decision.
const LEFT_OUT: f64 = 0.02;
/// Share of the samples whose fate before the horizon is not known up to which they stand.
const NOT_KNOWN: f64 = 2e-3;

/// A run of the rail under a grinding, and how fast it grows.
#[derive(Clone, Copy)]
struct GroundRun<'a> {
    /// The plan that it has; none without grinding.
    grinding: Option<Grinding<Mgt>>,
    steps: &'a [StepDigest],
    speed: f64,
}

/// The samples of plans: scatter, deviates, and the horizon.
struct PlanDraws<'a> {
    scatter: &'a Scatter,
    draws: Vec<Draw>,
    horizon: Mgt,
}

impl Planning<'_> {
    /// Samples of each plan; none without scatter.
    pub(super) fn samples_of_each(&self) -> Option<usize> {
        let scatter = self.simulation.case.scatter?;
        Some(scatter.samples.min(MOST_SAMPLES)).filter(|count| *count > 0)
    }

    /// The samples of each of `plans` up to the `horizon`, none without scatter, and the number of
    /// runs that were computed for them. The rail `alone` was followed to `state`.
    ///
    /// Errors: an interruption.
    pub(super) fn samples(
        &self,
        alone: &Followed,
        plans: &[Followed],
        state: &GrowthState,
        horizon: Mgt,
    ) -> Result<(Vec<PlanSamples>, usize), RunError> {
        let (case, engine) = (self.simulation.case, self.simulation.case.engine());
        let Some((scatter, count)) = case.scatter.as_ref().zip(self.samples_of_each()) else {
            return Ok((Vec::new(), 0));
        };
        let mut draws = Draws::of(scatter, self.info.mix());
        let draws = PlanDraws { scatter, draws: (0..count).map(|_| draws.next()).collect(), horizon };
        let mut samples: Vec<Option<PlanSamples>> = vec![None; plans.len()];
        let mut joined: Vec<(&Followed, Companion)> = Vec::new();
        // Samples with their own toughness go on where the plans break.
        let is_shared = case.fracture.is_none() || scatter.toughness_std == 0.0;
        let mut helpers: Option<Vec<usize>> = is_shared.then(|| (0..plans.len()).collect());
        if let Some(helpers) = &mut helpers {
            helpers.sort_by(|i, j| plans[*i].removal_rate().total_cmp(&plans[*j].removal_rate()));
        }
        while helpers.is_some() {
            let missing: Vec<usize> = (0..plans.len()).filter(|i| samples[*i].is_none()).collect();
            let at_speeds: Vec<GroundRun> =
                joined.iter().filter_map(|(plan, run)| plan.at_speed(run)).collect();
            let found = of_each(&missing, engine, |&i: &usize| {
                let others = plans[..i].iter().chain(&plans[i + 1..]).map(Followed::as_run);
                let others: Vec<GroundRun> = others.chain(at_speeds.iter().copied()).collect();
                Ok(draws.between(&plans[i], alone.as_run(), &others))
            })?;
            missing.iter().zip(found).for_each(|(i, found)| samples[*i] = found);
            // That which removes most goes first: its samples grow farthest.
            let next = helpers.as_mut().and_then(|left| {
                left.retain(|i| samples[*i].is_none());
                left.pop()
            });
            match next {
                Some(next) => {
                    let own = self.first_speeds(&plans[next], state)?;
                    joined.extend(own.into_iter().map(|run| (&plans[next], run)));
                }
                None => helpers = None,
            }
        }
        let mut runs = joined.len();
        let missing: Vec<usize> = (0..plans.len()).filter(|i| samples[*i].is_none()).collect();
        let own = of_each(&missing, engine, |&i: &usize| {
            let plan = &plans[i];
            let speeds = self.speeds(plan, state)?;
            let NominalRun { question, ref course, found, .. } = plan.run;
            let family = Companions { all: &speeds, question, found }.speeds().family(course);
            Ok((draws.of(plan, &family), speeds.len()))
        })?;
        for (i, (own, count)) in missing.into_iter().zip(own) {
            samples[i] = Some(own);
            runs += count;
        }
        Ok((samples.into_iter().flatten().collect(), runs))
    }
}

impl PlanDraws<'_> {
    /// The samples of `plan` between it, the rail `alone` and the `others`; none where the life of
    /// the plan is not repeated between these, or its samples lead nowhere.
    fn between(&self, plan: &Followed, alone: GroundRun, others: &[GroundRun]) -> Option<PlanSamples> {
        let has_own = others.iter().any(|other| other.grinding == plan.grinding);
        let (alone, others) = (plan.course_of(alone), others.iter().map(|other| plan.course_of(*other)));
        let others: Vec<Course> = others.collect();
        let mut others: Vec<&Course> = others.iter().collect();
        let left_out = Family::of_grindings(&alone, &others);
        let life = plan.run.nominal.failure.mgt;
        let is_repeated = match (Nominal::mgt_at_speed(&left_out, 1.0, &plan.run.question), life) {
            (Some(found), Some(own)) => (found / own - 1.0).abs() <= LEFT_OUT,
            (found, own) => found == own,
        };
        others.push(&alone);
        let samples = is_repeated.then(|| self.of(plan, &Family::of_grindings(&plan.run.course, &others)));
        // Nothing tells of faster cracks of a plan that does not fail itself.
        let is_tested = |samples: &PlanSamples| has_own || life.is_some() || samples.fails == 0.0;
        samples.filter(|samples| samples.not_known <= NOT_KNOWN && is_tested(samples))
    }

    /// The samples of `plan` in `family`.
    fn of(&self, plan: &Followed, family: &Family) -> PlanSamples {
        let Self { scatter, draws, horizon: Mgt(horizon) } = self;
        let sampler = Sampler::of(Sampling::of_run(&plan.info, plan.run.question, family, scatter));
        let ends = sampler.each(draws, |sample, _| (sample.to_critical, sample.outlives));
        let share = |is_it: &dyn Fn(&(f64, f64)) -> bool| {
            ends.iter().filter(|end| is_it(end)).count() as f64 / ends.len() as f64
        };
        PlanSamples { fails: share(&|end| end.0 <= *horizon), not_known: share(&|end| end.1 < *horizon) }
    }
}

impl Followed {
    fn removal_rate(&self) -> f64 {
        self.run.question.removal.mean_rate()
    }

    fn as_run(&self) -> GroundRun<'_> {
        GroundRun { grinding: self.grinding, steps: &self.log.steps, speed: 1.0 }
    }

    /// The `run` of this plan at another speed.
    fn at_speed<'a>(&self, run: &'a Companion) -> Option<GroundRun<'a>> {
        Some(GroundRun { grinding: self.grinding, steps: &run.steps, speed: run.at_speed()? })
    }

    /// The course of `run`, of which is asked what is asked of this plan.
    fn course_of(&self, run: GroundRun) -> Course {
        let NominalRun { question, found, .. } = &self.run;
        let removal = question.at_speed(run.speed).removal.over_axles(question.tonnes);
        Course::of(run.steps, &removal, *found)
    }
}
