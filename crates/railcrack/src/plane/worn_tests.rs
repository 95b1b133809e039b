//! Cracks shortened at their mouths.

use super::*;
use crate::crack::{CrackTip, End};
use crate::growth::{
    Axles, EarlierStep, Grinding, GrowthSettings, Mover, RunStop, StepStart, SurfaceRemoval, TipStop,
    Turning, WornSurface,
};
use crate::plane::fixtures::{self, SETTINGS, advanced, at, crack, state};
use crate::plane::step_state::{StepState, TipDrive};

const ROUNDING: f64 = 1e-13;

fn left(worn: Worn) -> (Crack, [bool; 2]) {
    match worn {
        Worn::Left { crack, broken_out } => (crack, broken_out),
        Worn::Away(stub) => panic!("worn away to {stub:?}"),
    }
}

#[test]
fn the_mouth_moves_down_along_the_path() {
    // Two segments in the ratio 3-4-5: a depth of 2 mm removes all of the first segment and 5/16 of
    // the second.
    let bent = crack(&[(0.0, 0.0), (4.0, -1.5), (7.0, -5.5)]);
    let (cut, broken) = left(worn(&bent, 2.0, 0.0, 10.0, 0.01));
    let want = [(4.375, 0.0), (7.0, -3.5)];
    assert_eq!(cut.points().len(), 2);
    for (got, want) in cut.points().iter().zip(want) {
        assert!((*got - Vec2::new(want.0, want.1)).length() < ROUNDING, "{cut:?}");
    }
    assert!(cut.is_surface_breaking() && broken == [false, false]);
    assert!((mouth_sine(&cut).unwrap() - 0.8).abs() < ROUNDING);
    // A remainder of the first segment that no engine resolves is dropped.
    let (cut, _) = left(worn(&bent, 1.499, 0.0, 10.0, 0.01));
    assert_eq!(cut.points().len(), 2);
}

#[test]
fn a_tip_that_the_surface_reaches_has_broken_out_and_a_buried_crack_stays_below() {
    let rising = crack(&[(0.0, 0.0), (4.0, -3.0), (8.0, -1.0)]);
    let (cut, broken) = left(worn(&rising, 1.5, 0.0, 9.0, 0.01));
    assert_eq!(broken, [false, true]);
    let last = cut.tip(End::Last);
    assert!((last.y + 0.01 * rising.length()).abs() < ROUNDING, "a ligament stays: {last:?}");
    let buried = crack(&[(0.0, -1.0), (4.0, -3.0)]);
    let (cut, broken) = left(worn(&buried, 1.5, 0.0, 5.0, 0.01));
    assert!(broken == [true, false] && !cut.is_surface_breaking());
    assert!((cut.tip(End::Last).y + 1.5).abs() < ROUNDING);
}

#[test]
fn short_and_shallow_rests_are_worn_away() {
    let straight = crack(&[(0.0, 0.0), (4.0, -3.0)]);
    assert!(matches!(worn(&straight, 2.8, 0.0, 5.0, 0.01), Worn::Left { .. }));
    assert!(matches!(worn(&straight, 2.9, 0.0, 5.0, 0.01), Worn::Away(_)), "5 % of the longest");
    assert!(matches!(worn(&straight, 2.9, 0.5, 5.0, 0.01), Worn::Left { .. }), "deferred growth counts");
    assert!(matches!(worn(&straight, 3.5, 0.0, 5.0, 0.01), Worn::Away(_)));
    let flat = crack(&[(0.0, 0.0), (4.0, -1.0), (8.0, -1.0)]);
    assert!(matches!(worn(&flat, 0.95, 0.0, 8.0, 0.01), Worn::Away(_)), "a flap thinner than a ligament");
}

fn drive(rate: f64) -> TipDrive {
    fixtures::tip(0, 0.0, rate)
}

/// The first step after 1e5 load cycles.
fn due<'a>(cracks: &'a [Crack], tips: &'a [TipDrive]) -> StepState<'a> {
    StepState { at: at(0, 1e5), ..state(cracks, tips, 0.01) }
}

