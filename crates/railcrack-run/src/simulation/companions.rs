//! The companions of a run: other runs of the same cracks that its decision needs.
//!
//! Of a long row they follow the cracks that decide, with the neighbours that shield them.

use super::drive::OfSteps;
use super::each::of_each;
use super::error::RunError;
use super::job::Stage;
use super::observer::{AskedAlone, RunObserver};
use super::residual_stress::carrying_rail;
use super::run::Simulation;
use super::variations::{variations, varied};
use crate::decision::{Companions, Course, NominalRun, Question, deciding, from_run};
use crate::log::{Companion, CompanionKind, RunInfo, RunLog, StepDigest, Variation};
use crate::numbers::short;
use crate::setup::{SharedRail, known_straight};
use railcrack::bulk::Boundary;
use railcrack::fatigue::DirectionCriterion;
use railcrack::growth::{GrowthState, SurfaceRemoval, Turning};
use railcrack::plane::KnownStraight;
use railcrack_case::{Case, Engine, Geometry, PlaneEngine, Scatter};
use std::path::Path;
use std::sync::Arc;

/// The largest deviation of the speed, over that of all samples together, at which cracks are
/// followed against the removal of the surface.
const FARTHEST: f64 = 2.2;
/// Distance of the logarithms of two speeds beyond which quantiles between them may be 1 % off; the
/// error grows with the square of it.
pub(super) const APART: f64 = 0.35;
/// Speeds on each side at first, and in all at most.
const FIRST_SPEEDS: usize = 2;
const MOST_SPEEDS: usize = 12;
/// Error of the life at a speed that is left out from which on the gaps beside it are halved: four
/// times that of the samples.
const LEFT_OUT: f64 = 0.02;
/// Runs at most between a speed at which the rail fails and one at which it does not, and the
/// distance, as a fraction of the largest deviation, at which these are near enough.
const MOST_BETWEEN: usize = 5;
const NEAR: f64 = 0.03;
/// The smallest deviation of the logarithm of the speed: nearer runs differ by no more than their
/// increments.
const LEAST_DEVIATION: f64 = 0.02;
/// Standard deviations of the toughness above its mean up to which samples do not break.
const TOUGHEST: f64 = 3.0;
/// Frictions between the faces that bracket what is measured on clean and on rough steel.
const FRICTIONS: [f64; 2] = [0.1, 0.5];
/// Depth over the critical one to which cracks at other speeds are followed.
const BEYOND_CRITICAL: f64 = 1.1;
/// Removal over the wear limit up to which cracks at other speeds are followed.
const BEYOND_LIMIT: f64 = 1.3;
/// Difference of the lives by both engines, relative to that of the run, up to which the
/// dislocations compute the companions.
const ENGINES_AGREE: f64 = 0.02;
/// Steps of a companion over those of the run: slower cracks and the limit path take more.
const MORE_STEPS: usize = 3;
/// Steps of the limit path at most.
const MOST_OF_LIMIT: usize = 300;
/// Steps of the limit path at most under wear or grinding: where they nearly keep up with growth it
/// would go on by hundreds of small kinks, each dearer than the one before.
const MOST_KINKS: usize = 75;

/// The run to which companions belong.
struct Beside<'a> {
    /// Its state after its last step.
    state: &'a GrowthState,
    /// Holds the plastic state of a rolled rail.
    folder: &'a Path,
    observer: &'a dyn RunObserver,
    /// The engine that computes the companions.
    engine: Engine,
    /// The crack as they know it together.
    known: Option<&'a Arc<KnownStraight>>,
    /// The rail with the plastic stress that it carries.
    rail: Option<&'a SharedRail>,
}

impl<'a> Beside<'a> {
    /// The start of a companion of `simulation` on a rail that is `shared`.
    fn stage(&self, simulation: &Simulation<'a>, shared: Option<&'a SharedRail>) -> Stage<'a> {
        // The plastic state that the run has computed is read back.
        let (folder, observer, state) = (self.folder, self.observer, Some(self.state.clone()));
        Stage { folder, observer, presentation: simulation.presentation, shared, state }
    }
}

