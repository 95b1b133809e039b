//! Orders of convergence, on a crack so deep in so large a rail that neither is felt: the closed forms of the wide plate.

use crate::common::{buried_crack, largest, sifs_under, steel};
use railcrack::body::CrackedBody;
use railcrack::bulk::{Boundary, BulkRail};
use railcrack::crack::CrackNetwork;
use railcrack::math::{Stress, Vec2};
use railcrack::xfem::{EnrichmentRadius, MeshSettings, Outline, Window, XfemBody, XfemSettings};
use std::f64::consts::PI;

const HALF: f64 = 3.0;
/// Surface and ends change K by about (half-length / distance)², 2e-8.
const CENTRE: Vec2 = Vec2::new(0.0, -20_000.0);
const OUTLINE: Outline = Outline { left: -20_000.0, right: 20_000.0, depth: 40_000.0 };
/// Elements along the crack; the default are 60.
const MESHES: [f64; 5] = [6.0, 9.0, 13.5, 20.25, 30.375];
/// Angles (degrees) over which errors are averaged: that of one crack depends on where nodes happen to be.
const ANGLES: [f64; 3] = [10.0, 35.0, 62.0];

/// Slope of the line through (log h, log error) by least squares.
fn fitted_order(errors: &[f64]) -> f64 {
    let points: Vec<(f64, f64)> =
        MESHES.iter().zip(errors).map(|(n, error)| (-n.ln(), error.abs().ln())).collect();
    let count = points.len() as f64;
    let mean = |pick: fn(&(f64, f64)) -> f64| points.iter().map(pick).sum::<f64>() / count;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let sums = points.iter().fold((0.0, 0.0), |s, p| (s.0 + (p.0 - x) * (p.1 - y), s.1 + (p.0 - x).powi(2)));
    sums.0 / sums.1
}

/// The root of the mean square over `ANGLES` of an error, per mesh.
fn errors(enrichment: EnrichmentRadius, error: impl Fn(f64, &XfemBody) -> f64) -> Vec<f64> {
    let of = |elements: f64, degrees: f64| {
        let network = CrackNetwork::from(buried_crack(CENTRE, HALF, degrees));
        let settings = MeshSettings { element_size: 2.0 * HALF / elements, expected_growth: 1.0 };
        let mesh = Window::new(&network, settings).mesh(OUTLINE).unwrap();
        let rail = BulkRail::new(mesh, &steel(), Boundary::HalfPlane).unwrap();
        let settings = XfemSettings { enrichment, ..XfemSettings::default() };
        error(degrees, &XfemBody::new(&rail, &network, settings).unwrap())
    };
    let mean = |elements| {
        let squares: f64 = ANGLES.iter().map(|&degrees| of(elements, degrees).powi(2)).sum();
        (squares / ANGLES.len() as f64).sqrt()
    };
    MESHES.map(mean).to_vec()
}

/// K under σ_yy = 1 against σ√(πa) cos²α and σ√(πa) cos α sin α, over σ√(πa); the largest of both tips and modes.
fn sif_error(degrees: f64, body: &XfemBody) -> f64 {
    let unit = (PI * HALF).sqrt();
    let (sin, cos) = degrees.to_radians().sin_cos();
    let k = sifs_under(body, |_| Stress { yy: 1.0, ..Stress::ZERO });
    let want = [cos * cos, cos * sin, cos * cos, cos * sin].map(|f| f * unit);
    largest(k.iter().zip(want).map(|(k, want)| k - want)) / unit
}

/// Least order of K: the √r functions are there in a part of the rail that does not shrink, and elements are quadratic.
const FIXED_ORDER: f64 = 3.0;
/// Least order where the part with √r functions shrinks with the elements: what is left of √r outside decides.
const SHRINKING_ORDER: f64 = 0.8;

#[test]
fn sif_with_a_fixed_enrichment_radius() {
    let errors = errors(EnrichmentRadius::Fixed(1.5), sif_error);
    println!("errors {errors:?}, order {:.2}", fitted_order(&errors));
    assert!(fitted_order(&errors) > FIXED_ORDER, "{errors:?}");
}

#[test]
fn sif_with_an_enrichment_of_some_elements() {
    let errors = errors(XfemSettings::default().enrichment, sif_error);
    println!("errors {errors:?}, order {:.2}", fitted_order(&errors));
    assert!(fitted_order(&errors) > SHRINKING_ORDER, "{errors:?}");
}

/// Under a pressure 1 + x/a on its faces a crack opens by (4/E′) √(a² − x²) (1 + x/(2a)); sampled at the quadrature points of
/// the faces. The largest error of a nodal jump over the largest jump.
fn jump_error(_: f64, body: &XfemBody) -> f64 {
    let points = &body.faces().points;
    let along = |p: Vec2| (p - CENTRE).dot(points[0].tangent);
    let normal = points[0].tangent.left();
    let stress = |p: Vec2| {
        let pressure = 1.0 + along(p) / HALF;
        let part = |a: f64, b: f64| pressure * a * b;
        Stress {
            xx: part(normal.x, normal.x),
            yy: part(normal.y, normal.y),
            xy: part(normal.x, normal.y),
            ..Stress::ZERO
        }
    };
    let jumps = body.compliance().times(&body.faces().nodal_forces(stress));
    let opening = |x: f64| {
        4.0 / steel().plane_strain_modulus() * (HALF * HALF - x * x).max(0.0).sqrt() * (1.0 + 0.5 * x / HALF)
    };
    let error = |(j, x): (usize, f64)| jumps[2 * j + 1] - opening(x);
    largest(points.iter().map(|p| along(p.position)).enumerate().map(error))
        / largest(points.iter().map(|p| opening(along(p.position))))
}

/// Least order of the jumps at the face points.
const JUMP_ORDER: f64 = 1.5;

#[test]
fn jumps_under_a_sampled_pressure() {
    let errors = errors(XfemSettings::default().enrichment, jump_error);
    println!("errors {errors:?}, order {:.2}", fitted_order(&errors));
    assert!(fitted_order(&errors) > JUMP_ORDER, "{errors:?}");
}
