//! Corrections of the half-plane stress under a wheel for the ends of a block.

use super::boundary::{Boundary, Freedom};
use super::gauss_stress::StressAtPoints;
use super::rail::{BulkError, BulkRail, RectangleStiffness};
use crate::field::{EndField, EndsError, RailEnds, StressesUnderWheel, Wheel};
use crate::math::{Stress, Vec2, chebyshev, gauss_legendre};
use crate::mesh::{Edge, NODES};
use std::ops::RangeInclusive;
use std::sync::Arc;

/// The field that, added to that of the half-plane under the wheel, gives the field of the block:
/// it removes the tractions of the half-plane from the free ends of the block and its displacements
/// from the held ones.
///
/// The ends are far from the wheel, so the field is smooth and coarse elements suffice. It depends
/// on the wheel position x_c through its data on the ends, which are analytic in x_c: it is solved
/// at Chebyshev points and interpolated between them, to [`BlockCorrection::TOLERANCE`]. No further
/// wheel position needs a solution.
#[derive(Debug, Clone)]
pub struct BlockCorrection {
    rail: Arc<BulkRail>,
    range: RangeInclusive<f64>,
    /// Wheel positions for which the correction was solved, mm.
    pub(super) positions: Vec<f64>,
    /// mm, position by position, node by node.
    displacements: Vec<Vec<Vec2>>,
}

/// The field of the half-plane with the wheel at one position.
struct Under<'a> {
    wheel: &'a dyn Wheel,
    xc: f64,
}

impl ElasticField for Under<'_> {
    fn stress(&self, point: Vec2) -> Stress {
        self.wheel.stress(point, self.xc)
    }

    fn displacement(&self, point: Vec2) -> Vec2 {
        self.wheel.displacement(point, self.xc)
    }

    fn smooth_within(&self, point: Vec2) -> f64 {
        self.wheel.smooth_within(point, self.xc)
    }
}

impl BlockCorrection {
    /// Error of the interpolation between wheel positions, relative to the largest value of the
    /// correction; far below the error of the mesh.
    pub const TOLERANCE: f64 = 1e-8;

    /// Largest number of wheel positions with a solution.
    const MOST_POSITIONS: usize = 200;

    /// The correction of `rail` for a `wheel` anywhere in `range` (mm).
    ///
    /// Errors: a half-plane; a wheel that bends the rail; a range that is empty or not finite; a
    /// contact that leaves the block or comes so close to one of its sides that the field is no
    /// longer smooth.
    pub fn new(
        rail: &Arc<BulkRail>,
        wheel: &dyn Wheel,
        range: RangeInclusive<f64>,
    ) -> Result<Self, BulkError> {
        if rail.boundary() == Boundary::HalfPlane {
            return Err(BulkError::NoBlock);
        }
        if wheel.bending().is_some() {
            return Err(BulkError::Bending);
        }
        let (from, to) = (*range.start(), *range.end());
        if !(from <= to && from.is_finite() && to.is_finite()) {
            return Err(BulkError::Positions { from, to });
        }
        let count = positions_needed(rail, wheel, &range)?;
        let positions = chebyshev::points(&range, count);
        let fields: Vec<Under> = positions.iter().map(|&xc| Under { wheel, xc }).collect();
        let fields: Vec<&dyn ElasticField> = fields.iter().map(|field| field as _).collect();
        let displacements = rail.cancel(&fields)?;
        Ok(Self { rail: Arc::clone(rail), range, positions, displacements })
    }

    /// The displacements (mm, node by node) of the correction for the wheel at `xc` (mm).
    ///
    /// Errors: a position outside the range.
    pub(crate) fn displacements(&self, xc: f64) -> Result<Vec<Vec2>, BulkError> {
        let weights = weights(&self.positions, &self.range, xc)?;
        let mut sum = vec![Vec2::default(); self.rail.mesh().node_count()];
        for (weight, displacements) in weights.into_iter().zip(&self.displacements) {
            sum.iter_mut().zip(displacements).for_each(|(sum, u)| *sum = *sum + *u * weight);
        }
        Ok(sum)
    }

    /// The correction prepared for many wheel positions at fixed `points` (mm).
    ///
    /// Errors: a point outside the mesh.
    pub fn at(&self, points: &[Vec2]) -> Result<CorrectionAtPoints, BulkError> {
        let stress = StressAtPoints::new(&self.rail, points)?;
        let by_position: Vec<Vec<Stress>> = self.displacements.iter().map(|u| stress.stress(u)).collect();
        let of_point = |k: usize| by_position.iter().map(move |stresses| stresses[k]);
        Ok(CorrectionAtPoints {
            range: self.range.clone(),
            positions: self.positions.clone(),
            stresses: (0..points.len()).flat_map(of_point).collect(),
        })
    }
}

