//! Mixes of wheels: rates add by share, and the wheels know nothing of each other.

use crate::common::{steel, surface_crack};
use railcrack::dislocation::{DislocationEngine, FaceResolution};
use railcrack::fatigue::KinkFunctions;
use railcrack::field::HertzWheel;
use railcrack::fracture::Sif;
use railcrack::growth::{Growth, GrowthSettings, GrowthState, StepRecord, Unobserved};
use railcrack::load::HertzianContact;
use railcrack::plane::{PlaneRail, PlaneWheel};

fn wheel(peak_pressure: f64, friction: f64) -> HertzWheel {
    HertzWheel::new(&HertzianContact { peak_pressure, half_width: 6.75, friction }, &steel()).unwrap()
}

/// The steps of a crack of 6 mm at 30° under `wheels`, with their shares.
fn steps(wheels: &[(f64, HertzWheel)]) -> Vec<StepRecord> {
    grown(wheels, 2, 6.0)
}

/// The same for a number of increments and a length (mm) at first.
fn grown(wheels: &[(f64, HertzWheel)], increments: usize, length: f64) -> Vec<StepRecord> {
    let engine = DislocationEngine { steel: steel(), resolution: FaceResolution::default() };
    let wheel =
        |&(share, wheel): &(f64, HertzWheel)| PlaneWheel { share, ..PlaneWheel::new(Box::new(wheel)) };
    let mut problem = PlaneRail::under(Box::new(engine), wheels.iter().map(wheel).collect(), vec![0.3]);
    problem.growth = GrowthSettings { steps: increments, ..GrowthSettings::default() };
    let mut growth = Growth::new(problem, GrowthState::initial(&surface_crack(0.0, length, 30.0).into()));
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
        assert!(two.passages.last() == two.other_wheels[0].last(), "the same history under both wheels");
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

/// The kink (degrees) that maximises Σ s_i C (Δk1² + w Δk2²)^(m/2) over a grid of angles, from
/// histories at the output positions: nothing of the search of the library.
fn kink_on_a_grid(wheels: &[(f64, &[Sif])]) -> f64 {
    let rate = |angle: f64| {
        let functions = KinkFunctions::at(angle);
        let of = |&(share, history): &(f64, &[Sif])| {
            let (mut low, mut high) = ([0.0_f64, f64::INFINITY], [0.0_f64, f64::NEG_INFINITY]);
            for k in history.iter().map(|&k| functions.kinked(k)) {
                high = [high[0].max(k.k1), high[1].max(k.k2)];
                low = [0.0, low[1].min(k.k2)];
            }
            let (k1, k2) = (high[0] - low[0], high[1] - low[1]);
            share * (k1 * k1 + 0.772 * k2 * k2).powf(0.5 * 3.33)
        };
        wheels.iter().map(of).sum::<f64>()
    };
    let angles = (-1000..=1000).map(|i| 0.1 * f64::from(i));
    let best = |a: f64, b: f64| if rate(b.to_radians()) > rate(a.to_radians()) { b } else { a };
    angles.reduce(best).unwrap()
}

/// Where `kink` (degrees), a function of the share of the first wheel, passes the middle between
/// its values without and with that wheel alone, to 1/512.
fn flip(kink: impl Fn(f64) -> f64) -> f64 {
    let (without, alone) = (kink(1e-6), kink(1.0 - 1e-6));
    assert!((without - alone).abs() > 20.0, "{without} and {alone} degrees");
    let middle = 0.5 * (without + alone);
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..9 {
        let share = 0.5 * (low + high);
        if (kink(share) > middle) == (alone > middle) { high = share } else { low = share }
    }
    0.5 * (low + high)
}

/// A crack of 4 mm branches upward under the heavy wheel and goes on under the braking one.
#[test]
fn the_share_at_which_the_direction_flips() {
    let wheels = [wheel(1000.0, 0.1), wheel(800.0, 0.3)];
    let alone = wheels.map(|wheel| grown(&[(1.0, wheel)], 0, 4.0).remove(0));
    let histories = alone.each_ref().map(|step| step.passages.last().unwrap().sifs[0].as_slice());
    let of_mix = flip(|share| {
        let mix = [(share, wheels[0]), (1.0 - share, wheels[1])];
        grown(&mix, 0, 4.0)[0].tips[0].kink.unwrap().to_degrees()
    });
    let by_hand = flip(|share| kink_on_a_grid(&[(share, histories[0]), (1.0 - share, histories[1])]));
    println!("direction flips at a share of {of_mix:.4}, by hand {by_hand:.4}");
    // Bisection to 0.002; extremes between output positions are not in the histories by hand.
    assert!((of_mix - by_hand).abs() < 0.01, "{of_mix} {by_hand}");
}
