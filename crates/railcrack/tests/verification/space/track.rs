//! The rail that bends under the axles: handbook, superposition, the 2D engine.

use super::body;
use crate::common::{Absolute, Of, Relative, close, largest, steel, surface_crack};
use railcrack::contact::{FaceProblem, Newton};
use railcrack::field::{BendingWheel, HertzField, HertzWheel, Uniform, Wheels};
use railcrack::growth::{PassageSettings, Unobserved, output_positions};
use railcrack::load::{Axle, Bending, HertzianContact, NamedSection, Passage, Track};
use railcrack::math::Vec2;
use railcrack::plane::{RailLoad, stabilised_passage};
use railcrack::space::{
    EllipticWheel, SpaceBody, SpaceContact, SpaceCrack, SpaceHistory, SpaceLoad, SpacePassageSettings,
    SpaceResolution, Surroundings, Symmetric, space_passage,
};
use std::f64::consts::{FRAC_PI_2, PI};

/// 60E1 on 50 MPa under 100 kN; a second axle 1.8 m behind.
fn track(axles: &[f64]) -> Track {
    let section = NamedSection::of("60E1").unwrap().section();
    let axles = axles.iter().map(|&at| Axle { at, wheel_load: 100e3 }).collect();
    Track { section, foundation: 50.0, axles }
}

fn beam(axles: &[f64]) -> Bending {
    track(axles).bending(&steel()).unwrap()
}

const NEAR: Passage = Passage { from: -36.0, to: 36.0, positions: 25 };
const WHOLE_STEPS: SpacePassageSettings = SpacePassageSettings { tolerance: f64::INFINITY, halvings: 0 };

fn pass(body: &SpaceBody, load: &SpaceLoad) -> SpaceHistory {
    let contact = SpaceContact { body, friction: &[0.3] };
    space_passage(&contact, load, NEAR, &WHOLE_STEPS, &mut contact.virgin()).unwrap()
}

#[test]
#[ignore = "extra: minutes"]
fn wide_crack_in_bending_alone() {
    // Tada, Paris & Irwin: edge crack under a stress that falls linearly with depth.
    let (length, bending) = (6.0, beam(&[0.0]));
    let crack = SpaceCrack::surface_breaking(FRAC_PI_2, 25.0 * length, length).unwrap();
    let body = body(&crack, Surroundings::HalfSpace, 4);
    let none = |_: f64, _: [f64; 3]| [0.0; 6];
    let history =
        pass(&body, &SpaceLoad { wheel: &none, bending: Some(&bending), constant: None, fluid: None });
    let ki = |sifs: &Vec<railcrack::space::FrontSif>| sifs[sifs.len() / 2].ki;
    let top = largest(history.positions.iter().map(|xc| bending.stress(-xc, 0.0).max(0.0)));
    close(top, 13.1639, Absolute(1e-3), "tension beside an axle: positions hold the place of the largest");
    let axis = bending.track().section.neutral_axis_depth;
    let want = (PI * length).sqrt() * (1.12152 - 0.6829 * length / axis) * top;
    close(largest(history.sifs.iter().map(ki)), want, Relative(5e-3), "a mouth of 50 depths, 4 cells");
    // Compressed under the axle, and back at rest after it.
    let under = history.positions.iter().position(|xc| *xc == 0.0).unwrap();
    close(ki(&history.sifs[under]), 0.0, Of(1e-6, want), "closed");
    close(largest(history.before.iter().map(|k| k.ki)), 0.0, Of(1e-9, want), "nothing stays");
}