impl Simulation<'_> {
    /// The companions of the run of `log`, which ended in `state`; `folder` holds the plastic state
    /// of a rolled rail. None where the decision needs none.
    ///
    /// Errors: an interruption. A companion that cannot be computed says why.
    pub(super) fn companions(
        &self,
        info: &RunInfo,
        log: &RunLog,
        state: &GrowthState,
        folder: &Path,
    ) -> Result<Option<Vec<Companion>>, RunError> {
        if self.kinds(info, log, self.case.engine()).is_empty() {
            return Ok(None);
        }
        let asked = AskedAlone(self.observer);
        let engine = self.case.engine();
        let rail = self.shared;
        let mut beside = Beside { state, folder, observer: &asked, engine, known: self.known, rail };
        beside.engine = self.quick_engine(info, log, &beside)?;
        let own = self.known_straight();
        beside.known = self.known.filter(|_| beside.engine == engine).or(own.as_ref());
        let kinds = self.kinds(info, log, beside.engine);
        let count = kinds.iter().filter(|kind| !is_the_run(self.case, **kind)).count();
        if count > 0 {
            let life = life_in_words(info, &log.steps).unwrap_or_default();
            self.observer.note(&format!("as computed: {life}; {count} or more runs for the decision follow"));
        }
        let part = if count > 0 { self.part_of_row(info, log, &beside)? } else { None };
        // Of a part of the cracks the mesh is another one.
        let carrying = match &part {
            None if count > 0 => carrying_rail(self.case, beside.engine, &beside.stage(self, self.shared))?,
            _ => None,
        };
        beside.rail = carrying.as_ref().or(self.shared);
        let of = |kind: &CompanionKind| match is_the_run(self.case, *kind) {
            true => Ok(Companion { kind: *kind, steps: log.steps.clone(), reason: None }),
            false => {
                let companion = match &part {
                    Some(part) => self.companion_of_part(*kind, part, &beside),
                    None => self.companion(*kind, None, &beside),
                }?;
                self.observer.stage(&result_of(info, &companion));
                Ok(companion)
            }
        };
        let computed = |kinds: &[CompanionKind]| of_each(kinds, beside.engine, of);
        let (first, others) = self.with_first_alone(&kinds, &beside);
        let mut all = computed(first)?;
        all.extend(computed(others)?);
        loop {
            let finer: Vec<CompanionKind> =
                self.finer(info, &all, log).into_iter().map(CompanionKind::Speed).collect();
            if finer.is_empty() {
                break;
            }
            all.extend(computed(&finer)?);
        }
        for _ in 0..MOST_BETWEEN {
            let Some(speed) = self.doubtful(info, &all, log) else { break };
            all.push(of(&CompanionKind::Speed(speed))?);
        }
        all.extend(part.map(|part| part.run));
        Ok(Some(all))
    }

    /// The first of `kinds` by itself where several share the crack, which then know what it has
    /// found; none otherwise. And the others.
    fn with_first_alone<'k>(
        &self,
        kinds: &'k [CompanionKind],
        beside: &Beside,
    ) -> (&'k [CompanionKind], &'k [CompanionKind]) {
        let sharing = kinds.iter().filter(|kind| kind.keeps_rail() && !is_the_run(self.case, **kind));
        let is_ahead = beside.known.is_some() && sharing.count() > 1;
        kinds.split_at(usize::from(is_ahead))
    }

    /// The first runs of all cracks at other speeds than that of the run of `log`, without those
    /// that their accuracy asks for.
    ///
    /// Errors: an interruption.
    pub(super) fn first_speeds(
        &self,
        info: &RunInfo,
        log: &RunLog,
        state: &GrowthState,
        folder: &Path,
    ) -> Result<Vec<Companion>, RunError> {
        let engine = self.case.engine();
        let (known, rail) = (self.known, self.shared);
        let beside = Beside { state, folder, observer: self.observer, engine, known, rail };
        let of = |kind: &CompanionKind| self.companion(*kind, None, &beside);
        of_each(&self.kinds(info, log, engine), engine, of)
    }

    /// The crack as runs of this rail can know it together; none where K depends on more than its
    /// length, or a judge decides on the rates.
    pub(super) fn known_straight(&self) -> Option<Arc<KnownStraight>> {
        known_straight(self.case).filter(|_| self.judge.is_none())
    }

    /// The engine that computes the companions: the dislocations where they repeat a run of finite
    /// elements, otherwise its own.
    ///
    /// Errors: an interruption.
    fn quick_engine(&self, info: &RunInfo, log: &RunLog, beside: &Beside) -> Result<Engine, RunError> {
        let own = self.case.engine();
        let is_half_plane = self.case.boundary() == Boundary::HalfPlane;
        if own != Engine::Plane(PlaneEngine::Xfem) || !is_half_plane {
            return Ok(own);
        }
        self.observer.stage("the run again with dislocations, for the runs that its decision needs");
        let quick = Beside { engine: Engine::Plane(PlaneEngine::Dislocation), ..*beside };
        let again = self.companion(CompanionKind::PartOfRow, None, &quick)?;
        let agrees = from_run(info, log, &again).is_some_and(|difference| difference <= ENGINES_AGREE);
        Ok(if agrees { quick.engine } else { own })
    }

    /// Speeds between which samples would be too far from whole runs; none where there are enough.
    fn finer(&self, info: &RunInfo, all: &[Companion], log: &RunLog) -> Vec<f64> {
        let run = Question::of(info).and_then(|question| NominalRun::of(&log.steps, question));
        let Some(NominalRun { course, question, found, .. }) = run else { return Vec::new() };
        let speeds = Companions { all, question, found }.speeds();
        let mut finer = speeds.finer(&course, &question, LEFT_OUT);
        let known = all.iter().filter(|companion| matches!(companion.kind, CompanionKind::Speed(_)));
        finer.truncate(MOST_SPEEDS.saturating_sub(known.count()));
        finer
    }

    /// A speed between two neighbours of which one fails and the other does not; none where these
    /// are close together.
    fn doubtful(&self, info: &RunInfo, all: &[Companion], log: &RunLog) -> Option<f64> {
        let question = Question::of(info).filter(|_| info.maintenance.is_some())?;
        let fails = |steps: &[StepDigest], speed: f64| {
            let run = NominalRun::of(steps, question.at_speed(speed));
            run.is_some_and(|run| run.nominal.failure.mode.is_some())
        };
        let of_speed = |companion: &Companion| {
            let speed = companion.at_speed()?;
            Some((speed, fails(&companion.steps, speed)))
        };
        let mut speeds: Vec<(f64, bool)> = all.iter().filter_map(of_speed).collect();
        if speeds.is_empty() {
            return None;
        }
        if !speeds.iter().any(|(speed, _)| *speed == 1.0) {
            speeds.push((1.0, fails(&log.steps, 1.0)));
        }
        speeds.sort_by(|a, b| a.0.total_cmp(&b.0));
        let widest = speeds.iter().map(|(speed, _)| speed.ln().abs()).fold(0.0, f64::max);
        let pair = speeds.windows(2).find(|pair| {
            let apart = (pair[1].0 / pair[0].0).ln();
            pair[0].1 != pair[1].1 && apart > NEAR * widest
        })?;
        Some((pair[0].0 * pair[1].0).sqrt())
    }

    fn kinds(&self, info: &RunInfo, log: &RunLog, engine: Engine) -> Vec<CompanionKind> {
        let case = self.case;
        let Some(NominalRun { course, nominal, .. }) =
            Question::of(info).and_then(|question| NominalRun::of(&log.steps, question))
        else {
            return Vec::new();
        };
        let mut kinds = Vec::new();
        if let Some(scatter) = info.scatter.as_ref().filter(|_| course.points.len() > 1) {
            let deviation = deviation(case, scatter, &course);
            let is_removed = info.maintenance.is_some_and(|removal| removal.mean_rate() > 0.0);
            if scatter.toughness_std > 0.0 && case.fracture.is_some() {
                kinds.push(CompanionKind::Speed(1.0));
            }
            if is_removed && deviation > 0.0 {
                let deviation = deviation.max(LEAST_DEVIATION);
                kinds.extend(speeds(deviation).into_iter().map(CompanionKind::Speed));
            }
        }
        if self.has_variants && course.points.len() > 1 {
            kinds.extend(variants(case, engine));
        } else if self.has_variants && nominal.failure.mode.is_some() {
            // A rail that fails at once may hold along another path.
            kinds.extend(variants(case, engine).into_iter().filter(CompanionKind::is_path));
        }
        kinds
    }

    /// The companion of `kind` `beside` the run; of the cracks `kept` (from 0) alone, where they
    /// are given.
    ///
    /// Errors: an interruption.
    fn companion(
        &self,
        kind: CompanionKind,
        kept: Option<&[usize]>,
        beside: &Beside,
    ) -> Result<Companion, RunError> {
        let changed = match kind {
            CompanionKind::Varied(variation) => varied(self.case, variation, beside.folder),
            _ => Some(case_of(self.case, kind)),
        };
        let Some(mut case) = changed else {
            let reason = Some("does not apply to this case".to_owned());
            return Ok(Companion { kind, steps: Vec::new(), reason });
        };
        let part = kept.and_then(|kept| case.with_cracks(kept));
        // A rail that is shared has the mesh of all cracks, as deep as they are.
        let is_deeper = matches!(kind, CompanionKind::Varied(Variation::Deeper(_)));
        let shared =
            if is_deeper { self.shared.filter(|rail| rail.carried().is_none()) } else { beside.rail };
        let shared = shared.filter(|_| part.is_none());
        case = part.unwrap_or(case);
        if let (Engine::Plane(engine), Geometry::Plane(plane)) = (beside.engine, &mut case.geometry) {
            plane.engine = engine;
        }
        let known = beside.known.filter(|_| kind.keeps_rail());
        let simulation = Simulation { case: &case, observer: beside.observer, shared, known, ..*self };
        let stage = beside.stage(self, shared);
        let mut log = RunLog::default();
        let margin = if matches!(kind, CompanionKind::Speed(_)) { BEYOND_CRITICAL } else { 1.0 };
        let critical = case.inspection.and_then(|inspection| inspection.critical_depth);
        match simulation.follow(&stage, &mut log, critical.map_or(f64::INFINITY, |depth| depth * margin)) {
            Err(error) if error.is_interruption() => Err(error),
            ended => {
                let reason = ended.err().map(|error| error.to_string());
                numbered_as_in_the_run(&mut log.steps, kept);
                Ok(Companion { kind, steps: log.steps, reason })
            }
        }
    }

    /// The run from its beginning into `log`, until a tip is `deepest` (mm) deep; the state after
    /// its last step.
    pub(super) fn follow(
        &self,
        stage: &Stage,
        log: &mut RunLog,
        deepest: f64,
    ) -> Result<GrowthState, RunError> {
        let mut growth = self.growth_from(stage, None)?;
        while let Some(record) = growth.next_step(&OfSteps(self.observer))? {
            let is_deep = record.tips.iter().any(|tip| tip.depth() >= deepest);
            log.add(&record, Vec::new());
            if is_deep {
                break;
            }
        }
        Ok(growth.state().clone())
    }
}

