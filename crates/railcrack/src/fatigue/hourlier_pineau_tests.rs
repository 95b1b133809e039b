//! Kink angles known from theory, ties, mirrored histories, and the reduction to hull corners.

use super::*;
use crate::fatigue::{EquivalentRange, Paris, RateLaw};

const ALL: [DirectionCriterion; 4] = [
    DirectionCriterion::MaxRate,
    DirectionCriterion::MaxRateUnclipped,
    DirectionCriterion::MaxDeltaK1,
    DirectionCriterion::MaxK1,
];

fn with(criterion: DirectionCriterion) -> HourlierPineau {
    HourlierPineau { law: GrowthLaw::RAIL_STEEL, criterion, kink_friction: 0.0 }
}

fn weighted(mode_2_weight: f64) -> GrowthLaw {
    GrowthLaw { equivalent: EquivalentRange::HourlierPineau { mode_2_weight }, ..GrowthLaw::RAIL_STEEL }
}

fn value_of(rule: &HourlierPineau, samples: &[Sif], beta: f64) -> f64 {
    rule.value(&[(1.0, samples.to_vec())], Quantity::Drive, beta)
}

fn history(samples: impl IntoIterator<Item = (f64, f64)>) -> SifHistory {
    SifHistory { samples: samples.into_iter().map(|(ki, kii)| Sif { ki, kii }).collect() }
}

/// A passage that is neither proportional nor symmetric, K_I noisy at zero while closed.
fn passage(count: usize) -> SifHistory {
    history((0..count).map(|i| {
        let t = 6.0 * (i as f64 / (count - 1) as f64) - 3.0;
        let opening = 120.0 * (-(t + 1.0) * (t + 1.0)).exp() - 20.0;
        (opening.max(1e-9 * (i % 7) as f64), 300.0 * t * (-t * t).exp() + 40.0 * (-t * t).exp())
    }))
}

#[test]
fn pure_mode_one_goes_straight_ahead() {
    for criterion in ALL {
        let kink = with(criterion).kink(&history([(0.0, 0.0), (100.0, 0.0)])).unwrap();
        assert!(kink.angle.abs() < 1e-7, "{criterion:?}: {kink:?}"); // golden section, see its steps
        assert!((kink.delta_k1 - 100.0).abs() < 1e-9 && kink.delta_k2 < 1e-5, "{kink:?}");
    }
}

#[test]
fn pulsating_mode_two_kinks_to_the_side_on_which_it_opens() {
    // K_II > 0 opens at −76.6°, with k1 = 1.2316 K_II.
    for (kii, sign) in [(100.0, -1.0), (-100.0, 1.0)] {
        for criterion in [DirectionCriterion::MaxDeltaK1, DirectionCriterion::MaxK1] {
            let kink = with(criterion).kink(&history([(0.0, 0.0), (0.0, kii)])).unwrap();
            assert!((kink.angle.to_degrees() - 76.6 * sign).abs() < 0.05, "{criterion:?}: {kink:?}");
            assert!((kink.delta_k1 - 123.16).abs() < 0.01, "{kink:?}");
            assert!(kink.secondary.is_none(), "{kink:?}");
        }
    }
}

#[test]
fn alternating_mode_two_is_a_tie_that_goes_to_the_positive_angle() {
    let alternating = history([(0.0, 100.0), (0.0, -100.0)]);
    let kink = with(DirectionCriterion::MaxK1).kink(&alternating).unwrap();
    let secondary = kink.secondary.unwrap();
    assert!((kink.angle.to_degrees() - 76.6).abs() < 0.05, "{kink:?}");
    assert_eq!((secondary.angle, secondary.ratio), (-kink.angle, 1.0));
}

#[test]
fn clipping_makes_alternating_mode_two_coplanar() {
    // Clipped, Δk1 at ±76.6° is 1.2316 K_II, but w Δk2² straight ahead is 0.772 · (2 K_II)²:
    // co-planar growth prevails.
    let kink = with(DirectionCriterion::MaxRate).kink(&history([(0.0, 100.0), (0.0, -100.0)])).unwrap();
    assert!(kink.angle.abs() < 1e-6, "{kink:?}");
    assert!((kink.delta_k2 - 200.0).abs() < 1e-6 && kink.delta_k1 < 1e-3, "{kink:?}");
}

