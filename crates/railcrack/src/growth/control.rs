//! Control of the increments: their error, the location of events, and the turns of the limit path.

use super::turning::AFTER_KINK;
use super::{Advance, DeferredGrowth, EarlierStep, GrowthSettings, Jump, Mover, TipRecord, Turn};
use crate::fatigue::SECONDARY_DISTANCE;
use serde::{Deserialize, Serialize};

/// The course of a run, carried from step to step.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Course {
    /// The next increment of the fastest mover as a fraction of the length of its crack; `None`
    /// for that of the settings.
    pub share: Option<f64>,
    /// Estimated error of the cycles so far by the rates of the steps.
    pub cycles_error: f64,
    /// Estimated error of the direction of the leading tip so far, radians.
    pub turn_error: f64,
    /// Estimated error of the cycles so far by the direction.
    pub path_error: f64,
}

impl Course {
    /// The estimated error of `load_cycles`.
    #[must_use]
    pub fn error(&self) -> f64 {
        self.cycles_error + self.path_error
    }
}

/// An attempt at a step.
#[derive(Debug, Clone)]
pub(super) struct Trial {
    /// The cycles it may take.
    pub cycles_at_most: f64,
    /// The turns of tips of the limit path.
    pub turns: Vec<Turn>,
    /// Number of times that the step was cut.
    cuts: usize,
    /// The attempts at the turns of these tips.
    searches: Vec<Search>,
    /// Share at which the next step begins, where this one was cut before an event.
    then: Option<f64>,
}

impl Default for Trial {
    fn default() -> Self {
        Self { cycles_at_most: f64::INFINITY, turns: Vec::new(), cuts: 0, searches: Vec::new(), then: None }
    }
}

impl Trial {
    /// Whether it was cut to end just before an event.
    pub fn ends_at_event(&self) -> bool {
        self.then.is_some()
    }

    /// This attempt, cut to `cycles`.
    fn cut(&self, cycles: f64, then: Option<f64>) -> Self {
        Self { cycles_at_most: cycles, cuts: self.cuts + 1, then, ..Self::default() }
    }
}

/// The start or the end of a step, as far as the control depends on it.
pub(super) struct End<'a> {
    pub tips: &'a [TipRecord],
    pub movers: &'a [Mover],
    /// The largest k1 over the toughness.
    pub hazard: f64,
    pub load_cycles: f64,
}

/// The fate of an attempt.
#[derive(Debug, Clone)]
pub(super) enum Verdict {
    /// It stands, and the run goes on with this course.
    Accepted(Course),
    /// It is made again.
    Again(Trial),
}