impl EndField for BlockCorrection {
    fn at(&self, points: &[Vec2]) -> Result<StressesUnderWheel, EndsError> {
        let (count, correction) = (points.len(), BlockCorrection::at(self, points)?);
        Ok(Box::new(move |xc| {
            let wheel = correction.wheel_nearest(xc);
            (0..count).map(|k| wheel.stress(k)).collect()
        }))
    }
}

impl RailEnds for BulkRail {
    fn under(
        self: Arc<Self>,
        wheel: &dyn Wheel,
        positions: RangeInclusive<f64>,
    ) -> Result<Arc<dyn EndField>, EndsError> {
        Ok(Arc::new(BlockCorrection::new(&self, wheel, positions)?))
    }
}

impl From<BulkError> for EndsError {
    fn from(reason: BulkError) -> Self {
        Self { reason: Box::new(reason) }
    }
}

/// The number of positions that interpolate the correction to the tolerance.
fn positions_needed(
    rail: &BulkRail,
    wheel: &dyn Wheel,
    range: &RangeInclusive<f64>,
) -> Result<usize, BulkError> {
    let lines = rail.mesh().x_lines();
    let (left, right) = (lines[0], lines[lines.len() - 1]);
    let edges = wheel.edges();
    let from = range.start() + edges.first().unwrap_or(&0.0);
    let to = range.end() + edges.last().unwrap_or(&0.0);
    // At a point on the ends of the block, the potential as a function of x_c has branch points
    // where an edge of the contact would coincide with that point or its mirror image above the
    // surface. The nearest branch points of the sides belong to the top corners; those of the
    // bottom lie at its depth from the real axis.
    let half = 0.5 * (range.end() - range.start());
    let depth = -rail.mesh().y_lines()[0];
    let needed = |gap: f64| {
        if half == 0.0 {
            return 1.0;
        }
        chebyshev::count(chebyshev::rate(gap / half, depth / half), BlockCorrection::TOLERANCE)
    };
    let most = BlockCorrection::MOST_POSITIONS as f64;
    let count = needed((from - left).min(right - to));
    if from >= left && to <= right && count <= most {
        return Ok(count.ceil() as usize);
    }
    // The smallest sufficient gap, by bisection: the wider the gap, the fewer the positions.
    let (mut narrow, mut wide) = (0.0, half);
    for _ in 0..50 {
        let middle = 0.5 * (narrow + wide);
        if needed(middle) > most {
            narrow = middle;
        } else {
            wide = middle;
        }
    }
    Err(BulkError::OffTheBlock { from, to, left, right, gap: wide })
}

fn weights(positions: &[f64], range: &RangeInclusive<f64>, xc: f64) -> Result<Vec<f64>, BulkError> {
    if !range.contains(&xc) {
        return Err(BulkError::Position { position: xc, from: *range.start(), to: *range.end() });
    }
    Ok(chebyshev::weights(positions, xc))
}

/// Stress of the correction at fixed points for any wheel position of its range.
#[derive(Debug, Clone, PartialEq)]
pub struct CorrectionAtPoints {
    range: RangeInclusive<f64>,
    positions: Vec<f64>,
    /// MPa, point by point, position by position.
    stresses: Vec<Stress>,
}

impl CorrectionAtPoints {
    /// The correction for the wheel at `xc` (mm).
    ///
    /// Errors: a position outside the range.
    pub fn wheel_at(&self, xc: f64) -> Result<WheelAt<'_>, BulkError> {
        Ok(WheelAt { points: self, weights: weights(&self.positions, &self.range, xc)? })
    }

    /// The correction for the wheel at the position of the range nearest to `xc` (mm).
    pub(crate) fn wheel_nearest(&self, xc: f64) -> WheelAt<'_> {
        let inside = xc.clamp(*self.range.start(), *self.range.end());
        WheelAt { points: self, weights: chebyshev::weights(&self.positions, inside) }
    }
}

/// The correction at fixed points for one wheel position.
#[derive(Debug, Clone)]
pub struct WheelAt<'a> {
    points: &'a CorrectionAtPoints,
    weights: Vec<f64>,
}

impl WheelAt<'_> {
    /// The stress (MPa) of the correction at point `k` (from 0, in the order of
    /// [`BlockCorrection::at`]).
    pub fn stress(&self, k: usize) -> Stress {
        let count = self.weights.len();
        let stresses = &self.points.stresses[k * count..(k + 1) * count];
        self.weights.iter().zip(stresses).fold(Stress::ZERO, |sum, (weight, stress)| sum + *stress * *weight)
    }
}

/// A field in equilibrium without body forces in the half-plane, under surface loads that the rail
/// carries too.
pub trait ElasticField {
    /// Stress (MPa) at a point (mm).
    fn stress(&self, point: Vec2) -> Stress;

    /// Displacement (mm) at a point (mm), up to a rigid motion.
    fn displacement(&self, point: Vec2) -> Vec2;

