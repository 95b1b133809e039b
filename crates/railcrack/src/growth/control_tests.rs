//! The control on attempts whose outcome is given.

use super::control::{Control, End as Ends, MOST_TURNS, Trial, Verdict};
use super::*;
use crate::crack::{Crack, CrackTip, End};
use crate::growth::StepProgress;
use crate::math::Vec2;

/// A tip that leaves by `turn`, in a direction that is best by `kink` further round.
fn tip(number: usize, turn: f64, kink: f64, is_drawn: bool) -> TipRecord {
    TipRecord {
        tip: CrackTip { crack: 0, tip: number, end: if number == 0 { End::First } else { End::Last } },
        x: 0.0,
        y: -6.0,
        length: 4.0,
        ki_max: 0.0,
        delta_ki: 0.0,
        delta_kii: 0.0,
        delta_keq: 1.0,
        largest_k1: None,
        kink: Some(kink),
        increment: 0.04,
        rate: 1e-6,
        stop: None,
        shares: WheelShares::default(),
        opened_by: 0,
        toughness_ratio: 1.0,
        mouth_sine: None,
        geometry: TipGeometry::Plane(PlaneTip { turn, is_drawn, ..PlaneTip::default() }),
    }
}

fn advance() -> Advance {
    let buried = Crack::polyline(vec![Vec2::new(0.0, -2.0), Vec2::new(0.0, -6.0)]).unwrap();
    Advance {
        geometry: GrowthState::initial(&buried.into()).geometry,
        pieces: Vec::new(),
        progress: StepProgress { cycles: 4e4, share: 0.01, ..StepProgress::default() },
        stop: None,
        warnings: Vec::new(),
    }
}

/// Of two tips each attempt draws the one that the attempt before deferred: both searches go on,
/// and the last attempt leaves its tip in the direction of no kink.
#[test]
fn a_step_of_the_limit_path_ends_though_its_attempts_draw_other_tips() {
    let settings = GrowthSettings { turning: Turning::Over(0.0), ..GrowthSettings::REFERENCE };
    let advance = advance();
    // The best kink after a turn: one that falls evenly to zero, one that changes its sign at once.
    let best: [fn(f64) -> f64; 2] = [|turn| 0.5 * (0.4 - turn), |turn| 0.3f64.copysign(0.4 - turn)];
    for kink in best {
        let mut trial = Trial::default();
        let mut attempts = 0;
        let left = loop {
            let drawn = attempts % 2;
            attempts += 1;
            assert!(attempts <= 2 * MOST_TURNS, "the attempts do not end");
            let turn = |number: usize| {
                trial.turns.iter().find(|turn| turn.tip == number).map_or(0.0, |turn| turn.angle)
            };
            let before = [0, 1].map(|i| tip(i, turn(i), 0.0, i == drawn));
            let after = [0, 1].map(|i| tip(i, 0.0, kink(turn(i)), i == drawn));
            let control = Control {
                settings: settings.clone(),
                course: Default::default(),
                earlier: None,
                advance: &advance,
                before: Ends { tips: &before, movers: &[], hazard: 0.0, load_cycles: 1e6 },
            };
            let end = Ends { tips: &after, movers: &[], hazard: 0.0, load_cycles: 1.04e6 };
            match control.judge(&end, &trial) {
                Verdict::Again(next) => trial = next,
                Verdict::Accepted(_) => break turn(drawn),
            }
        };
        assert!((left - 0.4).abs() < 5e-4, "the path leaves by {left} after {attempts} attempts");
    }
}

