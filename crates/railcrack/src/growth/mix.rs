//! A mix of wheels: its members, their shares of the growth, and the one that turns the crack.

use super::{Observer, PassageSettings, RailLoad};
use crate::fatigue::{HourlierPineau, LargestK1, RUNAWAY, SifRanges, WheelHistory};
use crate::field::{StressField, Wheel};
use crate::fracture::SifHistory;
use serde::{Deserialize, Serialize};

/// Most wheels of a mix.
pub const MOST_WHEELS: usize = 20;

/// A wheel of a mix beside the first one: what may be its own.
pub struct MixedWheel {
    /// Its field.
    pub wheel: Box<dyn Wheel>,
    /// Share of the axles.
    pub share: f64,
    /// Stress of the rail while it passes that stays between passages, temperature included.
    pub residual: Option<Box<dyn StressField>>,
    /// Its passages.
    pub passages: PassageSettings,
    /// K_Ic (MPa √mm) at its temperature; none where the rail does not break.
    pub toughness: Option<f64>,
}

impl MixedWheel {
    pub(super) fn load(&self) -> RailLoad<'_> {
        RailLoad { wheel: self.wheel.as_ref(), residual: self.residual.as_deref() }
    }
}

/// Shares of the wheels of a mix in the growth of a tip; no members where there is one wheel.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct WheelShares {
    count: usize,
    values: [f64; MOST_WHEELS],
}

impl WheelShares {
    /// The shares of `rates` in their sum; zeros where nothing grows.
    pub fn of(rates: &[f64]) -> Self {
        let mut shares = Self { count: rates.len().min(MOST_WHEELS), ..Self::default() };
        let sum: f64 = rates.iter().sum();
        for (share, rate) in shares.values.iter_mut().zip(rates) {
            *share = if sum > 0.0 { rate / sum } else { 0.0 };
        }
        shares
    }

    /// The shares `values`, as stored.
    pub fn from_values(values: &[f64]) -> Self {
        let mut shares = Self { count: values.len().min(MOST_WHEELS), ..Self::default() };
        shares.values.iter_mut().zip(values).for_each(|(share, value)| *share = *value);
        shares
    }

    /// From wheel to wheel.
    pub fn values(&self) -> &[f64] {
        &self.values[..self.count]
    }
}

/// A tip under all wheels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct MixedTip {
    /// Of the wheel that grows it most; the largest K_I is that of all wheels.
    pub ranges: SifRanges,
    /// Σ s_i r_i, mm per axle.
    pub rate: f64,
    pub shares: WheelShares,
    /// The largest k1 in relation to the toughness, and its wheel, from 0.
    pub largest_k1: Option<LargestK1>,
    pub opened_by: usize,
}

impl MixedTip {
    /// Of the histories under `wheels`, with the toughness of each.
    pub fn of(direction: &HourlierPineau, wheels: &[WheelHistory], toughness: &[Option<f64>]) -> Self {
        let law = &direction.law;
        let ranges: Vec<SifRanges> = wheels.iter().map(|wheel| SifRanges::of(wheel.history)).collect();
        let rate = |(ranges, wheel): (&SifRanges, &WheelHistory)| {
            let rate = law.rate(ranges.load()).min(RUNAWAY);
            if wheels.len() == 1 || rate >= RUNAWAY { rate } else { wheel.share * rate }
        };
        let rates: Vec<f64> = ranges.iter().zip(wheels).map(rate).collect();
        let driven = |i: usize| (rates[i], law.equivalent_range(ranges[i].delta_ki, ranges[i].delta_kii));
        let most = (0..wheels.len()).reduce(|a, b| if driven(b) > driven(a) { b } else { a }).unwrap_or(0);
        let opened =
            wheels.iter().enumerate().filter_map(|(i, wheel)| Some((i, LargestK1::of(wheel.history)?)));
        let danger = |(i, largest): &(usize, LargestK1)| {
            largest.k1 / toughness.get(*i).copied().flatten().unwrap_or(1.0)
        };
        let opened = opened.reduce(|a, b| if danger(&b) > danger(&a) { b } else { a });
        let ki_max = ranges.iter().map(|ranges| ranges.ki_max).fold(f64::NEG_INFINITY, f64::max);
        Self {
            ranges: SifRanges { ki_max, ..ranges[most] },
            rate: rates.iter().sum::<f64>().min(RUNAWAY),
            shares: if wheels.len() > 1 { WheelShares::of(&rates) } else { WheelShares::default() },
            largest_k1: opened.map(|(_, largest)| largest),
            opened_by: opened.map_or(0, |(wheel, _)| wheel),
        }
    }
}

