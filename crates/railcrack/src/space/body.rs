//! Cracked body in space: compliance, stiffness and stress intensity factors along the front.

use super::Symmetric;
use super::galerkin::{Galerkin, ImagePart};
use super::grid::{Grid, SpaceResolution};
use super::image_table::ImageTable;
use super::plane::{PlaneFrame, Surroundings};
use super::shape::SpaceCrack;
use crate::interruption::{Interrupted, Interruption};
use crate::linear::{LinearError, spd_inverse_unless};
use crate::material::IsotropicElastic;
use crate::math::{Matrix, gauss_legendre};
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::Arc;
use thiserror::Error;

/// Points per cell and direction at which the stress of the uncracked rail is taken.
const LOAD_POINTS: usize = 4;

/// A body in space that cannot be made.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SpaceError {
    /// The stiffness of the crack is not positive definite, or not finite.
    #[error(transparent)]
    Linear(#[from] LinearError),
    /// Given up on request.
    #[error("{0}")]
    Interrupted(#[from] Interrupted),
}

/// The half-space seen from planes of one dip: what cracks that grow in their plane share.
#[derive(Debug, Clone)]
pub struct SpaceKernel {
    dip: f64,
    poisson: f64,
    table: Arc<ImageTable>,
}

impl SpaceKernel {
    /// For planes that go down at `dip` (radians) in steel of Poisson's ratio `poisson`.
    pub fn new(dip: f64, poisson: f64) -> Self {
        Self { dip, poisson, table: Arc::new(ImageTable::new(dip, poisson)) }
    }
}

/// A point of the front.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrontPoint {
    /// Parametric angle: 0 and π at the surface, π/2 at the deepest point, radians.
    pub phi: f64,
    /// x, lateral and depth, mm.
    pub position: [f64; 3],
    /// Unit normal of the front within its plane, away from the crack: along the dip and the trace.
    pub normal: [f64; 2],
}

/// Stress intensity factors of a point of the front, MPa √mm. At the deepest point K_II slides
/// along the dip and K_III along the lateral axis; elsewhere both directions turn with the front.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize, serde::Deserialize)]
pub struct FrontSif {
    /// Opening.
    pub ki: f64,
    /// Sliding.
    pub kii: f64,
    /// Tearing.
    pub kiii: f64,
}

impl FrontSif {
    /// The largest difference from another one, MPa √mm.
    #[must_use]
    pub fn difference(&self, other: &Self) -> f64 {
        let of = |a: f64, b: f64| (a - b).abs();
        of(self.ki, other.ki).max(of(self.kii, other.kii)).max(of(self.kiii, other.kiii))
    }
}

/// Where the stress of the uncracked rail is taken, and its part in the nodal forces.
#[derive(Debug, Clone)]
pub(super) struct LoadPoint {
    /// x, lateral and depth, mm.
    pub position: [f64; 3],
    /// Points of the crack and the integrals of their hats, mm².
    pub hats: [(usize, f64); 4],
}

/// A planar crack in the half-space as matrices: with f the nodal forces on its faces,
/// ⟦w⟧ = C f and K = S f.
#[derive(Debug, Clone)]
pub struct SpaceBody {
    frame: PlaneFrame,
    points: Vec<[f64; 3]>,
    front: Vec<FrontPoint>,
    stiffness: Matrix,
    compliance: Matrix,
    sif_influence: Matrix,
    sif_of_jumps: Matrix,
    loads: Vec<LoadPoint>,
    cells: Vec<[usize; 4]>,
}

impl SpaceBody {
    /// The body with `crack` in `surroundings`.
    ///
    /// Errors: a stiffness that is not positive definite.
    pub fn new(
        crack: &SpaceCrack,
        steel: &IsotropicElastic,
        surroundings: Surroundings,
        resolution: SpaceResolution,
    ) -> Result<Self, SpaceError> {
        let kernel =
            (surroundings == Surroundings::HalfSpace).then(|| SpaceKernel::new(crack.dip, steel.poisson()));
        Self::with_kernel(crack, steel, kernel.as_ref(), resolution, Interruption::NEVER)
    }

    /// The body with `crack` in the half-space of `kernel`, or in the full space without one. Given
    /// up on an `interruption`.
    ///
    /// Errors: a stiffness that is not positive definite; the interruption.
    pub fn with_kernel(
        crack: &SpaceCrack,
        steel: &IsotropicElastic,
        kernel: Option<&SpaceKernel>,
        resolution: SpaceResolution,
        interruption: Interruption<'_>,
    ) -> Result<Self, SpaceError> {
        let grid = Grid::new(crack, resolution);
        let poisson = steel.poisson();
        debug_assert!(kernel.is_none_or(|kernel| (kernel.dip, kernel.poisson) == (crack.dip, poisson)));
        let image = kernel.map(|kernel| ImagePart { table: Arc::clone(&kernel.table), dip: crack.dip });
        let mut stiffness = Galerkin::new(&grid, poisson, image.as_ref()).stiffness_unless(interruption)?;
        let mu = steel.shear_modulus();
        (0..stiffness.rows()).for_each(|i| stiffness.row_mut(i).iter_mut().for_each(|v| *v *= mu));
        let compliance = spd_inverse_unless(interruption, &stiffness)?;
        let sif_of_jumps = front_rows(&grid, steel);
        let sif_influence = crate::linear::product(&sif_of_jumps, &compliance)?;
        let frame = PlaneFrame::turned(crack.dip, crack.strike);
        let place = |[s, zeta]: [f64; 2]| {
            let [x, lateral, depth] = frame.position(s.max(0.0), zeta);
            [x + crack.middle[0], lateral + crack.middle[1], depth]
        };
        let points = grid.vertices[..grid.free].iter().map(|&p| place(p)).collect();
        let front = grid
            .front
            .iter()
            .enumerate()
            .map(|(t, column)| FrontPoint {
                phi: column.phi,
                position: place(grid.vertices[grid.free + t]),
                normal: column.normal,
            })
            .collect();
        let rule = gauss_legendre(LOAD_POINTS);
        let mut loads = Vec::new();
        for cell in &grid.cells {
            for (u, wu) in &rule {
                for (v, wv) in &rule {
                    let point = cell.at(*u, *v);
                    let hats = std::array::from_fn(|a| {
                        let weight = wu * wv * point.area * point.hats[a];
                        let vertex = cell.vertices[a];
                        if vertex < grid.free { (vertex, weight) } else { (0, 0.0) }
                    });
                    loads.push(LoadPoint { position: place(point.position), hats });
                }
            }
        }
        let cells = grid.cells.iter().map(|cell| cell.vertices).collect();
        Ok(Self { frame, points, front, stiffness, compliance, sif_influence, sif_of_jumps, loads, cells })
    }

