//! Load cycles of an increment: the trapezoidal rule in the inverse of the rate.

use super::Mover;
use serde::{Deserialize, Serialize};

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