/// Events are located until the step that contains them takes less than this fraction of all
/// cycles.
pub(crate) const LOCATED: f64 = 0.004;
/// A step is cut so often at most; what results then stands.
const MOST_CUTS: usize = 16;
/// Attempts at the turn of a step of the limit path; the last one stands.
pub(super) const MOST_TURNS: usize = 24;
/// Smallest and largest increment that the control chooses, as a fraction of the length.
const SHARES: (f64, f64) = (5e-4, 0.1);
/// Shares of the tolerance allowed for the error of one step, by its rates and by its turns,
/// relative to its own cycles.
const STEP_TOLERANCE: f64 = 0.6;
/// The same under wear and grinding: as [`OF_GIVEN_UNDER_WEAR`].
const STEP_TOLERANCE_UNDER_WEAR: f64 = 0.3;
/// Share of the tolerance that a step may always spend on the life without wear, however large its
/// error is relative to its own cycles: behind a kink, and where the rate or the best kink changes
/// abruptly.
const OF_LIFE: f64 = 0.05;
/// Growth, as a fraction of the length, whose cycles the life is taken to last at least.
const SOON: f64 = 0.1;
/// A step is at most so many times as long as the one before, and as one that was cut.
const MOST_LONGER: f64 = 3.5;
const LONGER_AFTER_CUT: f64 = 1.5;
/// Error from which a step of a given increment is cut.
const OF_GIVEN: f64 = 0.01;
/// The same under wear and grinding, where errors of single steps may decide on which side of a
/// grinding a size is reached.
const OF_GIVEN_UNDER_WEAR: f64 = 0.002;
/// Largest turn of a step, radians, and the turn that steps are chosen for: the engines take a
/// polyline of smaller turns for a smooth curve.
const LARGEST_TURN: f64 = 0.05;
const CHOSEN_TURN: f64 = 0.04;
/// Error of the trapezoidal rule over the second divided difference and the cube of the increment:
/// a sixth, with a margin for the next order.
const OF_RULE: f64 = 0.2;
/// Error of the turn of a step over its difference from the prediction: a sixth, with a margin.
const OF_TURN: f64 = 0.2;
/// Weight of the error of turns in the choice of increments: most of it is scatter of the best
/// kink, which does not add up.
const TURN_WEIGHT: f64 = 0.2;
/// The same for one step by itself: where the best kink changes abruptly within it, its turn is
/// wrong by up to half of the difference from the prediction, and near ties of directions need the
/// path.
const SUDDEN_TURN_WEIGHT: f64 = 2.0;
/// Tolerance of the life from which the errors of turns are no longer allowed more: the branch that
/// a path takes at a near tie depends on them.
const PATH_TOLERANCE: f64 = 0.01;
/// Growth over the increment of the step from which a part of it was deferred.
const DEFERRED: f64 = 1.2;
/// Relative change of a rate from which that is sudden: where a path turns smoothly, growth that
/// has been deferred changes it by 0.6 % at most, for which the next increments make up.
const SUDDEN: f64 = 0.02;
/// Relative change of the life per radian of direction that is allowed for at least: the rate
/// hardly depends on the direction of the tip, but on the depth to which it leads.
const LEAST_SENSITIVITY: f64 = 1.0;
/// Where growth and removal nearly balance, an error of the growth moves the life by as many times
/// more. Increments are chosen for this factor at most, so that their number stays bounded; the
/// estimated error knows no bound.
const MOST_LEVERAGE: f64 = 5.0;
/// Best kink (radians) that counts as zero on the limit path: the scatter of the best kink. A path
/// that drifts by a tenth of a degree in each increment has not arrived.
const ZERO_KINK: f64 = 0.02 * std::f64::consts::PI / 180.0;
/// Largest turn of a step of the limit path, radians: no kink of a tip is larger, whatever the mix
/// of modes, and a path that turned farther would run back along its own crack.
const LARGEST_BEND: f64 = 80.0 * std::f64::consts::PI / 180.0;
/// Largest change of the turn from one attempt to the next until its zero is enclosed, radians: the
/// search must not pass a direction in which the path would stay.
const LARGEST_STRIDE: f64 = 0.2;

/// Decides on attempts at steps.
pub(super) struct Control<'a> {
    pub settings: GrowthSettings,
    /// The course before the step.
    pub course: Course,
    /// The previous step.
    pub earlier: Option<EarlierStep>,
    pub advance: &'a Advance,
    pub before: End<'a>,
}

