//! Increments, cycles and every stop.

use super::*;
use crate::crack::{CrackTip, End};
use crate::plane::fixtures::{self, SETTINGS, advanced, crack as polyline};
use crate::words::Choice;

/// Round-off of a few operations.
const ROUNDING: f64 = 1e-13;

fn slanted(mouth: f64, length: f64, degrees: f64) -> Crack {
    Crack::surface_breaking(mouth, length, degrees.to_radians()).unwrap()
}

fn drive(crack: usize, degrees: f64, rate: f64) -> TipDrive {
    fixtures::tip(crack, degrees.to_radians(), rate)
}

fn state<'a>(cracks: &'a [Crack], tips: &'a [TipDrive]) -> StepState<'a> {
    fixtures::state(cracks, tips, 0.1)
}

/// The stop of the only tip of the first crack, which kinks by `degrees`.
fn stop_of_first(cracks: &[Crack], degrees: f64) -> Option<TipStop> {
    advanced(&state(cracks, &[drive(0, degrees, 1e-5)]), &SETTINGS).tips[0].stop
}

#[test]
fn fastest_tip_sets_the_pace() {
    let cracks = [slanted(0.0, 6.0, 30.0), slanted(20.0, 10.0, 30.0)];
    let tips = [drive(0, 0.0, 1e-6), drive(1, -10.0, 4e-6)];
    let next = advanced(&state(&cracks, &tips), &SETTINGS);
    assert!((next.tips[1].increment - 0.4).abs() < ROUNDING, "{next:?}");
    assert!((next.tips[0].increment - 0.1).abs() < ROUNDING, "{next:?}");
    assert!((next.progress.cycles / 1e5 - 1.0).abs() < ROUNDING, "{next:?}");
    assert!((next.tips[0].deferred.length - 0.1).abs() < ROUNDING && next.stop.is_none());
    assert_eq!(next.cracks[0], cracks[0]);
    let deeper = next.cracks[1].ahead(End::Last).angle().to_degrees();
    assert!((deeper + 40.0).abs() < 1e-11, "{deeper}"); // degrees, round-off of atan2 over a short segment
}

#[test]
fn buried_crack_grows_at_both_ends() {
    let cracks = [polyline(&[(0.0, -5.0), (4.0, -5.0)])];
    let first = TipDrive { tip: CrackTip { crack: 0, tip: 0, end: End::First }, ..drive(0, 0.0, 1.5e-6) };
    let last = TipDrive { tip: CrackTip { crack: 0, tip: 1, end: End::Last }, ..drive(0, 90.0, 2e-6) };
    let next = advanced(&state(&cracks, &[first, last]), &SETTINGS);
    let points = next.cracks[0].points();
    for (got, want) in points.iter().zip([(-0.12, -5.0), (0.0, -5.0), (4.0, -5.0), (4.0, -4.84)]) {
        assert!((*got - Vec2::new(want.0, want.1)).length() < ROUNDING, "{points:?}");
    }
}

#[test]
fn slow_and_unloaded_tips_are_arrested_and_the_run_with_them() {
    let cracks = [slanted(0.0, 6.0, 30.0)];
    let unloaded = TipDrive { kink: None, ..drive(0, 0.0, 1e-5) };
    for tip in [drive(0, 0.0, 0.9e-9), drive(0, 0.0, 0.0), drive(0, 0.0, f64::NAN), unloaded] {
        let next = advanced(&state(&cracks, &[tip]), &SETTINGS);
        assert_eq!(next.stop, Some(RunStop::NoTipGrows(TipStop::Arrest)));
        assert_eq!((next.tips[0].stop, next.tips[0].increment), (Some(TipStop::Arrest), 0.0));
        assert_eq!((&next.cracks[..], next.progress.cycles), (&cracks[..], 0.0));
    }
    assert_eq!(advanced(&state(&cracks, &[drive(0, 0.0, 1e-9)]), &SETTINGS).tips[0].stop, None);
}

#[test]
fn stopped_tip_stays_stopped_and_does_not_set_the_pace() {
    let cracks = [slanted(0.0, 6.0, 30.0), slanted(20.0, 10.0, 30.0)];
    let stopped = TipDrive { stopped: Some(TipStop::Coalescence), ..drive(1, 0.0, 4e-6) };
    let next = advanced(&state(&cracks, &[drive(0, 0.0, 1e-6), stopped]), &SETTINGS);
    assert!((next.tips[0].increment - 0.24).abs() < ROUNDING, "{next:?}");
    assert_eq!((next.tips[1].increment, next.tips[1].stop), (0.0, Some(TipStop::Coalescence)));
    assert_eq!(next.tips[1].deferred, DeferredGrowth::default());
    assert_eq!(next.stop, None);
}

#[test]
fn rising_tip_near_the_surface_breaks_out() {
    // 6 mm at 5°: 0.52 mm deep. Rising by 0.24 mm leaves 0.28 mm, more than the 0.2 mm of two
    // elements.
    assert_eq!(stop_of_first(&[slanted(0.0, 6.0, 5.0)], 95.0), None);
    // At 3° the tip is 0.31 mm deep: 0.07 mm would be left.
    assert_eq!(stop_of_first(&[slanted(0.0, 6.0, 3.0)], 93.0), Some(TipStop::BreakOut));
    // At 1° the tip is 0.10 mm deep, but descends: no spall.
    assert_eq!(stop_of_first(&[slanted(0.0, 6.0, 1.0)], -20.0), None);
    // A step through the surface, and a ligament of 1 % of a long crack.
    let shallow = [polyline(&[(0.0, 0.0), (1.0, -2.0), (60.0, -2.0)])];
    assert_eq!(stop_of_first(&shallow, 90.0), Some(TipStop::BreakOut));
    let long = [polyline(&[(0.0, 0.0), (1.0, -2.0), (60.0, -0.7)])];
    assert_eq!(stop_of_first(&long, 1.5), Some(TipStop::BreakOut));
}

