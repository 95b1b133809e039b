//! Elastic energy of jumps that are linear in g between the nodes.

use super::integrals::{PairRules, pair_integral};
use super::junctions::Ties;
use super::kernel::Interaction;
use crate::body::{FaceElement, FaceMesh};
use crate::crack::CrackCurve;
use crate::interruption::{Interrupted, Interruption};
use crate::math::Matrix;
use rayon::prelude::*;

/// A: the energy ½ wᵀ A w of the jumps w (slip and opening, mm) at the points of `faces`, N/mm per
/// mm, for E′ = `modulus` MPa. The jumps at the ends of `elements` depend on those at these points
/// through `ties`.
///
/// A_jk = E′/(8π) ∬ φ_j′ E(z, z′) φ_k′ dg dg′ with the hat functions φ: weakly singular because
/// jumps are continuous and dislocations on the surface have no effect, so that the mouth needs no
/// condition.
///
/// Errors: an interruption.
pub(super) fn stiffness(
    curves: &[CrackCurve],
    elements: &[FaceElement],
    ties: &Ties,
    faces: &FaceMesh,
    modulus: f64,
    interruption: Interruption<'_>,
) -> Result<Matrix, Interrupted> {
    let rules = PairRules::new();
    let row = |i: usize| -> Result<Vec<Interaction>, Interrupted> {
        interruption.check()?;
        Ok((0..=i).map(|j| element_integral(curves, &elements[i], &elements[j], &rules)).collect())
    };
    let blocks = (0..elements.len()).into_par_iter().map(row).collect::<Result<Vec<_>, Interrupted>>()?;
    let points = faces.points.len();
    let mut global = Matrix::zeros(2 * points, 2 * points);
    let slopes: Vec<Vec<(usize, f64)>> = elements.iter().map(|element| slope(element, ties)).collect();
    for (i, row) in blocks.iter().enumerate() {
        interruption.check()?;
        for (j, block) in row.iter().enumerate() {
            scatter(&mut global, &slopes[i], &slopes[j], *block);
            if i != j {
                scatter(&mut global, &slopes[j], &slopes[i], [block[0], block[2], block[1], block[3]]);
            }
        }
    }
    let scale = modulus / (8.0 * std::f64::consts::PI);
    in_face_frames(&global, faces, scale, interruption)
}

pub(super) fn element_integral(
    curves: &[CrackCurve],
    a: &FaceElement,
    b: &FaceElement,
    rules: &PairRules,
) -> Interaction {
    let mut sum = [0.0; 4];
    for piece in &a.pieces {
        for other in &b.pieces {
            let pair = pair_integral(curves, piece, other, rules);
            for k in 0..4 {
                sum[k] += pair[k];
            }
        }
    }
    let slopes = 1.0 / ((a.range.1 - a.range.0) * (b.range.1 - b.range.0));
    sum.map(|e| e * slopes)
}

/// The face points on which the derivative of the jump along `element` depends, with their factors.
pub(super) fn slope(element: &FaceElement, ties: &Ties) -> Vec<(usize, f64)> {
    let mut slope: Vec<(usize, f64)> = Vec::new();
    for (node, sign) in element.ends.iter().zip([-1.0, 1.0]) {
        for &(point, factor) in node.map_or(&[][..], |node| ties.of(node)) {
            match slope.iter_mut().find(|entry| entry.0 == point) {
                Some(entry) => entry.1 += sign * factor,
                None => slope.push((point, sign * factor)),
            }
        }
    }
    slope.retain(|entry| entry.1 != 0.0);
    slope
}

pub(super) fn scatter(global: &mut Matrix, a: &[(usize, f64)], b: &[(usize, f64)], block: Interaction) {
    for &(p, factor_p) in a {
        for &(q, factor_q) in b {
            for k in 0..4 {
                global[(2 * p + k / 2, 2 * q + k % 2)] += factor_p * factor_q * block[k];
            }
        }
    }
}

/// Rotates x and y components to slip and opening at each face point, and symmetrises the round-off
/// away.
fn in_face_frames(
    global: &Matrix,
    faces: &FaceMesh,
    scale: f64,
    interruption: Interruption<'_>,
) -> Result<Matrix, Interrupted> {
    let points = faces.points.len();
    let mut local = Matrix::zeros(2 * points, 2 * points);
    for p in 0..points {
        interruption.check()?;
        let frame = [faces.points[p].tangent, faces.points[p].tangent.left()];
        for q in 0..=p {
            let other = [faces.points[q].tangent, faces.points[q].tangent.left()];
            for (a, e) in frame.iter().enumerate() {
                for (b, f) in other.iter().enumerate() {
                    let g = |i: usize, j: usize| global[(2 * p + i, 2 * q + j)];
                    let value = scale
                        * (e.x * (g(0, 0) * f.x + g(0, 1) * f.y) + e.y * (g(1, 0) * f.x + g(1, 1) * f.y));
                    local[(2 * p + a, 2 * q + b)] = value;
                    local[(2 * q + b, 2 * p + a)] = value;
                }
            }
        }
    }
    Ok(local)
}
