//! Wear and grinding against the equation of the length, and runs that go on where they stopped.

use crate::common::{steel, surface_crack};
use railcrack::dislocation::{DislocationEngine, FaceResolution};
use railcrack::fatigue::DirectionCriterion;
use railcrack::field::{DepthProfile, HertzWheel};
use railcrack::growth::{
    Axles, Grinding, Growth, GrowthSettings, GrowthState, RunStop, StepRecord, StressMoves, SurfaceRemoval,
    TipStop, Unobserved,
};
use railcrack::load::HertzianContact;
use railcrack::plane::{KnownRail, KnownStraight, PlaneRail};
use std::sync::Arc;

/// A crack of 6 mm at 30° that goes straight on under a driven wheel.
fn problem(maintenance: Option<SurfaceRemoval<Axles>>, steps: usize, increment: f64) -> PlaneRail {
    let contact = HertzianContact { peak_pressure: 845.0, half_width: 6.75, friction: 0.3 };
    let engine = DislocationEngine { steel: steel(), resolution: FaceResolution::default() };
    let wheel = HertzWheel::new(&contact, &steel()).unwrap();
    let mut problem = PlaneRail::new(engine, wheel, vec![0.3]);
    problem.growth = GrowthSettings {
        steps,
        increment,
        criterion: DirectionCriterion::Coplanar,
        maintenance,
        ..GrowthSettings::default()
    };
    problem
}

fn run(problem: PlaneRail) -> Vec<StepRecord> {
    let mut growth = Growth::new(problem, GrowthState::initial(&surface_crack(0.0, 6.0, 30.0).into()));
    std::iter::from_fn(|| growth.next_step(&Unobserved).unwrap()).collect()
}

fn wear(rate: f64) -> SurfaceRemoval<Axles> {
    SurfaceRemoval { wear: rate, stress: StressMoves::WithSurface, ..SurfaceRemoval::NONE }
}

/// Cycles until the length is `length`, linear between steps.
fn cycles_at(steps: &[StepRecord], length: f64) -> f64 {
    let of = |step: &StepRecord| step.tips[0].length;
    let pair = steps.windows(2).find(|pair| (of(&pair[0]) - length) * (of(&pair[1]) - length) <= 0.0);
    let [a, b] = pair.expect("the length is passed") else { unreachable!() };
    a.load_cycles + (length - of(a)) / (of(b) - of(a)) * (b.load_cycles - a.load_cycles)
}

/// da/dN (mm per cycle) by length (mm), from a run without wear over the lengths of the tests.
fn rates() -> impl Fn(f64) -> f64 {
    let from = surface_crack(0.0, 3.0, 30.0);
    let mut growth = Growth::new(problem(None, 30, 0.04), GrowthState::initial(&from.into()));
    let steps: Vec<StepRecord> = std::iter::from_fn(|| growth.next_step(&Unobserved).unwrap()).collect();
    let points: Vec<(f64, f64)> =
        steps.iter().map(|step| (step.tips[0].length.ln(), step.tips[0].rate.ln())).collect();
    move |length: f64| {
        let x = length.ln();
        let i = points.partition_point(|point| point.0 < x).clamp(1, points.len() - 1);
        let ((a, from), (b, to)) = (points[i - 1], points[i]);
        (from + (x - a) / (b - a) * (to - from)).exp()
    }
}

/// dl/dN = da/dN − w/sin θ by small steps: the straight crack is the same one wherever its mouth
/// is.
fn integrated(rate: &impl Fn(f64) -> f64, loss: f64, to: f64) -> f64 {
    let steps = 4000;
    let d = (to - 6.0) / f64::from(steps);
    (0..steps).map(|i| d / (rate(6.0 + (f64::from(i) + 0.5) * d) - loss)).sum()
}

#[test]
fn length_follows_growth_less_wear() {
    let rate = rates();
    let first = rate(6.0);
    // A third of the growth is worn away at first; then four times the growth.
    for (share, to) in [(1.0 / 3.0, 8.0), (4.0, 4.0)] {
        let loss = share * first;
        let steps = run(problem(Some(wear(0.5 * loss)), 40, 0.04));
        let (cycles, want) = (cycles_at(&steps, to), integrated(&rate, loss, to));
        println!("wear of {share:.2} times the growth: {cycles:.0} cycles, {want:.0} by integration");
        // Growth that waits for a whole segment makes K that of a crack shorter by up to 4 %, so
        // that rates are up to 7 % low where wear takes more than grows.
        let tolerance = if share < 1.0 { 0.005 } else { 0.02 };
        assert!((cycles / want - 1.0).abs() < tolerance, "{cycles} {want}");
    }
}

