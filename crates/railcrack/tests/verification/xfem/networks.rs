//! Networks under the wheel, crack by crack against the other engine.

use crate::common::{Absolute, Meshed, Rolling, StepControl, close, joined_body, largest, surface_crack};
use railcrack::body::CrackedBody;
use railcrack::contact::{FaceProblem, Newton};
use railcrack::crack::{Crack, CrackNetwork, End};

/// What the engines may differ by, over the largest K of the crack.
const DIFFERENCE: f64 = 0.015;
/// Elements of the other engine along each crack.
const ELEMENTS: usize = 40;

/// The cracks of `cases/squat-pair.toml`.
fn squat() -> Vec<Crack> {
    vec![surface_crack(0.0, 6.0, 15.0), surface_crack(-1.0, 6.0, 165.0)]
}

/// Those of `cases/network-nine.toml`.
fn nine() -> Vec<Crack> {
    (0..9).map(|i| surface_crack(3.375 * f64::from(i), 6.0, 15.0)).collect()
}

/// Each crack two increments longer, which turn like those of a run, by half a degree or so.
fn grown(cracks: &[Crack]) -> Vec<Crack> {
    let longer = |(i, crack): (usize, &Crack)| {
        let turn = (-0.3 - 0.2 * (i % 3) as f64).to_radians();
        let once = crack.extended(End::Last, 0.24, turn).unwrap();
        once.extended(End::Last, 0.25, turn).unwrap()
    };
    cracks.iter().enumerate().map(longer).collect()
}

/// The largest difference at any position of each crack, over its largest |K|.
fn differences(start: &[Crack], cracks: &[Crack], friction: f64, wheel: f64) -> Vec<f64> {
    let network = CrackNetwork::new(cracks.to_vec()).unwrap();
    let meshed = {
        use railcrack::body::BodyEngine;
        Meshed::default().engine(start).body(&network).unwrap()
    };
    let mut rolling = Rolling::over(cracks.to_vec(), friction, wheel);
    rolling.steps = StepControl { positions: 81, ..StepControl::default() };
    let sifs = |body: &dyn CrackedBody| {
        let problem = FaceProblem::new(body, &vec![friction; cracks.len()]);
        let mut result = rolling.on(&problem, &Newton::default());
        result.passages.pop().unwrap().sifs
    };
    let (k, want) = (sifs(meshed.as_ref()), sifs(&joined_body(cracks, &[], ELEMENTS)));
    let of_crack = |(k, want): (&Vec<railcrack::fracture::Sif>, &Vec<railcrack::fracture::Sif>)| {
        let off = largest(k.iter().zip(want).flat_map(|(a, b)| [a.k1 - b.k1, a.k2 - b.k2]));
        off / largest(want.iter().flat_map(|k| [k.k1, k.k2]))
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
