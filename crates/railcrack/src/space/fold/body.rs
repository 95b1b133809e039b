//! Cracked body with a folded crack.
//!
//! Points on the fold belong to both planes. Contact acts there along the normal of the strip, and
//! without friction: where both planes are closed a continuous jump vanishes on the fold, and in
//! the limit of small cells the points next to it see to that. Both conditions at one point, or
//! friction there, would lock slip over the length of a cell; the normal of a plane between the two
//! rounds off the fold over a cell on either side of it.

use super::super::body::{Assembled, CrackPart, FrontPoint, LOAD_POINTS, LoadPoint, SpaceBody};
use super::super::front_motion::{counts_on_strip, phi_on_strip};
use super::super::plane::PlaneFrame;
use super::super::shape::{SpaceCrack, SpaceError};
use super::super::stiffness::SpaceKernel;
use super::assembly::{Assembly, MorePoints};
use super::grid::{FoldedGrid, FoldedResolution, Part};
use super::shape::{FoldError, FoldedCrack};
use crate::growth::MouthStrip;
use crate::interruption::Interruption;
use crate::material::IsotropicElastic;
use crate::math::{Matrix, dot3, gauss_legendre};
use std::f64::consts::PI;

impl FoldedCrack {
    /// The body with this crack in the half-space of steel `steel`; `kernel` may hold the image for
    /// the plane of the strip. An `interruption` ends the computation.
    ///
    /// The front of the body runs from the mouth down one side of the strip (φ from −π/2), along
    /// the branch (φ from 0 to π) and up the other side (φ to 3π/2); K refers to the plane of each
    /// point.
    /// At the ends of the fold, where the front turns, K has no meaning.
    ///
    /// Errors: an inadmissible crack; a stiffness that is not positive definite; the interruption.
    pub fn body(
        &self,
        steel: &IsotropicElastic,
        kernel: &SpaceKernel,
        resolution: FoldedResolution,
        interruption: Interruption<'_>,
    ) -> Result<SpaceBody, FoldedBodyError> {
        self.checked()?;
        let branch = SpaceCrack { middle: self.middle, ..self.branch_shape()? };
        let grid = FoldedGrid::new(self, resolution)?;
        let image = kernel.image(self.mouth_dip);
        let assembly = Assembly::new(self, &grid, steel.poisson(), MorePoints(0));
        let stiffness = assembly
            .stiffness_unless(&image, interruption)
            .map_err(|stopped| FoldedBodyError::Body(stopped.into()))?
            .scaled(steel.shear_modulus());
        let [strip, below] = self.planes();
        let planes = vec![strip, below];
        let plane_of_point: Vec<usize> = grid.part_of_vertex.iter().map(|part| part.plane()).collect();
        let parts = Assembled {
            crack: CrackPart {
                shape: branch,
                strip: Some(MouthStrip { dip: self.mouth_dip, length: self.fold }),
                frame: below,
                points: 0..grid.free,
                front: 0..grid.front.len(),
                fold: (0..grid.free).filter(|&v| grid.part_of_vertex[v] == Part::Fold).collect(),
            },
            points: grid.vertices[..grid.free].iter().map(|&p| self.position(p)).collect(),
            front: self.front(&grid),
            stiffness,
            sif_of_jumps: sif_rows(&grid, steel, &planes),
            loads: self.loads(&grid),
            cells: grid.cells.iter().map(|cell| cell.vertices).collect(),
            planes,
            plane_of_point,
        };
        Ok(SpaceBody::assembled(parts, interruption)?)
    }

    fn front(&self, grid: &FoldedGrid) -> Vec<FrontPoint> {
        let of = |(q, front): (usize, &super::grid::FoldedFront)| {
            let [s, zeta] = grid.vertices[grid.free + q];
            let [right, left] = phi_on_strip(1.0 - s / self.fold);
            let side = if zeta > 0.0 { right } else { left };
            let is_on_strip = front.part == Part::Strip;
            FrontPoint {
                crack: 0,
                phi: if is_on_strip { side } else { front.column.phi },
                counts: if is_on_strip { counts_on_strip(side) } else { front.column.counts },
                position: self.position([s, zeta]),
                normal: front.column.normal,
            }
        };
        grid.front.iter().enumerate().map(of).collect()
    }

    fn loads(&self, grid: &FoldedGrid) -> Vec<LoadPoint> {
        let rule = gauss_legendre(LOAD_POINTS);
        let mut loads = Vec::new();
        for (cell, part) in grid.cells.iter().zip(&grid.part_of_cell) {
            for (u, wu) in &rule {
                for (v, wv) in &rule {
                    let point = cell.at(*u, *v);
                    let hats = std::array::from_fn(|a| {
                        let weight = wu * wv * point.area * point.hats[a];
                        let corner = cell.vertices[a];
                        if corner < grid.free { (corner, weight) } else { (0, 0.0) }
                    });
                    let position = self.position(point.position);
                    loads.push(LoadPoint { crack: 0, plane: part.plane(), position, hats });
                }
            }
        }
        loads
    }
}

/// Reasons why the body of a folded crack cannot be built.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FoldedBodyError {
    /// An inadmissible crack.
    #[error(transparent)]
    Fold(#[from] FoldError),
    /// An inadmissible branch.
    #[error(transparent)]
    Branch(#[from] super::super::shape::ShapeError),
    /// Matrices that cannot be computed.
    #[error(transparent)]
    Body(#[from] SpaceError),
}

/// K from the jumps of the first two rows, as for planar cracks, with jumps turned from the plane
/// of each point to that of the front.
fn sif_rows(grid: &FoldedGrid, steel: &IsotropicElastic, planes: &[PlaneFrame]) -> Matrix {
    let mut rows = Matrix::zeros(3 * grid.front.len(), 3 * grid.free);
    for (q, front) in grid.front.iter().enumerate() {
        let column = &front.column;
        let [e, f] = column.parameters;
        let weights = [f * f / (e * (f * f - e * e)), -e * e / (f * (f * f - e * e))];
        let scale = steel.shear_modulus() * (2.0 * PI).sqrt() / (4.0 * column.distance.sqrt());
        let plane = scale / (1.0 - steel.poisson());
        let [ms, mz] = column.normal;
        let [normal, dip, trace] = planes[front.part.plane()].directions();
        let across: [f64; 3] = std::array::from_fn(|c| ms * dip[c] + mz * trace[c]);
        let along: [f64; 3] = std::array::from_fn(|c| ms * trace[c] - mz * dip[c]);
        for (vertex, weight) in column.vertices.into_iter().zip(weights) {
            if vertex >= grid.free {
                continue;
            }
            let directions = planes[grid.part_of_vertex[vertex].plane()].directions();
            for (j, direction) in directions.into_iter().enumerate() {
                let modes = [(normal, plane), (across, plane), (along, scale)];
                for (mode, (of_mode, scale)) in modes.into_iter().enumerate() {
                    rows[(3 * q + mode, 3 * vertex + j)] += scale * weight * dot3(of_mode, direction);
                }
            }
        }
    }
    rows
}