impl Control<'_> {
    /// The attempt to make instead of `trial` where that is too long by its turn or its kink,
    /// whatever it leads to.
    pub fn shortened(&self, trial: &Trial) -> Option<Trial> {
        let Self { settings, advance, .. } = self;
        // The limit path bends at once, however short the step.
        if settings.turning.is_kink() || settings.turning.is_limit() || trial.cuts >= MOST_CUTS {
            return None;
        }
        // The rates change abruptly at a kink: it is the start of a short step.
        if self.kinks() {
            let is_long = settings.tolerance.is_some() && advance.progress.share > 2.0 * AFTER_KINK;
            return is_long
                .then(|| trial.cut(AFTER_KINK / advance.progress.share * advance.progress.cycles, None));
        }
        let turn = self.largest_turn();
        let is_long = turn > LARGEST_TURN && self.moved() > 2.0 * SHARES.0 && advance.progress.cycles > 0.0;
        is_long.then(|| trial.cut((CHOSEN_TURN / turn).max(0.2) * advance.progress.cycles, None))
    }

    /// Whether a tip kinks at the start of the step.
    fn kinks(&self) -> bool {
        self.before.tips.iter().any(|tip| tip.plane().is_some_and(|plane| plane.jump.is_some()))
    }

    /// The largest smooth turn of a tip in the step, radians.
    fn largest_turn(&self) -> f64 {
        let planes = self.before.tips.iter().filter_map(TipRecord::plane);
        let smooth = planes.filter(|plane| plane.jump.is_none() && plane.is_drawn);
        smooth.map(|plane| plane.turn.abs()).fold(0.0, f64::max)
    }

    /// The verdict on the attempt `trial`, which leads to `after`.
    pub fn judge(&self, after: &End<'_>, trial: &Trial) -> Verdict {
        let Self { settings, before, advance, .. } = self;
        if settings.turning.is_kink() {
            return self.accepted(after, trial);
        }
        if settings.turning.is_limit()
            && let Some(again) = self.turned_again(after, trial)
        {
            return Verdict::Again(again);
        }
        if trial.cuts >= MOST_CUTS {
            return self.accepted(after, trial);
        }
        let passed = after.load_cycles - before.load_cycles;
        let cut =
            |part: f64, then: Option<f64>| Verdict::Again(trial.cut(part * advance.progress.cycles, then));
        // A long increment may only hide the curve of a path without a corner.
        if settings.turning.is_limit() && self.kinks() && advance.progress.share > 2.0 * AFTER_KINK {
            return cut((AFTER_KINK / advance.progress.share).max(0.25), None);
        }
        let room = LOCATED * after.load_cycles / passed;
        if room < 1.0 && advance.progress.share > SHARES.0 {
            let breaks = before.hazard < 1.0 && after.hazard >= 1.0;
            let by_hazard = (1.0 - before.hazard) / (after.hazard - before.hazard);
            let by_hazard = if by_hazard.is_finite() { by_hazard } else { 0.5 };
            if let Some(crossing) = if breaks { Some(by_hazard) } else { self.tied_at(after) } {
                // The step ends just before the event, or contains it and is short enough.
                if crossing < 0.5 * room {
                    return cut(crossing + 0.4 * room, None);
                }
                let part = (crossing - 0.4 * room).min(0.9);
                let left = (crossing - part) + 0.5 * room;
                return cut(part, Some(left * advance.progress.share));
            }
            if self.has_kinked(after) || self.has_arrested(after) {
                return cut(0.5, Some(0.5 * advance.progress.share));
            }
        }
        let error = self.step_error(after);
        let (moved, least) = self.divisible(after);
        if moved > least && passed > 0.0 {
            // The limit path is cut by its bends.
            let is_strict = settings.maintained().is_some() && !settings.turning.is_limit();
            let given = if is_strict { OF_GIVEN_UNDER_WEAR } else { OF_GIVEN };
            let excess = match settings.tolerance {
                Some(tolerance) => {
                    let relative = error.relative() / (2.0 * self.step_tolerance());
                    self.leverage() * relative.min(error.of_life / OF_LIFE) / tolerance
                }
                None => self.leverage() * error.relative() / given,
            };
            if excess > 1.0 {
                return cut((0.6 * excess.powf(-0.5)).clamp(0.2, 0.7).max(self.waiting_part(after)), None);
            }
        }
        self.accepted(after, trial)
    }

    fn accepted(&self, after: &End<'_>, trial: &Trial) -> Verdict {
        let error = self.step_error(after);
        let passed = after.load_cycles - self.before.load_cycles;
        let course = self.course;
        let turn_error = course.turn_error + error.turn;
        let leverage = self.leverage_of_balance();
        let next = Course {
            share: self.next_share(&error, trial),
            // A step is not known to be wrong by more than its own cycles.
            cycles_error: course.cycles_error
                + (leverage * error.rate).min(1.0) * passed
                + self.error_of_deferral(after),
            turn_error,
            path_error: course.path_error + (leverage * error.sensitivity * turn_error).min(1.0) * passed,
        };
        Verdict::Accepted(next)
    }

    /// The increment of the next step where the control chooses it.
    fn next_share(&self, error: &StepError, trial: &Trial) -> Option<f64> {
        let Self { advance, settings, .. } = self;
        let last = self.course.share.unwrap_or(settings.increment);
        let Some(tolerance) = settings.tolerance else {
            // Behind a bend a long increment would pass over the directions that follow.
            let made = if advance.progress.share > 0.0 { advance.progress.share } else { 0.5 * last };
            return settings.turning.is_limit().then(|| (2.0 * made).min(settings.increment));
        };
        if let Some(then) = trial.then {
            return Some(then.clamp(SHARES.0, last));
        }
        if self.kinks() {
            return Some(2.0 * AFTER_KINK);
        }
        // A step of no or few cycles, at a grinding or a limit, says nothing about the next one.
        if advance.progress.share <= 0.0 {
            return Some(last);
        }
        // The relative error of a step is of second order in its length, that of the life of third.
        let relative = self.leverage() * error.relative() / (self.step_tolerance() * tolerance);
        let of_life = self.leverage() * error.of_life / (0.5 * OF_LIFE * tolerance);
        let factor = relative.max(1e-6).powf(-0.5).max(of_life.max(1e-6).powf(-1.0 / 3.0));
        let factor = (0.85 * factor).clamp(0.4, MOST_LONGER);
        let moved = self.moved();
        let by_turn = CHOSEN_TURN * moved / self.largest_turn().max(1e-9);
        // What a step was cut for usually lies just behind it.
        let longer = if trial.cuts > 0 { LONGER_AFTER_CUT * moved } else { f64::INFINITY };
        let by_error = (factor * moved.max(0.5 * last)).min(longer);
        Some(by_error.min(by_turn).clamp(SHARES.0, SHARES.1))
    }

    fn step_tolerance(&self) -> f64 {
        let is_maintained = self.settings.maintained().is_some();
        if is_maintained { STEP_TOLERANCE_UNDER_WEAR } else { STEP_TOLERANCE }
    }

    /// The change of a crack in the step as a fraction of its length: the growth of its tip, or the
    /// loss at its mouth where that is more.
    fn moved(&self) -> f64 {
        self.advance.progress.share.max(self.lost())
    }

    /// The loss of a crack at its mouth as a fraction of its length, at most an increment.
    fn lost(&self) -> f64 {
        let Self { before, advance, settings, .. } = self;
        let lost = before
            .tips
            .iter()
            .filter_map(|tip| Some(advance.progress.removal / (tip.mouth_sine? * tip.length)));
        let last = self.course.share.unwrap_or(settings.increment);
        lost.fold(0.0, f64::max).min(last)
    }

    /// The change of a crack in the step as a fraction of its length, and that from which on
    /// shorter steps have a smaller error.
    ///
    /// Where the surface is removed, steps may be shorter than the growth from which a slow tip is
    /// drawn. The rates change at once where it is drawn, by as much in a short step as in a longer
    /// one. In steps of twice that growth, tips of half the pace are drawn every time.
    fn divisible(&self, after: &End<'_>) -> (f64, f64) {
        let least = 2.0 * SHARES.0;
        let waits =
            |start: &TipRecord| start.increment > 0.0 && start.plane().is_some_and(|own| !own.is_drawn);
        let some_wait = |start: &TipRecord| waits(start) || self.deferred(start, after).is_some();
        if self.settings.maintained().is_none() || !self.before.tips.iter().any(some_wait) {
            return (self.moved(), least);
        }
        let cycles = self.advance.progress.cycles;
        let grown = leading(self.before.movers).map_or(0.0, |leader| cycles * leader.rate / leader.length);
        let last = self.course.share.unwrap_or(self.settings.increment);
        let drawn = last.min(DeferredGrowth::LEAST_SMOOTH).max(DeferredGrowth::LEAST_DRAWN * last);
        (grown.max(self.lost()), least.max(2.0 * drawn))
    }

    /// The part of the step below which it is not cut for an error that it keeps.
    fn waiting_part(&self, after: &End<'_>) -> f64 {
        let (moved, least) = self.divisible(after);
        if least > 2.0 * SHARES.0 { least / moved } else { 0.0 }
    }

    /// The growth (mm) from earlier steps that this one draws at the tip `start`, if any.
    fn deferred(&self, start: &TipRecord, after: &End<'_>) -> Option<f64> {
        let end = after.tips.iter().find(|end| end.tip == start.tip)?;
        let drawn = (end.x - start.x).hypot(end.y - self.advance.progress.removal - start.y);
        let is_drawn = start.plane()?.is_drawn && drawn > DEFERRED * start.increment;
        is_drawn.then_some(drawn - start.increment)
    }

    /// The relative change of the life over that of the growth of the leading mover, as far as
    /// increments are chosen by it.
    fn leverage(&self) -> f64 {
        self.leverage_of_balance().min(MOST_LEVERAGE)
    }

    /// The relative change of the life over that of the growth of the leading mover: growth over
    /// growth less removal. An error of the growth, once made, stays the same number of cycles.
    fn leverage_of_balance(&self) -> f64 {
        let Some(removal) = self.settings.maintained() else { return 1.0 };
        let Some(leader) = leading(self.before.movers).filter(|leader| leader.rate > 0.0) else { return 1.0 };
        let own = |tip: &&TipRecord| (tip.tip.crack, tip.tip.tip) == (leader.crack, leader.index);
        let Some(sine) = self.before.tips.iter().find(own).and_then(|tip| tip.mouth_sine) else { return 1.0 };
        let net = (leader.rate - removal.mean_rate() / sine).abs();
        leader.rate / net.max(f64::MIN_POSITIVE)
    }

    /// The estimated error of a step, of its leading mover.
    fn step_error(&self, after: &End<'_>) -> StepError {
        let Self { before, advance, .. } = self;
        let mut error = StepError::default();
        let Some(earlier) = &advance.progress.earlier else { return error };
        let passed = after.load_cycles - before.load_cycles;
        let Some(leader) = leading(before.movers) else { return error };
        let Some(now) = after.movers.iter().find(|mover| mover.is(leader)) else { return error };
        if passed <= 0.0 || now.rate <= 0.0 || now.rate.is_nan() || !earlier.is_smooth {
            return error;
        }
        error.rate = match self.curvature_of_inverse(leader, now, advance, passed) {
            Some(curvature) => {
                let growth = passed * 0.5 * (leader.rate + now.rate);
                OF_RULE * growth.powi(3) * curvature.abs() / passed
            }
            // The difference from the prediction by one rate is of second order.
            None => (advance.progress.cycles / passed - 1.0).powi(2) / 3.0,
        };
        let tips = before.tips.iter().filter_map(|tip| {
            let end = after.tips.iter().find(|end| end.tip == tip.tip)?;
            Some((tip, end, tip.plane()?, end.plane()?))
        });
        for (tip, end, start_plane, end_plane) in tips {
            if start_plane.jump.is_some() || (tip.tip.crack, tip.tip.tip) != (leader.crack, leader.index) {
                continue;
            }
            let curvature = |tip: &TipRecord| self.settings.turning.curvature(tip.kink.unwrap_or(0.0));
            if self.settings.turning.is_limit()
                || self.settings.goes_straight(tip)
                || end_plane.jump.is_some()
            {
                continue;
            }
            let turned = 0.5 * tip.increment * (curvature(tip) + curvature(end));
            error.turn = (turned - start_plane.predicted_turn).abs() * OF_TURN;
            error.sensitivity = end_plane.sensitivity.max(LEAST_SENSITIVITY);
            error.length_over_increment = tip.length / tip.increment.max(1e-12);
        }
        error.strictness = (self.settings.tolerance.unwrap_or(0.0) / PATH_TOLERANCE).max(1.0);
        let life = after.load_cycles.max(SOON * now.length / now.rate);
        error.of_life = (error.rate * passed / life).max(SUDDEN_TURN_WEIGHT * error.turn * error.sensitivity);
        error
    }

    /// The estimated error of the cycles by kinks of slower tips that this step draws.
    ///
    /// Until a kink is drawn, its tip grows at the rate that it had before. With the rate r₁ behind
    /// it instead of r₀, the N cycles of the deferred growth would have been N r₀/r₁. Of tips that
    /// stay slower than the leading one, this counts by the ratio of their paces.
    fn error_of_deferral(&self, after: &End<'_>) -> f64 {
        let Some(leader) = leading(after.movers).filter(|leader| leader.rate > 0.0) else { return 0.0 };
        if self.settings.turning.is_kink() {
            return 0.0;
        }
        let of_tip = |start: &TipRecord| {
            let end = after.tips.iter().find(|end| end.tip == start.tip)?;
            let grows = start.rate > 0.0 && end.rate > 0.0;
            let cycles = (self.deferred(start, after)? / start.rate).min(self.before.load_cycles);
            let change = 1.0 - (start.rate / end.rate).min(end.rate / start.rate);
            let pace = (end.rate * leader.length / (end.length * leader.rate)).min(1.0);
            (grows && change > SUDDEN).then_some(pace * change * cycles)
        };
        self.before.tips.iter().filter_map(of_tip).sum()
    }

    /// The second divided difference of 1/(da/dN) of the leading mover over its growth, from the
    /// starts of the previous step and of this one and from the end of it; `None` where the rates
    /// of the previous step do not continue.
    fn curvature_of_inverse(
        &self,
        start: &Mover,
        end: &Mover,
        advance: &Advance,
        passed: f64,
    ) -> Option<f64> {
        let earlier = self.earlier.as_ref().filter(|earlier| earlier.is_smooth)?;
        let this = advance.progress.earlier.as_ref().filter(|this| this.is_extrapolated)?;
        let first = earlier.movers.iter().find(|mover| mover.is(start) && mover.rate > 0.0)?;
        let before = earlier.growth_of(start).filter(|growth| *growth > 0.0)?;
        let growth = this.growth_of(start).filter(|_| passed > 0.0 && start.rate > 0.0)?;
        let slope = |one: &Mover, other: &Mover, growth: f64| (1.0 / other.rate - 1.0 / one.rate) / growth;
        Some((slope(start, end, growth) - slope(first, start, before)) / (before + growth))
    }

    /// Whether a tip that turned so far has to kink at the end of the step. A tip whose growth is
    /// not drawn has the direction of an earlier place, which no shorter step changes.
    fn has_kinked(&self, after: &End<'_>) -> bool {
        let jump = |tip: &TipRecord| tip.plane().and_then(|plane| plane.jump);
        let turned =
            |start: &TipRecord| start.plane().is_some_and(|plane| plane.jump.is_none() && plane.is_drawn);
        let starts = |tip: &TipRecord| {
            matches!(jump(tip), Some(Jump::Kink | Jump::Rival))
                && self.before.tips.iter().any(|start| start.tip == tip.tip && turned(start))
        };
        after.tips.iter().any(starts)
    }

    /// The part of the step after which a tip that turned so far has to kink, where that follows
    /// from the direction that it leaves and the one that it takes: their rates are equal there.
    fn tied_at(&self, after: &End<'_>) -> Option<f64> {
        let at = |start: &TipRecord| {
            let end = after.tips.iter().find(|end| end.tip == start.tip)?;
            let (before, now) = (start.plane()?, end.plane()?);
            let turned = before.jump.is_none() && before.is_drawn;
            let jumps = turned && matches!(now.jump, Some(Jump::Kink | Jump::Rival));
            let rises = -before.secondary_ratio?.ln();
            let falls = -now.secondary_ratio?.ln();
            let near = |one: f64, other: f64| (one - other).abs() < 0.5 * SECONDARY_DISTANCE;
            let is_tie = near(before.secondary?, end.kink?) && near(now.secondary?, start.kink?);
            (jumps && is_tie && rises + falls > 0.0).then(|| rises / (rises + falls))
        };
        self.before.tips.iter().filter_map(at).reduce(f64::min)
    }

    /// Whether a mover that grew at the start of the step is arrested at its end.
    fn has_arrested(&self, after: &End<'_>) -> bool {
        let least = self.settings.arrest_rate;
        let grows = |mover: &Mover| mover.rate > 0.0 && mover.rate >= least;
        let arrested = |start: &&Mover| after.movers.iter().any(|end| end.is(start) && !grows(end));
        // Slow tips may come to rest at any time without an effect on the life.
        let fastest = leading(self.before.movers).map_or(0.0, |leader| leader.rate);
        let some = |start: &Mover| grows(start) && start.rate > 0.01 * fastest;
        self.before.movers.iter().filter(|start| some(start)).any(|start| arrested(&start))
    }

    /// The limit path: the next attempt at the turns, if the best kinks at the new tips are not
    /// zero yet.
    fn turned_again(&self, after: &End<'_>, trial: &Trial) -> Option<Trial> {
        // A tip whose growth is deferred in this attempt may be drawn in the next: its search goes
        // on, or attempts that differ in what they draw would follow one another for ever.
        let mut searches = trial.searches.clone();
        let mut is_done = true;
        for start in self.before.tips {
            let drawn = start.increment > 0.0 && start.plane().is_some_and(|plane| plane.is_drawn);
            let end = after.tips.iter().find(|end| end.tip == start.tip).filter(|_| drawn);
            let Some((end, plane)) = end.zip(start.plane()) else { continue };
            let key = (start.tip.crack, start.tip.tip);
            let known = searches.iter().position(|search| search.key == key);
            let place = known.unwrap_or_else(|| {
                searches.push(Search::new(key));
                searches.len() - 1
            });
            let search = &mut searches[place];
            search.add(plane.turn, end.kink.unwrap_or(0.0));
            is_done &= search.is_found;
        }
        if is_done {
            return None;
        }
        let turns = searches
            .iter()
            .map(|search| {
                let angle = if search.is_found { search.last.0 } else { search.next() };
                Turn { crack: search.key.0, tip: search.key.1, angle }
            })
            .collect();
        Some(Trial { turns, searches, ..trial.clone() })
    }
}

