//! Orders of convergence, on a crack so deep in so large a rail that neither is felt: the closed forms of the wide plate.

use crate::common::{buried_crack, largest, sifs_under, steel};
use railcrack::body::CrackedBody;
use railcrack::bulk::{Boundary, BulkRail};
use railcrack::crack::CrackNetwork;
use railcrack::math::{Stress, Vec2};
use railcrack::mesh::QuadMesh;
use railcrack::xfem::{EnrichmentRadius, MeshSettings, Outline, Window, XfemBody, XfemSettings};
use std::f64::consts::PI;

const HALF: f64 = 3.0;
/// Surface and ends change K by about (half-length / distance)², 2e-8.
const CENTRE: Vec2 = Vec2::new(0.0, -20_000.0);
const OUTLINE: Outline = Outline { left: -20_000.0, right: 20_000.0, depth: 40_000.0 };
/// Elements along the crack on the coarsest mesh; the default are 60.
const COARSEST: f64 = 4.0;
/// Parts into which each of its elements, also those far away, is cut along either side.
const MESHES: [usize; 4] = [1, 2, 3, 4];
/// Angles (degrees) over which errors are averaged: that of one crack depends on where nodes happen to be.
const ANGLES: [f64; 2] = [35.0, 62.0];

/// Slope of the line through (log h, log error) by least squares.
fn fitted_order(errors: &[f64]) -> f64 {
    let points: Vec<(f64, f64)> =
        MESHES.iter().zip(errors).map(|(n, error)| (-(*n as f64).ln(), error.abs().ln())).collect();
    let count = points.len() as f64;
    let mean = |pick: fn(&(f64, f64)) -> f64| points.iter().map(pick).sum::<f64>() / count;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let sums = points.iter().fold((0.0, 0.0), |s, p| (s.0 + (p.0 - x) * (p.1 - y), s.1 + (p.0 - x).powi(2)));
    sums.0 / sums.1
}

/// Lines with each interval cut into equal parts.
fn cut(lines: &[f64], parts: usize) -> Vec<f64> {
    let within = |pair: &[f64]| {
        let (from, to) = (pair[0], pair[1]);
        (0..parts).map(move |i| from + (to - from) * i as f64 / parts as f64).collect::<Vec<f64>>()
    };
    let last = lines[lines.len() - 1];
    lines.windows(2).flat_map(within).chain([last]).collect()
}

/// The root of the mean square over `ANGLES` of an error, per mesh.
fn errors(enrichment: EnrichmentRadius, error: impl Fn(f64, &XfemBody) -> f64) -> Vec<f64> {
    let of = |parts: usize, degrees: f64| {
        let network = CrackNetwork::from(buried_crack(CENTRE, HALF, degrees));
        let settings = MeshSettings { element_size: 2.0 * HALF / COARSEST, expected_growth: 1.0 };
        let mesh = Window::new(&network, settings).mesh(OUTLINE).unwrap();
        let (x, y) = (cut(mesh.x_lines(), parts), cut(mesh.y_lines(), parts));
        let mesh = QuadMesh::new(x, y).unwrap();
        let rail = BulkRail::new(mesh, &steel(), Boundary::HalfPlane).unwrap();
        let settings = XfemSettings { enrichment, ..XfemSettings::default() };
        error(degrees, &XfemBody::new(&rail, &network, settings).unwrap())
    };
    let mean = |parts| {
        let squares: f64 = ANGLES.iter().map(|&degrees| of(parts, degrees).powi(2)).sum();
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

/// A crack under the pressure 1 + x/a on its faces.
struct Pressed {
    /// Distance of the face points from the centre along the walk, mm.
    x: Vec<f64>,
    forces: Vec<f64>,
    jumps: Vec<f64>,
}

impl Pressed {
    fn new(body: &XfemBody) -> Self {
        let points = &body.faces().points;
        let (tangent, normal) = (points[0].tangent, points[0].tangent.left());
        let stress = |p: Vec2| {
            let pressure = 1.0 + (p - CENTRE).dot(tangent) / HALF;
            Stress {
                xx: pressure * normal.x * normal.x,
                yy: pressure * normal.y * normal.y,
                xy: pressure * normal.x * normal.y,
                ..Stress::ZERO
            }
        };
        let forces = body.faces().nodal_forces(stress);
        let jumps = body.compliance().times(&forces);
        Self { x: points.iter().map(|p| (p.position - CENTRE).dot(tangent)).collect(), forces, jumps }
    }
}

/// Least order of the work of the pressure on the jumps.
const WORK_ORDER: f64 = 1.8;

/// The opening is (4/E′) √(a² − x²) (1 + x/(2a)), and the work of the pressure on it (9/4) π a²/E′.
#[test]
fn work_of_a_sampled_pressure() {
    let want = 2.25 * PI * HALF * HALF / steel().plane_strain_modulus();
    let errors = errors(XfemSettings::default().enrichment, |_, body| {
        let pressed = Pressed::new(body);
        pressed.forces.iter().zip(&pressed.jumps).map(|(f, w)| f * w).sum::<f64>() / want - 1.0
    });
    println!("errors {errors:?}, order {:.2}", fitted_order(&errors));
    assert!(fitted_order(&errors) > WORK_ORDER, "{errors:?}");
}

/// Least order of the largest error of a jump. Jumps are linear in g ~ √r between points whose distance in g is a third of √h next to
/// a tip: the second derivative is of the order of the jump there, √h, and the error h √h.
const JUMP_ORDER: f64 = 1.2;

#[test]
fn jumps_under_a_sampled_pressure() {
    let opening = |x: f64| {
        4.0 / steel().plane_strain_modulus() * (HALF * HALF - x * x).max(0.0).sqrt() * (1.0 + 0.5 * x / HALF)
    };
    let errors = errors(XfemSettings::default().enrichment, |_, body| {
        let pressed = Pressed::new(body);
        let error = |(j, &x): (usize, &f64)| pressed.jumps[2 * j + 1] - opening(x);
        largest(pressed.x.iter().enumerate().map(error)) / largest(pressed.x.iter().map(|&x| opening(x)))
    });
    println!("errors {errors:?}, order {:.2}", fitted_order(&errors));
    assert!(fitted_order(&errors) > JUMP_ORDER, "{errors:?}");
}
