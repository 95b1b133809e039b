//! Recovery of nodal values from means over cells.

use super::cells::CellMesh;
use crate::math::{Stress, Vec2};

/// Layers of neighbours by which a patch is extended until the centroids of its cells spread in
/// every direction.
const EXTENSIONS: usize = 3;
/// Variance of the centroids in a direction, over the largest variance, below which they do not
/// determine the gradient in that direction.
const SPREAD: f64 = 1e-6;

/// Number of rounds, each of which adds the fit to the remaining defect of the cell means. Two
/// rounds compensate most of the flattening; more would overshoot where cells are too coarse for
/// the field.
const ROUNDS: usize = 2;

/// Nodal values of `mesh` from `values`, the means over its cells: at each node the least-squares
/// linear fit to the cells around it, followed by the same fit to the defect of the resulting
/// means. Linear fields are reproduced exactly, at the boundary too; the rounds restore peaks that
/// the fits flatten. Points without a cell get zero.
///
/// A least-squares fit of the shape functions to one point per cell is not unique on
/// quadrilaterals: there are fewer cells than nodes. Source: Zienkiewicz & Zhu 1992, Int. J. Numer.
/// Meth. Engng 33, 1331–1364 (recovery on patches).
pub(super) fn nodes_from_cells(mesh: &CellMesh, values: &[Stress]) -> Vec<Stress> {
    let patches = patches(mesh);
    let mut nodal = vec![Stress::ZERO; mesh.points.len()];
    let mut lacking = values.to_vec();
    for _ in 0..ROUNDS {
        for (value, patch) in nodal.iter_mut().zip(&patches) {
            *value = patch.iter().fold(*value, |sum, &(cell, weight)| sum + lacking[cell] * weight);
        }
        for (cell, (lack, value)) in lacking.iter_mut().zip(values).enumerate() {
            *lack = *value - mean(mesh, cell, &nodal);
        }
    }
    nodal
}

/// The mean over a cell of the field interpolated from nodal values.
fn mean(mesh: &CellMesh, cell: usize, nodal: &[Stress]) -> Stress {
    let nodes = &mesh.cells[cell].nodes;
    let (mut sum, mut area) = (Stress::ZERO, 0.0);
    for (shapes, weight) in mesh.quadrature(cell) {
        sum = nodes.iter().zip(shapes).fold(sum, |sum, (&node, n)| sum + nodal[node] * (n[0] * weight));
        area += weight;
    }
    sum * (1.0 / area)
}

/// For each node the cells whose values are fitted there, with their weights.
fn patches(mesh: &CellMesh) -> Vec<Vec<(usize, f64)>> {
    let centroids: Vec<Vec2> = (0..mesh.cells.len()).map(|cell| mesh.centroid(cell)).collect();
    let mut around: Vec<Vec<usize>> = vec![Vec::new(); mesh.points.len()];
    for (cell, nodes) in mesh.cells.iter().map(|cell| &cell.nodes).enumerate() {
        for &node in nodes {
            around[node].push(cell);
        }
    }
    let grown = |patch: &[usize]| {
        let nodes = patch.iter().flat_map(|&cell| &mesh.cells[cell].nodes);
        let mut wider: Vec<usize> = nodes.flat_map(|&node| &around[node]).copied().collect();
        wider.sort_unstable();
        wider.dedup();
        wider
    };
    let at_node = |(node, cells): (usize, &Vec<usize>)| {
        if cells.is_empty() {
            return Vec::new();
        }
        let here = mesh.points[node];
        let fit = |patch: &[usize]| Fit::new(patch.iter().map(|&cell| centroids[cell]), here);
        // The smallest patch whose centroids spread in the largest number of directions. A strip of
        // cells never determines the gradient across it.
        let (mut best, mut patch) = (cells.clone(), cells.clone());
        let mut directions = fit(&best).directions();
        for _ in 0..EXTENSIONS {
            if directions == 2 {
                break;
            }
            patch = grown(&patch);
            let more = fit(&patch).directions();
            if more > directions {
                (best, directions) = (patch.clone(), more);
            }
        }
        let weights = fit(&best).weights();
        best.into_iter().zip(weights).collect()
    };
    around.iter().enumerate().map(at_node).collect()
}

/// The least-squares fit of a + b·(x − x̄) to values at some points, evaluated at `here`.
struct Fit {
    /// Positions of the points relative to their mean.
    offsets: Vec<Vec2>,
    /// Position of `here` relative to their mean.
    here: Vec2,
    /// Principal directions and variances of the points, the widest first.
    axes: [(Vec2, f64); 2],
}

impl Fit {
    fn new(points: impl Iterator<Item = Vec2> + Clone, here: Vec2) -> Self {
        let count = points.clone().count().max(1) as f64;
        let mean = points.clone().fold(Vec2::default(), |sum, p| sum + p) * (1.0 / count);
        let offsets: Vec<Vec2> = points.map(|p| p - mean).collect();
        let sum = |term: fn(&Vec2) -> f64| offsets.iter().map(term).sum::<f64>();
        let (xx, yy, xy) = (sum(|p| p.x * p.x), sum(|p| p.y * p.y), sum(|p| p.x * p.y));
        let widest = Vec2::unit(0.5 * (2.0 * xy).atan2(xx - yy));
        let along = |axis: Vec2| (axis, offsets.iter().map(|p| p.dot(axis).powi(2)).sum::<f64>());
        Self { here: here - mean, axes: [along(widest), along(widest.left())], offsets }
    }

    /// Directions in which the points spread.
    fn directions(&self) -> usize {
        let widest = self.axes[0].1;
        self.axes.iter().filter(|(_, variance)| widest > 0.0 && *variance > SPREAD * widest).count()
    }

    /// The weight of each point's value.
    fn weights(&self) -> Vec<f64> {
        let count = self.offsets.len() as f64;
        let used = &self.axes[..self.directions()];
        let weight = |p: &Vec2| {
            let slope = |(axis, variance): &(Vec2, f64)| p.dot(*axis) * self.here.dot(*axis) / variance;
            1.0 / count + used.iter().map(slope).sum::<f64>()
        };
        self.offsets.iter().map(weight).collect()
    }
}