fn maintained(wear: f64, grinding: Option<Grinding<Axles>>) -> GrowthSettings {
    let maintenance = SurfaceRemoval { wear, grinding, ..SurfaceRemoval::NONE };
    GrowthSettings { maintenance: Some(maintenance), turning: Turning::Over(1.0), ..SETTINGS }
}

/// 5 mm at 3 in 5 below the surface.
fn crack_of_five() -> [Crack; 1] {
    [crack(&[(0.0, 0.0), (4.0, -3.0)])]
}

#[test]
fn in_the_balance_the_length_stays() {
    let (cracks, tips) = (crack_of_five(), [drive(1e-6)]);
    // w = sin θ da/dN.
    let next = advanced(&state(&cracks, &tips, 0.01), &maintained(0.6e-6, None));
    assert!((next.cracks[0].length() - 5.0).abs() < ROUNDING, "{next:?}");
    assert!((next.progress.cycles - 2e5).abs() < 1e-8 && (next.progress.removal - 0.12).abs() < ROUNDING);
    assert!((next.tips[0].increment - 0.2).abs() < ROUNDING);
    // At half the wear, the crack grows by half as much.
    let next = advanced(&state(&cracks, &tips, 0.01), &maintained(0.3e-6, None));
    assert!((next.cracks[0].length() - 5.1).abs() < ROUNDING, "{next:?}");
}

#[test]
fn wear_that_takes_more_than_grows_sets_the_pace() {
    let (cracks, tips) = (crack_of_five(), [drive(1e-6)]);
    let next = advanced(&state(&cracks, &tips, 0.01), &maintained(2.4e-6, None));
    assert!(
        (next.progress.removal - 0.12).abs() < ROUNDING && (next.progress.cycles - 5e4).abs() < 1e-8,
        "{next:?}"
    );
    assert!(next.progress.interval.unwrap().is_settled && (next.tips[0].increment - 0.05).abs() < ROUNDING);
    // The growth is too short for a segment and is deferred.
    let length = next.cracks[0].length() + next.tips[0].deferred.length;
    assert!((length - (5.0 - 0.2 + 0.05)).abs() < ROUNDING, "{next:?}");
    // A tip at rest is not stopped for good, since the surface comes closer.
    let at_rest = advanced(&state(&cracks, &[drive(0.0)], 0.01), &maintained(2.4e-6, None));
    assert!(at_rest.stop.is_none() && at_rest.tips[0].stop.is_none());
    assert!(
        (at_rest.progress.removal - 0.12).abs() < ROUNDING
            && at_rest.progress.interval.unwrap().cycles == next.progress.cycles
    );
    // Increments that follow from cycles use the line through two rates.
    let earlier = EarlierStep {
        movers: vec![Mover { crack: 0, index: 0, rate: 1.2e-6, length: 5.0 }],
        balance: vec![-1.1e-6 * 5e4],
        growth: vec![0.0],
        cycles: 5e4,
        leader: None,
        is_extrapolated: false,
        is_smooth: true,
    };
    let surface = WornSurface { longest: vec![5.0], ..WornSurface::default() };
    let start = StepStart { worn: &surface, earlier: Some(&earlier), passed: 5e4, ..at(0, 0.0) };
    let slower = StepState { at: start, ..state(&cracks, &tips, 0.01) };
    let next = advanced(&slower, &maintained(2.4e-6, None));
    assert!((next.tips[0].increment - 0.9e-6 * 5e4).abs() < ROUNDING, "{next:?}");
}