/// The fastest of `movers`.
fn leading(movers: &[Mover]) -> Option<&Mover> {
    movers.iter().max_by(|a, b| {
        (a.rate, a.length).partial_cmp(&(b.rate, b.length)).unwrap_or(std::cmp::Ordering::Equal)
    })
}

/// The estimated error of a step.
#[derive(Debug, Clone, Copy, Default)]
struct StepError {
    /// Of the cycles, relative to those of the step.
    rate: f64,
    /// Of the direction of the leading tip, radians.
    turn: f64,
    /// Relative change of the rate per radian of direction.
    sensitivity: f64,
    /// The length of its crack over its increment.
    length_over_increment: f64,
    /// Weight of the error of the turn in the control, besides those of its kind.
    strictness: f64,
    /// Of the life, relative, if the other steps have none; infinite under wear and grinding.
    of_life: f64,
}

impl StepError {
    /// The error of the life if all steps were like this one, relative. An error of the direction
    /// stays: it counts over the growth by the length of the crack.
    fn relative(&self) -> f64 {
        let turned = self.turn * self.sensitivity * self.length_over_increment;
        self.rate.max(TURN_WEIGHT * self.strictness * turned)
    }
}

/// The search for the turn after which the best kink is zero.
///
/// It follows the path that turns ever faster: from the first attempt in the direction of the best
/// kink, until that changes its sign. A zero from which the best kinks lead away is thus never
/// found, although the secants would converge to it.
#[derive(Debug, Clone)]
struct Search {
    /// Crack and tip.
    key: (usize, usize),
    /// Number of turns tried.
    tried: usize,
    /// Turns with the best kinks after them: the last one, and one on each side of the zero.
    last: (f64, f64),
    low: Option<(f64, f64)>,
    high: Option<(f64, f64)>,
    /// The last change of the turn.
    stride: f64,
    /// Whether the search ends with the last one.
    is_found: bool,
}

