//! A of a long row of cracks, crack by crack.

use super::assembly::{element_integral, scatter, slope};
use super::integrals::{Rules, samples};
use super::junctions::Ties;
use super::kernel::interaction;
use crate::body::{BlockStiffness, FaceElement, FaceMesh, FarStiffness};
use crate::crack::{CrackNetwork, Walk};
use crate::interruption::{Interrupted, Interruption};
use crate::math::{Matrix, Vec2, chebyshev};
use rayon::prelude::*;
use std::ops::Range;

/// Cracks are near to each other up to this distance along the rail, over the larger of their
/// sizes.
const GAP: f64 = 1.0;
/// Chebyshev points of the expansion along the rail and in depth, by crack.
const ALONG: usize = 5;
const DOWN: usize = 4;

/// Boxes are wider than their cracks by this (mm), or those of upright cracks would have no width.
const FLAT: f64 = 1e-9;

/// The box around a crack.
#[derive(Debug, Clone, Copy)]
struct Extent {
    low: Vec2,
    high: Vec2,
}

impl Extent {
    fn of(walk: &Walk) -> Self {
        let points = (0..walk.segments()).map(|i| walk.position(i, walk.vertices()[i]));
        let all = points.chain([walk.last_point()]);
        let none = Self {
            low: Vec2::new(f64::INFINITY, f64::INFINITY),
            high: Vec2::new(f64::NEG_INFINITY, f64::NEG_INFINITY),
        };
        all.fold(none, |extent, p| Self {
            low: Vec2::new(extent.low.x.min(p.x), extent.low.y.min(p.y)),
            high: Vec2::new(extent.high.x.max(p.x), extent.high.y.max(p.y)),
        })
    }

    fn size(&self) -> f64 {
        (self.high.x - self.low.x).max(self.high.y - self.low.y)
    }

    fn is_apart(&self, other: &Self) -> bool {
        let gap = (other.low.x - self.high.x).max(self.low.x - other.high.x);
        gap >= GAP * self.size().max(other.size())
    }

    /// Chebyshev points, of which [`Extent::weights`] are the weights of a point.
    fn nodes(&self) -> Vec<Vec2> {
        let [xs, ys] = self.lines();
        xs.iter().flat_map(|&x| ys.iter().map(move |&y| Vec2::new(x, y))).collect()
    }

    fn lines(&self) -> [Vec<f64>; 2] {
        let range = |low: f64, high: f64| low - FLAT..=high + FLAT;
        let (xs, ys) = (range(self.low.x, self.high.x), range(self.low.y, self.high.y));
        [chebyshev::points(&xs, ALONG), chebyshev::points(&ys, DOWN)]
    }

    fn weights(&self, point: Vec2) -> Vec<f64> {
        let [xs, ys] = self.lines();
        let (along, down) = (chebyshev::weights(&xs, point.x), chebyshev::weights(&ys, point.y));
        along.iter().flat_map(|a| down.iter().map(move |d| a * d)).collect()
    }
}

/// The cracks of each unit, in the order in which they lie along the rail: those that have joined
/// each other, or one alone.
fn units(network: &CrackNetwork, extents: &[Extent]) -> Vec<Vec<usize>> {
    let mut units: Vec<Vec<usize>> = (0..extents.len()).map(|crack| vec![crack]).collect();
    for point in network.junction_points() {
        let through = point.through.iter().map(|passing| passing.crack);
        let joined: Vec<usize> = point.ends.iter().map(|end| end.crack).chain(through).collect();
        let (one, others): (Vec<_>, Vec<_>) =
            units.into_iter().partition(|unit| unit.iter().any(|crack| joined.contains(crack)));
        units = others;
        units.push(one.concat());
    }
    units.retain(|unit| !unit.is_empty());
    units.iter_mut().for_each(|unit| unit.sort_unstable());
    let middle = |unit: &Vec<usize>| {
        let ends = |&crack: &usize| extents[crack].low.x + extents[crack].high.x;
        unit.iter().map(ends).sum::<f64>() / unit.len() as f64
    };
    units.sort_by(|a, b| middle(a).total_cmp(&middle(b)).then(a.cmp(b)));
    units
}

/// The cracks and elements of which A is made.
pub(super) struct Row<'a> {
    pub network: &'a CrackNetwork,
    pub walks: &'a [Walk],
    pub elements: &'a [FaceElement],
    pub ties: &'a Ties,
    pub faces: &'a FaceMesh,
    /// E′, MPa.
    pub modulus: f64,
}

