//! Rates extrapolated from the previous step, growth that it left out, and the cycles in between.

use super::{EarlierStep, GrowthSettings, Mover, StepStart};
use serde::{Deserialize, Serialize};

/// Relative difference of rates and lengths of movers that are alike.
const ALIKE: f64 = 1e-9;

/// The rates of movers, extrapolated from the previous step, and the growth that it left out.
///
/// The growth of a step is predicted from the rates at its start and at the start of the previous
/// one (Adams–Bashforth) and corrected once the rates at its end are known (trapezoidal rule). The
/// correction is added to the next increment: no step is computed twice, and the error of the life
/// is of second order in the increment.
#[derive(Debug, Clone)]
pub(super) struct History {
    earlier: Option<EarlierStep>,
    /// Cycles of the previous step.
    passed: f64,
    /// The present state of the mover that led the previous step.
    leader: Option<Mover>,
    is_second_order: bool,
}

impl History {
    /// The history of the movers `all` at the start of a step.
    pub fn of(at: &StepStart<'_>, all: &[Mover], settings: &GrowthSettings) -> Self {
        let is_second_order = !settings.turning.is_kink();
        let earlier = at.earlier.filter(|_| is_second_order).cloned();
        let leader = earlier.as_ref().and_then(|earlier| earlier.leader);
        let now = leader.and_then(|(leader, _)| all.iter().copied().find(|mover| mover.is(&leader)));
        let leader = now.filter(|now| now.rate > 0.0 && now.rate >= settings.arrest_rate);
        Self { earlier, passed: at.passed, leader, is_second_order }
    }

    pub fn is_second_order(&self) -> bool {
        self.is_second_order
    }

    fn before(&self, mover: &Mover) -> Option<(Mover, f64)> {
        let EarlierStep { movers, balance, .. } = self.earlier.as_ref()?;
        let i = movers.iter().position(|before| before.is(mover))?;
        Some((movers[i], balance[i]))
    }

    /// Whether both are the same mover, or their cracks are equally long and they have been equally
    /// fast, but for round-off: sides of a symmetric crack grow alike, whichever sets the pace.
    pub fn are_alike(&self, one: &Mover, other: &Mover) -> bool {
        let alike = |a: f64, b: f64| (a - b).abs() <= ALIKE * a.abs().max(b.abs());
        let now = alike(one.rate, other.rate) && alike(one.length, other.length);
        let before = match [one, other].map(|mover| self.before(mover)) {
            [Some((a, _)), Some((b, _))] => alike(a.rate, b.rate),
            [a, b] => a.is_none() == b.is_none(),
        };
        one.is(other) || now && before
    }

    /// Whether the rate of `mover` is extrapolated.
    pub fn extrapolates(&self, mover: &Mover) -> bool {
        self.passed > 0.0
            && self.earlier.as_ref().is_some_and(|earlier| earlier.is_smooth)
            && self.before(mover).is_some()
    }

    /// The mean rate (mm per cycle) of `mover` over the next `cycles`.
    pub fn mean_rate(&self, mover: &Mover, cycles: f64) -> f64 {
        let rate = mover.rate;
        match self.before(mover) {
            Some((before, _)) if self.extrapolates(mover) => {
                let change = 0.5 * (rate - before.rate) * cycles / self.passed;
                (rate + change).clamp(0.5 * rate, 2.0 * rate)
            }
            _ => rate,
        }
    }

    /// Growth of `mover` so far that its increments lack, mm.
    pub fn owed(&self, mover: &Mover) -> f64 {
        let Some((before, balance)) = self.before(mover) else { return 0.0 };
        let led = self.earlier.as_ref().and_then(|earlier| earlier.leader).zip(self.leader);
        let growth = match led {
            Some(((start, growth), end)) => 0.5 * growth * (before.rate / start.rate + mover.rate / end.rate),
            None => 0.5 * self.passed * (before.rate + mover.rate),
        };
        balance + growth
    }
}

/// An increment whose number of cycles follows once the rate at its end is known.
///
/// The number of cycles is the integral of da/(da/dN) along the path of the fastest mover, and the
/// rate is known at both ends of an increment: ΔN = Δa/2 (1/r_start + 1/r_end), which is
/// second-order accurate in the increment. The rate at the start alone gives only first-order
/// accuracy, and at the default increment it overestimates ΔN by a few per cent.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Interval {
    /// The tip or motion that set the pace, with its rate at the start.
    pub mover: Mover,
    /// Δa over that rate: the cycles given by the rate at the start alone.
    pub cycles: f64,
    /// Whether the increment was shortened to end at a given number of cycles, which is then final.
    pub is_settled: bool,
    /// Whether the tip kinked at its start: then only the rate at the end is one of the increment.
    pub is_kinked: bool,
}

impl Interval {
    /// Cycles from its start to its end, where the movers are `movers`. If the mover that set the
    /// pace no longer exists, or is slower than `slowest` (mm per cycle), only the rate at the
    /// start counts.
    pub(crate) fn cycles_until(&self, movers: &[Mover], slowest: f64) -> f64 {
        let end = movers.iter().find(|mover| mover.is(&self.mover)).map(|mover| mover.rate);
        match end.filter(|rate| *rate > 0.0 && *rate >= slowest && !self.is_settled) {
            Some(rate) if self.is_kinked => self.cycles * self.mover.rate / rate,
            Some(rate) => 0.5 * self.cycles * (1.0 + self.mover.rate / rate),
            None => self.cycles,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mover(crack: usize, rate: f64) -> Mover {
        Mover { crack, index: 0, rate, length: 1.0 }
    }

    #[test]
    fn mean_of_the_inverse_rates_of_the_tip_that_set_the_pace() {
        let movers = [mover(0, 1e-9), mover(1, 4e-6)];
        let interval = Interval { mover: mover(1, 2e-6), cycles: 1e5, is_settled: false, is_kinked: false };
        // 0.2 mm at 1/2e-6 and 1/4e-6 cycles per mm.
        assert_eq!(interval.cycles_until(&movers, 0.0), 0.75e5);
        assert_eq!(interval.cycles_until(&movers[..1], 0.0), 1e5);
        assert_eq!(interval.cycles_until(&movers, 1e-5), 1e5);
        let kinked = Interval { is_kinked: true, ..interval };
        assert_eq!(kinked.cycles_until(&movers, 0.0), 0.5e5);
        assert_eq!(Interval { is_settled: true, ..interval }.cycles_until(&movers, 0.0), 1e5);
    }

    /// da/dN = a^1.7 from a = 1 to 2 has a closed form.
    #[test]
    fn halving_the_increment_quarters_the_error() {
        let rate = |length: f64| length.powf(1.7);
        let exact = (1.0 - 2.0_f64.powf(-0.7)) / 0.7;
        let error = |steps: usize| {
            let of = |i: usize| {
                let (from, to) = (1.0 + i as f64 / steps as f64, 1.0 + (i + 1) as f64 / steps as f64);
                let cycles = (to - from) / rate(from);
                Interval { mover: mover(0, rate(from)), cycles, is_settled: false, is_kinked: false }
                    .cycles_until(&[mover(0, rate(to))], 0.0)
            };
            (0..steps).map(of).sum::<f64>() - exact
        };
        let ratio = error(20) / error(40);
        assert!((ratio - 4.0).abs() < 0.02, "{ratio}"); // next term of the error: 1/20² of it
    }
}
