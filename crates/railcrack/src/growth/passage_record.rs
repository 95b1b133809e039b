//! Records of a passage: histories of K and states of the crack faces.

use super::FaceAcross;
use crate::body::FacePoint;
use crate::contact::{CoupledState, FaceState, FluidState, SurfaceState};
use crate::fracture::Sif;
use serde::{Deserialize, Serialize};

/// One passage on fixed cracks.
#[derive(Debug, Clone, PartialEq)]
pub struct PassageRecord {
    /// Output positions x_c in the order of travel, mm.
    pub xc: Vec<f64>,
    /// `sifs[tip][position]`, MPa √mm.
    pub sifs: Vec<Vec<Sif>>,
    /// `fluid[tip][position]`: the fluid in the crack of each tip; empty without fluid.
    pub fluid: Vec<Vec<FluidState>>,
    /// `kiii[tip][position]`: K_III, MPa √mm; empty in the plane.
    pub kiii: Vec<Vec<f64>>,
    /// `wheel[position]`: the contact of a wheel that feels the cracks, where it does; empty for
    /// other wheels.
    pub wheel: Vec<Option<CoupledState>>,
}

/// The faces during the stabilised passage.
#[derive(Debug, Clone, PartialEq)]
pub struct FaceRecord {
    /// The face points, crack by crack, in the order of each crack's polyline.
    pub points: Vec<FacePoint>,
    /// `states[position][point]`.
    pub states: Vec<Vec<FaceState>>,
    /// The third direction, for cracks in space.
    pub across: Option<FaceAcross>,
    /// `surface[position]`: the nodes of the running surface under a wheel that feels the cracks,
    /// where it does; empty for other wheels.
    pub surface: Vec<Vec<SurfaceState>>,
}

/// Effort of the contact solver in one growth step.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct SolverCounts {
    /// Passages until the history repeated.
    pub passages: usize,
    /// Load steps between output positions, in addition to the one that each position requires.
    pub substeps: usize,
    /// Contact solutions.
    pub solves: usize,
    /// Contact iterations, all solutions together.
    pub iterations: usize,
    /// The most iterations of one solution.
    pub iterations_max: usize,
    /// Largest violation of the contact conditions, relative to the largest traction and jump.
    pub complementarity_max: f64,
}

impl SolverCounts {
    /// The sum of this effort and that for another wheel on the same body.
    pub(crate) fn and(self, other: Self) -> Self {
        Self {
            passages: self.passages.max(other.passages),
            substeps: self.substeps + other.substeps,
            solves: self.solves + other.solves,
            iterations: self.iterations + other.iterations,
            iterations_max: self.iterations_max.max(other.iterations_max),
            complementarity_max: self.complementarity_max.max(other.complementarity_max),
        }
    }
}