#[test]
fn counting_negative_k1_makes_alternating_mode_two_branch() {
    // Unclipped, Δk1 at ±76.6° is 2 · 1.2316 K_II, more than √0.772 · 2 K_II straight ahead.
    // Without the weight of mode II the kink is where k1 is largest; with it slightly off.
    let alternating = history([(0.0, 100.0), (0.0, -100.0)]);
    let rule = with(DirectionCriterion::MaxRateUnclipped);
    let mode_1 = HourlierPineau { law: weighted(0.0), ..rule.clone() };
    let kink = mode_1.kink(&alternating).unwrap();
    assert!((kink.angle.to_degrees() - 76.6).abs() < 0.05, "{kink:?}");
    let kink = rule.kink(&alternating).unwrap();
    let secondary = kink.secondary.unwrap();
    assert!((kink.angle.to_degrees() - 76.6).abs() < 10.0, "{kink:?}");
    assert_eq!((secondary.angle, secondary.ratio), (-kink.angle, 1.0));
}

#[test]
fn chosen_angle_is_the_best_of_a_fine_scan() {
    for criterion in ALL {
        let rule = with(criterion);
        let history = passage(2000);
        let kink = rule.kink(&history).unwrap();
        // With all samples: the reduction to hull corners must not change the result.
        let value = |beta: f64| value_of(&rule, &history.samples, beta);
        let scan = (-11000..=11000).map(|i| (0.01 * f64::from(i)).to_radians());
        let best = scan.max_by(|a, b| value(*a).total_cmp(&value(*b))).unwrap();
        assert!((best - kink.angle).abs() < 0.01_f64.to_radians(), "{criterion:?}: {best} {kink:?}");
        assert!(value(kink.angle) >= value(best));
        let corners = convex_hull(&history.samples);
        assert_eq!(value(kink.angle), value_of(&rule, &corners, kink.angle));
    }
}

#[test]
fn the_secondary_maximum_is_another_local_maximum() {
    let rule = with(DirectionCriterion::MaxRate);
    // Opening under positive K_II, then reversed shear while closed.
    let samples = history([(0.0, 0.0), (60.0, 100.0), (0.0, -80.0)]).samples;
    let kink = rule.kink(&SifHistory { samples: samples.clone() }).unwrap();
    let secondary = kink.secondary.unwrap();
    assert!((secondary.angle - kink.angle).abs() >= SECONDARY_DISTANCE);
    assert!(secondary.ratio > 0.0 && secondary.ratio < 1.0, "{kink:?}");
    let value = |beta: f64| value_of(&rule, &samples, beta);
    assert!(
        value(secondary.angle) >= value(secondary.angle - 0.01)
            && value(secondary.angle) >= value(secondary.angle + 0.01)
    );
    let ratio = (value(secondary.angle) / value(kink.angle)).powf(3.33);
    assert!((ratio - secondary.ratio).abs() < 1e-12); // same formula, different summation order
}

#[test]
fn an_end_of_the_searched_range_is_no_secondary_maximum() {
    // The criterion still rises at an end of the range, without a maximum there.
    let rising = history([(0.0, 0.0), (60.0, 100.0), (0.0, -50.0)]);
    let rule = with(DirectionCriterion::MaxRate);
    let end = *KINK_ANGLES.end();
    assert!(value_of(&rule, &rising.samples, end) > value_of(&rule, &rising.samples, end - 0.01));
    assert_eq!(rule.kink(&rising).unwrap().secondary, None);
}

#[test]
fn mirrored_history_gives_the_opposite_angle_to_the_bit() {
    for criterion in ALL {
        let history = passage(1501);
        let mirrored =
            SifHistory { samples: history.samples.iter().map(|k| Sif { ki: k.ki, kii: -k.kii }).collect() };
        let (kink, other) =
            (with(criterion).kink(&history).unwrap(), with(criterion).kink(&mirrored).unwrap());
        let opposite = Kink {
            angle: -other.angle,
            secondary: other.secondary.map(|r| SecondaryMaximum { angle: -r.angle, ..r }),
            ..other
        };
        assert_eq!(kink, opposite);
    }
}