/// The companions of a crack of `case` that grows, by `engine`, except those at other speeds: other
/// paths, frictions between the faces and [`variations`]. A rail that holds in the run may fail in
/// one of these.
pub(crate) fn variants(case: &Case, engine: Engine) -> Vec<CompanionKind> {
    if case.inspection.is_none() || case.space().is_some() {
        return Vec::new();
    }
    let mut kinds = vec![CompanionKind::Straight];
    let is_limit = case.growth.criterion == DirectionCriterion::MaxRate
        && case.growth.turning == Turning::Over(0.0)
        && case.growth.straight_depth == 0.0;
    kinds.extend((!is_limit).then_some(CompanionKind::Limit));
    let one = case.crack_friction.first().copied();
    let is_one = case.crack_friction.iter().all(|friction| Some(*friction) == one);
    let varied = variations(case, engine);
    if is_one && (case.scatter.is_some() || !varied.is_empty()) {
        kinds.extend(FRICTIONS.map(CompanionKind::Friction));
    }
    kinds.extend(varied.into_iter().map(CompanionKind::Varied));
    kinds
}

/// The failure of the run of `steps`; none where the case asks for no decision.
fn life_in_words(info: &RunInfo, steps: &[StepDigest]) -> Option<String> {
    let failure = NominalRun::of(steps, Question::of(info)?)?.nominal.failure;
    Some(match (failure.mode, failure.mgt) {
        (Some(mode), Some(mgt)) => format!("{} after {} million gross tonnes", mode.words(), short(mgt)),
        _ => "no failure within the run".to_owned(),
    })
}

