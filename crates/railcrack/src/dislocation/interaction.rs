//! Interaction of dislocations in the half-plane, units of joined cracks, and the expansion of A
//! between distant ones.

use crate::body::{FaceElement, FaceMesh, FarStiffness};
use crate::crack::{CrackCurve, CrackNetwork};
use crate::linear::product;
use crate::math::{Matrix, Vec2, chebyshev, gauss_legendre};
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

/// The 2 × 2 interaction of unit dislocations: `[xx, xy, yx, yy]`, first index the Burgers vector
/// at z.
pub(super) type Interaction = [f64; 4];

/// Energy of interaction of unit dislocations at `z` and `z0` (mm), in units of E′/(8π) per mm² of
/// Burgers vectors.
///
/// With the Kolosov–Muskhelishvili potentials φ0 = γ log(z − z0), ψ0 = γ̄ log(z − z0) − γ
/// z̄0/(z − z0) of a dislocation (b_x + i b_y = 8π i γ/E′) and their images φ1 = −(z φ̄0′ + ψ̄0),
/// ψ1 = −(φ̄0 + z φ1′) that make y = 0 traction-free, the resultant force over a line from the
/// surface to z is F = φ + z φ̄′ + ψ̄ = γ P + γ̄ Q,
/// P = log(|z−z0|²/|z−z̄0|²) − 4 y y0/(z̄−z0)²,
/// Q = (z−z0)/(z̄−z̄0) − (z−z0)/(z−z̄0) − 2 i y/(z̄−z0).
/// It vanishes with z or z0 on the surface. Moving a second dislocation b′ in from the surface
/// costs b′_x Im F − b′_y Re F. (Muskhelishvili 1953, §§ 41, 90–93.)
#[inline]
pub(super) fn interaction(z: Vec2, z0: Vec2) -> Interaction {
    split_interaction(z, z0).whole()
}

/// An interaction split into its logarithm, which appears on the diagonal only, and the rest. Sums
/// over many points need only the logarithm of one product.
#[derive(Debug, Clone, Copy)]
pub(super) struct Split {
    /// The interaction without the logarithm.
    pub rational: Interaction,
    /// The argument of the logarithm.
    pub of_log: f64,
}

impl Split {
    fn whole(self) -> Interaction {
        let Self { rational: [xx, xy, yx, yy], of_log } = self;
        let log = of_log.ln();
        [xx + log, xy, yx, yy + log]
    }
}

/// [`interaction`] in two parts; the argument of the logarithm is |z̄−z0|²/|z−z0|².
#[inline]
pub(super) fn split_interaction(z: Vec2, z0: Vec2) -> Split {
    let (dx, dy) = (z.x - z0.x, z.y - z0.y);
    let inverse = 1.0 / (dx * dx + dy * dy);
    // (z − z0)/(z̄ − z̄0): the direction squared.
    let (ex, ey) = ((dx * dx - dy * dy) * inverse, 2.0 * dx * dy * inverse);
    let Split { rational: [xx, xy, yx, yy], of_log } = split_image_interaction(z, z0);
    Split { rational: [xx + ex, xy + ey, yx + ey, yy - ex], of_log: of_log * inverse }
}

/// Contribution of the free surface to [`interaction`]: all but −log|z−z0|² and (z−z0)/(z̄−z̄0);
/// smooth at z = z0 below the surface. The argument of the logarithm is |z̄−z0|² in mm².
#[inline]
pub(super) fn split_image_interaction(z: Vec2, z0: Vec2) -> Split {
    // m = z̄ − z0.
    let (mx, my) = (z.x - z0.x, -z.y - z0.y);
    let (dx, dy) = (z.x - z0.x, z.y - z0.y);
    let m2 = mx * mx + my * my;
    let inverse = 1.0 / m2;
    // 4 y y0 / m² = 4 y y0 m̄² / |m|⁴.
    let scale = 4.0 * z.y * z0.y * inverse * inverse;
    let (px, py) = (-scale * (mx * mx - my * my), scale * 2.0 * mx * my);
    // −(z−z0) m/|m|² − 2 i y m̄/|m|²; (z − z̄0) is the conjugate of m.
    let qx = (-(dx * mx - dy * my) - 2.0 * z.y * my) * inverse;
    let qy = (-(dx * my + dy * mx) - 2.0 * z.y * mx) * inverse;
    Split { rational: [qx - px, py + qy, qy - py, -(px + qx)], of_log: m2 }
}

