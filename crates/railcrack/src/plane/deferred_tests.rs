//! Growth of slow tips, deferred until it makes a segment.

use super::*;
use crate::crack::{CrackTip, End};
use crate::growth::{Jump, Turning};
use crate::plane::fixtures::{self, advanced, crack};

const SETTINGS: GrowthSettings = GrowthSettings { steps: 1000, arrest_rate: 1e-12, ..fixtures::SETTINGS };
/// Length that the engine resolves, mm.
const RESOLUTION: f64 = 0.02;
/// Round-off of a run of a few dozen steps.
const ROUNDING: f64 = 1e-12;

/// Two vertical cracks, of 6 mm at x = −40 and of 2 mm at x = 0.
fn pair() -> Vec<Crack> {
    vec![crack(&[(-40.0, 0.0), (-40.0, -6.0)]), crack(&[(0.0, 0.0), (0.0, -2.0)])]
}

/// A run of cracks from the surface.
struct Run {
    settings: GrowthSettings,
    step: usize,
    cracks: Vec<Crack>,
    deferred: Vec<DeferredGrowth>,
    cycles: f64,
    stop: Option<RunStop>,
}

impl Run {
    fn new(cracks: Vec<Crack>, settings: GrowthSettings) -> Self {
        let deferred = vec![DeferredGrowth::default(); cracks.len()];
        Self { settings, step: 0, cracks, deferred, cycles: 0.0, stop: None }
    }

    /// One step in which crack i kinks by `kinks[i]` (radians) and grows at `rates[i]`. Where paths
    /// turn over a length, kinks of more than 1 are whole ones.
    fn grow(&mut self, kinks: [f64; 2], rates: [f64; 2]) -> PlaneAdvance {
        let drive = |crack: usize| TipDrive {
            deferred: self.deferred[crack],
            jump: (kinks[crack].abs() > 1.0).then_some(Jump::Kink),
            ..fixtures::tip(crack, kinks[crack], rates[crack])
        };
        let tips = [drive(0), drive(1)];
        let state = StepState {
            at: fixtures::at(self.step, self.cycles),
            ..fixtures::state(&self.cracks, &tips, RESOLUTION)
        };
        let next = advanced(&state, &self.settings);
        self.step += 1;
        self.cracks.clone_from(&next.cracks);
        self.deferred = next.tips.iter().map(|tip| tip.deferred).collect();
        self.cycles += next.progress.cycles;
        self.stop = next.stop;
        next
    }

    fn length(&self, crack: usize) -> f64 {
        self.cracks[crack].length() + self.deferred[crack].length
    }

    /// Position of the tip of crack `crack`, including its deferred growth.
    fn tip(&self, crack: usize) -> Vec2 {
        self.cracks[crack].tip(End::Last) + self.deferred[crack].direction * self.deferred[crack].length
    }
}

/// However small its growth per step, a tip grows by its rate times the cycles, in resolved
/// segments.
#[test]
fn a_slow_tip_grows_by_its_rate() {
    for ratio in [0.013, 0.05, 0.1, 0.2] {
        let mut run = Run::new(pair(), SETTINGS);
        let (mut grown, mut waited) = (0.0, 0);
        for step in 0..25 {
            // It becomes faster by half and turns slightly.
            let rate = 1e-6 * ratio * (1.0 + f64::from(step) / 120.0);
            let next = run.grow([0.0, 0.01], [1e-6, rate]);
            grown += rate * next.progress.cycles;
            waited += usize::from(run.deferred[1].length > 0.0);
            assert!((run.length(1) - 2.0 - grown).abs() < ROUNDING, "{ratio}, step {step}");
        }
        assert!(waited > 2, "{ratio}: {waited}");
        let points = &run.cracks[1].points()[1..];
        for segment in points.windows(2).map(|p| (p[1] - p[0]).length()) {
            // Towards the end the faster tips keep pace. The crack is at least as long as at the
            // beginning.
            assert!(
                segment > DeferredGrowth::KEEPS_PACE * SETTINGS.increment * 2.0 - ROUNDING,
                "{ratio}: {segment}"
            );
        }
    }
}

/// The fastest tip, and those that are nearly as fast relative to the length of their cracks, make
/// each increment at once.
#[test]
fn fast_tips_are_not_deferred() {
    for [first, second] in [[1.0, 0.67 / 3.0], [0.5, 0.2], [0.3, 1.0]] {
        let mut run = Run::new(pair(), SETTINGS);
        let increments = run.grow([0.1, -0.2], [1e-6 * first, 1e-6 * second]);
        for i in 0..2 {
            let start = pair()[i].clone();
            let [tip, to] = [start.tip(End::Last), run.cracks[i].tip(End::Last)];
            let direction = Vec2::unit(start.ahead(End::Last).angle() + [0.1, -0.2][i]);
            let deferred = i == 0 && first < second;
            let want = if deferred { tip } else { tip + direction * increments.tips[i].increment };
            assert_eq!((to, run.deferred[i].length > 0.0), (want, deferred), "{first} {second} crack {i}");
        }
    }
}

