//! Kernels between surface elements of any direction.
//!
//! With D_m w_j = (n × ∇w_j)_m the surface curl of a jump, in the full space and for jumps that are
//! continuous and vanish on the edge of the surface (Nedelec 1982; Li, Mear & Xiao 1998),
//!
//!   A(w, w′) = k ∬ [δ_kj D_m w_k D_m w′_j + e_k e_j D_m w_k D_m w′_j − (1 − ν) D_k w_k D_j w′_j
//!              − 2ν D_j w_k D_k w′_j]/r
//!
//! with k = μ/(4π (1 − ν)) and e the direction from point to point.
//!
//! The surface may be curved and have folds: the integrals along a fold cancel between its two
//! sides. On one plane this is the form of `galerkin`.

use super::grid::{Block, CellPoint};
use super::plane::{PAIRS, Symmetric, entry, image_matrix, kelvin_stress, moment, traction};
use super::sheet::SheetPoint;
use std::f64::consts::PI;

/// Hats of a cell.
const HATS: usize = 4;

/// A point of a cell with the curls of its hats.
#[derive(Debug, Clone, Copy)]
pub(super) struct CurlPoint {
    position: [f64; 3],
    /// Surface curls of the hats times area and weight, mm.
    curls: [[f64; 3]; HATS],
}

impl CurlPoint {
    /// That of `point` of a cell, which lies `at` a place of the surface, with its weight. The curl
    /// of a hat is ∂_ζ of it times the tangent along s, less ∂_s of it times that along ζ.
    pub fn new(at: &SheetPoint, point: &CellPoint, weight: f64) -> Self {
        let [along, across] = at.tangents;
        let curl = |[s, zeta]: [f64; 2]| std::array::from_fn(|c| weight * (zeta * along[c] - s * across[c]));
        Self { position: at.position, curls: point.gradients.map(curl) }
    }
}

/// Sums over pairs of points of two cells, of curls c and c′ of their hats over the distance: c_k
/// c′_j, row by row, then c·c′ times each e_k e_j.
pub(super) type WeakSums = [[[f64; 15]; HATS]; HATS];
pub(super) const NO_SUMS: WeakSums = [[[0.0; 15]; HATS]; HATS];

/// Adds the products of `x` with the points `second` to `sums`.
pub(super) fn add_weak(x: &CurlPoint, second: &[CurlPoint], sums: &mut WeakSums) {
    let mut felt = [[[0.0; 7]; 3]; HATS];
    for y in second {
        let d: [f64; 3] = std::array::from_fn(|c| x.position[c] - y.position[c]);
        let square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        let inverse = 1.0 / square.sqrt();
        let cube = inverse / square;
        let kernels: [f64; 7] = std::array::from_fn(|c| match c {
            0 => inverse,
            c => d[PAIRS[c - 1].0] * d[PAIRS[c - 1].1] * cube,
        });
        for (felt, curl) in felt.iter_mut().zip(&y.curls) {
            for (felt, g) in felt.iter_mut().zip(curl) {
                felt.iter_mut().zip(&kernels).for_each(|(felt, kernel)| *felt += g * kernel);
            }
        }
    }
    for (row, curl) in sums.iter_mut().zip(x.curls) {
        for (sum, felt) in row.iter_mut().zip(&felt) {
            for k in 0..3 {
                (0..3).for_each(|j| sum[3 * k + j] += curl[k] * felt[j][0]);
                (0..6).for_each(|c| sum[9 + c] += curl[k] * felt[k][c + 1]);
            }
        }
    }
}

/// Adds the weakly singular form of two cells to their block, in units of the shear modulus;
/// components are along the axes of the rail.
pub(super) fn add_sums(sums: &WeakSums, poisson: f64, block: &mut Block) {
    let scale = 1.0 / (4.0 * PI * (1.0 - poisson));
    for a in 0..HATS {
        for b in 0..HATS {
            let sum = &sums[a][b];
            let trace = sum[0] + sum[4] + sum[8];
            for k in 0..3 {
                for j in 0..3 {
                    let both = if k == j { trace } else { 0.0 } + sum[9 + entry(k, j)];
                    let value = both - (1.0 - poisson) * sum[3 * k + j] - 2.0 * poisson * sum[3 * j + k];
                    block[a][k][b][j] += scale * value;
                }
            }
        }
    }
}

/// The parts of the stress that act between two points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Stress {
    /// The full space.
    Kelvin,
    /// Its image in the surface.
    Image,
    /// The half-space: both.
    HalfSpace,
}

/// A point of a cell with the moments of its hats.
#[derive(Debug, Clone, Copy)]
pub(super) struct MomentPoint {
    position: [f64; 3],
    normal: [f64; 3],
    /// Hats times area and weight, mm².
    hats: [f64; HATS],
    /// Moments of unit jumps along the axes of the rail.
    moments: [Symmetric; 3],
}

