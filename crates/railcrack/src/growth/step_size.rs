//! The pace of a step: the cycles until the next one, with the growth and surface removal during
//! them.

use super::control::LOCATED;
use super::history::History;
use super::{
    Axles, DeferredGrowth, EarlierStep, GrowthSettings, Interval, Mover, StepProgress, StepStart,
    SurfaceRemoval,
};

/// The pace of a step. It is set by the fastest-growing mover, or by the removal of the surface
/// where that takes more of a crack.
#[derive(Debug, Clone)]
pub(crate) struct StepSize {
    history: History,
    /// The mover whose rate determines the cycles; `None` where nothing grows.
    mover: Option<Mover>,
    /// The increment of that mover, mm, and its growth during the step.
    increment: f64,
    growth: f64,
    /// The cycles of that increment at the rate at the start.
    cycles_at_start: f64,
    /// The increment divided by the length of its crack.
    pub share: f64,
    /// Cycles to the next step, as predicted.
    pub cycles: f64,
    /// Depth removed from the surface, mm.
    pub removal: f64,
    /// Whether the step is a grinding, which takes no cycles.
    pub grinds: bool,
    /// Whether the increments follow from the cycles, which are final, instead of the cycles from
    /// an increment.
    is_timed: bool,
    /// Whether an event leaves less than half of what the step would be.
    is_cut: bool,
}

/// A crack that is shortened as the surface is removed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WearingCrack {
    /// Sine of its angle at the mouth; 1 for a buried crack.
    pub mouth_sine: f64,
    /// The greatest length it has had, mm.
    pub longest: f64,
}

/// The movers of a step and the cracks subject to wear.
pub(crate) struct Moving<'a> {
    /// All movers of cracks, including those that have stopped.
    pub all: &'a [Mover],
    /// Those that grow.
    pub growing: &'a [Mover],
    /// Whether any of them has not stopped, even if none grows now.
    pub some_are_left: bool,
    /// The cracks that are not worn away completely.
    pub wearing: &'a [WearingCrack],
}

/// Cycles before a grinding, relative to its interval, that are attributed to rounding.
const DUE: f64 = 1e-9;

impl StepSize {
    /// The pace of `moving`. It is shortened to the fraction `part` of the full step, so that the
    /// step ends at an event.
    pub fn of(moving: &Moving<'_>, at: &StepStart<'_>, settings: &GrowthSettings, part: f64) -> Self {
        // Of equally fast movers, the one of the longest crack is taken, so that their order does
        // not matter.
        let faster = |a: &Mover, b: &Mover| (b.rate, b.length) > (a.rate, a.length);
        let fastest = moving.growing.iter().copied().reduce(|a, b| if faster(&a, &b) { b } else { a });
        let history = History::of(at, moving.all, settings);
        let left = (settings.stop_after_cycles.unwrap_or(f64::INFINITY) - at.load_cycles).max(0.0);
        let left = left.min(at.cycles_at_most);
        let maintenance = settings.maintained();
        if let Some(maintenance) = maintenance
            && let Some(depth) = maintenance.grinding_due(at)
        {
            return Self { removal: depth, grinds: true, mover: fastest, ..Self::none(history) };
        }
        let mut pace = match fastest {
            Some(fastest) => Self::of_growth(history, fastest, at.share, part),
            None => Self { cycles: f64::INFINITY, ..Self::none(history) },
        };
        let until_event = maintenance.map_or(left, |own| left.min(own.until_event(at)));
        let limit = match maintenance {
            Some(_) if !moving.some_are_left => 0.0,
            Some(maintenance) => left.min(maintenance.cycles_at_most(moving.wearing, at)),
            None => left,
        };
        if pace.cycles > limit {
            // Where nothing grows, any mover serves to carry the cycles.
            let mover = fastest.or_else(|| moving.all.first().copied());
            let cycles = if limit < f64::INFINITY { part * limit } else { 0.0 };
            let share = fastest.map_or(0.0, |mover| cycles * mover.rate / mover.length);
            // Growth that is much slower than the removal of the surface is drawn in larger steps.
            let least = if maintenance.is_some() { DeferredGrowth::LEAST_DRAWN * at.share } else { 0.0 };
            let is_cut = cycles < CUT * pace.cycles && limit >= until_event;
            pace = Self {
                mover,
                cycles,
                is_timed: true,
                is_cut,
                share: share.max(least).min(at.share),
                ..Self::none(pace.history)
            };
        }
        if let Some(maintenance) = maintenance {
            pace.removal = maintenance.removal_over(pace.cycles, at);
        }
        pace
    }

    /// Nothing grows and nothing is removed.
    fn none(history: History) -> Self {
        Self {
            history,
            mover: None,
            increment: 0.0,
            growth: 0.0,
            cycles_at_start: 0.0,
            share: 0.0,
            cycles: 0.0,
            removal: 0.0,
            grinds: false,
            is_timed: false,
            is_cut: false,
        }
    }

    /// The pace at which `fastest` grows by `share` of the length of its crack.
    fn of_growth(history: History, fastest: Mover, share: f64, part: f64) -> Self {
        let increment = part * share * fastest.length;
        // The growth during this step: the increment also makes up what earlier ones lack.
        let growth = (increment - history.owed(&fastest)).max(0.1 * increment);
        let cycles_at_start = growth / fastest.rate;
        let cycles = growth / history.mean_rate(&fastest, cycles_at_start);
        Self {
            mover: Some(fastest),
            increment,
            growth,
            cycles_at_start,
            cycles,
            share: part * share,
            is_cut: part < CUT,
            ..Self::none(history)
        }
    }

