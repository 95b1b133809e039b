//! A of cracks by pairs of elements: of all together, and of a long row in blocks between units.

use super::integrals::{PairRules, pair_integral};
use super::interaction::{FarRow, Interaction, Source, Units};
use super::junctions::Ties;
use crate::body::{BlockStiffness, FaceElement, FaceMesh};
use crate::crack::{CrackCurve, CrackNetwork};
use crate::interruption::{Interrupted, Interruption};
use crate::math::Matrix;
use rayon::prelude::*;
use std::ops::Range;

/// The cracks and elements from which A is assembled.
pub(super) struct CrackRow<'a> {
    pub network: &'a CrackNetwork,
    pub curves: &'a [CrackCurve],
    pub elements: &'a [FaceElement],
    pub ties: &'a Ties,
    pub faces: &'a FaceMesh,
    /// E′, MPa.
    pub modulus: f64,
}

impl CrackRow<'_> {
    /// A in blocks, without the gains of the tips.
    ///
    /// Errors: an interruption.
    pub(crate) fn stiffness(&self, interruption: Interruption<'_>) -> Result<BlockStiffness, Interrupted> {
        let units = Units::new(self.network, self.curves);
        let unit_of = units.of_cracks();
        let count = units.cracks.len();
        let mut points = vec![Vec::new(); count];
        let mut place = vec![0; self.faces.points.len()];
        for (i, point) in self.faces.points.iter().enumerate() {
            let own: &mut Vec<usize> = &mut points[unit_of[point.crack]];
            place[i] = own.len();
            own.push(i);
        }
        let mut elements = vec![Vec::new(); count];
        for (i, element) in self.elements.iter().enumerate() {
            elements[unit_of[element.crack]].push(i);
        }
        let slopes: Vec<Vec<(usize, f64)>> = self
            .elements
            .iter()
            .map(|element| slope(element, self.ties).into_iter().map(|(p, f)| (place[p], f)).collect())
            .collect();
        let near = Near { row: self, points: &points, elements: &elements, slopes: &slopes };
        let all = (0..count).flat_map(|k| (k..count).map(move |l| (k, l)));
        let pairs: Vec<(usize, usize)> = all.filter(|&(k, l)| units.are_near(k, l)).collect();
        let blocks: Vec<Matrix> = pairs
            .par_iter()
            .map(|&(k, l)| interruption.check().map(|()| near.block(k, l)))
            .collect::<Result<_, _>>()?;
        let mut nearby: Vec<Vec<(usize, Matrix)>> = vec![Vec::new(); count];
        for (&(k, l), block) in pairs.iter().zip(blocks) {
            if k != l {
                nearby[l].push((k, block.transposed()));
            }
            nearby[k].push((l, block));
        }
        let source = |&e: &usize| Source { element: &self.elements[e], follows: slopes[e].clone() };
        let sources: Vec<Vec<Source<'_>>> =
            elements.iter().map(|own| own.iter().map(source).collect()).collect();
        let Self { curves, faces, modulus, .. } = *self;
        let far = FarRow { units: &units, curves, faces, points: &points, sources: &sources, modulus };
        let far = far.stiffness();
        interruption.check()?;
        let extents = (0..count).map(|k| units.span(k)).collect();
        Ok(BlockStiffness { units: points, extents, near: nearby, far, tips: Vec::new() })
    }
}

/// Blocks of A between near units, integrated pair by pair of elements.
struct Near<'a> {
    row: &'a CrackRow<'a>,
    points: &'a [Vec<usize>],
    elements: &'a [Vec<usize>],
    slopes: &'a [Vec<(usize, f64)>],
}

impl Near<'_> {
    fn block(&self, k: usize, l: usize) -> Matrix {
        let CrackRow { curves, elements, faces, modulus, .. } = *self.row;
        let rules = PairRules::new();
        let integrals: Vec<Vec<[f64; 4]>> = self.elements[k]
            .par_iter()
            .enumerate()
            .map(|(number, &i)| {
                let others: Range<usize> = if k == l { 0..number + 1 } else { 0..self.elements[l].len() };
                let integral =
                    |j: usize| element_integral(curves, &elements[i], &elements[self.elements[l][j]], &rules);
                others.map(integral).collect()
            })
            .collect();
        let (rows, columns) = (2 * self.points[k].len(), 2 * self.points[l].len());
        let mut global = Matrix::zeros(rows, columns);
        for (&i, row) in self.elements[k].iter().zip(&integrals) {
            for (&j, block) in self.elements[l].iter().zip(row) {
                scatter(&mut global, &self.slopes[i], &self.slopes[j], *block);
                if k == l && i != j {
                    let transposed = [block[0], block[2], block[1], block[3]];
                    scatter(&mut global, &self.slopes[j], &self.slopes[i], transposed);
                }
            }
        }
        let scale = modulus / (8.0 * std::f64::consts::PI);
        let mut local = Matrix::zeros(rows, columns);
        for (p, &point) in self.points[k].iter().enumerate() {
            let frame = [faces.points[point].tangent, faces.points[point].tangent.left()];
            let last = if k == l { p + 1 } else { self.points[l].len() };
            for (q, &other) in self.points[l][..last].iter().enumerate() {
                let frame_q = [faces.points[other].tangent, faces.points[other].tangent.left()];
                for (a, e) in frame.iter().enumerate() {
                    for (b, f) in frame_q.iter().enumerate() {
                        let g = |i: usize, j: usize| global[(2 * p + i, 2 * q + j)];
                        let value = scale
                            * (e.x * (g(0, 0) * f.x + g(0, 1) * f.y) + e.y * (g(1, 0) * f.x + g(1, 1) * f.y));
                        local[(2 * p + a, 2 * q + b)] = value;
                        if k == l {
                            local[(2 * q + b, 2 * p + a)] = value;
                        }
                    }
                }
            }
        }
        local
    }
}

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
