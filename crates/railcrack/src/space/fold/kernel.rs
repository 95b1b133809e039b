//! Kernels between surface elements in different planes.
//!
//! With D_m w_j = (n × ∇w_j)_m the surface curl of a jump, in the full space and for jumps that are
//! continuous and vanish on the edge of the surface (Nedelec 1982; Li, Mear & Xiao 1998),
//!
//!   A(w, w′) = k ∬ [δ_kj D_m w_k D_m w′_j + e_k e_j D_m w_k D_m w′_j − (1 − ν) D_k w_k D_j w′_j
//!              − 2ν D_j w_k D_k w′_j]/r
//!
//! with k = μ/(4π (1 − ν)) and e the direction from point to point.
//!
//! The surface may have folds: the integrals along a fold cancel between its two planes. On one
//! plane this is the form of `galerkin`.

use super::super::grid::Block;
use super::super::plane::{PlaneFrame, image_matrix, kelvin_stress, moment, traction};
use crate::math::dot3;
use std::f64::consts::PI;

/// Hats of a cell.
pub(super) const HATS: usize = 4;

/// A point of a cell in the rail.
#[derive(Debug, Clone, Copy)]
pub(super) struct SurfacePoint {
    /// x, lateral, depth, mm.
    pub position: [f64; 3],
    /// Unit normal.
    pub normal: [f64; 3],
    /// Hats times area and weight, mm².
    pub hats: [f64; HATS],
    /// Gradients of the hats (∂_s, ∂_ζ) times area and weight, mm.
    pub gradients: [[f64; 2]; HATS],
}

/// The entries e_k e_j of a symmetric tensor.
const PAIRS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)];
const ENTRY: [[usize; 3]; 3] = [[0, 5, 4], [5, 1, 3], [4, 3, 2]];

/// Sums over pairs of points of two cells, of gradients (s, ζ) of their hats over the distance: the
/// products ss, sζ, ζs and ζζ, then ss and ζζ times each e_k e_j.
pub(super) type WeakSums = [[[f64; 16]; HATS]; HATS];
pub(super) const NO_SUMS: WeakSums = [[[0.0; 16]; HATS]; HATS];

/// Adds the products of `x` with the points `second` to `sums`.
pub(super) fn add_weak(x: &SurfacePoint, second: &[SurfacePoint], sums: &mut WeakSums) {
    let mut felt = [[[0.0; 7]; 2]; HATS];
    for y in second {
        let d: [f64; 3] = std::array::from_fn(|c| x.position[c] - y.position[c]);
        let square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        let inverse = 1.0 / square.sqrt();
        let cube = inverse / square;
        let kernels: [f64; 7] = std::array::from_fn(|c| match c {
            0 => inverse,
            c => d[PAIRS[c - 1].0] * d[PAIRS[c - 1].1] * cube,
        });
        for (felt, gradient) in felt.iter_mut().zip(&y.gradients) {
            for (felt, g) in felt.iter_mut().zip(gradient) {
                felt.iter_mut().zip(&kernels).for_each(|(felt, kernel)| *felt += g * kernel);
            }
        }
    }
    for (row, [s, zeta]) in sums.iter_mut().zip(x.gradients) {
        for (sum, [of_s, of_zeta]) in row.iter_mut().zip(&felt) {
            sum[0] += s * of_s[0];
            sum[1] += s * of_zeta[0];
            sum[2] += zeta * of_s[0];
            sum[3] += zeta * of_zeta[0];
            for c in 0..6 {
                sum[4 + c] += s * of_s[c + 1];
                sum[10 + c] += zeta * of_zeta[c + 1];
            }
        }
    }
}

/// Adds the weakly singular form of two cells in `planes` to their block, in units of the shear
/// modulus. The curl of a hat with the gradient (s, ζ) is ζ times the dip less s times the trace.
pub(super) fn add_sums(sums: &WeakSums, planes: [&PlaneFrame; 2], poisson: f64, block: &mut Block) {
    let scale = 1.0 / (4.0 * PI * (1.0 - poisson));
    let [[_, dip, trace], [_, other_dip, _]] = planes.map(PlaneFrame::directions);
    let cosine = dot3(dip, other_dip);
    for a in 0..HATS {
        for b in 0..HATS {
            let sum = &sums[a][b];
            let products = |k: usize, j: usize| {
                sum[3] * dip[k] * other_dip[j] - sum[2] * dip[k] * trace[j] - sum[1] * trace[k] * other_dip[j]
                    + sum[0] * trace[k] * trace[j]
            };
            for k in 0..3 {
                for j in 0..3 {
                    let entry = ENTRY[k][j];
                    let mut value = cosine * sum[10 + entry] + sum[4 + entry];
                    if k == j {
                        value += cosine * sum[3] + sum[0];
                    }
                    value -= (1.0 - poisson) * products(k, j) + 2.0 * poisson * products(j, k);
                    block[a][k][b][j] += scale * value;
                }
            }
        }
    }
}