/// Directions that differ by less (radians) are the same for the question of who turns the crack.
const TURNED: f64 = std::f64::consts::PI / 180.0;

/// The wheel (from 0) without which the crack would kink most differently from `angle` (radians);
/// none where none changes the direction by a degree.
pub(super) fn turned_by(direction: &HourlierPineau, wheels: &[WheelHistory], angle: f64) -> Option<usize> {
    let without = |i: usize| {
        let others: Vec<WheelHistory> =
            wheels.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, wheel)| *wheel).collect();
        let kink = if others.is_empty() { None } else { direction.kink_of_mix(&others) };
        (i, kink.map_or(0.0, |kink| (kink.angle - angle).abs()))
    };
    let turns = (0..wheels.len()).map(without).filter(|(_, turn)| *turn > TURNED);
    turns.reduce(|a, b| if b.1 > a.1 { b } else { a }).map(|(i, _)| i)
}

/// The histories of tip `tip` under each wheel.
pub(super) fn histories_of<'a>(
    tip: usize,
    shares: &'a [f64],
    histories: &'a [&'a [SifHistory]],
) -> Vec<WheelHistory<'a>> {
    let of = |(&share, all): (&f64, &&'a [SifHistory])| WheelHistory { share, history: &all[tip] };
    shares.iter().zip(histories).map(of).collect()
}

/// Passes on that a step is to be given up, and no progress: that of the first wheel stands for
/// all.
pub(super) struct Beside<'a>(pub &'a dyn Observer);

impl Observer for Beside<'_> {
    fn progress(&self, _: f64) {}

    fn interrupted(&self) -> bool {
        self.0.interrupted()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fracture::Sif;

    fn history(samples: &[(f64, f64)]) -> SifHistory {
        SifHistory { samples: samples.iter().map(|&(ki, kii)| Sif { ki, kii }).collect() }
    }

    #[test]
    fn rates_add_by_share_and_the_weak_wheel_may_turn_the_crack() {
        let direction = HourlierPineau::default();
        let (often, seldom) = (history(&[(0.0, 0.0), (100.0, 0.0)]), history(&[(0.0, 0.0), (0.0, 400.0)]));
        let wheels =
            [WheelHistory { share: 0.9, history: &often }, WheelHistory { share: 0.1, history: &seldom }];
        let tip = MixedTip::of(&direction, &wheels, &[None, None]);
        let rate = |history| direction.law.rate(SifRanges::of(history).load());
        let want = [0.9 * rate(&often), 0.1 * rate(&seldom)];
        assert_eq!(tip.rate, want[0] + want[1]);
        assert_eq!(tip.shares.values(), [want[0] / tip.rate, want[1] / tip.rate]);
        assert!(tip.shares.values()[1] > 0.8 && tip.ranges.delta_kii == 400.0 && tip.ranges.ki_max == 100.0);
        let angle = direction.kink_of_mix(&wheels).unwrap().angle;
        assert!(angle < -0.5, "{angle}");
        assert_eq!(turned_by(&direction, &wheels, angle), Some(1));
        // A cold rail breaks first under the wheel that passes in the cold.
        let cold = MixedTip::of(&direction, &wheels, &[Some(100.0), Some(1000.0)]);
        assert_eq!((cold.opened_by, cold.largest_k1.unwrap().k1), (0, 100.0));
    }
}
