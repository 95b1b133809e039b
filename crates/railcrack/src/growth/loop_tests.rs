//! The loop on a crack whose rate is a function of its length, with lives in closed form.

use super::*;
use crate::crack::{Crack, CrackTip, End};
use crate::interruption::Interruption;
use crate::math::Vec2;

/// A vertical crack with da/dN = `RATE` a^`POWER` `factor` (a), k1 over the toughness `hazard` (a)
/// and the best kink and other directions of `direction` (a).
struct Rule {
    settings: GrowthSettings,
    passages: PassageSettings,
    factor: fn(f64) -> f64,
    hazard: fn(f64) -> f64,
    direction: fn(f64) -> (f64, PlaneTip),
    /// Lengths of all bodies, mm.
    computed: std::cell::RefCell<Vec<f64>>,
}

const RATE: f64 = 1e-6;
const POWER: f64 = 1.7;
const START: f64 = 4.0;

/// N from `START` to `length`.
fn life(length: f64) -> f64 {
    (START.powf(1.0 - POWER) - length.powf(1.0 - POWER)) / ((POWER - 1.0) * RATE)
}

fn crack(length: f64) -> Crack {
    Crack::polyline(vec![Vec2::new(0.0, 0.0), Vec2::new(0.0, -length)]).unwrap()
}

impl Rule {
    fn new(settings: GrowthSettings) -> Self {
        let passages = PassageSettings::default();
        Self {
            settings,
            passages,
            factor: |_| 1.0,
            hazard: |_| 0.0,
            direction: |_| (0.0, PlaneTip::default()),
            computed: Default::default(),
        }
    }

    /// All steps, and the bodies that they took.
    fn run(self) -> (Vec<StepRecord>, usize) {
        let state = GrowthState::initial(&crack(START).into());
        let mut growth = Growth::new(self, state);
        let mut records = Vec::new();
        while let Some(record) = growth.next_step(&Unobserved).unwrap() {
            records.push(record);
        }
        let computed = growth.rail().computed.borrow().len();
        (records, computed)
    }
}

impl CrackedRail for Rule {
    type Body = PlaneGeometry;
    type Site = PlaneGeometry;

    fn settings(&self) -> &GrowthSettings {
        &self.settings
    }

