//! Closed faces with friction, and passages of the wheel.

use super::{body, stress};
use crate::common::{Of, close, largest};
use railcrack::load::Passage;
use railcrack::space::{
    EllipticWheel, FrontSif, SpaceContact, SpaceCrack, SpaceFaces, SpaceHistory, SpaceLoad,
    SpacePassageSettings, SpaceStatus, Surroundings, space_passage,
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
    let load = SpaceLoad { wheel: &wheel, bending: None, constant: None, fluid: None };
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
    let load = SpaceLoad { wheel: &field, bending: None, constant: None, fluid: None };
    let settings = SpacePassageSettings { tolerance: 0.0, halvings: 2 };
    let history = space_passage(&contact, &load, passage, &settings, &mut contact.virgin()).unwrap();
    assert!(history.violation < 1e-10, "{}", history.violation);
    let scale = peak(&history);
    let after = |before: &SpaceFaces, position: f64| {
        let forces = body.nodal_forces(|point| field(position, point));
        contact.step(before, &forces).unwrap().0
    };
    let check = |k: usize, faces: &SpaceFaces| {
        for (got, want) in history.sifs[k].iter().zip(&body.sifs_of_jumps(&faces.jumps)) {
            close(got.difference(want), 0.0, Of(1e-7, scale), "changes of 1e-9 end the iterations");
        }
    };
    let at = &history.positions;
    let (mut earlier, mut last) = (None, after(&contact.virgin(), at[0]));
    check(0, &last);
    for k in 1..at.len() {
        // Halves of the interval before the position.
        for position in [0.5 * (at[k - 1] + at[k]), at[k]] {
            let mut origin = last.clone();
            if let Some(earlier) = &earlier {
                second_order(earlier, &mut origin);
            }
            earlier = Some(std::mem::replace(&mut last, after(&origin, position)));
        }
        check(k, &last);
    }
}

/// Moves the jumps from which slip counts in a step as long as the one from `earlier` to `last`:
/// backward differences of slip, and closing points to where they meet.
fn second_order(earlier: &SpaceFaces, last: &mut SpaceFaces) {
    for (a, status) in last.status.iter().enumerate() {
        let rate: [f64; 3] = std::array::from_fn(|c| last.jumps[3 * a + c] - earlier.jumps[3 * a + c]);
        let share = match status {
            SpaceStatus::Open if rate[0] < 0.0 => (last.jumps[3 * a] / -rate[0]).min(1.0),
            SpaceStatus::Slip { .. } if earlier.status[a] != SpaceStatus::Open => 1.0 / 3.0,
            _ => 0.0,
        };
        (1..3).for_each(|c| last.jumps[3 * a + c] += share * rate[c]);
    }
}

#[test]
fn slip_that_turns_is_of_second_order() {
    // Shear beyond friction whose direction turns by 100° while all faces slip.
    let crack = SpaceCrack::buried(1.0, 1.0, 1.0, 50.0).unwrap();
    let body = body(&crack, Surroundings::FullSpace, 2);
    let contact = SpaceContact { body: &body, friction: &[0.3] };
    let wheel = |position: f64, _: [f64; 3]| {
        let (sin, cos) = (1.7 * position).sin_cos();
        let size = 60.0 + 40.0 * position;
        stress(1f64.to_degrees(), [-100.0, size * cos, size * sin])
    };
    let load = SpaceLoad { wheel: &wheel, bending: None, constant: None, fluid: None };
    let settings = SpacePassageSettings { tolerance: f64::INFINITY, halvings: 0 };
    let last = |steps: usize| {
        let passage = Passage { from: 0.0, to: 1.0, positions: steps + 1 };
        let history = space_passage(&contact, &load, passage, &settings, &mut contact.virgin()).unwrap();
        history.sifs[steps].clone()
    };
    let fine = last(160);
    let [rough, better] = [10, 20].map(|steps| {
        let pairs = last(steps).into_iter().zip(&fine);
        pairs.map(|(k, fine)| k.difference(fine)).fold(0.0, f64::max)
    });
    assert!(better > 0.0 && rough > 3.2 * better, "{rough} {better}: 4 of second order, 2 of first");
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
