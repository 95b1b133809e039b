//! Cracks in a rail of finite section: strips, head with web and foot.

use crate::common::{
    Meshed, Of, Relative, TENSION, close, column, default_elements, measured, measured_order, order,
    polyline, rows, sifs_of, steel, surface_crack,
};
use railcrack::body::{BodyEngine, CrackedBody};
use railcrack::crack::{Crack, CrackNetwork};
use railcrack::dislocation::{DislocationEngine, FaceResolution};
use railcrack::load::NamedSection;
use railcrack::math::{Stress, Vec2};
use railcrack::section::{Layer, SectionEngine, SectionLayers};
use std::f64::consts::PI;

fn rail() -> SectionLayers {
    SectionLayers::of(NamedSection::of("60E1").unwrap()).unwrap()
}

/// The body of `cracks` in a free rail of `layers`, of the half-plane engine `engine`.
fn of_engine(engine: Box<dyn BodyEngine + Send>, cracks: &[Crack], layers: SectionLayers) -> CrackedBody {
    let network = CrackNetwork::new(cracks.to_vec()).unwrap();
    SectionEngine::new(engine, steel(), layers, 0.0).unwrap().body(&network).unwrap()
}

fn dislocations(elements: usize) -> Box<dyn BodyEngine + Send> {
    Box::new(DislocationEngine { resolution: FaceResolution { elements }, ..DislocationEngine::new(steel()) })
}

fn body(cracks: &[Crack], layers: SectionLayers) -> CrackedBody {
    of_engine(dislocations(default_elements()), cracks, layers)
}

/// K_I over √(πa) of an edge crack of depth `a` in a rail of `layers`.
fn factor(a: f64, layers: SectionLayers, stress: impl Fn(Vec2) -> Stress) -> f64 {
    sifs_of(&body(&[surface_crack(0.0, a, 90.0)], layers), stress)[0] / (PI * a).sqrt()
}

#[test]
fn edge_crack_in_a_strip() {
    const HEIGHT: f64 = 50.0;
    let table = rows("strip-edge-crack/factors.csv");
    let (tension, bending) = (column(&table, "tension"), column(&table, "bending"));
    for (i, share) in column(&table, "a_over_h").into_iter().enumerate() {
        let of =
            |stress: &dyn Fn(Vec2) -> Stress| factor(share * HEIGHT, SectionLayers::strip(HEIGHT), stress);
        let linear = |point: Vec2| Stress { xx: 1.0 + 2.0 * point.y / HEIGHT, ..Stress::ZERO };
        let reason = "default elements; the reference has five digits";
        close(of(&|_| TENSION), tension[i], Relative(2e-4), reason);
        close(of(&linear), bending[i], Relative(2e-4), reason);
    }
}

#[test]
fn layers_of_one_width_are_a_strip() {
    let parts = SectionLayers {
        head: Layer { height: 20.0, width: 72.0 },
        below: [12.0, 18.0].map(|height| Layer { height, width: 72.0 }).to_vec(),
    };
    for crack in [surface_crack(3.0, 15.0, 90.0), polyline(&[(0.0, 0.0), (8.0, -4.0), (10.0, -14.0)])] {
        let [strip, parts] = [SectionLayers::strip(50.0), parts.clone()]
            .map(|layers| sifs_of(&body(std::slice::from_ref(&crack), layers), |_| TENSION));
        for (one, other) in strip.iter().zip(&parts) {
            close(*other, *one, Of(1e-5, strip[0]), "quadrature over the wave numbers");
        }
    }
}

/// The correction of a shallow crack is of second order in its depth.
#[test]
fn shallow_cracks_are_in_a_half_plane() {
    let plane = |a: f64| {
        let network = CrackNetwork::new(vec![surface_crack(0.0, a, 90.0)]).unwrap();
        sifs_of(&dislocations(default_elements()).body(&network).unwrap(), |_| TENSION)[0] / (PI * a).sqrt()
    };
    let excess: Vec<f64> = [2.0, 1.0, 0.5].map(|a| factor(a, rail(), |_| TENSION) / plane(a) - 1.0).to_vec();
    for pair in excess.windows(2) {
        let order = order(pair[0], pair[1]);
        measured_order(order, 1.9, "volume of the crack times the stress that it reflects");
        assert!(order > 1.9 && pair[1] > 0.0, "{excess:?}");
    }
}

