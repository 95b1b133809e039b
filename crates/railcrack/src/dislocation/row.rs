//! A of a long row of cracks, by groups of neighbours.

use super::assembly::{element_integral, scatter, slope};
use super::integrals::{Rules, samples};
use super::junctions::Ties;
use super::kernel::interaction;
use crate::body::{BlockStiffness, FaceElement, FaceMesh, FarStiffness};
use crate::crack::{CrackNetwork, Walk};
use crate::interruption::Interruption;
use crate::linear::{LinearError, spd_inverse};
use crate::math::{Matrix, Vec2};
use rayon::prelude::*;
use std::ops::Range;

/// The least number of cracks of a group.
const LEAST: usize = 3;
/// Cracks of groups that are not neighbours are at least this far apart along the rail, over the
/// larger of their sizes.
const GAP: f64 = 1.0;
/// Chebyshev points of the expansion along the rail and in depth, by crack.
const ALONG: usize = 5;
const DOWN: usize = 4;

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

    /// Chebyshev points and the weights of `point` in the interpolation between them.
    fn nodes(&self) -> Vec<Vec2> {
        let (xs, ys) = (chebyshev(self.low.x, self.high.x, ALONG), chebyshev(self.low.y, self.high.y, DOWN));
        xs.iter().flat_map(|&x| ys.iter().map(move |&y| Vec2::new(x, y))).collect()
    }

    fn weights(&self, point: Vec2) -> Vec<f64> {
        let along = lagrange(&chebyshev(self.low.x, self.high.x, ALONG), point.x);
        let down = lagrange(&chebyshev(self.low.y, self.high.y, DOWN), point.y);
        along.iter().flat_map(|a| down.iter().map(move |d| a * d)).collect()
    }
}

/// `n` Chebyshev points between `low` and `high`.
fn chebyshev(low: f64, high: f64, n: usize) -> Vec<f64> {
    let (middle, half) = (0.5 * (low + high), (0.5 * (high - low)).max(1e-9));
    let angle = |i: usize| std::f64::consts::PI * (i as f64 + 0.5) / n as f64;
    (0..n).map(|i| middle - half * angle(i).cos()).collect()
}

fn lagrange(nodes: &[f64], x: f64) -> Vec<f64> {
    let factor = |i: usize, j: usize| if i == j { 1.0 } else { (x - nodes[j]) / (nodes[i] - nodes[j]) };
    (0..nodes.len()).map(|i| (0..nodes.len()).map(|j| factor(i, j)).product()).collect()
}

/// The cracks of each group, in the order in which they lie along the rail. Joined cracks are in
/// the same group, and cracks of groups that are not neighbours lie apart.
fn groups(network: &CrackNetwork, extents: &[Extent]) -> Vec<Vec<usize>> {
    let count = extents.len();
    let mut unit: Vec<usize> = (0..count).collect();
    for point in network.junction_points() {
        let through = point.through.iter().map(|passing| passing.crack);
        let all: Vec<usize> = point.ends.iter().map(|end| end.crack).chain(through).collect();
        let units: Vec<usize> = all.iter().map(|&crack| unit[crack]).collect();
        let Some(&least) = units.iter().min() else { continue };
        unit.iter_mut().filter(|own| units.contains(own)).for_each(|own| *own = least);
    }
    let middle = |crack: usize| extents[crack].low.x + extents[crack].high.x;
    let place = |own: usize| {
        let members = (0..count).filter(|&crack| unit[crack] == own);
        members.map(middle).fold(f64::INFINITY, f64::min)
    };
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|&a, &b| {
        let key = |crack: usize| (place(unit[crack]), unit[crack], middle(crack));
        let ((p, u, m), (q, v, n)) = (key(a), key(b));
        p.total_cmp(&q).then(u.cmp(&v)).then(m.total_cmp(&n))
    });
    let mut groups: Vec<Vec<usize>> = Vec::new();
    let mut at = 0;
    while at < count {
        let apart = |crack: usize| match groups.len() {
            0 => true,
            k => groups[k - 1].iter().all(|&other| extents[crack].is_apart(&extents[other])),
        };
        // All that is near to a crack of the group before belongs to this one.
        let near = (at..count).rev().find(|&i| !apart(order[i])).map_or(at, |i| i + 1);
        let mut end = near.max(at + LEAST).min(count);
        while end < count && unit[order[end]] == unit[order[end - 1]] {
            end += 1;
        }
        groups.push(order[at..end].to_vec());
        at = end;
    }
    groups
}

