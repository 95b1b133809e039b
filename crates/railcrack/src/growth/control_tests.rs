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