/// A slow tip whose path bends and whose rate rises with its length: position and length after the
/// same cycles converge to those of the closed form, to first order in the increment, like steps
/// without deferred growth.
#[test]
fn paths_converge_with_the_increment() {
    // dL/dN = r (1 + g (L − 2)); the direction turns by L − 2 over a radius of 3 mm.
    const RATE: f64 = 5e-8;
    const GAIN: f64 = 0.3;
    const RADIUS: f64 = 3.0;
    const CYCLES: f64 = 1.2e7;
    let grown = ((GAIN * RATE * CYCLES).exp() - 1.0) / GAIN;
    let turn = grown / RADIUS;
    let at = Vec2::new(RADIUS * (1.0 - turn.cos()), -2.0 - RADIUS * turn.sin());
    let errors = [0.04, 0.02, 0.01].map(|increment| {
        let settings = GrowthSettings { increment, stop_after_cycles: Some(CYCLES), ..SETTINGS };
        let mut run = Run::new(pair(), settings);
        while run.stop.is_none() {
            // The passage sees the crack without its deferred growth.
            let length = run.cracks[1].length() - 2.0;
            let heading = run.cracks[1].ahead(End::Last).angle() + std::f64::consts::FRAC_PI_2;
            let first = 1e-6 * run.cracks[0].length() / 6.0;
            run.grow([0.0, length / RADIUS - heading], [first, RATE * (1.0 + GAIN * length)]);
        }
        assert_eq!(run.stop, Some(RunStop::Cycles));
        [(run.tip(1) - at).length(), (run.length(1) - 2.0 - grown).abs()]
    });
    println!("{errors:?} of {grown} mm");
    for i in 0..2 {
        assert!(errors[0][i] < 0.05 * grown, "{errors:?}");
        for [coarse, fine] in [[errors[0][i], errors[1][i]], [errors[1][i], errors[2][i]]] {
            assert!((1.5..2.8).contains(&(coarse / fine)), "first order: {errors:?}");
        }
    }
}

/// Deferred growth keeps to the branch on which it began, and its length counts irrespective of
/// direction.
#[test]
fn a_tip_between_two_branches_takes_the_first() {
    let mut run = Run::new(pair(), SETTINGS);
    let mut grown = 0.0;
    for step in 0..40 {
        let kink = if step % 3 == 0 { -1.2 } else { 1.2 };
        grown += run.grow([0.0, kink], [1e-6, 1e-8]).tips[1].increment;
        if run.cracks[1].segment_count() == 2 {
            break;
        }
    }
    let (from, to) = run.cracks[1].segment(1);
    let down = -std::f64::consts::FRAC_PI_2;
    assert!(((to - from) - Vec2::unit(down - 1.2) * grown).length() < ROUNDING, "{from:?} {to:?}");
    assert_eq!(run.deferred[1], DeferredGrowth::default());
}

/// Where paths turn over a length, a slow tip that kinks lags by less than 0.8 % of its length,
/// however long the increments of the fastest tip are.
#[test]
fn a_kink_of_a_slow_tip_is_drawn_early_where_paths_turn() {
    let settings = GrowthSettings { turning: Turning::Over(0.5), ..SETTINGS };
    let mut run = Run::new(pair(), settings);
    let mut last = 0.0;
    while run.cracks[1].segment_count() == 1 {
        assert!(run.deferred[1].length < DeferredGrowth::LEAST_KINKED * 2.0);
        last = run.grow([0.0, 1.2], [1e-6, 2e-9]).tips[1].increment;
    }
    let (from, to) = run.cracks[1].segment(1);
    let drawn = (to - from).length();
    assert!(last > 0.0 && drawn < DeferredGrowth::LEAST_KINKED * 2.0 + last, "{drawn} {last}");
    assert!(((to - from).angle() + std::f64::consts::FRAC_PI_2 - 1.2).abs() < ROUNDING, "{from:?} {to:?}");
}

fn slow(crack: usize, kink: f64, rate: f64, deferred: DeferredGrowth) -> TipDrive {
    TipDrive { deferred, ..fixtures::tip(crack, kink, rate) }
}

/// The step of `cracks`; the last one is far from the others and sets the pace with 1e-6 mm per
/// cycle.
fn next(mut cracks: Vec<Crack>, mut tips: Vec<TipDrive>) -> PlaneAdvance {
    tips.push(slow(cracks.len(), 0.0, 1e-6, DeferredGrowth::default()));
    cracks.push(crack(&[(100.0, 0.0), (100.0, -6.0)]));
    let state = StepState { at: fixtures::at(3, 0.0), ..fixtures::state(&cracks, &tips, RESOLUTION) };
    advanced(&state, &SETTINGS)
}

