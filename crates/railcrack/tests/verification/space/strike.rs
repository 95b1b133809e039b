//! Cracks whose mouth is not across the rail.

use super::body;
use crate::common::{Of, close, largest};
use railcrack::load::Passage;
use railcrack::space::{
    EllipticWheel, FrontSif, SpaceContact, SpaceCrack, SpaceHistory, SpaceLoad, SpacePassageSettings,
    Surroundings, WheelStress, space_passage,
};
use std::f64::consts::{FRAC_PI_2, PI};

/// Semi-axes of 4 mm along the surface and 3 mm down the dip.
fn crack(dip: f64, strike: f64) -> SpaceCrack {
    SpaceCrack { strike, ..SpaceCrack::surface_breaking(dip, 4.0, 3.0).unwrap() }.checked().unwrap()
}

const WHEEL: EllipticWheel = EllipticWheel {
    peak_pressure: 845.0,
    half_width: 6.0,
    lateral_half_width: 4.0,
    lateral: 1.5,
    friction: 0.1,
    lateral_friction: 0.04,
};

fn pass(crack: &SpaceCrack, wheel: &dyn WheelStress) -> SpaceHistory {
    let body = body(crack, Surroundings::HalfSpace, 2);
    let contact = SpaceContact { body: &body, friction: &[0.3] };
    let load = SpaceLoad { wheel, bending: None, constant: None, fluid: None };
    let settings = SpacePassageSettings { tolerance: f64::INFINITY, halvings: 0 };
    let passage = Passage { from: -20.0, to: 20.0, positions: 31 };
    space_passage(&contact, &load, passage, &settings, &mut contact.virgin()).unwrap()
}

fn peak(history: &SpaceHistory) -> f64 {
    largest(history.sifs.iter().flatten().flat_map(|k| [k.ki, k.kii, k.kiii]))
}

/// `other`, of one body, has the same history with the signs of K_II and K_III, from the other end
/// of the front.
fn same(one: &SpaceHistory, other: &SpaceHistory, (kii, kiii, is_reversed): (f64, f64, bool)) {
    let scale = peak(one);
    assert!(scale > 50.0, "{scale}");
    for (a, b) in one.sifs.iter().zip(&other.sifs) {
        let ahead: Vec<FrontSif> = if is_reversed { b.iter().rev().copied().collect() } else { b.clone() };
        for (k, m) in a.iter().zip(ahead) {
            let gap = k.difference(&FrontSif { ki: m.ki, kii: kii * m.kii, kiii: kiii * m.kiii });
            close(gap, 0.0, Of(1e-6, scale), "the wheel's stress and the stiffness by quadrature");
        }
    }
}

#[test]
fn a_crack_along_the_rail_is_the_case_turned() {
    let along = pass(&crack(0.7, FRAC_PI_2), &|x, point| WHEEL.stress(x, point, 0.3));
    // The same seen with z as x: the wheel comes from larger lateral positions.
    let across = pass(&crack(0.7, 0.0), &|x: f64, point: [f64; 3]| {
        let EllipticWheel { half_width, lateral_half_width, friction, lateral_friction, .. } = WHEEL;
        let wheel = EllipticWheel {
            half_width: lateral_half_width,
            lateral_half_width: half_width,
            lateral: -x,
            friction: lateral_friction,
            lateral_friction: -friction,
            ..WHEEL
        };
        wheel.stress(WHEEL.lateral, point, 0.3)
    });
    same(&along, &across, (1.0, 1.0, false));
    let residual = |stress: [f64; 3], strike: f64| {
        let body = body(&crack(0.7, strike), Surroundings::HalfSpace, 2);
        body.sifs(&body.nodal_forces(|_| [stress[0], stress[1], stress[2], 0.0, 0.0, 0.0]))
    };
    let (one, other) = (residual([100.0, 30.0, 0.0], FRAC_PI_2), residual([30.0, 100.0, 0.0], 0.0));
    for (a, b) in one.iter().zip(&other) {
        close(a.difference(b), 0.0, Of(1e-12, 100.0), "residual stress along and across the rail");
    }
    assert!(one[4].ki.abs() < 0.5 * residual([100.0, 30.0, 0.0], 0.0)[4].ki, "another one unturned");
}

#[test]
fn cracks_turned_to_either_side_are_mirror_images() {
    let mirrored =
        EllipticWheel { lateral: -WHEEL.lateral, lateral_friction: -WHEEL.lateral_friction, ..WHEEL };
    let one = pass(&crack(0.5, 0.6), &|x, point| WHEEL.stress(x, point, 0.3));
    let other = pass(&crack(0.5, -0.6), &|x, point| mirrored.stress(x, point, 0.3));
    same(&one, &other, (1.0, -1.0, true));
}

#[test]
fn half_a_turn_leans_the_other_way() {
    // Normal and trace point the other way: the faces change places.
    let one = pass(&crack(0.5, PI), &|x, point| WHEEL.stress(x, point, 0.3));
    let other = pass(&crack(PI - 0.5, 0.0), &|x, point| WHEEL.stress(x, point, 0.3));
    same(&one, &other, (-1.0, 1.0, true));
}

#[test]
fn everything_turned_under_a_round_contact() {
    let wheel = EllipticWheel { lateral_half_width: 6.0, friction: 0.0, lateral_friction: 0.0, ..WHEEL };
    let sifs = |turn: f64| {
        let body = body(&crack(0.6, 0.3 + turn), Surroundings::HalfSpace, 2);
        let (sin, cos) = turn.sin_cos();
        let (x, z) = (7.0 * cos - 2.0 * sin, 7.0 * sin + 2.0 * cos);
        let wheel = EllipticWheel { lateral: z, ..wheel };
        body.sifs(&body.nodal_forces(|point| wheel.stress(x, point, 0.3)))
    };
    let want = sifs(0.0);
    let scale = largest(want.iter().flat_map(|k| [k.ki, k.kii, k.kiii]));
    for turn in [0.5, 1.4, -2.2] {
        for (a, b) in sifs(turn).iter().zip(&want) {
            close(a.difference(b), 0.0, Of(1e-9, scale), "the same points relative to the wheel");
        }
    }
    let unturned = body(&crack(0.6, 0.0), Surroundings::HalfSpace, 2);
    let wheel = EllipticWheel { lateral: 2.0, ..wheel };
    let other = unturned.sifs(&unturned.nodal_forces(|point| wheel.stress(7.0, point, 0.3)));
    assert!(other[4].difference(&want[4]) > 0.01 * scale, "the strike is felt");
}