/// The part of the stress that acts between two points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Stress {
    /// The full space.
    Kelvin,
    /// Its image in the surface.
    Image,
}

/// Adds the products of `x` with `second` of minus the traction at x due to jumps, in units of the
/// shear modulus: hats that do not touch.
pub(super) fn add_strong(
    stress: Stress,
    x: &SurfacePoint,
    second: &[SurfacePoint],
    poisson: f64,
    block: &mut Block,
) {
    let unit = |j: usize| std::array::from_fn(|i| f64::from(u8::from(i == j)));
    let mut felt = [[[0.0; 3]; HATS]; 3];
    for y in second {
        let moments: [_; 3] = std::array::from_fn(|j| moment(unit(j), y.normal, poisson));
        let tractions = match stress {
            Stress::Kelvin => {
                let d = std::array::from_fn(|c| x.position[c] - y.position[c]);
                moments.map(|m| traction(&kelvin_stress(d, &m, poisson), x.normal))
            }
            Stress::Image => {
                let image = image_matrix(x.position, y.position, poisson);
                moments.map(|m| {
                    let stress = image.map(|row| row.iter().zip(m).map(|(a, b)| a * b).sum());
                    traction(&stress, x.normal)
                })
            }
        };
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
    use super::super::super::grid::EMPTY;
    use super::*;
    use crate::math::gauss_legendre;

    /// The points of a tent over four cells of 1 mm in the plane of `dip`, about (s, ζ).
    fn tent(frame: &PlaneFrame, middle: [f64; 2], x: f64) -> Vec<SurfacePoint> {
        let rule = gauss_legendre(8);
        let mut points = Vec::new();
        for signs in [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]] {
            for (u, wu) in &rule {
                for (v, wv) in &rule {
                    let [a, b] = [*u, *v];
                    let weight = wu * wv;
                    let mut position = frame.position(middle[0] + signs[0] * a, middle[1] + signs[1] * b);
                    position[0] += x;
                    points.push(SurfacePoint {
                        position,
                        normal: frame.directions()[0],
                        hats: [(1.0 - a) * (1.0 - b) * weight, 0.0, 0.0, 0.0],
                        gradients: [
                            [-signs[0] * (1.0 - b) * weight, -signs[1] * (1.0 - a) * weight],
                            [0.0; 2],
                            [0.0; 2],
                            [0.0; 2],
                        ],
                    });
                }
            }
        }
        points
    }

    #[test]
    fn curls_of_jumps_on_two_planes_have_the_work_of_their_tractions() {
        // Tents that vanish at their edges do not touch: by parts, both forms are the same, in
        // every component and for every Poisson's ratio.
        let frames = [0.4, 1.3].map(PlaneFrame::new);
        let tents = [tent(&frames[0], [4.0, 0.3], 0.0), tent(&frames[1], [7.5, -1.1], 1.5)];
        for poisson in [0.0, 0.3, 0.45] {
            let (mut weak, mut strong, mut sums) = (EMPTY, EMPTY, NO_SUMS);
            for x in &tents[0] {
                add_weak(x, &tents[1], &mut sums);
                add_strong(Stress::Kelvin, x, &tents[1], poisson, &mut strong);
            }
            add_sums(&sums, [&frames[0], &frames[1]], poisson, &mut weak);
            let [weak, strong] = [weak, strong].map(|block| block[0].map(|row| row[0]));
            let largest = strong.iter().flatten().fold(0.0f64, |most, value| most.max(value.abs()));
            for (weak, strong) in weak.iter().flatten().zip(strong.iter().flatten()) {
                assert!((weak - strong).abs() < 1e-6 * largest, "{poisson}: {weak} {strong} {largest}");
            }
        }
    }
}
