//! Kink angles known from theory, ties, mirrored histories, and the reduction to hull corners.

use super::*;

const ALL: [DirectionCriterion; 4] = [
    DirectionCriterion::MaxRate,
    DirectionCriterion::MaxRateUnclipped,
    DirectionCriterion::MaxDeltaK1,
    DirectionCriterion::MaxK1,
];

fn with(criterion: DirectionCriterion) -> HourlierPineau {
    HourlierPineau { law: ParisLaw::RAIL_STEEL, criterion }
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
    let mode_1 = HourlierPineau { law: ParisLaw { mode_2_weight: 0.0, ..rule.law }, ..rule };
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
        // All samples, no hull: the reduction to corners must not change the result.
        let value = |beta: f64| rule.value(&history.samples, beta);
        let scan = (-11000..=11000).map(|i| (0.01 * f64::from(i)).to_radians());
        let best = scan.max_by(|a, b| value(*a).total_cmp(&value(*b))).unwrap();
        assert!((best - kink.angle).abs() < 0.01_f64.to_radians(), "{criterion:?}: {best} {kink:?}");
        assert!(value(kink.angle) >= value(best));
        let corners = convex_hull(&history.samples);
        assert_eq!(value(kink.angle), rule.value(&corners, kink.angle));
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
    let value = |beta: f64| rule.value(&samples, beta);
    assert!(
        value(secondary.angle) >= value(secondary.angle - 0.01)
            && value(secondary.angle) >= value(secondary.angle + 0.01)
    );
    let ratio = (value(secondary.angle) / value(kink.angle)).powf(rule.law.m);
    assert!((ratio - secondary.ratio).abs() < 1e-12); // same formula, other summation order
}

#[test]
fn an_end_of_the_searched_range_is_no_secondary_maximum() {
    // The criterion still rises at an end of the range, without a maximum there.
    let rising = history([(0.0, 0.0), (60.0, 100.0), (0.0, -50.0)]);
    let rule = with(DirectionCriterion::MaxRate);
    let end = *KINK_ANGLES.end();
    assert!(rule.value(&rising.samples, end) > rule.value(&rising.samples, end - 0.01));
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
