//! Forces of surface tractions on the crack faces.

use super::grid::SurfaceGrid;
use crate::body::FaceMesh;
use crate::field::{SegmentEnd, SegmentStress};
use crate::math::{Matrix, Stress, Vec2};

/// Nodal forces on the faces for a unit traction of each surface node; row i belongs to node i and
/// has 2p entries, N/mm per MPa.
pub(super) struct SurfaceForces {
    /// Of a unit pressure.
    pub pressure: Matrix,
    /// Of a unit shear along +x on the rail.
    pub shear: Matrix,
}

/// The forces of the hats of `grid` on `faces`.
pub(super) fn forces(grid: &SurfaceGrid, faces: &FaceMesh) -> SurfaceForces {
    let none = || Matrix::zeros(grid.nodes.len(), 2 * faces.points.len());
    let (mut pressure, mut shear) = (none(), none());
    let mut ends: Vec<SegmentEnd> = Vec::with_capacity(grid.nodes.len());
    let mut hats = Vec::with_capacity(grid.nodes.len());
    for sample in &faces.graded {
        ends.clear();
        ends.extend(grid.nodes.iter().map(|&x| SegmentEnd::of(sample.point, x)));
        hats.clear();
        hats.resize(grid.nodes.len(), [Stress::default(); 2]);
        for segment in &grid.segments {
            let [start, end] = segment.nodes.map(|node| &ends[node]);
            let stress = SegmentStress::between(start, end);
            for (end, &node) in segment.nodes.iter().enumerate() {
                let [pressure, shear] = &mut hats[node];
                *pressure = *pressure + stress.pressure[end];
                *shear = *shear + stress.shear[end];
            }
        }
        for (node, stresses) in hats.iter().enumerate() {
            for (forces, stress) in [&mut pressure, &mut shear].into_iter().zip(stresses) {
                let traction = stress.traction(sample.normal);
                let row = forces.row_mut(node);
                for (point, length) in sample.shares {
                    row[2 * point] += length * traction.x;
                    row[2 * point + 1] += length * traction.y;
                }
            }
        }
    }
    for forces in [&mut pressure, &mut shear] {
        for node in 0..grid.nodes.len() {
            for (force, point) in forces.row_mut(node).chunks_exact_mut(2).zip(&faces.points) {
                let sum = Vec2::new(force[0], force[1]);
                (force[0], force[1]) = (sum.dot(point.tangent), sum.dot(point.tangent.left()));
            }
        }
    }
    SurfaceForces { pressure, shear }
}
