//! Load cycles of an increment: the trapezoidal rule in the inverse of the rate.

use super::Mover;
use serde::{Deserialize, Serialize};

/// An increment whose cycles are known once the rate at its end is.
///
/// The number of cycles is the integral of da/(da/dN) along the path of the fastest mover, and the
/// rate is known at both ends of an increment: ΔN = Δa/2 (1/r_start + 1/r_end), which is of second
/// order in the increment. With the rate at the start alone, ΔN is of first order, and some per
/// cent too many at the default increment.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Interval {
    /// The tip or motion that set the pace, with its rate at the start.
    pub mover: Mover,
    /// Δa over that rate: cycles by the rate at the start alone.
    pub cycles: f64,
    /// Whether the increment was shortened to end on a number of cycles: it has that number.
    pub is_settled: bool,
}

impl Interval {
    /// Cycles from its start to its end, where the movers are `movers`. Where the one that set the
    /// pace is gone, or slower than `slowest` (mm per cycle), the rate at the start counts alone.
    #[must_use]
    pub fn cycles_until(&self, movers: &[Mover], slowest: f64) -> f64 {
        let end = movers.iter().find(|mover| mover.is(&self.mover)).map(|mover| mover.rate);
        match end.filter(|rate| *rate > 0.0 && *rate >= slowest && !self.is_settled) {
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
        let interval = Interval { mover: mover(1, 2e-6), cycles: 1e5, is_settled: false };
        // 0.2 mm at 1/2e-6 and 1/4e-6 cycles per mm.
        assert_eq!(interval.cycles_until(&movers, 0.0), 0.75e5);
        assert_eq!(interval.cycles_until(&movers[..1], 0.0), 1e5);
        assert_eq!(interval.cycles_until(&movers, 1e-5), 1e5);
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
                Interval { mover: mover(0, rate(from)), cycles, is_settled: false }
                    .cycles_until(&[mover(0, rate(to))], 0.0)
            };
            (0..steps).map(of).sum::<f64>() - exact
        };
        let ratio = error(20) / error(40);
        assert!((ratio - 4.0).abs() < 0.02, "{ratio}"); // next term of the error: 1/20² of it
    }
}