/// The attempts at a step of the tips `before` under wear and grinding that takes `share` of the
/// length of the leading crack, in which the rate rises by `rise(share)`, until one is accepted:
/// the share of that one.
fn accepted_under_wear(before: &[TipRecord], share: f64, rise: impl Fn(f64) -> f64) -> f64 {
    let removal = SurfaceRemoval {
        wear: 2e-8,
        grinding: None,
        limit: None,
        stress: StressMoves::WithMetal,
        least_spall: None,
    };
    let settings =
        GrowthSettings { increment: 0.04, maintenance: Some(removal), ..GrowthSettings::REFERENCE };
    let mover = |rate: f64| Mover { crack: 0, index: 0, rate, length: 4.0 };
    let step = |start: f64, share: f64, is_extrapolated| EarlierStep {
        movers: vec![mover(start)],
        balance: vec![0.0],
        growth: vec![4.0 * share],
        cycles: 4.0 * share / start,
        leader: None,
        is_extrapolated,
        is_smooth: true,
    };
    let mut trial = Trial::default();
    loop {
        let part = (trial.cycles_at_most * 1e-6 / 4.0).min(share);
        let (cycles, end) = (4.0 * part / 1e-6, 1e-6 * (1.0 + rise(part)));
        // The growth of slow tips is drawn in larger steps.
        let mut advance = advance();
        advance.progress = StepProgress {
            cycles,
            share: part.max(0.004),
            earlier: Some(step(1e-6, part, true)),
            ..StepProgress::default()
        };
        let [start, next] = [[mover(1e-6)], [mover(end)]];
        let control = Control {
            settings: settings.clone(),
            course: Default::default(),
            earlier: Some(step(1e-6, 0.01, false)),
            advance: &advance,
            before: Ends { tips: before, movers: &start, hazard: 0.0, load_cycles: 1e6 },
        };
        let after = Ends { tips: before, movers: &next, hazard: 0.0, load_cycles: 1e6 + cycles };
        match control.judge(&after, &trial) {
            Verdict::Again(next) => trial = next,
            Verdict::Accepted(_) => return part,
        }
    }
}

#[test]
fn steps_under_wear_do_not_shrink_before_growth_that_is_drawn_at_once() {
    let one = [tip(0, 0.0, 0.0, true)];
    let both = [tip(0, 0.0, 0.0, true), tip(1, 0.0, 0.0, false)];
    // The rate jumps by 3 % however short the step is.
    for share in [0.04, 0.02, 0.009, 0.003] {
        let left = accepted_under_wear(&both, share, |_| 0.03);
        assert!(left >= share.min(0.008) * (1.0 - 1e-9), "{share}: {left}");
    }
    // A rate that rises with the growth is resolved.
    assert_eq!(accepted_under_wear(&both, 0.04, |part| 0.2 * part), 0.04);
    let curved = [&both[..], &one].map(|tips| accepted_under_wear(tips, 0.04, |part| 400.0 * part * part));
    assert!((0.0079..0.02).contains(&curved[0]) && curved[1] <= curved[0], "{curved:?}");
}

#[test]
fn a_kink_that_was_deferred_counts_in_the_error_of_the_cycles() {
    let settings = GrowthSettings { tolerance: Some(0.01), ..GrowthSettings::REFERENCE };
    // The second crack has waited at 1e-7 mm per cycle; with its kink it grows at `rate`.
    let error = |rate: f64, drawn: f64| {
        let slow = |y: f64, rate| {
            let tip = tip(0, 0.0, 0.0, true);
            TipRecord { tip: CrackTip { crack: 1, ..tip.tip }, y, rate, increment: 0.01, ..tip }
        };
        let mover = |crack, rate| Mover { crack, index: 0, rate, length: 4.0 };
        let (start, end) = ([slow(-6.0, 1e-7)], [slow(-6.0 - drawn, rate)]);
        let advance = advance();
        let control = Control {
            settings: settings.clone(),
            course: Default::default(),
            earlier: None,
            advance: &advance,
            before: Ends { tips: &start, movers: &[mover(0, 1e-6)], hazard: 0.0, load_cycles: 1e6 },
        };
        let movers = [mover(0, 1e-6), mover(1, rate)];
        let after = Ends { tips: &end, movers: &movers, hazard: 0.0, load_cycles: 1.04e6 };
        match control.judge(&after, &Trial::default()) {
            Verdict::Accepted(course) => course.cycles_error,
            Verdict::Again(_) => panic!("a short step"),
        }
    };
    // 0.03 mm took 3e5 cycles instead of 7.5e4; the crack stays slower than the other by 0.4.
    assert!((error(4e-7, 0.04) - 0.4 * 2.25e5).abs() < 1e-6 * 9e4, "{}", error(4e-7, 0.04));
    assert_eq!(error(4e-7, 0.01), 0.0, "nothing was deferred");
    assert_eq!(error(1.01e-7, 0.04), 0.0, "the rate changes smoothly");
}