/// −log|z−z0|² and (z−z0)/(z̄−z̄0) when both lie on one straight line of direction `tangent`: the
/// second is constant. Returns it as an [`Interaction`] without the logarithm.
pub(super) fn collinear_constant(tangent: Vec2) -> Interaction {
    let (ex, ey) = (tangent.x * tangent.x - tangent.y * tangent.y, 2.0 * tangent.x * tangent.y);
    [ex, ey, ey, -ex]
}

/// Distance along the rail, over the larger crack size, up to which cracks are near to each other.
const GAP: f64 = 1.0;
/// Numbers of Chebyshev points of the expansion per crack, along the rail and in depth.
const ALONG: usize = 5;
const DOWN: usize = 4;

/// Width (mm) by which boxes exceed their cracks, so that the boxes of upright cracks have a width.
const FLAT: f64 = 1e-9;

/// The bounding box of a crack.
#[derive(Debug, Clone, Copy)]
pub(super) struct SourceBox {
    low: Vec2,
    high: Vec2,
}

impl SourceBox {
    /// Number of Chebyshev points of a box.
    pub(super) const NODES: usize = ALONG * DOWN;

    fn of(curve: &CrackCurve) -> Self {
        let points = (0..curve.segments()).map(|i| curve.position(i, curve.vertices()[i]));
        let all = points.chain([curve.last_point()]);
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

    /// The Chebyshev points to which [`SourceBox::weights`] refers.
    pub(super) fn nodes(&self) -> Vec<Vec2> {
        let [xs, ys] = self.lines();
        xs.iter().flat_map(|&x| ys.iter().map(move |&y| Vec2::new(x, y))).collect()
    }

    fn lines(&self) -> [Vec<f64>; 2] {
        let range = |low: f64, high: f64| low - FLAT..=high + FLAT;
        let (xs, ys) = (range(self.low.x, self.high.x), range(self.low.y, self.high.y));
        [chebyshev::points(&xs, ALONG), chebyshev::points(&ys, DOWN)]
    }

    pub(super) fn weights(&self, point: Vec2) -> Vec<f64> {
        let [xs, ys] = self.lines();
        let (along, down) = (chebyshev::weights(&xs, point.x), chebyshev::weights(&ys, point.y));
        along.iter().flat_map(|a| down.iter().map(move |d| a * d)).collect()
    }
}

/// Cracks that have joined each other are one unit, every other crack is a unit of its own; units
/// are in the order in which they lie along the rail.
pub(super) struct Units {
    /// The cracks of each unit, in order.
    pub cracks: Vec<Vec<usize>>,
    pub(super) extents: Vec<SourceBox>,
}

impl Units {
    /// The units of `network`, whose cracks have the `curves`.
    pub(super) fn new(network: &CrackNetwork, curves: &[CrackCurve]) -> Self {
        let extents: Vec<SourceBox> = curves.iter().map(SourceBox::of).collect();
        Self { cracks: units(network, &extents), extents }
    }

    /// The unit of each crack.
    pub(super) fn of_cracks(&self) -> Vec<usize> {
        let mut unit_of = vec![0; self.extents.len()];
        for (k, cracks) in self.cracks.iter().enumerate() {
            cracks.iter().for_each(|&crack| unit_of[crack] = k);
        }
        unit_of
    }

    /// Whether units `k` and `l` are near to each other.
    pub(super) fn are_near(&self, k: usize, l: usize) -> bool {
        let near = |&one: &usize| {
            self.cracks[l].iter().any(|&other| !self.extents[one].is_apart(&self.extents[other]))
        };
        self.cracks[k].iter().any(near)
    }

    /// Ends of unit `k` along the rail, mm.
    pub(super) fn span(&self, k: usize) -> (f64, f64) {
        let low = self.cracks[k].iter().map(|&c| self.extents[c].low.x).fold(f64::INFINITY, f64::min);
        (low, self.cracks[k].iter().map(|&c| self.extents[c].high.x).fold(f64::NEG_INFINITY, f64::max))
    }
}

fn units(network: &CrackNetwork, extents: &[SourceBox]) -> Vec<Vec<usize>> {
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

#[cfg(test)]
#[path = "kernel_tests.rs"]
mod tests;
