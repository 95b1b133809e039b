//! Forces of surface tractions on the crack faces.

use super::grid::SurfaceGrid;
use crate::body::FaceMesh;
use crate::field::SegmentStress;
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
    for sample in &faces.graded {
        for segment in &grid.segments {
            let stress = SegmentStress::at(sample.point, segment.range.0, segment.range.1);
            for (end, &node) in segment.nodes.iter().enumerate() {
                let add = |forces: &mut Matrix, stress: Stress| {
                    let traction = stress.traction(sample.normal);
                    let row = forces.row_mut(node);
                    for (point, length) in sample.shares {
                        row[2 * point] += length * traction.x;
                        row[2 * point + 1] += length * traction.y;
                    }
                };
                add(&mut pressure, stress.pressure[end]);
                add(&mut shear, stress.shear[end]);
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
