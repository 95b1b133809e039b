//! The pace of a step: the cycles until the next one, and what grows and what is removed in them.

use super::cycles::Interval;
use super::step_state::{StepState, TipDrive};
use super::stops::grows;
use super::surface::EarlierRates;
use super::worn::mouth_sine;
use super::{GrowthSettings, Maintenance, TipStop};
use crate::crack::CrackTip;

/// The pace of a step. The fastest growing tip sets it, or the removal of the surface, where that
/// takes more of a crack.
#[derive(Debug, Clone)]
pub(super) struct Pace {
    /// The tip whose rate decides over the cycles; none where none grows.
    tip: Option<CrackTip>,
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

impl Pace {
    pub fn of(state: &StepState<'_>, settings: &GrowthSettings, stops: &[Option<TipStop>]) -> Self {
        let growing = state.tips.iter().zip(stops).filter(|(_, stop)| stop.is_none()).map(|(tip, _)| tip);
        let growing = growing.filter(|tip| grows(tip, settings));
        // Of equally fast tips that of the longest crack, so that their order does not matter.
        let length = |tip: &TipDrive| state.length(tip.tip.crack);
        let faster = |a: &TipDrive, b: &TipDrive| (b.rate, length(b)) > (a.rate, length(a));
        let fastest = growing.reduce(|a, b| if faster(a, b) { b } else { a });
        let left = (settings.stop_after_cycles.unwrap_or(f64::INFINITY) - state.load_cycles).max(0.0);
        if let Some(maintenance) = settings.maintained() {
            let some_are_left = stops.iter().any(Option::is_none);
            let left = if some_are_left { left } else { 0.0 };
            return Self::maintained(state, settings, maintenance, fastest, left);
        }
        let Some(fastest) = fastest else { return Self::none() };
        let increment = settings.increment * length(fastest);
        let cycles = increment / fastest.rate;
        let share = settings.increment;
        let (tip, rate) = (Some(fastest.tip), fastest.rate);
        if cycles <= left {
            return Self { tip, rate, increment, share, cycles, ..Self::none() };
        }
        let increment = left * rate;
        let share = increment / length(fastest);
        Self { tip, rate, increment, share, cycles: left, is_settled: true, ..Self::none() }
    }

    /// Nothing grows and nothing is removed.
    fn none() -> Self {
        Self {
            tip: None,
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
    /// of the longest that it has been, and a step ends with each grinding. Where the fastest tip
    /// sets the pace, cycles follow from its rates as everywhere; elsewhere the increments follow
    /// from the cycles.
    fn maintained(
        state: &StepState<'_>,
        settings: &GrowthSettings,
        maintenance: &Maintenance,
        fastest: Option<&TipDrive>,
        left: f64,
    ) -> Self {
        let increment = fastest.map_or(0.0, |tip| settings.increment * state.length(tip.tip.crack));
        let by_growth = fastest.map_or(f64::INFINITY, |tip| increment / tip.rate);
        let by_wear = |crack: usize| {
            let sine = mouth_sine(&state.cracks[crack]).unwrap_or(1.0);
            settings.increment * state.longest(crack) * sine / maintenance.wear
        };
        let left_of = (0..state.cracks.len()).filter(|&crack| !state.is_worn_away(crack));
        let by_wear = left_of.map(by_wear).fold(f64::INFINITY, f64::min);
        let to_grinding = maintenance.grinding.map(|grinding| {
            ((state.worn.grindings + 1) as f64 * grinding.interval - state.load_cycles).max(0.0)
        });
        let cycles = by_growth.min(by_wear).min(left).min(to_grinding.unwrap_or(f64::INFINITY));
        let grinds = to_grinding.is_some_and(|to_grinding| to_grinding <= cycles);
        let ground = maintenance
            .grinding
            .map_or(0.0, |grinding| grinding.depth * (state.worn.grindings + usize::from(grinds)) as f64);
        let removed = maintenance.wear * (state.load_cycles + cycles) + ground;
        let is_timed = maintenance.grinding.is_some() || cycles < by_growth;
        Self {
            // Where no tip grows, any of them stands for the cycles.
            tip: fastest.or(state.tips.first()).map(|tip| tip.tip),
            rate: fastest.map_or(1.0, |tip| tip.rate),
            increment,
            share: settings.increment,
            cycles,
            is_settled: is_timed,
            is_timed,
            removal: (removed - state.worn.removed).max(0.0),
            grinds,
            earlier: state.worn.before.clone(),
        }
    }

    /// The increment whose rate at its end decides over the cycles; none where no cycles pass.
    pub fn interval(&self) -> Option<Interval> {
        let Self { rate, cycles, is_settled, .. } = *self;
        self.tip.map(|tip| Interval { tip, rate, cycles, is_settled })
    }

    /// The increment (mm) of a tip.
    pub fn increment(&self, drive: &TipDrive) -> f64 {
        if !self.is_timed {
            return self.increment * (drive.rate / self.rate);
        }
        let mean = |earlier: &EarlierRates| earlier.mean(drive.tip, drive.rate, self.cycles);
        self.cycles * self.earlier.as_ref().map_or(drive.rate, mean)
    }
}