impl MomentPoint {
    /// That of `point` of a cell, which lies `at` a place of a surface that unrolls, with its
    /// weight.
    pub fn new(at: &SheetPoint, point: &CellPoint, weight: f64, poisson: f64) -> Self {
        let unit = |j: usize| std::array::from_fn(|i| f64::from(u8::from(i == j)));
        Self {
            position: at.position,
            normal: at.normal,
            hats: point.hats.map(|hat| hat * point.area * weight),
            moments: std::array::from_fn(|j| moment(unit(j), at.normal, poisson)),
        }
    }
}

/// Adds the products of `x` with `second` of minus the traction at x due to jumps, in units of the
/// shear modulus: hats that do not touch. Components are along the axes of the rail.
pub(super) fn add_strong(
    stress: Stress,
    x: &MomentPoint,
    second: &[MomentPoint],
    poisson: f64,
    block: &mut Block,
) {
    let mut felt = [[[0.0; 3]; HATS]; 3];
    for y in second {
        let mut stresses = [[0.0; 6]; 3];
        if stress != Stress::Image {
            let d = std::array::from_fn(|c| x.position[c] - y.position[c]);
            stresses = y.moments.map(|m| kelvin_stress(d, &m, poisson));
        }
        if stress != Stress::Kelvin {
            let image = image_matrix(x.position, y.position, poisson);
            for (stress, m) in stresses.iter_mut().zip(&y.moments) {
                for (value, row) in stress.iter_mut().zip(&image) {
                    *value += row.iter().zip(m).map(|(a, b)| a * b).sum::<f64>();
                }
            }
        }
        let tractions = stresses.map(|stress| traction(&stress, x.normal));
        for (i, felt) in felt.iter_mut().enumerate() {
            for (felt, hat) in felt.iter_mut().zip(y.hats) {
                (0..3).for_each(|j| felt[j] -= hat * tractions[j][i]);
            }
        }
    }
    for a in 0..HATS {
        for i in 0..3 {
            for b in 0..HATS {
                (0..3).for_each(|j| block[a][i][b][j] += x.hats[a] * felt[i][b][j]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::grid::EMPTY;
    use super::super::plane::PlaneFrame;
    use super::*;
    use crate::math::gauss_legendre;

    /// The points of a tent over four cells of 1 mm about (s, ζ), on a cylinder of the radius 6 mm
    /// whose tangent at s = 0 has the dip `dip`.
    fn tent(dip: f64, middle: [f64; 2], x: f64, poisson: f64) -> (Vec<CurlPoint>, Vec<MomentPoint>) {
        let rule = gauss_legendre(8);
        let (mut curls, mut moments) = (Vec::new(), Vec::new());
        for signs in [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]] {
            for (u, wu) in &rule {
                for (v, wv) in &rule {
                    let [a, b] = [*u, *v];
                    let [s, zeta] = [middle[0] + signs[0] * a, middle[1] + signs[1] * b];
                    let turned = dip + s / 6.0;
                    let place = [6.0 * (turned.sin() - dip.sin()), 6.0 * (dip.cos() - turned.cos())];
                    let [normal, along, across] = PlaneFrame::new(turned).directions();
                    let at = SheetPoint {
                        position: [x + place[0], zeta, 3.0 + place[1]],
                        tangents: [along, across],
                        normal,
                    };
                    let mut gradients = [[0.0; 2]; HATS];
                    gradients[0] = [-signs[0] * (1.0 - b), -signs[1] * (1.0 - a)];
                    let hats = [(1.0 - a) * (1.0 - b), 0.0, 0.0, 0.0];
                    let point = CellPoint { position: [s, zeta], hats, gradients, area: 1.0 };
                    curls.push(CurlPoint::new(&at, &point, wu * wv));
                    moments.push(MomentPoint::new(&at, &point, wu * wv, poisson));
                }
            }
        }
        (curls, moments)
    }

    #[test]
    fn curls_of_jumps_on_two_surfaces_have_the_work_of_their_tractions() {
        // Tents that vanish at their edges do not touch: by parts, both forms are the same, in
        // every component and for every Poisson's ratio.
        for poisson in [0.0, 0.3, 0.45] {
            let (mut weak, mut strong, mut sums) = (EMPTY, EMPTY, NO_SUMS);
            let [one, other] = [tent(0.4, [4.0, 0.3], 0.0, poisson), tent(1.3, [2.5, -1.1], 9.5, poisson)];
            one.0.iter().for_each(|x| add_weak(x, &other.0, &mut sums));
            one.1.iter().for_each(|x| add_strong(Stress::Kelvin, x, &other.1, poisson, &mut strong));
            add_sums(&sums, poisson, &mut weak);
            let [weak, strong] = [weak, strong].map(|block| block[0].map(|row| row[0]));
            let largest = strong.iter().flatten().fold(0.0f64, |most, value| most.max(value.abs()));
            for (weak, strong) in weak.iter().flatten().zip(strong.iter().flatten()) {
                assert!((weak - strong).abs() < 1e-6 * largest, "{poisson}: {weak} {strong} {largest}");
            }
        }
    }
}