#[test]
fn loads_of_an_open_crack_add() {
    let crack = SpaceCrack::surface_breaking(0.9, 4.0, 3.0).unwrap();
    let body = body(&crack, Surroundings::HalfSpace, 2);
    let wheel = EllipticWheel {
        peak_pressure: 100.0,
        half_width: 6.0,
        lateral_half_width: 5.0,
        lateral: 1.0,
        friction: 0.1,
        lateral_friction: 0.0,
    };
    let bending = beam(&[0.0, -1800.0]);
    let contact = |position: f64, point: [f64; 3]| wheel.stress(position, point, 0.3);
    let none = |_: f64, _: [f64; 3]| [0.0; 6];
    let tension = |_: [f64; 3]| [1000.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let both = pass(
        &body,
        &SpaceLoad { wheel: &contact, bending: Some(&bending), constant: Some(&tension), fluid: None },
    );
    let beam = pass(
        &body,
        &SpaceLoad { wheel: &none, bending: Some(&bending), constant: Some(&tension), fluid: None },
    );
    let alone =
        pass(&body, &SpaceLoad { wheel: &contact, bending: None, constant: Some(&tension), fluid: None });
    assert_eq!(both.positions, output_positions(&NEAR, Some(&bending), &[0.0]), "as in the plane");
    assert_eq!(both.positions, beam.positions);
    assert_eq!(alone.positions, NEAR.abscissae());
    let rest: Vec<_> = body.sifs(&body.nodal_forces(tension));
    let scale = largest(rest.iter().map(|k| k.ki));
    let reason = "linear";
    for (a, b) in rest.iter().zip(&both.before) {
        close(a.difference(b), 0.0, Of(1e-9, scale), reason);
    }
    for (k, xc) in both.positions.iter().enumerate() {
        // The beam's stress point by point, and the contact near it.
        let of_beam = body.sifs(
            &body.nodal_forces(|[x, _, depth]| [bending.stress(x - xc, depth), 0.0, 0.0, 0.0, 0.0, 0.0]),
        );
        let near = alone.positions.iter().position(|x| x == xc);
        for (q, rest) in rest.iter().enumerate() {
            let sum = of_beam[q].ki + rest.ki;
            close(beam.sifs[k][q].ki, sum, Of(1e-9, scale), reason);
            if let Some(near) = near {
                let sum = alone.sifs[near][q].ki + of_beam[q].ki;
                close(both.sifs[k][q].ki, sum, Of(1e-9, scale), reason);
            }
        }
    }
}

/// The line contact of the 2D engine: y is up there.
fn line_contact(position: f64, [x, _, depth]: [f64; 3], field: &HertzField) -> Symmetric {
    let s = field.stress(Vec2::new(x, -depth), position);
    [s.xx, s.zz, s.yy, 0.0, -s.xy, 0.0]
}

#[test]
#[ignore = "extra: minutes"]
fn wide_crack_under_axles_of_a_cold_rail() {
    let (degrees, length, cold) = (60.0, 6.0, 72.45);
    let line = HertzianContact { peak_pressure: 845.0, half_width: 6.0, friction: 0.025 };
    let axles = [0.0, -1800.0];
    let plane = crate::common::body(&[surface_crack(0.0, length, degrees)], 20);
    let problem = FaceProblem::new(&plane, &[0.3]).unwrap();
    let on_track = Wheels::on_track(
        HertzWheel::new(&line, &steel()).unwrap(),
        BendingWheel::new(&track(&axles), &steel()).unwrap(),
    );
    let residual = Uniform::along_rail(cold);
    let settings = PassageSettings { passage: NEAR, max_passages: 1, ..PassageSettings::default() };
    let load = RailLoad { wheel: &on_track.unwrap(), residual: Some(&residual) };
    let plane = stabilised_passage(&problem, &Newton::default(), load, &settings, &Unobserved).unwrap();
    let plane = &plane.passages[0];

    let crack = SpaceCrack::surface_breaking(f64::to_radians(degrees), 20.0 * length, length).unwrap();
    let resolution = SpaceResolution::new(4, 4);
    let body = SpaceBody::new(&[crack], &steel(), Surroundings::HalfSpace, resolution).unwrap();
    let field = HertzField::new(&line, 0.3);
    let wheel = |position: f64, point: [f64; 3]| line_contact(position, point, &field);
    let bending = beam(&axles);
    let constant = |_: [f64; 3]| [cold, 0.0, 0.0, 0.0, 0.0, 0.0];
    let load = SpaceLoad { wheel: &wheel, bending: Some(&bending), constant: Some(&constant), fluid: None };
    let contact = SpaceContact { body: &body, friction: &[0.3] };
    let steps = SpacePassageSettings { tolerance: 1.0, halvings: 8 };
    let space = space_passage(&contact, &load, NEAR, &steps, &mut contact.virgin()).unwrap();
    assert_eq!(space.positions, plane.xc);
    let peak = largest(plane.sifs[0].iter().flat_map(|k| [k.ki, k.kii]));
    let far = largest(plane.sifs[0].iter().take(20).map(|k| k.ki));
    let near =
        largest(plane.sifs[0].iter().zip(&plane.xc).filter(|(_, x)| x.abs() < 20.0).map(|(k, _)| k.ki));
    assert!(far > 1.1 * near, "{far} {near}: what bending opens is seen");
    for ((sifs, want), xc) in space.sifs.iter().zip(&plane.sifs[0]).zip(&plane.xc) {
        let got = sifs[sifs.len() / 2];
        let reason = format!("a mouth of 40 depths, 4 cells, the wheel at {xc}");
        close(got.ki, want.ki, Of(0.02, peak), &reason);
        close(got.kii, want.kii, Of(0.02, peak), &reason);
    }
}