/// The result of `companion`: a life, except at other speeds, which serve the samples.
fn result_of(info: &RunInfo, companion: &Companion) -> String {
    let (quantity, setting) = companion.kind.in_words();
    let life = match companion.kind {
        CompanionKind::Speed(_) => None,
        _ => life_in_words(info, &companion.steps),
    };
    let ending = companion.reason.clone().or(life).map_or_else(String::new, |ending| format!(": {ending}"));
    format!("{quantity}, {setting}{ending}")
}

/// Whether the companion of `kind` is the run of `case` itself: cracks that grow straight ahead by
/// their criterion, or over an infinite length.
fn is_the_run(case: &Case, kind: CompanionKind) -> bool {
    kind == CompanionKind::Straight && case.growth.all_go_straight()
}

/// Speeds over that of the run at which cracks are followed for samples with this `deviation` of
/// the logarithm of the speed, the fastest first.
fn speeds(deviation: f64) -> Vec<f64> {
    let farthest = FARTHEST * deviation;
    let at = |i: usize| (farthest * i as f64 / FIRST_SPEEDS as f64).exp();
    (1..=FIRST_SPEEDS).rev().map(at).chain((1..=FIRST_SPEEDS).map(|i| at(i).recip())).collect()
}

/// The standard deviation of the logarithm of growth over removal in the samples of `scatter`.
fn deviation(case: &Case, scatter: &Scatter, course: &Course) -> f64 {
    let removal = case.maintenance.map_or(0.0, |removal| removal.mean_rate());
    let wear = if removal > 0.0 { scatter.wear_std / removal } else { 0.0 };
    let steeper = course
        .points
        .iter()
        .filter(|point| point.delta_keq > 0.0)
        .map(|point| (scatter.m_std * (point.delta_keq / 10.0).ln()).abs())
        .fold(0.0, f64::max);
    let shares = if case.is_mix() { scatter.share_log_std } else { 0.0 };
    [scatter.c_log_std, wear, steeper, shares].iter().map(|part| part * part).sum::<f64>().sqrt()
}

