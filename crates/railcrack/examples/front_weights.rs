//! The weights with which a load along the front of a crack counts at its deepest point: of shear
//! on closed faces of semi-ellipses, by the engine in space.
//!
//! `front_weights CELLS DEGREES ASPECT ...` prints, for each half length over the length down the
//! dip, the contribution to K_II of shear cos(k y) in a band around s, over that of even shear
//! there in the plane: α (1 + β q) e^(−q) with q = R k l, and the largest error of that form up to
//! k l = 6. The tables of the library are those of 10 cells, of aspects 1 and 2.

use railcrack::body::{BodyEngine, CrackedBody};
use railcrack::crack::Crack;
use railcrack::dislocation::{DislocationEngine, FaceResolution};
use railcrack::linear::general_inverse;
use railcrack::material::IsotropicElastic;
use railcrack::math::{Matrix, Stress};
use railcrack::space::{SpaceBody, SpaceCrack, SpaceResolution, Surroundings};
use std::error::Error;

/// Length down the dip, mm.
const LENGTH: f64 = 10.0;
/// Middles of the bands, and half their width, over the length.
const BANDS: [f64; 8] = [0.06, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 0.96];
const HALF_BAND: f64 = 0.1;
/// k l.
const WAVES: [f64; 11] = [0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0];

/// A hat around the middle of a band, narrower next to the front.
fn hat(s: f64, middle: f64) -> f64 {
    let half = HALF_BAND.min(1.0 - middle);
    (1.0 - (s - middle).abs() / half).max(0.0)
}

/// K_II of the deepest point by unit forces along the dip (N) on closed faces that slide freely.
fn influence(body: &SpaceBody) -> Result<Vec<f64>, Box<dyn Error>> {
    let count = body.points().len();
    let middle = body.front().iter().enumerate().min_by(|a, b| {
        let off = |phi: f64| (phi - std::f64::consts::FRAC_PI_2).abs();
        off(a.1.phi).total_cmp(&off(b.1.phi))
    });
    let row = 3 * middle.ok_or("no front")?.0 + 1;
    // K of jumps: S A.
    let of_jumps = body.stiffness().times(body.sif_influence().row(row));
    let unknowns: Vec<usize> = (0..count).flat_map(|i| [3 * i + 1, 3 * i + 2]).collect();
    let stiffness = body.stiffness();
    let reduced =
        Matrix::from_fn(unknowns.len(), unknowns.len(), |i, j| stiffness.entry(unknowns[i], unknowns[j]));
    let inverse = general_inverse(&reduced)?;
    let own: Vec<f64> = unknowns.iter().map(|i| of_jumps[*i]).collect();
    let all = inverse.times(&own);
    Ok((0..count).map(|i| all[2 * i]).collect())
}

/// The same of the crack in the plane, per force (N/mm).
fn influence_in_plane(
    angle: f64,
    steel: IsotropicElastic,
) -> Result<(CrackedBody, Vec<f64>), Box<dyn Error>> {
    let crack = Crack::surface_breaking(0.0, LENGTH, angle)?;
    let mut engine = DislocationEngine { steel, resolution: FaceResolution { elements: 40 } };
    let body = engine.body(&crack.into())?;
    let count = body.faces.points.len();
    let of_jumps = body.stiffness.transposed().times(body.sif_influence.row(1));
    let reduced = Matrix::from_fn(count, count, |i, j| body.stiffness.row(2 * j)[2 * i]);
    let own: Vec<f64> = (0..count).map(|i| of_jumps[2 * i]).collect();
    let all = general_inverse(&reduced)?.times(&own);
    Ok((body, all))
}