impl Row<'_> {
    /// A crack by crack, without what the tips need.
    ///
    /// Errors: an interruption.
    pub fn stiffness(&self, interruption: Interruption<'_>) -> Result<BlockStiffness, Interrupted> {
        let extents: Vec<Extent> = self.walks.iter().map(Extent::of).collect();
        let members = units(self.network, &extents);
        let mut unit_of = vec![0; self.walks.len()];
        for (k, cracks) in members.iter().enumerate() {
            cracks.iter().for_each(|&crack| unit_of[crack] = k);
        }
        let mut points = vec![Vec::new(); members.len()];
        let mut place = vec![0; self.faces.points.len()];
        for (i, point) in self.faces.points.iter().enumerate() {
            let own: &mut Vec<usize> = &mut points[unit_of[point.crack]];
            place[i] = own.len();
            own.push(i);
        }
        let mut elements = vec![Vec::new(); members.len()];
        for (i, element) in self.elements.iter().enumerate() {
            elements[unit_of[element.crack]].push(i);
        }
        let slopes: Vec<Vec<(usize, f64)>> = self
            .elements
            .iter()
            .map(|element| slope(element, self.ties).into_iter().map(|(p, f)| (place[p], f)).collect())
            .collect();
        let near = Near { row: self, points: &points, elements: &elements, slopes: &slopes };
        let apart = |k: usize, l: usize| {
            let all = members[k].iter().flat_map(|&one| members[l].iter().map(move |&other| (one, other)));
            all.into_iter().all(|(one, other)| extents[one].is_apart(&extents[other]))
        };
        let count = members.len();
        let pairs: Vec<(usize, usize)> =
            (0..count).flat_map(|k| (k..count).map(move |l| (k, l))).filter(|&(k, l)| !apart(k, l)).collect();
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
        let far = self.far(&members, &extents, &near, &nearby);
        interruption.check()?;
        let span = |cracks: &Vec<usize>| {
            let low = cracks.iter().map(|&c| extents[c].low.x).fold(f64::INFINITY, f64::min);
            (low, cracks.iter().map(|&c| extents[c].high.x).fold(f64::NEG_INFINITY, f64::max))
        };
        let extents = members.iter().map(span).collect();
        Ok(BlockStiffness { units: points, extents, near: nearby, far, tips: Vec::new() })
    }

    fn far(
        &self,
        members: &[Vec<usize>],
        extents: &[Extent],
        near: &Near<'_>,
        nearby: &[Vec<(usize, Matrix)>],
    ) -> FarStiffness {
        let rank = 2 * ALONG * DOWN;
        let rules = Rules::new();
        let moments: Vec<Matrix> = (0..members.len())
            .into_par_iter()
            .map(|k| {
                let points = &near.points[k];
                let mut moments = Matrix::zeros(2 * points.len(), rank * members[k].len());
                for &e in &near.elements[k] {
                    let element = &self.elements[e];
                    let Some(number) = members[k].iter().position(|&crack| crack == element.crack) else {
                        continue;
                    };
                    let weights = self.element_moments(element, &extents[element.crack], &rules);
                    for &(point, factor) in &near.slopes[e] {
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
            })
            .collect();
        let nodes: Vec<Vec<Vec2>> = members
            .iter()
            .map(|cracks| cracks.iter().flat_map(|&crack| extents[crack].nodes()).collect())
            .collect();
        let scale = self.modulus / (8.0 * std::f64::consts::PI);
        let between = |k: usize, l: usize| {
            let mut matrix = Matrix::zeros(2 * nodes[k].len(), 2 * nodes[l].len());
            for (i, &z) in nodes[k].iter().enumerate() {
                for (j, &z0) in nodes[l].iter().enumerate() {
                    let e = interaction(z, z0);
                    for c in 0..4 {
                        matrix[(2 * i + c / 2, 2 * j + c % 2)] = scale * e[c];
                    }
                }
            }
            matrix
        };
        let count = members.len();
        let far = |k: usize| {
            let is_far = |l: &usize| nearby[k].iter().all(|(other, _)| other != l);
            (0..count).filter(is_far).map(|l| (l, between(k, l))).collect()
        };
        let between = (0..count).into_par_iter().map(far).collect();
        FarStiffness { moments, between }
    }

    /// ∫ L_q(z(g)) dg over an element, over its range.
    fn element_moments(&self, element: &FaceElement, extent: &Extent, rules: &Rules) -> Vec<f64> {
        let mut sum = vec![0.0; ALONG * DOWN];
        for piece in &element.pieces {
            for (point, weight) in samples(&self.walks[piece.crack], piece, rules.largest()) {
                let weights = extent.weights(point);
                sum.iter_mut().zip(weights).for_each(|(sum, w)| *sum += weight * w);
            }
        }
        let range = element.range.1 - element.range.0;
        sum.iter_mut().for_each(|value| *value /= range);
        sum
    }
}

/// Blocks of A that are integrated pair by pair.
struct Near<'a> {
    row: &'a Row<'a>,
    points: &'a [Vec<usize>],
    elements: &'a [Vec<usize>],
    slopes: &'a [Vec<(usize, f64)>],
}

impl Near<'_> {
    fn block(&self, k: usize, l: usize) -> Matrix {
        let Row { walks, elements, faces, modulus, .. } = *self.row;
        let rules = Rules::new();
        let integrals: Vec<Vec<[f64; 4]>> = self.elements[k]
            .par_iter()
            .enumerate()
            .map(|(number, &i)| {
                let others: Range<usize> = if k == l { 0..number + 1 } else { 0..self.elements[l].len() };
                let integral =
                    |j: usize| element_integral(walks, &elements[i], &elements[self.elements[l][j]], &rules);
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