#[test]
fn runs_that_share_what_they_know_of_a_crack_repeat_those_that_compute_it() {
    let rate = rates();
    let first = rate(6.0);
    let crack = surface_crack(0.0, 6.0, 30.0);
    let network = crack.clone().into();
    let steps = |rail: PlaneRail| {
        let known = Arc::new(KnownStraight::of(&network, &rail.growth).unwrap());
        let mut growth = Growth::new(KnownRail::new(rail, known), GrowthState::initial(&network));
        std::iter::from_fn(move || growth.next_step(&Unobserved).unwrap()).collect::<Vec<StepRecord>>()
    };
    let shared = |maintenance, count, increment| steps(problem(maintenance, count, increment));
    // No length of the run is one of those at which K was computed.
    for (own, step) in run(problem(None, 12, 0.043)).iter().zip(shared(None, 12, 0.043)) {
        let (own, tip) = (&own.tips[0], &step.tips[0]);
        let close = |a: f64, b: f64, tolerance: f64| (a / b - 1.0).abs() < tolerance;
        assert!(close(tip.length, own.length, 1e-12), "{} {}", tip.length, own.length);
        assert!(close(tip.delta_kii, own.delta_kii, 1e-3), "{} {}", tip.delta_kii, own.delta_kii);
        assert!(close(tip.rate, own.rate, 3e-3), "{} {}", tip.rate, own.rate);
    }
    // As above, of lengths with the growth that is not drawn yet.
    for (share, to) in [(1.0 / 3.0, 8.0), (4.0, 4.0)] {
        let loss = share * first;
        let (cycles, want) =
            (cycles_at(&shared(Some(wear(0.5 * loss)), 40, 0.04), to), integrated(&rate, loss, to));
        println!("wear of {share:.2} times the growth: {cycles:.0} cycles, {want:.0} by integration");
        assert!((cycles / want - 1.0).abs() < 2e-3, "{cycles} {want}");
    }
    // Straight ahead to a depth of 3.3 mm only: from there on everything is computed.
    let turning = || {
        let mut rail = problem(None, 200, 0.04);
        rail.growth.criterion = DirectionCriterion::MaxRate;
        rail.growth.straight_depth = 3.3;
        rail.growth.tolerance = Some(0.01);
        rail.growth.critical_length = Some(9.0);
        rail
    };
    let [own, shared] = [run(turning()), steps(turning())];
    let [own_end, end] = [&own, &shared].map(|steps| steps.last().unwrap());
    assert!(own.len().abs_diff(shared.len()) < 3, "{} {}", own.len(), shared.len());
    assert!((end.load_cycles / own_end.load_cycles - 1.0).abs() < 5e-3, "{own_end:?} {end:?}");
    let [own_tip, tip] = [own_end, end].map(|step| &step.tips[0]);
    assert!((own_tip.x - tip.x).hypot(own_tip.y - tip.y) < 0.02, "{own_tip:?} {tip:?}");
    assert!(shared.iter().any(|step| step.dofs == 0 && step.tips[0].depth() < 3.3));
}

#[test]
fn in_the_balance_the_length_stays_and_the_surface_comes_down() {
    let first = run(problem(None, 0, 0.04))[0].tips[0].rate;
    let steps = run(problem(Some(wear(0.5 * first)), 4, 0.04));
    let last = steps.last().unwrap();
    // The step tolerance of K decides how far it drifts.
    assert!((last.tips[0].length - 6.0).abs() < 0.02, "{}", last.tips[0].length);
    let removed = 0.5 * first * last.load_cycles;
    assert!((last.removed / removed - 1.0).abs() < 1e-2, "{} {removed}", last.removed);
    assert!((last.tips[0].y + 3.0).abs() < 0.01 && last.cracks()[0].points()[0].y == 0.0);
}

