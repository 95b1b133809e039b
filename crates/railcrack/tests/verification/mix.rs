//! Mixes of wheels: rates add by share, and the wheels know nothing of each other.

use crate::common::{steel, surface_crack};
use railcrack::dislocation::{DislocationEngine, FaceResolution};
use railcrack::field::HertzWheel;
use railcrack::growth::{
    Growth, GrowthProblem, GrowthSettings, GrowthState, MixedWheel, PassageSettings, StepRecord, Unobserved,
};
use railcrack::load::HertzianContact;

fn wheel(peak_pressure: f64, friction: f64) -> HertzWheel {
    HertzWheel::new(&HertzianContact { peak_pressure, half_width: 6.75, friction }, &steel()).unwrap()
}

/// The steps of a crack of 6 mm at 30° under `wheels`, with their shares.
fn steps(wheels: &[(f64, HertzWheel)]) -> Vec<StepRecord> {
    let engine = DislocationEngine { steel: steel(), resolution: FaceResolution::default() };
    let (first, others) = wheels.split_first().unwrap();
    let mut problem = GrowthProblem::new(engine, first.1, vec![0.3]);
    problem.growth = GrowthSettings { steps: 2, ..GrowthSettings::default() };
    problem.share = first.0;
    let mixed = |&(share, wheel): &(f64, HertzWheel)| MixedWheel {
        wheel: Box::new(wheel),
        share,
        residual: None,
        passages: PassageSettings::default(),
        toughness: None,
    };
    problem.others = others.iter().map(mixed).collect();
    let mut growth = Growth::new(problem, GrowthState::initial(&surface_crack(0.0, 6.0, 30.0).into()));
    std::iter::from_fn(|| growth.next_step(&Unobserved).unwrap()).collect()
}

/// Round-off through two searches for the direction, and two increments.
const ROUND_OFF: f64 = 1e-8;

#[test]
fn one_wheel_twice_with_half_shares_is_the_wheel_itself() {
    let one = steps(&[(1.0, wheel(845.0, 0.3))]);
    let two = steps(&[(0.5, wheel(845.0, 0.3)), (0.5, wheel(845.0, 0.3))]);
    assert_eq!(one.len(), two.len());
    for (one, two) in one.iter().zip(&two) {
        let (a, b) = (&one.tips[0], &two.tips[0]);
        for (a, b) in [
            (a.x, b.x),
            (a.y, b.y),
            (a.rate, b.rate),
            (a.delta_ki, b.delta_ki),
            (a.delta_kii, b.delta_kii),
            (a.kink.unwrap(), b.kink.unwrap()),
            (one.load_cycles, two.load_cycles),
        ] {
            assert!((a - b).abs() <= ROUND_OFF * a.abs(), "{a} {b}");
        }
        assert_eq!(two.tips[0].shares.values(), [0.5, 0.5]);
        assert!(two.passages.last() == two.beside[0].last(), "the same history under both wheels");
    }
}

#[test]
fn rates_add_by_share() {
    let wheels = [wheel(1000.0, 0.1), wheel(800.0, -0.35)];
    let alone = wheels.map(|wheel| steps(&[(1.0, wheel)])[0].tips[0].rate);
    let mixed = &steps(&[(0.7, wheels[0]), (0.3, wheels[1])])[0].tips[0];
    let parts = [0.7 * alone[0], 0.3 * alone[1]];
    // The same histories, so that nothing but the order of additions differs.
    assert!((mixed.rate / (parts[0] + parts[1]) - 1.0).abs() < 1e-12, "{mixed:?} {parts:?}");
    assert!((mixed.shares.values()[1] - parts[1] / mixed.rate).abs() < 1e-12);
}
