//! The residual stress of a run in its summary.

use railcrack::shakedown::RailState;
use serde::{Deserialize, Serialize};

/// The residual stress of a run and where it comes from.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ResidualSummary {
    /// File of `[residual_stress]`, balanced.
    pub balanced_profile: Option<String>,
    /// Where the plastic stress comes from.
    pub plastic_source: Option<PlasticOrigin>,
    /// The stage that computed it.
    pub rolled: Option<RolledSummary>,
    /// Losses in the projection onto the mesh of the rail.
    pub projection: Option<ProjectionSummary>,
    /// Effect of the free sides of a block on the residual stress of the middle line.
    pub release: Option<ReleaseSummary>,
    /// Wall time of both stages before the first step, s.
    pub wall_s: f64,
    /// Remarks for the reader.
    pub notes: Vec<String>,
}

/// Where a plastic stress comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PlasticOrigin {
    /// A field on a mesh.
    Field,
    /// A profile by depth.
    Profile,
    /// The run computed it first.
    Rolled,
}

impl PlasticOrigin {
    /// Its word in results.
    pub fn word(self) -> &'static str {
        match self {
            Self::Field => "field",
            Self::Profile => "profile",
            Self::Rolled => "rolled",
        }
    }
}

/// The stabilised plastic state that the run computed first.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RolledSummary {
    /// Its folder in the run folder.
    pub folder: String,
    /// The stabilised state.
    #[serde(with = "crate::disk::words")]
    pub state: RailState,
    /// Passages until the residual stress repeated.
    pub passes: usize,
    /// p0 over the yield stress in shear.
    pub p0_over_k: f64,
    /// The wheel of a mix that has rolled the rail, or the first of those in turn: the heaviest;
    /// null for one wheel.
    pub wheel: Option<String>,
}

/// Norms are √∫ p:p dA of the plastic stress p.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ProjectionSummary {
    /// Values at nodes that were fitted to values on cells: ratio of their norm to that of the
    /// cells. Null where values were given at nodes.
    pub nodes_norm_ratio: Option<f64>,
    /// Norm of their difference, over it.
    pub nodes_difference: Option<f64>,
    /// Interpolation by the mesh of the rail, within width and depth of the rail: its norm over
    /// that of the field.
    pub mesh_norm_ratio: f64,
    /// Norm of their difference, over it.
    pub mesh_difference: f64,
    /// Norm of the field there, MPa mm.
    pub norm_mpa_mm: f64,
}

/// Stress released by the free sides of a block, where it is largest.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ReleaseSummary {
    /// On the middle line, mm.
    pub depth_mm: f64,
    /// σ_xx with the sides held along x, MPa.
    pub held_sxx_mpa: f64,
    /// σ_xx with the sides free, MPa.
    pub free_sxx_mpa: f64,
    /// Whether the run uses the released stress: a plastic stress is balanced on the block, a
    /// balanced stress is taken as it is.
    pub carried: bool,
}