    /// Distance (mm) from a point to the nearest singularity of the field: it determines how finely
    /// tractions near the point are integrated.
    fn smooth_within(&self, point: Vec2) -> f64;
}

/// Gauss points on a part of a side that is not longer than its distance to the singularities of
/// the tractions: the error falls like 5.8^(−2n), so 1e-12.
const GAUSS_POINTS: usize = 8;

/// Largest number of halvings of a side of an element; pieces of 1e-9 of a side carry no
/// significant force.
const HALVINGS: u32 = 30;

impl BulkRail {
    /// The displacements (mm, node by node) that cancel each of `fields` at the boundary of the
    /// mesh: opposite displacements where it is held, opposite tractions where it is free, and no
    /// change on the top.
    ///
    /// Errors: those of the linear algebra.
    pub fn cancel(&self, fields: &[&dyn ElasticField]) -> Result<Vec<Vec<Vec2>>, BulkError> {
        let order = self.order();
        let mut columns = Vec::with_capacity(order * fields.len());
        for field in fields {
            columns.extend(self.forces(*field));
        }
        self.factor()?.solve(&mut columns)?;
        let at_nodes = |(field, free): (&&dyn ElasticField, &[f64])| {
            self.at_nodes(free, |point| -field.displacement(point))
        };
        Ok(fields.iter().zip(columns.chunks(order.max(1))).map(at_nodes).collect())
    }

    /// Forces (N/mm) on the free unknowns: the opposite tractions, and the forces that the
    /// prescribed displacements of the held nodes exert.
    fn forces(&self, field: &dyn ElasticField) -> Vec<f64> {
        let mesh = self.mesh();
        let mut forces = vec![0.0; self.order()];
        let stiffness = RectangleStiffness::new(self.steel());
        let rule = gauss_legendre(GAUSS_POINTS);
        for e in 0..mesh.element_count() {
            let unknowns = self.element_unknowns(e);
            let ends = [Edge::Bottom, Edge::Right, Edge::Left];
            for end in ends.into_iter().filter(|&end| mesh.neighbour(e, end).is_none()) {
                let tractions = self.tractions(e, end, field, &rule);
                for (node, traction) in end.nodes().into_iter().zip(tractions) {
                    let freedom =
                        if end == Edge::Bottom { self.boundary().bottom() } else { self.boundary().side() };
                    for (axis, part) in [traction.x, traction.y].into_iter().enumerate() {
                        if let (Freedom::Free, Some(unknown)) = (freedom[axis], unknowns[2 * node + axis]) {
                            forces[unknown] -= part;
                        }
                    }
                }
            }
            if unknowns.iter().all(Option::is_some) {
                continue;
            }
            let element = mesh.element(e);
            let held: [f64; 2 * NODES] = std::array::from_fn(|k| {
                let at = || -field.displacement(mesh.node_position(element.nodes[k / 2]));
                if unknowns[k].is_some() { 0.0 } else { [at().x, at().y][k % 2] }
            });
            let resisting = stiffness.matrix(element.size()).times(&held);
            for (unknown, force) in unknowns.iter().zip(resisting) {
                if let Some(unknown) = *unknown {
                    forces[unknown] -= force;
                }
            }
        }
        forces
    }

    /// ∫ N σ·n ds (N/mm) over an outer side of an element, for its three nodes in the order of
    /// [`Edge::nodes`].
    pub(super) fn tractions(
        &self,
        e: usize,
        end: Edge,
        field: &dyn ElasticField,
        rule: &[(f64, f64)],
    ) -> [Vec2; 3] {
        let corners = self.mesh().element(e).corners();
        let [first, second, _] = end.nodes();
        let (from, along) = (corners[first], corners[second] - corners[first]);
        // The sides run counter-clockwise: the outward normal points to the right.
        let normal = -along.left().normalised();
        let mut sums = [Vec2::default(); 3];
        let mut pending = vec![(0.0, 1.0, 0)];
        while let Some((s0, s1, halvings)) = pending.pop() {
            let length = (s1 - s0) * along.length();
            let middle = 0.5 * (s0 + s1);
            let clear = field.smooth_within(from + along * middle) - 0.5 * length;
            if clear < length && halvings < HALVINGS {
                pending.extend([(s0, middle, halvings + 1), (middle, s1, halvings + 1)]);
                continue;
            }
            for &(t, weight) in rule {
                let s = s0 + t * (s1 - s0);
                let traction = field.stress(from + along * s).traction(normal) * (weight * length);
                let shapes = [(1.0 - s) * (1.0 - 2.0 * s), s * (2.0 * s - 1.0), 4.0 * s * (1.0 - s)];
                for (sum, shape) in sums.iter_mut().zip(shapes) {
                    *sum = *sum + traction * shape;
                }
            }
        }
        sums
    }
}