    fn wheels(&self) -> Vec<WheelOfRail<'_>> {
        vec![WheelOfRail { share: 1.0, toughness: None, passages: &self.passages }]
    }

    fn refinement(&self) -> &'static str {
        "nothing"
    }

    fn body(&mut self, state: &GrowthState, _: Interruption<'_>) -> Result<PlaneGeometry, GrowthError> {
        let Geometry::Plane(geometry) = &state.geometry else { unreachable!() };
        self.computed.borrow_mut().push(geometry.cracks[0].length());
        Ok(geometry.clone())
    }

    fn report(&self, _: &PlaneGeometry) -> BodyReport {
        BodyReport::default()
    }

    fn passages(
        &mut self,
        _: &PlaneGeometry,
        _: &StepStart<'_>,
        _: &dyn Observer,
        _: &mut Vec<Warning>,
    ) -> Result<Vec<StabilisedPassage>, GrowthError> {
        Ok(vec![StabilisedPassage {
            passages: Vec::new(),
            histories: Vec::new(),
            faces: FaceRecord { points: Vec::new(), states: Vec::new(), across: None, surface: Vec::new() },
            counts: SolverCounts::default(),
            last_change: None,
            coupling: None,
            delta_kiii: Vec::new(),
        }])
    }

    fn fields(
        &mut self,
        _: &PlaneGeometry,
        _: &StepStart<'_>,
        _: &StabilisedPassage,
    ) -> Result<Option<FieldRecord>, GrowthError> {
        Ok(None)
    }

    fn demands(&self, geometry: &PlaneGeometry, _: &[StabilisedPassage]) -> Vec<TipRecord> {
        let length = geometry.cracks[0].length();
        let (kink, plane) = (self.direction)(length);
        vec![TipRecord {
            tip: CrackTip { crack: 0, tip: 0, end: End::Last },
            x: 0.0,
            y: -length,
            length,
            ki_max: 0.0,
            delta_ki: 0.0,
            delta_kii: 0.0,
            delta_keq: 1.0,
            largest_k1: None,
            kink: Some(kink),
            increment: 0.0,
            rate: RATE * length.powf(POWER) * (self.factor)(length),
            stop: None,
            shares: WheelShares::default(),
            opened_by: 0,
            toughness_ratio: 1.0,
            mouth_sine: Some(1.0),
            geometry: TipGeometry::Plane(plane),
        }]
    }

    fn movers(&self, _: &PlaneGeometry, tips: &[TipRecord]) -> Vec<Mover> {
        vec![Mover { crack: 0, index: 0, rate: tips[0].rate, length: tips[0].length }]
    }

    fn site(&self, body: &PlaneGeometry) -> PlaneGeometry {
        body.clone()
    }

    fn advance(
        &self,
        geometry: &PlaneGeometry,
        at: &StepStart<'_>,
        tips: &mut [TipRecord],
        movers: &[Mover],
    ) -> Advance {
        let wearing = [WearingCrack { mouth_sine: 1.0, longest: at.worn.longest_of(0, tips[0].length) }];
        let moving = Moving { all: movers, growing: movers, some_are_left: true, wearing: &wearing };
        let broken = self.hazard(geometry, &tips[0]) >= 1.0;
        let largest = LargestCracks { breaks: broken, length: tips[0].length, depth: tips[0].depth() };
        let stop = run_stop(&self.settings, at, largest);
        let pace = StepSize::of(&moving, at, &self.settings, 1.0);
        let increment = pace.increment(&movers[0]);
        let mut next = geometry.clone();
        if stop.is_none() {
            next.cracks[0] = crack(tips[0].length + increment - pace.removal);
            tips[0].increment = increment;
            let curvature = self.settings.turning.curvature(tips[0].kink.unwrap_or(0.0));
            if let TipGeometry::Plane(plane) = &mut tips[0].geometry {
                plane.predicted_turn = increment * curvature;
                plane.turn = if plane.jump.is_none() { plane.predicted_turn } else { 0.0 };
            }
        }
        Advance {
            geometry: Geometry::Plane(next),
            pieces: Vec::new(),
            progress: pace.progress(movers, |_| false),
            stop,
            warnings: Vec::new(),
        }
    }

    fn hazard(&self, _: &PlaneGeometry, tip: &TipRecord) -> f64 {
        (self.hazard)(tip.length)
    }

    fn popped_in(&self, _: &PlaneGeometry, _: &[&TipRecord], _: f64) -> Option<Geometry> {
        None
    }
}

fn settings(increment: f64) -> GrowthSettings {
    GrowthSettings { steps: 10_000, increment, critical_length: Some(8.0), ..GrowthSettings::default() }
}

#[test]
fn the_life_is_of_second_order() {
    let error = |increment: f64| {
        let (records, _) = Rule::new(settings(increment)).run();
        let last = records.last().unwrap();
        (last.load_cycles - life(last.tips[0].length)).abs()
    };
    let ratio = error(0.04) / error(0.02);
    assert!((ratio - 4.0).abs() < 0.4, "{ratio}");
}

#[test]
fn chosen_increments_keep_the_tolerance_and_say_so() {
    for tolerance in [1e-2, 1e-3, 1e-4] {
        let chosen = GrowthSettings { tolerance: Some(tolerance), ..settings(0.02) };
        let (records, bodies) = Rule::new(chosen).run();
        let last = records.last().unwrap();
        let exact = life(last.tips[0].length);
        let error = (last.load_cycles / exact - 1.0).abs();
        assert!(error < tolerance, "{tolerance}: {error}");
        assert!(last.cycles_error / exact > error, "{}: {error}", last.cycles_error / exact);
        // Each step is computed once, but for a few.
        assert!(bodies < records.len() + 5, "{bodies} bodies for {} steps", records.len());
    }
}

/// Another direction becomes the best at a length of 7 mm.
#[test]
fn a_kink_is_located_by_the_ratio_of_the_rates() {
    let direction = |length: f64| {
        let (kink, other) = if length < 7.0 { (0.0, 1.0) } else { (1.0, 0.0) };
        let plane = PlaneTip {
            secondary: Some(other),
            secondary_ratio: Some((-(length - 7.0).abs()).exp()),
            jump: (kink > 0.0).then_some(Jump::Kink),
            is_drawn: true,
            ..PlaneTip::default()
        };
        (kink, plane)
    };
    let limited = GrowthSettings { critical_length: Some(7.05), ..settings(0.1) };
    let (records, bodies) = Rule { direction, ..Rule::new(limited) }.run();
    let kinked = records.iter().find(|record| record.tips[0].kink == Some(1.0)).unwrap();
    let off = kinked.load_cycles / life(7.0) - 1.0;
    assert!((0.0..0.01).contains(&off), "{off}");
    assert!(bodies < records.len() + 4, "{bodies} bodies for {} steps", records.len());
}

