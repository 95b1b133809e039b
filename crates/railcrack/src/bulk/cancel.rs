//! Cancellation of a half-plane field at the boundary of the mesh.

use super::boundary::Freedom;
use super::rail::{BulkError, BulkRail};
use super::stiffness::RectangleStiffness;
use crate::math::{Stress, Vec2, gauss_legendre};
use crate::mesh::{Edge, NODES};

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