/// (K_I² + K_II²)(1 − ν²)/E is the derivative of the work of the faces.
#[test]
fn energy_release_is_that_of_the_sifs() {
    const STEP: f64 = 0.1;
    let stress = |point: Vec2| Stress { xx: 100.0 + 2.0 * point.y, xy: -20.0, ..Stress::ZERO };
    let of = |length: f64| {
        let crack = surface_crack(0.0, length, 60.0);
        let body = of_engine(dislocations(80), &[crack], rail());
        let forces = body.faces.nodal_forces(stress);
        let jumps = body.compliance.times(&forces);
        let work: f64 = forces.iter().zip(&jumps).map(|(f, w)| 0.5 * f * w).sum();
        (work, sifs_of(&body, stress))
    };
    for length in [12.0, 30.0] {
        let (shorter, (_, k), longer) = (of(length - STEP), of(length), of(length + STEP));
        let release = (longer.0 - shorter.0) / (2.0 * STEP);
        let of_sifs = (k[0].powi(2) + k[1].powi(2)) * (1.0 - 0.09) / 210e3;
        close(of_sifs, release, Relative(1e-4), "80 elements; energy converges twice as fast as K");
    }
}

#[test]
fn engines_agree() {
    let crack = polyline(&[(0.0, 0.0), (6.0, -3.0), (9.0, -14.0)]);
    let meshed = Meshed::still().engine(std::slice::from_ref(&crack));
    let stress = |point: Vec2| Stress { xx: 80.0 + point.y, ..Stress::ZERO };
    let meshed = sifs_of(&of_engine(Box::new(meshed), std::slice::from_ref(&crack), rail()), stress);
    let dislocations = sifs_of(&body(&[crack], rail()), stress);
    for (one, other) in meshed.iter().zip(&dislocations) {
        close(*one, *other, Of(5e-3, dislocations[0]), "as in the half-plane");
    }
}

/// Against plane finite elements with the thickness of head, web and foot, free and on a
/// foundation.
#[test]
fn edge_crack_in_a_rail() {
    let table = rows("strip-edge-crack/rail_fe.csv");
    let [depths, foundations, factors] =
        ["depth_mm", "foundation_mpa", "tension"].map(|name| column(&table, name));
    for ((a, foundation), want) in depths.into_iter().zip(foundations).zip(factors) {
        let network = CrackNetwork::new(vec![surface_crack(0.0, a, 90.0)]).unwrap();
        let engine = dislocations(default_elements());
        let body = SectionEngine::new(engine, steel(), rail(), foundation).unwrap().body(&network).unwrap();
        let got = sifs_of(&body, |_| TENSION)[0] / (PI * a).sqrt();
        close(got, want, Relative(2e-3), "elements of 0.08 mm at the tip, energies 2 % of the depth apart");
    }
}

/// The foundation only stiffens: K lies between that of the half-plane and that of the free rail.
#[test]
fn foundation_stiffens() {
    let crack = surface_crack(0.0, 20.0, 90.0);
    let network = CrackNetwork::new(vec![crack]).unwrap();
    let on = |foundation: f64| {
        let engine = dislocations(default_elements());
        let body = SectionEngine::new(engine, steel(), rail(), foundation).unwrap().body(&network).unwrap();
        sifs_of(&body, |_| TENSION)[0]
    };
    let stiffer: Vec<f64> = [0.0, 10.0, 50.0, 500.0].map(on).to_vec();
    assert!(stiffer.windows(2).all(|pair| pair[1] < pair[0]), "{stiffer:?}");
    let change = stiffer[0] / stiffer[2] - 1.0;
    assert!((0.015..0.025).contains(&change), "two per cent at 20 mm: {stiffer:?}");
}

#[test]
fn body_is_symmetric_and_definite() {
    let cracks = [surface_crack(0.0, 18.0, 50.0), surface_crack(7.0, 9.0, 35.0)];
    let body = body(&cracks, rail());
    let size = body.stiffness.rows();
    let mut product: f64 = 0.0;
    for i in 0..size {
        for j in 0..size {
            assert_eq!(body.stiffness[(i, j)], body.stiffness[(j, i)]);
            let entry: f64 = (0..size).map(|k| body.stiffness[(i, k)] * body.compliance[(k, j)]).sum();
            product = product.max((entry - f64::from(i == j)).abs());
        }
    }
    measured(product, 1e-9, "round-off of the inverse");
    assert!(product < 1e-9, "{product}");
}
