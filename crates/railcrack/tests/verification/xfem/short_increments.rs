//! Tips a few elements behind a kink, closed and with friction, against the other engine.

use crate::common::{
    Absolute, Meshed, Of, Rolling, StepControl, TENSION, close, joined_body, largest, sifs_of, surface_crack,
};
use railcrack::body::{BodyEngine, CrackedBody};
use railcrack::contact::{FaceProblem, Newton};
use railcrack::crack::{Crack, CrackNetwork, End};

/// Elements, mm: a sixtieth of the crack.
const SIZE: f64 = 0.1;
const FRICTION: f64 = 0.3;
/// Elements of the other engine.
const FINE: usize = 120;

/// The largest difference of K relative to its peak, and the remarks, for a crack of 6 mm that has
/// kinked by `turn` (degrees) and back by a fifth of it in every further increment of `elements`,
/// on the mesh of the initial crack.
fn misfit(elements: f64, turn: f64, increments: usize) -> (f64, Vec<String>) {
    let start = surface_crack(0.0, 6.0, 15.0);
    let longer = |crack: Crack, i: usize| {
        let turn = if i == 0 { turn } else { -0.2 * turn };
        crack.extended(End::Last, elements * SIZE, turn.to_radians()).unwrap()
    };
    let crack = (0..increments).fold(start.clone(), longer);
    let mut rolling = Rolling::over(vec![crack.clone()], FRICTION, 0.1);
    rolling.steps = StepControl { positions: 81, ..StepControl::default() };
    let histories = |body: &CrackedBody| {
        let passages = rolling.on(&FaceProblem::new(body, &[FRICTION]).unwrap(), &Newton::default()).passages;
        passages[passages.len() - 1].sifs[0].clone()
    };
    let meshed = Meshed { expected_growth: 1.5, ..Meshed::of_size(SIZE) };
    let body = meshed.engine(&[start]).body(&CrackNetwork::from(crack.clone())).unwrap();
    let (k, want) = (histories(&body), histories(&joined_body(&[crack], &[], FINE)));
    let off = largest(k.iter().zip(&want).flat_map(|(a, b)| [a.ki - b.ki, a.kii - b.kii]));
    (off / largest(want.iter().flat_map(|k| [k.ki, k.kii])), body.remarks.to_vec())
}

/// As long as the first increments of a run at the defaults: 4 % of the crack.
#[test]
fn increments_of_a_run() {
    for (turn, increments, within) in [
        (5.0, 1, 0.02),
        (5.0, 3, 0.015),
        (15.0, 1, 0.015),
        (15.0, 3, 0.015),
        (40.0, 3, 0.015),
        (-40.0, 3, 0.015),
        (-40.0, 1, 0.035),
        (70.0, 3, 0.015),
    ] {
        let (off, remarks) = misfit(2.4, turn, increments);
        println!("{turn}°, {increments} increments: {:.2} %", 100.0 * off);
        close(off, 0.0, Absolute(within), "the corner has enrichment functions of its own");
        assert!(remarks.is_empty(), "{turn}°, {increments} increments: {remarks:?}");
    }
}

/// For a tip that is slower than others. With oscillating pressures the error was 60 to 280 % of
/// this.
#[test]
fn small_kinks_of_slow_tips() {
    for (elements, increments) in [(0.25, 1), (0.25, 3), (0.5, 1), (0.5, 3), (1.0, 3)] {
        let (off, _) = misfit(elements, 5.0, increments);
        println!("{elements} elements, {increments} increments: {:.2} %", 100.0 * off);
        close(off, 0.0, Absolute(0.04), "the face element there runs across the kinks");
    }
}

/// An unresolved kink is reported.
#[test]
fn sharp_kinks_of_slow_tips_are_reported() {
    let (off, remarks) = misfit(0.5, 70.0, 1);
    println!("half an element behind 70°: {:.0} %", 100.0 * off);
    assert!(remarks.iter().any(|remark| remark.contains("behind a kink of 70°")), "{remarks:?}");
}

/// A path that slowed down before its kink: increments of a twentieth of an element end there, as
/// those with which a run approaches a kink.
#[test]
fn short_increments_before_a_sharp_kink() {
    let start = surface_crack(0.0, 6.0, 20.0);
    let meshed = Meshed { expected_growth: 1.5, ..Meshed::of_size(SIZE) };
    let engine =
        |crack: &Crack| meshed.engine(std::slice::from_ref(&start)).body(&CrackNetwork::from(crack.clone()));
    let kinked = |before: &[f64]| {
        let approach = before.iter().fold(start.clone(), |crack, &length| {
            crack.extended(End::Last, length * SIZE, 0.01f64.to_radians()).unwrap()
        });
        let [kink, last] = [-73.0, -2.3].map(f64::to_radians);
        let crack = approach.extended(End::Last, 3.1 * SIZE, kink).unwrap();
        crack.extended(End::Last, 3.2 * SIZE, last).unwrap()
    };
    for before in [[0.2, 0.05], [0.02, 0.02], [0.05, 0.005]] {
        let crack = kinked(&before);
        let (body, whole) = (engine(&crack).unwrap(), engine(&kinked(&[before.iter().sum()])).unwrap());
        let k = |body: &CrackedBody| sifs_of(body, |_| TENSION);
        let (k, want, other) = (k(&body), k(&whole), k(&joined_body(&[crack], &[], FINE)));
        for ((k, want), other) in k.iter().zip(&want).zip(&other) {
            close(*k, *want, Of(1e-3, 4.0), "the same path but for 0.01 degrees");
            close(*k, *other, Of(0.01, 4.0), "the other engine");
        }
    }
}