    /// Cycles, growth and removal of this step. `all` are the movers of all cracks; `is_kinked`
    /// says of a mover whether it kinks, and the rates at the start continue where none does.
    pub fn progress(&self, all: &[Mover], is_kinked: impl Fn(&Mover) -> bool) -> StepProgress {
        let is_smooth = !all.iter().any(&is_kinked);
        StepProgress {
            cycles: self.cycles,
            share: self.share,
            earlier: Some(self.as_earlier(all, is_smooth)),
            interval: self.interval(is_kinked),
            removal: self.removal,
            ground: self.grinds,
            is_cut: self.grinds || self.is_cut,
        }
    }

    /// The increment whose end rate determines the cycles; `None` where no cycles pass. `is_kinked`
    /// says of a mover whether it kinks.
    pub fn interval(&self, is_kinked: impl Fn(&Mover) -> bool) -> Option<Interval> {
        let Self { is_timed, cycles, cycles_at_start, .. } = *self;
        let cycles = if is_timed { cycles } else { cycles_at_start };
        let mover = self.mover.filter(|_| !self.grinds)?;
        Some(Interval { mover, cycles, is_settled: is_timed, is_kinked: is_kinked(&mover) })
    }

    /// The increment (mm) of a mover.
    pub fn increment(&self, mover: &Mover) -> f64 {
        if self.grinds {
            return 0.0;
        }
        match &self.mover {
            Some(fastest) if !self.is_timed && self.history.are_alike(mover, fastest) => self.increment,
            Some(fastest) if !self.is_timed && !self.history.is_second_order() => {
                self.increment * (mover.rate / fastest.rate)
            }
            _ => (self.predicted(mover) + self.history.owed(mover)).max(0.0),
        }
    }

    /// The growth (mm) of a mover during the step, as predicted.
    fn predicted(&self, mover: &Mover) -> f64 {
        self.cycles * self.history.mean_rate(mover, self.cycles)
    }

    /// This step as the next one sees it, of the movers `all`. `is_smooth` where the rates at its
    /// start continue during it.
    fn as_earlier(&self, all: &[Mover], is_smooth: bool) -> EarlierStep {
        let balance = |mover: &Mover| self.history.owed(mover) - self.increment(mover);
        EarlierStep {
            movers: all.to_vec(),
            balance: all.iter().map(balance).collect(),
            growth: all.iter().map(|mover| self.predicted(mover)).collect(),
            cycles: self.cycles,
            leader: self.mover.filter(|_| !self.is_timed && !self.grinds).map(|mover| (mover, self.growth)),
            is_extrapolated: self.mover.is_some_and(|mover| self.history.extrapolates(&mover)),
            is_smooth: is_smooth && !self.grinds,
        }
    }
}

/// A step that an event leaves less than this part of is one that was cut.
const CUT: f64 = 0.5;
/// A step is not shortened to less than this part for events.
pub(crate) const LEAST_PART: f64 = 1e-9;
/// Relative difference of a shortened step from the event at which it ends.
const AT_EVENT: f64 = 1e-9;

/// An event during a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Event {
    /// The part of the step after which it occurs.
    pub part: f64,
    /// Whether the run may end with it, so that its cycles are those of the end.
    pub ends_run: bool,
}

impl Event {
    /// The first of `events` before the end of the step.
    pub fn first(events: Vec<Self>) -> Option<Self> {
        let during = |event: &Self| event.part < 1.0 - AT_EVENT && event.part.is_finite();
        events.into_iter().filter(during).reduce(|a, b| if b.part < a.part { b } else { a })
    }
}

/// Whether a step of `pace` is shortened to end at `event`: where the run ends with it or enough
/// cycles would pass after it.
pub(crate) fn is_worth_a_step(
    event: Event,
    pace: &StepSize,
    at: &StepStart<'_>,
    settings: &GrowthSettings,
) -> bool {
    let after = (1.0 - event.part) * pace.cycles;
    !settings.turning.is_kink()
        && event.part > AT_EVENT
        && (event.ends_run || after > LOCATED * (at.load_cycles + pace.cycles))
}

impl SurfaceRemoval<Axles> {
    /// Depth (mm) of the grinding that is due at `at`, if one is.
    fn grinding_due(&self, at: &StepStart<'_>) -> Option<f64> {
        let grinding = self.grinding?;
        let due = grinding.at(at.worn.grindings).0 - at.load_cycles <= DUE * grinding.interval.0;
        due.then_some(grinding.depth)
    }

    /// The cycles after which some crack has lost a full increment at its mouth, the surface is
    /// ground, or the wear limit is reached.
    fn cycles_at_most(&self, wearing: &[WearingCrack], at: &StepStart<'_>) -> f64 {
        let by_wear = |crack: &WearingCrack| at.share * crack.longest * crack.mouth_sine / self.wear;
        let by_wear = wearing.iter().map(by_wear).fold(f64::INFINITY, f64::min);
        by_wear.min(self.until_event(at)).max(0.0)
    }

    /// The cycles until the surface is ground, or the wear limit is reached.
    fn until_event(&self, at: &StepStart<'_>) -> f64 {
        self.next_event(at.worn.grindings).0 - at.load_cycles
    }

    /// Depth (mm) that the surface loses in `cycles` without grinding.
    fn removal_over(&self, cycles: f64, at: &StepStart<'_>) -> f64 {
        let until = Axles(at.load_cycles + cycles);
        (self.removed_at(until, at.worn.grindings) - at.worn.removed).max(0.0)
    }
}