/// 5.5 mm to a tip at (0, −4), to the right. It grows by 0.02 mm; a full increment is 0.22 mm.
fn shelf() -> Crack {
    crack(&[(-1.5, 0.0), (-1.5, -4.0), (0.0, -4.0)])
}

const RIGHT: DeferredGrowth =
    DeferredGrowth { length: 0.1, direction: Vec2 { x: 1.0, y: 0.0 }, is_kinked: true };
const SLOW: f64 = 0.02 / 0.24 * 1e-6;

#[test]
fn deferred_growth_joins_a_crack() {
    let wall = |x: f64| crack(&[(x, -3.0), (x, -7.0)]);
    let still = |end: End, tip: usize| TipDrive {
        tip: CrackTip { crack: 1, tip, end },
        stopped: Some(TipStop::Arrest),
        ..slow(1, 0.0, 0.0, DeferredGrowth::default())
    };
    let to = |x: f64, deferred: DeferredGrowth| {
        next(
            vec![shelf(), wall(x)],
            vec![slow(0, 0.0, SLOW, deferred), still(End::First, 0), still(End::Last, 1)],
        )
    };
    // 0.12 mm of growth plus the resolution.
    let joined = to(0.13, RIGHT);
    assert_eq!(joined.junctions.len(), 1);
    assert!((joined.cracks[0].tip(End::Last) - Vec2::new(0.13, -4.0)).length() < ROUNDING, "{joined:?}");
    assert!((joined.tips[0].increment - 0.03).abs() < ROUNDING, "{:?}", joined.tips);
    assert_eq!(
        (joined.tips[0].deferred, joined.tips[0].stop),
        (DeferredGrowth::default(), Some(TipStop::Coalescence))
    );
    // Farther away, or with less deferred growth, its growth is deferred further.
    for deferred in [to(0.15, RIGHT), to(0.13, DeferredGrowth { length: 0.05, ..RIGHT })] {
        assert_eq!((deferred.junctions.len(), deferred.tips[0].stop), (0, None));
        assert_eq!(deferred.cracks[0], shelf());
    }
}

#[test]
fn another_tip_joins_deferred_growth() {
    // This tip approaches from below, 0.06 mm ahead of the other one.
    let below = crack(&[(6.0, -8.0), (0.06, -8.0), (0.06, -4.15)]);
    let still = TipDrive {
        tip: CrackTip { crack: 1, tip: 0, end: End::First },
        stopped: Some(TipStop::Arrest),
        ..slow(1, 0.0, 0.0, DeferredGrowth::default())
    };
    let rising = TipDrive {
        tip: CrackTip { crack: 1, tip: 1, end: End::Last },
        ..slow(1, 0.0, 0.9e-6, DeferredGrowth::default())
    };
    let met = next(vec![shelf(), below], vec![slow(0, 0.0, SLOW, RIGHT), still, rising]);
    let at = met.cracks[1].tip(End::Last);
    assert!((at - Vec2::new(0.06, -4.0)).length() < ROUNDING, "{at:?}");
    assert_eq!(met.junctions.len(), 1);
    // The segment that it joins exists now, and the tip continues.
    assert_eq!(met.cracks[0].vertex_at(at), Some(3));
    assert!((met.cracks[0].tip(End::Last) - Vec2::new(0.12, -4.0)).length() < ROUNDING, "{met:?}");
    assert_eq!((met.tips[0].deferred, met.tips[0].stop), (DeferredGrowth::default(), None));
}

#[test]
fn deferred_growth_breaks_out() {
    let up = DeferredGrowth { direction: Vec2::new(0.0, 1.0), ..RIGHT };
    let rising = |deferred| {
        let shallow = crack(&[(-6.0, 0.0), (-5.5, -0.17), (0.0, -0.17)]);
        next(vec![shallow], vec![slow(0, std::f64::consts::FRAC_PI_2, SLOW, deferred)])
    };
    let out = rising(up);
    assert_eq!((out.tips[0].stop, out.tips[0].increment), (Some(TipStop::BreakOut), 0.0));
    assert_eq!(out.tips[0].deferred, up, "it has grown");
    assert_eq!((out.pieces.len(), out.break_outs[0].surface.x.abs() < ROUNDING), (1, true));
    assert_eq!(rising(DeferredGrowth { length: 0.05, ..up }).tips[0].stop, None);
}

#[test]
fn deferred_growth_counts_in_the_critical_length() {
    let long = DeferredGrowth { length: 0.14, ..RIGHT };
    let tips = [slow(0, 0.0, SLOW, long)];
    let cracks = [shelf()];
    let state = fixtures::state(&cracks, &tips, RESOLUTION);
    for (critical, stop) in [(5.63, Some(RunStop::CriticalLength)), (5.65, None)] {
        let settings = GrowthSettings { critical_length: Some(critical), ..SETTINGS };
        assert_eq!(advanced(&state, &settings).stop, stop);
    }
}