/// `case` as `kind` changes it.
fn case_of(case: &Case, kind: CompanionKind) -> Case {
    let mut case = case.clone();
    // A run that goes on until its answer is known has no more to go.
    if case.growth.answer.is_none() {
        case.growth.steps *= MORE_STEPS;
    }
    if kind == CompanionKind::Limit {
        case.growth.steps = case.growth.steps.min(MOST_OF_LIMIT);
    }
    let is_removed = case.maintenance.is_some_and(|removal| removal.mean_rate() > 0.0);
    if kind == CompanionKind::Limit && is_removed {
        case.growth.steps = case.growth.steps.min(MOST_KINKS);
    }
    match kind {
        CompanionKind::PartOfRow | CompanionKind::Varied(_) => {}
        CompanionKind::Straight => case.growth.turning = Turning::Over(f64::INFINITY),
        CompanionKind::Limit => {
            // By the criterion that follows the load at once: others have no limit to speak of.
            case.growth.criterion = DirectionCriterion::MaxRate;
            case.growth.turning = Turning::Over(0.0);
            case.growth.straight_depth = 0.0;
        }
        CompanionKind::Friction(friction) => {
            case.crack_friction.iter_mut().for_each(|of_crack| *of_crack = friction);
        }
        CompanionKind::Speed(speed) => {
            // Samples that wear faster still find a course at their wear limit.
            case.set_maintenance(case.maintenance.map(|removal| SurfaceRemoval {
                limit: removal.limit.map(|limit| limit * BEYOND_LIMIT),
                ..removal.outpaced(speed)
            }));
            // Courses at other speeds go on beyond the critical depth, for the samples between
            // them.
            case.growth.answer = None;
            case.growth.arrest_rate /= speed;
            case.growth.stop_after_cycles = case.growth.stop_after_cycles.map(|cycles| cycles * speed);
            let above = case.scatter.map_or(0.0, |scatter| TOUGHEST * scatter.toughness_std);
            case.growth.toughness =
                case.growth.toughness.map(|toughness| toughness + above * railcrack::math::MPA_SQRT_MM);
        }
    }
    case
}

