//! Blocks of A between distant cracks, by interpolation of the dislocation interaction.

use super::kernel::interaction;
use super::units::{SourceBox, Units};
use crate::body::{FaceElement, FaceMesh, FarStiffness};
use crate::crack::CrackCurve;
use crate::linear::product;
use crate::math::{Matrix, Vec2, gauss_legendre};
use rayon::prelude::*;

/// Gauss points on each piece of an element.
const POINTS: usize = 8;
/// Gauss points on each piece for the estimate of the error.
const FEW_POINTS: usize = 2;

/// Dislocations on an element, over which the jump is linear in the parameter of the curve.
pub(super) struct Source<'a> {
    pub element: &'a FaceElement,
    /// Face points of the unit, by index within the unit, with the Burgers vector per jump there.
    pub follows: Vec<(usize, f64)>,
}

/// A row of cracks and the dislocations on them.
pub(super) struct FarRow<'a> {
    pub units: &'a Units,
    pub curves: &'a [CrackCurve],
    pub faces: &'a FaceMesh,
    /// The face points of each unit.
    pub points: &'a [Vec<usize>],
    /// The dislocations of each unit.
    pub sources: &'a [Vec<Source<'a>>],
    /// E′, MPa.
    pub modulus: f64,
}

impl FarRow<'_> {
    /// A between all units that are not near to each other.
    pub(super) fn stiffness(&self) -> FarStiffness {
        let count = self.units.cracks.len();
        let moments = (0..count).into_par_iter().map(|k| self.moments(k)).collect();
        let of_crack = |&crack: &usize| self.units.extents[crack].nodes();
        let nodes: Vec<Vec<Vec2>> =
            self.units.cracks.iter().map(|cracks| cracks.iter().flat_map(of_crack).collect()).collect();
        let far = |k: usize| {
            let apart = (0..count).filter(|&l| !self.units.are_near(k, l));
            apart.map(|l| (l, self.between(&nodes[k], &nodes[l]))).collect()
        };
        let mut stiffness =
            FarStiffness { moments, between: (0..count).into_par_iter().map(far).collect(), error: 0.0 };
        let error = |k: usize| {
            let nearest = stiffness.between[k].iter().find(|(l, _)| *l > k);
            nearest.map_or(0.0, |(l, between)| {
                self.off(&stiffness.moments[k], between, &stiffness.moments[*l], (k, *l))
            })
        };
        let errors: Vec<f64> = (0..count).into_par_iter().map(error).collect();
        stiffness.error = errors.into_iter().fold(0.0, f64::max);
        stiffness
    }

    /// The difference between the expansion of A between units `k` and `l` and its integral, over
    /// the norm of the integral.
    fn off(&self, moments: &Matrix, between: &Matrix, others: &Matrix, (k, l): (usize, usize)) -> f64 {
        let (one, other) = (self.dislocations(k), self.dislocations(l));
        let at = |all: &[(Vec2, f64, usize)]| all.iter().map(|(at, ..)| *at).collect::<Vec<Vec2>>();
        let kernel = self.between(&at(&one), &at(&other));
        let spread = |all: &[(Vec2, f64, usize)], k: usize| {
            let mut spread = Matrix::zeros(2 * self.points[k].len(), 2 * all.len());
            for (i, (_, burgers, point)) in all.iter().enumerate() {
                let tangent = self.faces.points[self.points[k][*point]].tangent;
                for (c, axis) in [tangent, tangent.left()].into_iter().enumerate() {
                    spread[(2 * point + c, 2 * i)] += burgers * axis.x;
                    spread[(2 * point + c, 2 * i + 1)] += burgers * axis.y;
                }
            }
            spread
        };
        let block = |left: &Matrix, middle: &Matrix, right: &Matrix| {
            product(left, middle).and_then(|half| product(&half, &right.transposed()))
        };
        let exact = block(&spread(&one, k), &kernel, &spread(&other, l));
        let (Ok(exact), Ok(expanded)) = (exact, block(moments, between, others)) else { return 0.0 };
        let squares = exact.entries().iter().zip(expanded.entries());
        let (off, norm) =
            squares.fold((0.0, 0.0), |(off, norm), (a, b)| (off + (a - b) * (a - b), norm + a * a));
        if norm > 0.0 { f64::sqrt(off / norm) } else { 0.0 }
    }

    /// The dislocations of unit `k`, with few quadrature points per element: position, Burgers
    /// vector per jump at a face point of the unit, and that face point.
    fn dislocations(&self, k: usize) -> Vec<(Vec2, f64, usize)> {
        let rule = gauss_legendre(FEW_POINTS);
        let mut all = Vec::new();
        for Source { element, follows } in &self.sources[k] {
            let mut at: Vec<(Vec2, f64)> = Vec::new();
            let range = element.range.1 - element.range.0;
            for piece in &element.pieces {
                let (start, width) = (piece.range.0, piece.range.1 - piece.range.0);
                at.extend(rule.iter().map(|&(t, w)| {
                    let g = start + t * width;
                    (self.curves[piece.crack].position(piece.segment, g), w * width / range)
                }));
            }
            for &(point, factor) in follows {
                all.extend(at.iter().map(|&(at, weight)| (at, factor * weight, point)));
            }
        }
        all
    }

    fn moments(&self, k: usize) -> Matrix {
        let (cracks, points) = (&self.units.cracks[k], &self.points[k]);
        let rank = 2 * SourceBox::NODES;
        let rule = gauss_legendre(POINTS);
        let mut moments = Matrix::zeros(2 * points.len(), rank * cracks.len());
        for Source { element, follows } in &self.sources[k] {
            let Some(number) = cracks.iter().position(|&own| own == element.crack) else { continue };
            let weights = self.weights(element, &rule);
            for &(point, factor) in follows {
                let frame = &self.faces.points[points[point]];
                for (c, axis) in [frame.tangent, frame.tangent.left()].into_iter().enumerate() {
                    let row = moments.row_mut(2 * point + c);
                    for (q, weight) in weights.iter().enumerate() {
                        let at = rank * number + 2 * q;
                        row[at] += factor * weight * axis.x;
                        row[at + 1] += factor * weight * axis.y;
                    }
                }
            }
        }
        moments
    }

    /// ∫ L_q(z(g)) dg over the range of `element` and relative to it, of each Chebyshev point q of
    /// the box of its crack.
    fn weights(&self, element: &FaceElement, rule: &[(f64, f64)]) -> Vec<f64> {
        let mut sum = vec![0.0; SourceBox::NODES];
        for piece in &element.pieces {
            let (start, width) = (piece.range.0, piece.range.1 - piece.range.0);
            for &(t, w) in rule {
                let point = self.curves[piece.crack].position(piece.segment, start + t * width);
                let weights = self.units.extents[element.crack].weights(point);
                sum.iter_mut().zip(weights).for_each(|(sum, l)| *sum += w * width * l);
            }
        }
        let range = element.range.1 - element.range.0;
        sum.iter_mut().for_each(|value| *value /= range);
        sum
    }

    fn between(&self, one: &[Vec2], other: &[Vec2]) -> Matrix {
        let scale = self.modulus / (8.0 * std::f64::consts::PI);
        let mut matrix = Matrix::zeros(2 * one.len(), 2 * other.len());
        for (i, &z) in one.iter().enumerate() {
            for (j, &z0) in other.iter().enumerate() {
                let e = interaction(z, z0);
                for c in 0..4 {
                    matrix[(2 * i + c / 2, 2 * j + c % 2)] = scale * e[c];
                }
            }
        }
        matrix
    }
}
