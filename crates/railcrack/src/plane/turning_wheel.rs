//! The wheel of a mix that turns a crack.

use crate::fatigue::{HourlierPineau, WheelHistory};
use crate::fracture::SifHistory;

/// Directions that differ by less than this (radians) count as equal.
const TURNED: f64 = std::f64::consts::PI / 180.0;

/// The wheel (from 0) whose removal would change the kink from `angle` (radians) most; `None` where
/// no removal changes the direction by a degree.
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
    shares: &[f64],
    histories: &'a [&'a [SifHistory]],
) -> Vec<WheelHistory<'a>> {
    let of = |(&share, all): (&f64, &&'a [SifHistory])| WheelHistory { share, history: &all[tip] };
    shares.iter().zip(histories).map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fracture::Sif;

    #[test]
    fn a_weak_wheel_may_turn_the_crack() {
        let history = |samples: &[(f64, f64)]| SifHistory {
            samples: samples.iter().map(|&(ki, kii)| Sif { ki, kii }).collect(),
        };
        let direction = HourlierPineau::default();
        let (often, seldom) = (history(&[(0.0, 0.0), (100.0, 0.0)]), history(&[(0.0, 0.0), (0.0, 400.0)]));
        let wheels =
            [WheelHistory { share: 0.9, history: &often }, WheelHistory { share: 0.1, history: &seldom }];
        let angle = direction.kink_of_mix(&wheels).unwrap().angle;
        assert!(angle < -0.5, "{angle}");
        assert_eq!(turned_by(&direction, &wheels, angle), Some(1));
    }
}
