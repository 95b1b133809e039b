//! Rates extrapolated from the previous step, and growth that it left out.

use super::{EarlierStep, GrowthSettings, Mover, StepStart};

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