#[test]
fn grinding_takes_its_depth_at_its_interval() {
    let (cracks, tips) = (crack_of_five(), [drive(1e-6)]);
    let settings = maintained(0.0, Some(Grinding { depth: 0.3, interval: Axles(2.5e5), first: None }));
    let first = advanced(&state(&cracks, &tips, 0.01), &settings);
    assert!(
        !first.progress.ground && first.progress.removal == 0.0 && (first.progress.cycles - 2e5).abs() < 1e-8
    );
    let surface = WornSurface { longest: vec![5.0], ..WornSurface::default() };
    let second = StepState { at: StepStart { worn: &surface, ..at(0, 2e5) }, ..state(&cracks, &tips, 0.01) };
    let second = advanced(&second, &settings);
    assert!(
        !second.progress.ground
            && (second.progress.cycles - 5e4).abs() < 1e-8
            && second.progress.removal == 0.0,
        "{second:?}"
    );
    // The grinding is a step of no cycles: rates are known on both sides of it.
    let due = StepState { at: StepStart { worn: &surface, ..at(0, 2.5e5) }, ..state(&cracks, &tips, 0.01) };
    let due = advanced(&due, &settings);
    assert!(
        due.progress.ground && due.progress.cycles == 0.0 && (due.progress.removal - 0.3).abs() < ROUNDING,
        "{due:?}"
    );
    assert!((due.cracks[0].length() - (5.0 - 0.5)).abs() < ROUNDING, "{due:?}");
    // The next grinding counts from there.
    let surface = WornSurface { removed: 0.3, grindings: 1, ..surface };
    let third = StepState { at: StepStart { worn: &surface, ..at(0, 2.5e5) }, ..state(&cracks, &tips, 0.01) };
    let third = advanced(&third, &settings);
    assert!(!third.progress.ground && third.progress.removal == 0.0);
}

#[test]
fn a_crack_that_is_worn_away_ends_the_run_and_others_go_on_without_it() {
    let (cracks, tips) = (crack_of_five(), [drive(1e-6)]);
    let deep = maintained(0.0, Some(Grinding { depth: 3.1, interval: Axles(1e5), first: None }));
    let next = advanced(&due(&cracks, &tips), &deep);
    assert_eq!(next.stop, Some(RunStop::NoTipGrows(TipStop::WornAway)));
    assert_eq!(next.tips[0].stop, Some(TipStop::WornAway));
    assert_eq!(next.cracks, cracks);

    let both = [cracks[0].clone(), crack(&[(30.0, 0.0), (30.0, -6.0)])];
    let other = TipDrive { tip: CrackTip { crack: 1, tip: 0, end: End::Last }, ..drive(1e-6) };
    let next = advanced(&due(&both, &[tips[0], other]), &deep);
    assert_eq!((next.stop, next.tips[0].stop, next.tips[1].stop), (None, Some(TipStop::WornAway), None));
    assert!((next.cracks[1].length() - (6.0 - 3.1)).abs() < ROUNDING, "{next:?}");
    assert!((next.cracks[0].length() - 0.25).abs() < ROUNDING, "{next:?}");
    let stopped = TipDrive { stopped: Some(TipStop::WornAway), ..tips[0] };
    let surface = WornSurface { removed: 3.1, grindings: 1, longest: vec![5.0, 6.0] };
    let later = [stopped, other];
    let later =
        StepState { at: StepStart { worn: &surface, ..at(0, 1e5) }, ..state(&next.cracks, &later, 0.01) };
    let last = advanced(&later, &deep);
    assert_eq!(last.cracks[0], next.cracks[0], "its stub stays as it is");
}

#[test]
fn a_surface_that_comes_down_to_a_junction_ends_the_run() {
    let cracks = [crack(&[(0.0, 0.0), (2.0, -2.0), (4.0, -4.0)]), crack(&[(6.0, -5.0), (2.0, -2.0)])];
    let junctions = [Junction { joining: crate::crack::CrackEnd { crack: 1, end: End::Last }, onto: 0 }];
    let tips = [drive(1e-6)];
    let joined = StepState { junctions: &junctions, ..due(&cracks, &tips) };
    let deep = |depth| maintained(0.0, Some(Grinding { depth, interval: Axles(1e5), first: None }));
    assert_eq!(advanced(&joined, &deep(1.5)).stop, None);
    assert_eq!(advanced(&joined, &deep(2.5)).stop, Some(RunStop::Detached));
}