impl Search {
    fn new(key: (usize, usize)) -> Self {
        Self { key, tried: 0, last: (0.0, 0.0), low: None, high: None, stride: 0.0, is_found: false }
    }

    /// Adds a turn with the best kink after it. The search ends with it where that kink is zero,
    /// the turn is enclosed as well, or the path can turn no farther.
    fn add(&mut self, turn: f64, kink: f64) {
        let is_confined = self.tried > 0 && turn == self.last.0;
        self.stride = if self.tried > 0 { turn - self.last.0 } else { 0.0 };
        self.last = (turn, kink);
        self.tried += 1;
        if kink > 0.0 {
            self.low = Some((turn, kink));
        } else {
            self.high = Some((turn, kink));
        }
        let is_known =
            matches!((self.low, self.high), (Some(low), Some(high)) if (low.0 - high.0).abs() < ZERO_KINK);
        let is_largest = turn.abs() >= LARGEST_BEND && turn * kink >= 0.0;
        self.is_found =
            kink.abs() <= ZERO_KINK || is_known || is_largest || is_confined || self.tried >= MOST_TURNS;
    }

    /// The next turn to try. The best kink of a closed tip hardly changes with the direction until
    /// it changes its sign, so that strides towards it double.
    fn next(&self) -> f64 {
        match (self.low, self.high) {
            (Some(low), Some(high)) => {
                let secant = low.0 + (high.0 - low.0) * low.1 / (low.1 - high.1);
                let width = high.0 - low.0;
                let (near, far) = (low.0 + 0.1 * width, high.0 - 0.1 * width);
                secant.clamp(near.min(far), near.max(far))
            }
            _ => {
                let (turn, kink) = self.last;
                let stride = (2.0 * self.stride.abs()).clamp(2.0 * ZERO_KINK, LARGEST_STRIDE);
                (turn + stride.max(kink.abs()).copysign(kink)).clamp(-LARGEST_BEND, LARGEST_BEND)
            }
        }
    }
}