#[test]
fn the_run_ends_when_the_rail_is_worn_to_its_limit() {
    let first = run(problem(None, 0, 0.04))[0].tips[0].rate;
    let rate = 0.5 * first;
    // A removal of 1.03 mm: by wear alone, by wear after two grindings, by the third grinding.
    let plans = [(None, 1.03), (Some((0.3, 0.2)), 1.03 - 2.0 * 0.3), (Some((0.3, 0.1)), 3.0 * 0.1)];
    for (ground, worn) in plans {
        let want = worn / rate;
        let grinding =
            ground.map(|(depth, worn)| Grinding { depth, interval: Axles(worn / rate), first: None });
        let limited = SurfaceRemoval { grinding, limit: Some(1.03), ..wear(rate) };
        let steps = run(problem(Some(limited), 200, 0.04));
        let last = steps.last().unwrap();
        assert_eq!((last.stop, last.tips[0].stop), (Some(RunStop::WearLimit), None));
        assert!((last.load_cycles / want - 1.0).abs() < 1e-9, "{ground:?}: {} {want}", last.load_cycles);
        assert!(last.removed > 1.03 * (1.0 - 1e-9) && last.removed < 1.03 + 0.3, "{}", last.removed);
    }
}

#[test]
fn grinding_wears_the_crack_away_at_last_and_a_resumed_run_is_the_same() {
    let first = run(problem(None, 0, 0.04))[0].tips[0].rate;
    // Every 0.5 mm of growth, 0.8 mm in depth: 1.6 mm of length.
    let grinding = Grinding { depth: 0.8, interval: Axles(0.5 / first), first: None };
    let maintained = || {
        let all = SurfaceRemoval { grinding: Some(grinding), ..SurfaceRemoval::NONE };
        let mut problem = problem(Some(all), 40, 0.04);
        let rows = vec![(0.0, -50.0, 0.0), (2.0, 20.0, 0.0), (6.0, 0.0, 0.0)];
        problem.wheels[0].residual = Some(Box::new(DepthProfile::new(rows).unwrap()));
        problem
    };
    let whole = run(maintained());
    let last = whole.last().unwrap();
    assert_eq!(last.stop, Some(RunStop::NoTipGrows(TipStop::WornAway)));
    assert_eq!(last.tips[0].stop, Some(TipStop::WornAway));
    let ground: Vec<f64> = whole.iter().map(|step| step.removed / 0.8).collect();
    assert!(ground.iter().all(|times| (times - times.round()).abs() < 1e-9), "{ground:?}");
    let after = whole.iter().find(|step| step.removed > 0.0).unwrap();
    assert!((after.load_cycles / grinding.interval.0 - 1.0).abs() < 1e-12, "at its interval");

    let mut growth = Growth::new(maintained(), GrowthState::initial(&surface_crack(0.0, 6.0, 30.0).into()));
    let mut state = growth.state().clone();
    for want in &whole {
        let got = growth.next_step(&Unobserved).unwrap().unwrap();
        let same = (got.load_cycles, got.removed, got.cracks(), got.tips[0].rate, got.tips[0].increment);
        assert_eq!(
            same,
            (want.load_cycles, want.removed, want.cracks(), want.tips[0].rate, want.tips[0].increment)
        );
        state.clone_from(growth.state());
        growth = Growth::new(maintained(), state.clone());
    }
    assert_eq!(state.ended, last.stop);
}

/// Compression of a layer that stays in the steel is worn off, one that moves with the surface is
/// not.
#[test]
fn residual_stress_stays_in_the_steel_or_moves_with_the_surface() {
    let rates = [StressMoves::WithMetal, StressMoves::WithSurface].map(|stress| {
        let grinding = Grinding { depth: 1.0, interval: Axles(1.0), first: None };
        let mut problem = problem(
            Some(SurfaceRemoval { grinding: Some(grinding), stress, ..SurfaceRemoval::NONE }),
            2,
            0.04,
        );
        let rows = vec![(0.0, -300.0, 0.0), (1.0, -300.0, 0.0), (1.001, 0.0, 0.0)];
        problem.wheels[0].residual = Some(Box::new(DepthProfile::new(rows).unwrap()));
        run(problem).remove(2).tips[0].rate
    });
    let [metal, surface] = rates;
    let mut bare = problem(None, 0, 0.04);
    bare.growth.steps = 0;
    let mut growth = Growth::new(bare, GrowthState::initial(&surface_crack(0.0, 4.0, 30.0).into()));
    let without = growth.next_step(&Unobserved).unwrap().unwrap().tips[0].rate;
    // The layer is gone and the crack of 6 mm is one of 4 mm: the mouth moved, nothing else.
    assert!((metal / without - 1.0).abs() < 0.01, "{metal} {without}");
    assert!(surface < 0.9 * metal, "{surface} {metal}");
}