#[test]
fn the_toughness_is_located_whatever_the_increment() {
    for increment in [0.16, 0.08, 0.04, 0.01] {
        let rule = Rule { hazard: |length| length / 7.3, ..Rule::new(settings(increment)) };
        let (records, _) = rule.run();
        let last = records.last().unwrap();
        assert_eq!(last.stop, Some(RunStop::Fracture));
        let off = last.load_cycles / life(7.3) - 1.0;
        assert!(off.abs() < 1e-2, "{increment}: {off}");
        // The step before is not broken yet, and the record of it has the increment made.
        let before = &records[records.len() - 2];
        assert!(before.tips[0].length < 7.3 && last.tips[0].length >= 7.3);
        let made = last.tips[0].length - before.tips[0].length;
        assert!((before.tips[0].increment - made).abs() < 1e-12);
    }
}

/// Two grindings at given cycles: the tip grows by the rule all the time, by the length that is
/// left.
#[test]
fn grinding_is_of_second_order() {
    let interval = 0.3 * life(8.0);
    let depth = 0.5;
    let exact = {
        let mut length = START;
        for _ in 0..2 {
            length = (length.powf(1.0 - POWER) - (POWER - 1.0) * RATE * interval).powf(1.0 / (1.0 - POWER));
            length -= depth;
        }
        length
    };
    let error = |increment: f64| {
        let grinding = Some(Grinding { depth, interval: Axles(interval), first: None });
        let maintenance = SurfaceRemoval { grinding, ..SurfaceRemoval::NONE };
        let maintained = GrowthSettings {
            maintenance: Some(maintenance),
            stop_after_cycles: Some(2.0 * interval),
            critical_length: None,
            ..settings(increment)
        };
        let (records, _) = Rule::new(maintained).run();
        // The second grinding is due when the cycles are over.
        records.last().unwrap().tips[0].length - depth - exact
    };
    let (coarse, fine) = (error(0.02), error(0.01));
    assert!(coarse.abs() < 5e-4 && (coarse / fine).abs() > 2.8, "{coarse} {fine}");
    // Longer increments are cut where errors would decide on which side of a grinding a size lies.
    for increment in [0.16, 0.08, 0.04] {
        let long = error(increment);
        assert!(long.abs() < 2e-3, "{increment}: {long}");
    }
}

/// N from `START` to `length` at the speed da/dN = `speed` (a), by Simpson's rule in 4000 parts.
fn life_at(speed: impl Fn(f64) -> f64, length: f64) -> f64 {
    let h = (length - START) / 4000.0;
    let at = |i: usize| START + h * i as f64;
    (0..4000).map(|i| 1.0 / speed(at(i)) + 4.0 / speed(at(i) + 0.5 * h) + 1.0 / speed(at(i + 1))).sum::<f64>()
        * h
        / 6.0
}

/// N from `START` to `length` with wear: ∫ da/(da/dN − w).
fn life_under(wear: f64, length: f64) -> f64 {
    life_at(|length| RATE * length.powf(POWER) - wear, length)
}

/// The rate trebles over some hundredths of a millimetre: steps over them are wrong by much of
/// their own cycles and by little of the life, and stand. Without that there are 35 and 60.
#[test]
fn an_abrupt_rate_is_resolved_as_far_as_the_life_depends_on_it() {
    let factor = |length: f64| 1.0 + 2.0 / (1.0 + (-(length - 6.0) / 0.01).exp());
    let exact = life_at(|length| RATE * length.powf(POWER) * factor(length), 8.0);
    for (tolerance, most) in [(1e-2, 28), (1e-3, 44)] {
        let chosen = GrowthSettings { tolerance: Some(tolerance), ..settings(0.02) };
        let (records, bodies) = Rule { factor, ..Rule::new(chosen) }.run();
        let last = records.last().unwrap();
        let off = (last.tips[0].length - 8.0) / last.tips[0].rate;
        let error = ((last.load_cycles - off) / exact - 1.0).abs();
        assert!(error < tolerance, "{tolerance}: {error}");
        // Three rates know of the layer that it lies between them, not where.
        assert!(1.5 * last.cycles_error / exact > error, "{}: {error}", last.cycles_error / exact);
        assert!(bodies <= most, "{tolerance}: {bodies} bodies");
    }
}