/// The cracks and elements of which A by groups is made.
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
    /// A by groups, without what the tips need.
    ///
    /// Errors: an interruption; a crack whose A is not positive definite.
    pub fn stiffness(&self, interruption: Interruption<'_>) -> Result<BlockStiffness, LinearError> {
        let extents: Vec<Extent> = self.walks.iter().map(Extent::of).collect();
        let members = groups(self.network, &extents);
        let mut group_of = vec![0; self.walks.len()];
        for (k, cracks) in members.iter().enumerate() {
            cracks.iter().for_each(|&crack| group_of[crack] = k);
        }
        let mut points = vec![Vec::new(); members.len()];
        let mut place = vec![0; self.faces.points.len()];
        for (i, point) in self.faces.points.iter().enumerate() {
            let own: &mut Vec<usize> = &mut points[group_of[point.crack]];
            place[i] = own.len();
            own.push(i);
        }
        let mut elements = vec![Vec::new(); members.len()];
        for (i, element) in self.elements.iter().enumerate() {
            elements[group_of[element.crack]].push(i);
        }
        let slopes: Vec<Vec<(usize, f64)>> = self
            .elements
            .iter()
            .map(|element| slope(element, self.ties).into_iter().map(|(p, f)| (place[p], f)).collect())
            .collect();
        let near = Near { row: self, points: &points, elements: &elements, slopes: &slopes };
        let own: Vec<Matrix> = (0..members.len())
            .map(|k| interruption.check().map(|()| near.block(k, k)))
            .collect::<Result<_, _>>()?;
        let next: Vec<Matrix> = (1..members.len())
            .map(|k| interruption.check().map(|()| near.block(k - 1, k)))
            .collect::<Result<_, _>>()?;
        let far = self.far(&members, &extents, &near);
        interruption.check()?;
        let alone = self.alone(&members, &points, &place, &own)?;
        let mut mobility = vec![0.0; 2 * self.faces.points.len()];
        for (points, compliance) in &alone {
            for (i, &point) in points.iter().enumerate() {
                for c in 0..2 {
                    mobility[2 * point + c] = compliance[(2 * i + c, 2 * i + c)].sqrt();
                }
            }
        }
        let span = |cracks: &Vec<usize>| {
            let low = cracks.iter().map(|&c| extents[c].low.x).fold(f64::INFINITY, f64::min);
            (low, cracks.iter().map(|&c| extents[c].high.x).fold(f64::NEG_INFINITY, f64::max))
        };
        let extents = members.iter().map(span).collect();
        Ok(BlockStiffness { groups: points, extents, own, next, far, tips: Vec::new(), mobility, alone })
    }

    /// C of each crack with all others closed.
    fn alone(
        &self,
        members: &[Vec<usize>],
        points: &[Vec<usize>],
        place: &[usize],
        own: &[Matrix],
    ) -> Result<Vec<(Vec<usize>, Matrix)>, LinearError> {
        let all = members.iter().enumerate().flat_map(|(k, cracks)| cracks.iter().map(move |&c| (k, c)));
        let all: Vec<(usize, usize)> = all.collect();
        all.into_par_iter()
            .map(|(k, crack)| {
                let of_crack = |i: &usize| self.faces.points[*i].crack == crack;
                let members: Vec<usize> = points[k].iter().copied().filter(of_crack).collect();
                let component = |i: usize| 2 * place[members[i / 2]] + i % 2;
                let n = 2 * members.len();
                let block = Matrix::from_fn(n, n, |i, j| own[k][(component(i), component(j))]);
                Ok((members, spd_inverse(&block)?))
            })
            .collect()
    }

    fn far(&self, members: &[Vec<usize>], extents: &[Extent], near: &Near<'_>) -> FarStiffness {
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
        let between =
            (0..count).into_par_iter().map(|k| (k + 2..count).map(|l| between(k, l)).collect()).collect();
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