/// The A, B and R that fit `values` at [`WAVES`] best, and the largest error.
fn fit(values: &[f64]) -> [f64; 4] {
    let mut best = [f64::INFINITY; 4];
    for i in 1..400 {
        let reach = 0.005 * f64::from(i);
        let basis = |k: f64| [(-reach * k).exp(), reach * k * (-reach * k).exp()];
        let (mut m, mut r) = ([[0.0; 2]; 2], [0.0; 2]);
        for (k, value) in WAVES.iter().zip(values) {
            let b = basis(*k);
            for a in 0..2 {
                r[a] += b[a] * value;
                (0..2).for_each(|c| m[a][c] += b[a] * b[c]);
            }
        }
        let det = m[0][0] * m[1][1] - m[0][1] * m[1][0];
        let coefficients = [(r[0] * m[1][1] - r[1] * m[0][1]) / det, (m[0][0] * r[1] - m[1][0] * r[0]) / det];
        let error = WAVES.iter().zip(values).map(|(k, value)| {
            let b = basis(*k);
            (coefficients[0] * b[0] + coefficients[1] * b[1] - value).abs()
        });
        let error = error.fold(0.0, f64::max);
        if error < best[3] {
            best = [coefficients[0], coefficients[1], reach, error];
        }
    }
    best
}

/// Shear along the dip of a crack at `angle` in the plane, as a stress.
fn shear_in_plane(angle: f64) -> Stress {
    let (sin, cos) = (2.0 * angle).sin_cos();
    Stress { xx: sin, yy: -sin, zz: 0.0, xy: cos }
}

/// The same in space: xx, yy (lateral), zz (depth), yz, xz, xy.
fn shear_in_space(angle: f64) -> [f64; 6] {
    let (sin, cos) = (2.0 * angle).sin_cos();
    [sin, 0.0, -sin, 0.0, -cos, 0.0]
}

/// For each band, the contributions at [`WAVES`] over that of even shear in the plane.
fn contributions(angle: f64, aspect: f64, cells: usize) -> Result<Vec<Vec<f64>>, Box<dyn Error>> {
    let steel = IsotropicElastic::new(210e3, 0.3)?;
    let (plane, weights) = influence_in_plane(angle, steel)?;
    let crack = SpaceCrack::surface_breaking(angle, aspect * LENGTH, LENGTH)?;
    let resolution = SpaceResolution::new(cells, cells);
    let body = SpaceBody::new(&[crack], &steel, Surroundings::HalfSpace, resolution)?;
    let own = influence(&body)?;
    let (flat, round) = (shear_in_plane(angle), shear_in_space(angle));
    let of_band = |middle: f64| {
        let in_plane = plane.faces.nodal_forces(|point| flat * hat(point.x.hypot(point.y) / LENGTH, middle));
        let even: f64 = weights.iter().enumerate().map(|(i, weight)| weight * in_plane[2 * i]).sum();
        let at = |wave: &f64| {
            let forces = body.nodal_forces(|[x, y, z]| {
                let load = hat(x.hypot(z) / LENGTH, middle) * (wave / LENGTH * y).cos();
                round.map(|component| load * component)
            });
            own.iter().enumerate().map(|(i, weight)| weight * forces[3 * i + 1]).sum::<f64>() / even
        };
        WAVES.iter().map(at).collect()
    };
    Ok(BANDS.map(of_band).to_vec())
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let numbers: Vec<f64> = std::env::args().skip(1).filter_map(|word| word.parse().ok()).collect();
    let (cells, degrees) = match numbers[..] {
        [cells, degrees, ..] => (cells as usize, degrees),
        _ => (4, 30.0),
    };
    let aspects = numbers.get(2..).filter(|own| !own.is_empty()).unwrap_or(&[2.0]);
    println!("degrees, half length over length, s/l, alpha, beta, R, largest error");
    for &aspect in aspects {
        let bands = contributions(degrees.to_radians(), aspect, cells)?;
        for (middle, values) in BANDS.iter().zip(&bands) {
            let [a, b, reach, error] = fit(values);
            println!("{degrees}, {aspect}, {middle}, {a:.3}, {:.3}, {reach:.3}, {error:.3}", b / a);
        }
    }
    Ok(())
}
