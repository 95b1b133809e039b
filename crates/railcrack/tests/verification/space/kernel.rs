//! Strains of a uniform jump over a triangle, summed over double forces, against a package of
//! triangular dislocations.

use crate::common::{Absolute, close, rows};
use railcrack::math::gauss_legendre;
use railcrack::space::{Symmetric, image_stress, kelvin_stress, moment};

/// Strain over stress in units of the shear modulus.
fn strain(stress: Symmetric, poisson: f64) -> Symmetric {
    let trace = stress[0] + stress[1] + stress[2];
    std::array::from_fn(|i| {
        let volumetric = if i < 3 { poisson / (1.0 + poisson) * trace } else { 0.0 };
        0.5 * (stress[i] - volumetric)
    })
}

#[test]
fn triangular_dislocations() {
    let rule = gauss_legendre(16);
    for row in rows("space-kernel/triangles.csv").1 {
        // The depth counts down here: axes x, y, −z.
        let down = |v: &[f64]| [v[0], v[1], -v[2]];
        let poisson = row[0];
        let (a, b, c) = (down(&row[1..4]), down(&row[4..7]), down(&row[7..10]));
        let (jump, point) = (down(&row[10..13]), down(&row[13..16]));
        let edge = |to: [f64; 3]| -> [f64; 3] { std::array::from_fn(|i| to[i] - a[i]) };
        let (u, v) = (edge(b), edge(c));
        // Mirrored axes turn the vector product round.
        let across = [u[2] * v[1] - u[1] * v[2], u[0] * v[2] - u[2] * v[0], u[1] * v[0] - u[0] * v[1]];
        let area = across.iter().map(|x| x * x).sum::<f64>().sqrt();
        let normal = across.map(|x| x / area);
        let m = moment(jump, normal, poisson);
        let (mut full, mut image) = ([0.0; 6], [0.0; 6]);
        for (p, wp) in &rule {
            for (q, wq) in &rule {
                let source: [f64; 3] = std::array::from_fn(|i| a[i] + p * (u[i] + q * (v[i] - u[i])));
                let weight = wp * wq * p * area;
                let d = std::array::from_fn(|i| point[i] - source[i]);
                let (k, i) = (kelvin_stress(d, &m, poisson), image_stress(point, source, &m, poisson));
                (0..6).for_each(|c| {
                    full[c] += weight * k[c];
                    image[c] += weight * i[c];
                });
            }
        }
        let (full, image) = (strain(full, poisson), strain(image, poisson));
        for c in 0..6 {
            let sign = if c == 3 || c == 4 { -1.0 } else { 1.0 };
            let reason = "round-off of the package; 16 × 16 points over the triangle";
            close(sign * full[c], row[16 + c], Absolute(1e-12), reason);
            close(sign * image[c], row[22 + c] - row[16 + c], Absolute(1e-12), reason);
        }
    }
}