#[test]
fn tip_that_would_meet_another_crack_or_itself_stops() {
    // The horizontal tip ends 0.3 mm before the vertical crack; its increment exceeds 0.2 mm.
    let wall = slanted(4.45, 6.0, 90.0);
    let near = polyline(&[(0.0, 0.0), (0.5, -2.0), (4.15, -2.0)]);
    assert_eq!(stop_of_first(&[near.clone(), wall.clone()], 0.0), Some(TipStop::Coalescence));
    assert_eq!(stop_of_first(&[near, wall.moved(0.3)], 0.0), None);
    // A hook that turns back on its own faces, and a straight crack of many short segments, which
    // does not.
    let hook = polyline(&[(0.0, 0.0), (0.0, -4.0), (3.0, -4.0), (3.0, -3.0), (0.2, -3.0)]);
    assert_eq!(stop_of_first(&[hook], 0.0), Some(TipStop::Coalescence));
    // Crossing of the own faces 0.15 mm behind the tip.
    let curl = polyline(&[(0.0, 0.0), (0.0, -4.0), (2.0, -4.0), (2.0, -3.95), (1.95, -3.95)]);
    assert_eq!(stop_of_first(std::slice::from_ref(&curl), 90.0), Some(TipStop::Coalescence));
    let short: Vec<(f64, f64)> = (0..=100).map(|i| (0.02 * f64::from(i), -0.02 * f64::from(i))).collect();
    assert_eq!(stop_of_first(&[polyline(&short)], 60.0), None);
}

#[test]
fn tip_at_the_end_of_the_rail_stops() {
    assert_eq!(stop_of_first(&[slanted(145.0, 6.0, 45.0)], 0.0), None);
    assert_eq!(stop_of_first(&[slanted(145.5, 6.0, 45.0)], 0.0), Some(TipStop::LeavesRail));
    assert_eq!(stop_of_first(&[slanted(0.0, 168.0, 90.0)], 0.0), Some(TipStop::LeavesRail));
}

#[test]
fn run_ends_on_steps_length_and_exactly_on_its_cycles() {
    let cracks = [slanted(0.0, 6.0, 30.0)];
    let tips = [drive(0, 0.0, 1e-6)];
    let step = StepState { at: fixtures::at(25, 0.0), ..state(&cracks, &tips) };
    let last = advanced(&step, &SETTINGS);
    assert_eq!(
        (last.stop, last.tips[0].increment, last.progress.cycles),
        (Some(RunStop::StepsDone), 0.0, 0.0)
    );
    let critical = GrowthSettings { critical_length: Some(6.0), ..SETTINGS };
    assert_eq!(advanced(&step, &critical).stop, Some(RunStop::CriticalLength));

    // Growth of 0.24 mm takes 240 000 cycles; 100 000 remain.
    let limited = GrowthSettings { stop_after_cycles: Some(350e3), ..SETTINGS };
    let before = StepState { at: fixtures::at(0, 250e3), ..state(&cracks, &tips) };
    let shortened = advanced(&before, &limited);
    assert_eq!((shortened.progress.cycles, shortened.stop), (100e3, None));
    assert!((shortened.tips[0].increment - 0.1).abs() < ROUNDING);
    let after = StepState { at: fixtures::at(0, 350e3), cracks: &shortened.cracks, ..before };
    assert_eq!(advanced(&after, &limited).stop, Some(RunStop::Cycles));
}

#[test]
fn the_rail_breaks_where_k1_reaches_the_toughness() {
    let cracks = [slanted(0.0, 6.0, 30.0), slanted(20.0, 6.0, 30.0)];
    let settings = GrowthSettings { toughness: Some(900.0), ..SETTINGS };
    let tips = |first: f64, second: f64| {
        [
            TipDrive { largest_k1: first, ..drive(0, 0.0, 1e-6) },
            TipDrive { largest_k1: second, ..drive(1, 0.0, 1e-6) },
        ]
    };
    let next = advanced(&state(&cracks, &tips(899.0, 900.0)), &settings);
    assert_eq!(next.stop, Some(RunStop::Fracture));
    assert_eq!([next.tips[0].stop, next.tips[1].stop], [None, Some(TipStop::Fracture)]);
    assert_eq!(
        (next.progress.cycles, &next.cracks[..], next.stop.map(RunStop::word)),
        (0.0, &cracks[..], Some("fracture"))
    );
    assert_eq!(advanced(&state(&cracks, &tips(899.0, 899.0)), &settings).stop, None);
    assert_eq!(advanced(&state(&cracks, &tips(899.0, 900.0)), &SETTINGS).stop, None);
    let mut spent = tips(1.0, 5000.0);
    spent[1].stopped = Some(TipStop::BreakOut);
    assert_eq!(advanced(&state(&cracks, &spent), &settings).stop, None);
}
