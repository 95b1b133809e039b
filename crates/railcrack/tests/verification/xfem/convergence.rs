//! Orders of convergence.

use crate::common::{Absolute, Meshed, TENSION, buried_crack, close, largest, sifs_under, steel, surface_crack};
use railcrack::math::{Stress, Vec2};
use railcrack::xfem::{EnrichmentRadius, XfemSettings};
use std::f64::consts::PI;

const LENGTH: f64 = 6.0;
/// Koiter (1965).
const NORMAL_CRACK: f64 = 1.121_522_255_2;
/// Elements along the crack; the default are 60.
const MESHES: [f64; 5] = [4.0, 6.0, 9.0, 13.5, 20.25];

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

fn meshed(elements: f64, enrichment: EnrichmentRadius) -> Meshed {
    Meshed {
        settings: XfemSettings { enrichment, ..XfemSettings::default() },
        ..Meshed::of_size(LENGTH / elements)
    }
}

fn edge_crack_errors(enrichment: EnrichmentRadius) -> Vec<f64> {
    MESHES
        .map(|elements| {
            let body = meshed(elements, enrichment).body(&[surface_crack(0.0, LENGTH, 90.0)]);
            sifs_under(body.as_ref(), |_| TENSION)[0] / (NORMAL_CRACK * (PI * LENGTH).sqrt()) - 1.0
        })
        .to_vec()
}

#[test]
fn edge_crack_with_a_fixed_enrichment_radius() {
    let errors = edge_crack_errors(EnrichmentRadius::Fixed(1.5));
    println!("errors {errors:?}, order {:.2}", fitted_order(&errors));
    assert!(fitted_order(&errors) > 3.0);
}

#[test]
fn edge_crack_with_an_enrichment_of_some_elements() {
    let errors = edge_crack_errors(XfemSettings::default().enrichment);
    println!("errors {errors:?}, order {:.2}", fitted_order(&errors));
    assert!(fitted_order(&errors) > 1.0);
}

/// σ_yy = sin(x/2) + x²/9 about the centre of a deep crack, sampled at the faces: the weighted jump Σ w² ds.
#[test]
fn jump_under_sampled_tractions() {
    const HALF: f64 = 3.0;
    // K = (4/E′) …: under σ_yy = 1 + x/a the opening is (4/E′) √(a² − x²) (1 + x/(2 a)).
    let modulus = steel().plane_strain_modulus();
    let exact = |x: f64| 4.0 / modulus * (HALF * HALF - x * x).max(0.0).sqrt() * (1.0 + 0.5 * x / HALF);
    let errors: Vec<f64> = MESHES
        .map(|elements| {
            let crack = buried_crack(Vec2::new(0.0, -2000.0), HALF, 0.0);
            let body = meshed(elements, XfemSettings::default().enrichment).body(&[crack]);
            let stress = |p: Vec2| Stress { yy: 1.0 + p.x / HALF, ..Stress::ZERO };
            let jumps = body.compliance().times(&body.faces().nodal_forces(stress));
            let points = &body.faces().points;
            let error = largest(points.iter().enumerate().map(|(j, p)| jumps[2 * j + 1] - exact(p.position.x)));
            error / exact(0.5 * HALF)
        })
        .to_vec();
    println!("errors {errors:?}, order {:.2}", fitted_order(&errors));
    close(fitted_order(&errors), 2.0, Absolute(0.5), "linear jumps");
}