#[test]
fn histories_without_driving_force_give_no_kink() {
    for criterion in ALL {
        assert_eq!(with(criterion).kink(&SifHistory::default()), None);
        assert_eq!(with(criterion).kink(&history([(0.0, 0.0), (0.0, 0.0)])), None);
        let broken = [(0.0, 0.0), (9.0, 1.0), (5.0, f64::NAN), (8.0, -7.0), (2.0, 3.0)];
        assert_eq!(with(criterion).kink(&history(broken)), None);
    }
}

#[test]
fn one_wheel_twice_is_the_wheel_itself() {
    let (history, rule) = (passage(400), with(DirectionCriterion::MaxRate));
    let one = rule.kink(&history).unwrap();
    let half = WheelHistory { share: 0.5, history: &history };
    let two = rule.kink_of_mix(&[half, half]).unwrap();
    // The parabola finds the angle to about 1e-11, for any quantity.
    assert!((one.angle - two.angle).abs() < 1e-9, "{one:?} {two:?}");
    assert!((one.rate / two.rate - 1.0).abs() < 1e-12, "{one:?} {two:?}");
}

#[test]
fn the_direction_of_a_mix_flips_where_the_rates_are_equal() {
    // Two wheels under which the crack kinks to opposite sides, the second one the stronger.
    let right = history([(0.0, 0.0), (0.0, 100.0)]);
    let left = history([(0.0, 0.0), (0.0, -130.0)]);
    let rule = HourlierPineau { law: weighted(0.1), ..HourlierPineau::default() };
    let angle = |share: f64| {
        let wheel = |share, history| WheelHistory { share, history };
        rule.kink_of_mix(&[wheel(1.0 - share, &right), wheel(share, &left)]).unwrap().angle
    };
    // By symmetry where share · 1.3^3.33 = 1 − share.
    let flips = 1.0 / (1.0 + 1.3_f64.powf(3.33));
    assert!(angle(flips - 1e-6) < -1.0 && angle(flips + 1e-6) > 1.0, "{} {}", angle(0.2), angle(0.4));
}

#[test]
fn thresholds_count_wheel_by_wheel() {
    // Each wheel is below the threshold, although their sum would not be.
    let paris = Paris { threshold: 5.0, ..Paris::RAIL_STEEL };
    let law = GrowthLaw { rate: RateLaw::Paris(paris), ..GrowthLaw::RAIL_STEEL };
    let rule = HourlierPineau { law, ..HourlierPineau::default() };
    let weak = history([(0.0, 0.0), (100.0, 0.0)]);
    let strong = history([(0.0, 0.0), (0.0, 300.0)]);
    let wheel = |share, history| WheelHistory { share, history };
    let below = rule.kink_of_mix(&[wheel(0.5, &weak), wheel(0.5, &weak)]).unwrap();
    assert!(below.rate == 0.0 && below.angle.abs() < 1e-6, "{below:?}");
    // The weak wheel does not contribute.
    let alone = rule.kink(&strong).unwrap();
    let mixed = rule.kink_of_mix(&[wheel(0.99, &weak), wheel(0.01, &strong)]).unwrap();
    assert!((alone.angle - mixed.angle).abs() < 1e-9, "{alone:?} {mixed:?}");
    assert!((mixed.rate / (0.01 * alone.rate) - 1.0).abs() < 1e-9, "{alone:?} {mixed:?}");
}

#[test]
fn other_directions() {
    let proportional = history([(0.0, 0.0), (0.0, 100.0)]);
    let angle = |criterion| with(criterion).kink(&proportional).unwrap().angle.to_degrees();
    // Erdogan & Sih 1963: −70.5° in mode II, from tan(θ/2) = −√2/2 exactly.
    let exact = -2.0 * 0.5_f64.sqrt().atan().to_degrees();
    assert!((angle(DirectionCriterion::MaxTangentialStress) - exact).abs() < 1e-4);
    assert_eq!(angle(DirectionCriterion::Coplanar), 0.0);
    let opened = history([(0.0, 0.0), (100.0, 0.0)]);
    let kink = with(DirectionCriterion::MaxDeltaCtd).kink(&opened).unwrap();
    assert!(kink.angle.abs() < 1e-6, "{kink:?}");
    assert_eq!(with(DirectionCriterion::Coplanar).kink(&history([(0.0, 0.0)])), None);
    assert_eq!(with(DirectionCriterion::MaxTangentialStress).kink(&history([(-1.0, 0.0)])), None);
}