    /// Points of the crack that carry a jump: x, lateral and depth, mm.
    pub fn points(&self) -> &[[f64; 3]] {
        &self.points
    }

    /// The area (mm²) that each point stands for: ∫ of its hat.
    pub fn areas(&self) -> Vec<f64> {
        let mut areas = vec![0.0; self.points.len()];
        for (point, weight) in self.loads.iter().flat_map(|load| load.hats) {
            areas[point] += weight;
        }
        areas
    }

    /// Where along the rail the crack is, mm: the middle of its mouth, or of a buried crack.
    pub fn places(&self) -> Vec<f64> {
        let at_surface = self.points.iter().filter(|point| point[2] == 0.0);
        let [mouth, all] = [at_surface.collect(), self.points.iter().collect::<Vec<_>>()];
        let points = if mouth.is_empty() { all } else { mouth };
        vec![points.iter().map(|point| point[0]).sum::<f64>() / points.len() as f64]
    }

    /// Points of the front, by growing φ.
    pub fn front(&self) -> &[FrontPoint] {
        &self.front
    }

    /// The directions of the plane of the crack.
    pub fn frame(&self) -> &PlaneFrame {
        &self.frame
    }

    /// Vertices of the cells: points of the crack, then points of the front.
    pub fn cells(&self) -> &[[usize; 4]] {
        &self.cells
    }

    /// C (mm/N), 3p × 3p: opening, slip along the dip and along the trace of each point.
    pub fn compliance(&self) -> &Matrix {
        &self.compliance
    }

    /// A = C⁻¹ (N/mm).
    pub fn stiffness(&self) -> &Matrix {
        &self.stiffness
    }

    /// S, 3q × 3p: K_I, K_II, K_III (MPa √mm) of each front point per nodal force (N).
    pub fn sif_influence(&self) -> &Matrix {
        &self.sif_influence
    }

    /// Nodal forces (N), 3p, of a stress field of the uncracked rail given at x, lateral and depth.
    pub fn nodal_forces(&self, stress: impl Fn([f64; 3]) -> Symmetric + Sync) -> Vec<f64> {
        let tractions: Vec<_> =
            self.loads.par_iter().map(|p| self.frame.traction(&stress(p.position))).collect();
        let mut forces = vec![0.0; 3 * self.points.len()];
        for (point, traction) in self.loads.iter().zip(tractions) {
            for (a, weight) in point.hats {
                (0..3).for_each(|c| forces[3 * a + c] += weight * traction[c]);
            }
        }
        forces
    }

    /// K along the front of jumps ⟦w⟧ (mm), 3p.
    pub fn sifs_of_jumps(&self, jumps: &[f64]) -> Vec<FrontSif> {
        sifs(&self.sif_of_jumps.times(jumps))
    }

    /// K along the front of nodal forces (N), 3p, on faces that nothing holds.
    pub fn sifs(&self, forces: &[f64]) -> Vec<FrontSif> {
        sifs(&self.sif_influence.times(forces))
    }
}

fn sifs(values: &[f64]) -> Vec<FrontSif> {
    values.chunks_exact(3).map(|k| FrontSif { ki: k[0], kii: k[1], kiii: k[2] }).collect()
}

/// K from the jumps of the first two rows: w = α η + β η³ along a column, α √(distance) near the
/// front, and K_I = μ α √(2π) / (4 (1 − ν)), the same for K_II, without (1 − ν) for K_III.
fn front_rows(grid: &Grid, steel: &IsotropicElastic) -> Matrix {
    let mut rows = Matrix::zeros(3 * grid.front.len(), 3 * grid.free);
    for (q, column) in grid.front.iter().enumerate() {
        let [e, f] = column.parameters;
        let weights = [f * f / (e * (f * f - e * e)), -e * e / (f * (f * f - e * e))];
        let scale = steel.shear_modulus() * (2.0 * PI).sqrt() / (4.0 * column.distance.sqrt());
        let plane = scale / (1.0 - steel.poisson());
        let [ms, mz] = column.normal;
        for (vertex, weight) in column.vertices.into_iter().zip(weights) {
            rows[(3 * q, 3 * vertex)] += plane * weight;
            rows[(3 * q + 1, 3 * vertex + 1)] += plane * weight * ms;
            rows[(3 * q + 1, 3 * vertex + 2)] += plane * weight * mz;
            // The front's direction, normal × x2: (−m_ζ, m_s).
            rows[(3 * q + 2, 3 * vertex + 1)] -= scale * weight * mz;
            rows[(3 * q + 2, 3 * vertex + 2)] += scale * weight * ms;
        }
    }
    rows
}