/// Neighbours on each side of a crack that decides; more where the life with these differs by more
/// than [`LARGEST_DIFFERENCE`]. Cracks beyond the 4th neighbour change K by 1.4 %, beyond the 6th
/// by 0.4 %, and of that most is common to all runs.
const NEIGHBOURS: [usize; 2] = [3, 6];
/// Difference of the life of a run with these cracks alone, relative to the life of the run.
/// Samples are held to 2 % of whole runs.
const LARGEST_DIFFERENCE: f64 = 0.01;
/// All cracks are followed unless at most one in this many is enough.
const ONE_IN: usize = 2;

/// The cracks that companions follow.
struct RowPart {
    /// The cracks that decide and their neighbours, from 0.
    kept: Vec<usize>,
    /// The run with these cracks and their neighbours alone.
    run: Companion,
}

impl Simulation<'_> {
    /// The part of a long row that companions of the run of `log` follow; none where all cracks are
    /// followed, because there are few or because no part of them repeats the run.
    ///
    /// Errors: an interruption.
    fn part_of_row(
        &self,
        info: &RunInfo,
        log: &RunLog,
        beside: &Beside,
    ) -> Result<Option<RowPart>, RunError> {
        if self.case.space().is_some() {
            return Ok(None);
        }
        let deciding = deciding(info, log);
        for neighbours in NEIGHBOURS {
            let Some(kept) = self.kept(&deciding, neighbours) else { return Ok(None) };
            let run = self.companion(CompanionKind::PartOfRow, Some(&kept), beside)?;
            if from_run(info, log, &run).is_some_and(|difference| difference <= LARGEST_DIFFERENCE) {
                return Ok(Some(RowPart { kept, run }));
            }
        }
        Ok(None)
    }

    /// The companion of `kind` with the cracks of `part` alone. That with another friction between
    /// the faces has all cracks: friction changes how far they shield one another, and which leads.
    ///
    /// Errors: an interruption.
    fn companion_of_part(
        &self,
        kind: CompanionKind,
        part: &RowPart,
        beside: &Beside,
    ) -> Result<Companion, RunError> {
        // Without scatter, samples about a run that must not break are that run.
        let has_all = kind == CompanionKind::Speed(1.0) || matches!(kind, CompanionKind::Friction(_));
        self.companion(kind, (!has_all).then_some(&part.kept), beside)
    }

    /// The cracks (from 0) around those that are `deciding`; none where they are so many that all
    /// are followed.
    fn kept(&self, deciding: &[usize], neighbours: usize) -> Option<Vec<usize>> {
        let kept = self.case.cracks.around(deciding, neighbours);
        let is_part = !kept.is_empty() && ONE_IN * kept.len() <= self.case.cracks.cracks().len();
        is_part.then_some(kept)
    }
}

/// Gives the cracks of `steps`, which are those `kept` (from 0) of a row, their numbers in it.
fn numbered_as_in_the_run(steps: &mut [StepDigest], kept: Option<&[usize]>) {
    let Some(kept) = kept else { return };
    let renumber = |crack: &mut usize| *crack = kept.get(*crack).copied().unwrap_or(*crack);
    for step in steps {
        step.tips.iter_mut().for_each(|tip| renumber(&mut tip.tip.crack));
        step.pieces.iter_mut().for_each(|piece| renumber(&mut piece.crack));
        step.pop_in_test.iter_mut().for_each(|test| renumber(&mut test.crack));
    }
}