/// A step that turns too far is cut before its end is computed, and so is a long one behind a kink.
#[test]
fn steps_that_turn_too_far_are_not_computed() {
    // The best kink over the turning length of 0.5 mm: 0.6 per mm.
    let turns = |_: f64| (0.3, PlaneTip { is_drawn: true, ..PlaneTip::default() });
    let given = GrowthSettings { turning: Turning::Over(0.5), ..settings(0.1) };
    let (records, bodies) = Rule { direction: turns, ..Rule::new(given) }.run();
    assert_eq!(bodies, records.len());
    let turn = |record: &StepRecord| record.tips[0].plane().unwrap().turn;
    assert!(records.iter().all(|record| turn(record) <= 0.05));
    // Steps are as long as that allows.
    let inner = &records[1..records.len() - 2];
    assert!(inner.iter().all(|record| turn(record) > 0.03));

    let kinks = |length: f64| {
        let is_kink = (6.0..6.001).contains(&length);
        let plane = PlaneTip { is_drawn: true, jump: is_kink.then_some(Jump::Kink), ..PlaneTip::default() };
        (if is_kink { 1.0 } else { 0.0 }, plane)
    };
    let chosen = GrowthSettings { tolerance: Some(1e-2), ..settings(0.02) };
    let rule = Rule { direction: kinks, ..Rule::new(chosen) };
    let mut growth = Growth::new(rule, GrowthState::initial(&crack(6.0005).into()));
    growth.next_step(&Unobserved).unwrap().unwrap();
    growth.next_step(&Unobserved).unwrap().unwrap();
    let computed = growth.rail().computed.borrow();
    assert_eq!(computed.len(), 3);
    assert!(computed.windows(2).all(|pair| pair[1] - pair[0] < 0.0081 * pair[0]), "{computed:?}");
}

/// Wear of `part` of the growth at the start until the crack is `length` mm long, near balance too.
#[test]
fn chosen_increments_under_wear_stay_bounded_and_right() {
    let first = RATE * START.powf(POWER);
    for (part, length) in
        [(0.5, 8.0), (0.9, 8.0), (0.98, 8.0), (0.999, 8.0), (1.02, 2.0), (1.25, 2.0), (4.0, 2.0)]
    {
        let wear = part * first;
        let exact = life_under(wear, length);
        for (tolerance, most) in [(1e-2, 60), (1e-3, 100)] {
            let maintenance = SurfaceRemoval { wear, ..SurfaceRemoval::NONE };
            let maintained = GrowthSettings {
                maintenance: Some(maintenance),
                tolerance: Some(tolerance),
                stop_after_cycles: Some(exact),
                critical_length: None,
                ..settings(0.02)
            };
            let (records, bodies) = Rule::new(maintained).run();
            let last = records.last().unwrap();
            let reached = last.tips[0].length;
            // The error of the length, as cycles at the speed at the end.
            let speed = (RATE * length.powf(POWER) - wear).abs();
            let error = (reached - length).abs() / speed / exact;
            assert!(bodies <= most, "{part} {tolerance}: {bodies}");
            assert!(error <= tolerance.max(last.cycles_error / exact), "{part} {tolerance}: {error}");
        }
    }
}

#[test]
fn a_run_in_two_parts_is_the_run() {
    let chosen = || GrowthSettings { tolerance: Some(1e-2), ..settings(0.02) };
    let (whole, _) = Rule::new(chosen()).run();
    let mut growth = Growth::new(Rule::new(chosen()), GrowthState::initial(&crack(START).into()));
    for want in &whole {
        let record = growth.next_step(&Unobserved).unwrap().unwrap();
        assert_eq!((record.load_cycles, &record.geometry), (want.load_cycles, &want.geometry));
        assert_eq!(
            (record.cycles_error, record.tips[0].increment),
            (want.cycles_error, want.tips[0].increment)
        );
        let state = growth.state().clone();
        growth = Growth::new(Rule::new(chosen()), state);
    }
}
