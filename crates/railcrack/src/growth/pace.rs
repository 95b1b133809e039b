//! The pace of a step: the cycles until the next one, and what grows and what is removed in them.

use super::{EarlierRates, GrowthSettings, Interval, Maintenance, Mover, StepStart};

/// The pace of a step. The fastest growing mover sets it, or the removal of the surface, where that
/// takes more of a crack.
#[derive(Debug, Clone)]
pub(crate) struct Pace {
    /// The mover whose rate decides over the cycles; none where none grows.
    mover: Option<Mover>,
    rate: f64,
    increment: f64,
    /// The increment over the length of its crack.
    pub share: f64,
    pub cycles: f64,
    /// Whether it has these cycles, whatever the rate at its end.
    is_settled: bool,
    /// Removed of the surface, mm.
    pub removal: f64,
    /// Whether the surface is ground at its end.
    pub grinds: bool,
    /// Whether increments follow from the cycles, not the cycles from an increment.
    is_timed: bool,
    /// Rates of the step before.
    earlier: Option<EarlierRates>,
}

/// A crack at the surface that is removed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WearingCrack {
    /// Sine of its angle at the mouth; 1 for a buried one.
    pub mouth_sine: f64,
    /// The longest that it has been, mm.
    pub longest: f64,
}

/// Who moves in a step, and what is worn.
pub(crate) struct Moving<'a> {
    /// All movers of cracks, those that have stopped included.
    pub all: &'a [Mover],
    /// Those that grow.
    pub growing: &'a [Mover],
    /// Whether some have not stopped, even if they do not grow now.
    pub some_are_left: bool,
    /// The cracks that are not worn away.
    pub wearing: &'a [WearingCrack],
}

impl Pace {
    pub fn of(moving: &Moving<'_>, at: &StepStart<'_>, settings: &GrowthSettings) -> Self {
        // Of equally fast movers that of the longest crack, so that their order does not matter.
        let faster = |a: &Mover, b: &Mover| (b.rate, b.length) > (a.rate, a.length);
        let fastest = moving.growing.iter().copied().reduce(|a, b| if faster(&a, &b) { b } else { a });
        let left = (settings.stop_after_cycles.unwrap_or(f64::INFINITY) - at.load_cycles).max(0.0);
        if let Some(maintenance) = settings.maintained() {
            let left = if moving.some_are_left { left } else { 0.0 };
            return Self::maintained(moving, at, settings, maintenance, fastest, left);
        }
        let Some(fastest) = fastest else { return Self::none() };
        let increment = settings.increment * fastest.length;
        let cycles = increment / fastest.rate;
        let share = settings.increment;
        let (mover, rate) = (Some(fastest), fastest.rate);
        if cycles <= left {
            return Self { mover, rate, increment, share, cycles, ..Self::none() };
        }
        let increment = left * rate;
        let share = increment / fastest.length;
        Self { mover, rate, increment, share, cycles: left, is_settled: true, ..Self::none() }
    }

    /// Nothing grows and nothing is removed.
    fn none() -> Self {
        Self {
            mover: None,
            rate: 1.0,
            increment: 0.0,
            share: 0.0,
            cycles: 0.0,
            is_settled: false,
            removal: 0.0,
            grinds: false,
            is_timed: false,
            earlier: None,
        }
    }

    /// The pace while the surface is removed: no crack loses more at its mouth than the increment
    /// of the longest that it has been, and a step ends with each grinding. Where the fastest mover
    /// sets the pace, cycles follow from its rates as everywhere; elsewhere the increments follow
    /// from the cycles.
    fn maintained(
        moving: &Moving<'_>,
        at: &StepStart<'_>,
        settings: &GrowthSettings,
        maintenance: &Maintenance,
        fastest: Option<Mover>,
        left: f64,
    ) -> Self {
        let increment = fastest.map_or(0.0, |mover| settings.increment * mover.length);
        let by_growth = fastest.map_or(f64::INFINITY, |mover| increment / mover.rate);
        let by_wear =
            |crack: &WearingCrack| settings.increment * crack.longest * crack.mouth_sine / maintenance.wear;
        let by_wear = moving.wearing.iter().map(by_wear).fold(f64::INFINITY, f64::min);
        let to_grinding = maintenance
            .grinding
            .map(|grinding| ((at.worn.grindings + 1) as f64 * grinding.interval - at.load_cycles).max(0.0));
        let cycles = by_growth.min(by_wear).min(left).min(to_grinding.unwrap_or(f64::INFINITY));
        let grinds = to_grinding.is_some_and(|to_grinding| to_grinding <= cycles);
        let ground = maintenance
            .grinding
            .map_or(0.0, |grinding| grinding.depth * (at.worn.grindings + usize::from(grinds)) as f64);
        let removed = maintenance.wear * (at.load_cycles + cycles) + ground;
        let is_timed = maintenance.grinding.is_some() || cycles < by_growth;
        Self {
            // Where none grows, any of them stands for the cycles.
            mover: fastest.or(moving.all.first().copied()),
            rate: fastest.map_or(1.0, |mover| mover.rate),
            increment,
            share: settings.increment,
            cycles,
            is_settled: is_timed,
            is_timed,
            removal: (removed - at.worn.removed).max(0.0),
            grinds,
            earlier: at.worn.before.clone(),
        }
    }

    /// The increment whose rate at its end decides over the cycles; none where no cycles pass.
    pub fn interval(&self) -> Option<Interval> {
        let Self { rate, cycles, is_settled, .. } = *self;
        self.mover.map(|mover| Interval { mover: Mover { rate, ..mover }, cycles, is_settled })
    }

    /// The increment (mm) of a mover.
    pub fn increment(&self, mover: &Mover) -> f64 {
        if !self.is_timed {
            return self.increment * (mover.rate / self.rate);
        }
        let mean = |earlier: &EarlierRates| earlier.mean(mover, self.cycles);
        self.cycles * self.earlier.as_ref().map_or(mover.rate, mean)
    }
}
