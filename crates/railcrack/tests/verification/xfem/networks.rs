//! Networks under the wheel, crack by crack against the other engine.

use crate::common::{Absolute, Meshed, Rolling, StepControl, close, joined_body, largest, surface_crack};
use railcrack::body::CrackedBody;
use railcrack::contact::{FaceProblem, FaceStatus, Newton};
use railcrack::crack::{Crack, CrackNetwork, End};

/// Allowed difference between the engines, relative to the largest K of the crack.
const DIFFERENCE: f64 = 0.015;
/// Elements of the other engine along each crack.
const ELEMENTS: usize = 40;
/// Output positions: some, or as many as in a run, of which some coincide with the moment at which
/// a tip begins to slip.
const SOME: usize = 81;
const ALL: usize = 241;

/// The cracks of `cases/squat-pair.toml`.
fn squat() -> Vec<Crack> {
    vec![surface_crack(0.0, 6.0, 15.0), surface_crack(-1.0, 6.0, 165.0)]
}

/// Those of `cases/network-nine.toml`.
fn nine() -> Vec<Crack> {
    (0..9).map(|i| surface_crack(3.375 * f64::from(i), 6.0, 15.0)).collect()
}

/// Each crack two increments longer, with kinks like those of a run, by half a degree or so.
fn grown(cracks: &[Crack]) -> Vec<Crack> {
    let longer = |(i, crack): (usize, &Crack)| {
        let turn = (-0.3 - 0.2 * (i % 3) as f64).to_radians();
        let once = crack.extended(End::Last, 0.24, turn).unwrap();
        once.extended(End::Last, 0.25, turn).unwrap()
    };
    cracks.iter().enumerate().map(longer).collect()
}

/// The nine cracks after three increments of a run, of which the last tip makes half as much as the
/// others.
fn nine_of_a_run() -> Vec<Crack> {
    let increments = [
        [0.2173, 0.2243, 0.2323],
        [0.2262, 0.2346, 0.2430],
        [0.2269, 0.2346, 0.2430],
        [0.2297, 0.2386, 0.2471],
        [0.2319, 0.2407, 0.2503],
        [0.2339, 0.2440, 0.2538],
        [0.2400, 0.2496, 0.2596],
        [0.2188, 0.2153, 0.2123],
        [0.1040, 0.0979, 0.0921],
    ];
    let longer =
        |crack: Crack, increment: &f64| crack.extended(End::Last, *increment, f64::to_radians(-0.4)).unwrap();
    nine().into_iter().zip(&increments).map(|(crack, own)| own.iter().fold(crack, longer)).collect()
}

/// The largest difference at any position for each crack, relative to its largest |K|.
fn differences(start: &[Crack], cracks: &[Crack], friction: f64, wheel: f64) -> Vec<f64> {
    let off = differences_by_position(start, cracks, friction, wheel, SOME);
    off.into_iter().map(largest).collect()
}

/// The difference at each of `positions` for each crack, relative to its largest |K|.
fn differences_by_position(
    start: &[Crack],
    cracks: &[Crack],
    friction: f64,
    wheel: f64,
    positions: usize,
) -> Vec<Vec<f64>> {
    let network = CrackNetwork::new(cracks.to_vec()).unwrap();
    let meshed = {
        use railcrack::body::BodyEngine;
        Meshed::default().engine(start).body(&network).unwrap()
    };
    let mut rolling = Rolling::over(cracks.to_vec(), friction, wheel);
    rolling.steps = StepControl { positions, ..StepControl::default() };
    let sifs = |body: &CrackedBody| {
        let problem = FaceProblem::new(body, &vec![friction; cracks.len()]).unwrap();
        let mut result = rolling.on(&problem, &Newton::default());
        result.passages.pop().unwrap().sifs
    };
    let (k, want) = (sifs(&meshed), sifs(&joined_body(cracks, &[], ELEMENTS)));
    let of_crack = |(k, want): (&Vec<railcrack::fracture::Sif>, &Vec<railcrack::fracture::Sif>)| {
        let peak = largest(want.iter().flat_map(|k| [k.ki, k.kii]));
        let off = |(a, b): (&railcrack::fracture::Sif, &railcrack::fracture::Sif)| {
            largest([a.ki - b.ki, a.kii - b.kii]) / peak
        };
        k.iter().zip(want).map(off).collect()
    };
    k.iter().zip(&want).map(of_crack).collect()
}

fn compare(name: &str, off: &[f64]) {
    println!("{name}: {:.2} % of its peak at most", 100.0 * largest(off.iter().copied()));
    for crack in off {
        close(*crack, 0.0, Absolute(DIFFERENCE), name);
    }
}

#[test]
fn squat_pair() {
    compare("squat, step 0", &differences(&squat(), &squat(), 0.5, 0.025));
    compare("squat, grown", &differences(&squat(), &grown(&squat()), 0.5, 0.025));
    compare("squat, smooth faces", &differences(&squat(), &grown(&squat()), 0.01, 0.025));
}

#[test]
fn nine_parallel_cracks() {
    compare("nine, step 0", &differences(&nine(), &nine(), 0.5, 0.1));
    compare("nine, grown", &differences(&nine(), &grown(&nine()), 0.5, 0.1));
}

/// At all positions of a run: some coincide with the moment at which a tip begins to slip, and K_II
/// falls by two thirds over 0.4 mm of wheel travel.
#[test]
fn nine_parallel_cracks_of_a_run() {
    let off = differences_by_position(&nine(), &nine_of_a_run(), 0.5, 0.1, ALL);
    compare("nine, of a run", &off.into_iter().map(largest).collect::<Vec<_>>());
}

/// While the face point next to a tip sticks, K is the same to the last bit, and it does not jump
/// as that point begins to slip.
#[test]
fn k_of_a_sticking_tip_is_constant() {
    let cracks = vec![surface_crack(0.0, 6.0, 15.0)];
    let body = Meshed::of_size(0.2).body(&cracks);
    let mut rolling = Rolling::over(cracks, 0.5, 0.1);
    rolling.steps = StepControl { positions: 4001, ..StepControl::default() };
    let result = rolling.on(&FaceProblem::new(&body, &[0.5]).unwrap(), &Newton::default());
    let k = &result.passages[result.passages.len() - 1].sifs[0];
    let last = result.faces.points.len() - 1;
    let at_tip = || result.faces.states.iter().map(|faces| faces[last]);
    let peak = largest(k.iter().map(|k| k.kii));
    let mut stuck = 0;
    for ((pair, before), after) in k.windows(2).zip(at_tip()).zip(at_tip().skip(1)) {
        if [before.status, after.status] == [FaceStatus::Stick; 2] && before.slip == after.slip {
            assert_eq!(pair[0], pair[1]);
            stuck += 1;
        }
        close((pair[1].kii - pair[0].kii) / peak, 0.0, Absolute(0.05), "over 0.02 mm of wheel travel");
    }
    assert!(stuck > 500, "{stuck}");
}
