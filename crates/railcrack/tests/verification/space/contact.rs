//! Closed faces with friction, and passages of the wheel.

use super::{body, stress};
use crate::common::{Of, close, largest};
use railcrack::load::Passage;
use railcrack::space::{
    EllipticWheel, FrontSif, SpaceContact, SpaceCrack, SpaceHistory, SpaceLoad, SpacePassageSettings,
    Surroundings, space_passage,
};
use std::f64::consts::PI;

#[test]
fn closed_penny_with_friction() {
    let crack = SpaceCrack::buried(1.0, 1.0, 1.0, 50.0).unwrap();
    let body = body(&crack, Surroundings::FullSpace, 4);
    let contact = SpaceContact { body: &body, friction: &[0.4] };
    let load = |factor: f64| {
        let stress = stress(1f64.to_degrees(), [-100.0 * factor, 90.0 * factor, 0.0]);
        body.nodal_forces(|_| stress)
    };
    let (faces, report) = contact.step(&contact.virgin(), &load(1.0)).unwrap();
    assert!(report.violation < 1e-9, "{report:?}");
    let scale = 4.0 * (90.0 - 0.4 * 100.0) / (PI.sqrt() * 1.7);
    for (k, front) in body.sifs_of_jumps(&faces.jumps).iter().zip(body.front()) {
        let reason = "slip of a penny under τ − μ p, Segedin 1951";
        close(k.kii, scale * front.phi.sin(), Of(0.02, scale), reason);
        close(k.ki, 0.0, Of(1e-9, scale), "closed");
    }
    // Friction holds the slip when the load falls a little.
    let (held, _) = contact.step(&faces, &load(0.9)).unwrap();
    let change = largest(held.jumps.iter().zip(&faces.jumps).map(|(a, b)| a - b));
    close(change, 0.0, Of(1e-9, largest(faces.jumps.iter().copied())), "held by friction");
}

#[test]
fn open_faces_do_not_feel_the_contact() {
    let crack = SpaceCrack::surface_breaking(0.6, 1.5, 1.0).unwrap();
    let body = body(&crack, Surroundings::HalfSpace, 2);
    let forces = body.nodal_forces(|_| stress(0.6f64.to_degrees(), [50.0, 10.0, 5.0]));
    let contact = SpaceContact { body: &body, friction: &[0.5] };
    let (faces, _) = contact.step(&contact.virgin(), &forces).unwrap();
    let free = body.compliance().times(&forces);
    let gap = largest(free.iter().zip(&faces.jumps).map(|(a, b)| a - b));
    close(gap, 0.0, Of(1e-9, largest(free)), "linear where nothing closes");
}

fn roll(degrees: f64, friction: f64, lateral: f64, lateral_friction: f64) -> (Vec<f64>, SpaceHistory) {
    let crack = SpaceCrack::surface_breaking(f64::to_radians(degrees), 4.0, 4.0).unwrap();
    let body = body(&crack, Surroundings::HalfSpace, 2);
    let wheel = EllipticWheel {
        peak_pressure: 845.0,
        half_width: 6.0,
        lateral_half_width: 5.0,
        lateral,
        friction: 0.1,
        lateral_friction,
    };
    let passage = Passage { from: -20.0, to: 20.0, positions: 31 };
    let settings = SpacePassageSettings { tolerance: f64::INFINITY, halvings: 0 };
    let contact = SpaceContact { body: &body, friction: &[friction] };
    let wheel = |position: f64, point: [f64; 3]| wheel.stress(position, point, 0.3);
    let load = SpaceLoad { wheel: &wheel, bending: None, constant: None };
    let history = space_passage(&contact, &load, passage, &settings, &mut contact.virgin()).unwrap();
    assert!(history.violation < 1e-8, "{}", history.violation);
    (body.front().iter().map(|front| front.phi).collect(), history)
}

#[test]
fn passages_are_steps_one_by_one() {
    // A passage begins each step with jumps and factors of earlier ones, and divides its intervals;
    // here each step stands alone, under the stress at its own position.
    let crack = SpaceCrack::surface_breaking(30f64.to_radians(), 5.0, 4.0).unwrap();
    let body = body(&crack, Surroundings::HalfSpace, 3);
    let wheel = EllipticWheel {
        peak_pressure: 845.0,
        half_width: 6.0,
        lateral_half_width: 5.0,
        lateral: 1.0,
        friction: 0.1,
        lateral_friction: 0.02,
    };
    let passage = Passage { from: -20.0, to: 20.0, positions: 21 };
    let contact = SpaceContact { body: &body, friction: &[0.3] };
    let field = |position: f64, point: [f64; 3]| wheel.stress(position, point, 0.3);
    let load = SpaceLoad { wheel: &field, bending: None, constant: None };
    let settings = SpacePassageSettings { tolerance: 0.0, halvings: 2 };
    let history = space_passage(&contact, &load, passage, &settings, &mut contact.virgin()).unwrap();
    assert!(history.violation < 1e-10, "{}", history.violation);
    let scale = peak(&history);
    let mut faces = contact.virgin();
    let mut step = |position: f64| {
        let forces = body.nodal_forces(|point| field(position, point));
        faces = contact.step(&faces, &forces).unwrap().0;
        body.sifs_of_jumps(&faces.jumps)
    };
    let mut alone = step(passage.from);
    for (k, sifs) in history.sifs.iter().enumerate() {
        // Quarters of the interval before the position.
        for quarter in (1..=4).filter(|_| k > 0) {
            let (from, to) = (history.positions[k - 1], history.positions[k]);
            alone = step(from + 0.25 * f64::from(quarter) * (to - from));
        }
        for (got, want) in sifs.iter().zip(&alone) {
            close(got.difference(want), 0.0, Of(1e-7, scale), "changes of 1e-9 end the iterations");
        }
    }
}

fn peak(history: &SpaceHistory) -> f64 {
    largest(history.sifs.iter().flatten().flat_map(|k| [k.ki, k.kii, k.kiii]))
}

#[test]
fn lateral_mirror_images() {
    let ((_, one), (_, other)) = (roll(30.0, 0.3, 2.0, 0.05), roll(30.0, 0.3, -2.0, -0.05));
    let scale = peak(&one);
    for (a, b) in one.sifs.iter().zip(&other.sifs) {
        for (k, m) in a.iter().zip(b.iter().rev()) {
            let gap = FrontSif { ki: k.ki - m.ki, kii: k.kii - m.kii, kiii: k.kiii + m.kiii };
            let reason = "quadrature of the stiffness, whose divisions are not mirrored";
            close(largest([gap.ki, gap.kii, gap.kiii]), 0.0, Of(2e-6, scale), reason);
        }
    }
}
