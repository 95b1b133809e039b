//! Cracks that the finite-element engine cannot represent.

use crate::bulk::BulkError;
use crate::interruption::Interrupted;
use crate::linear::LinearError;
use crate::mesh::MeshError;
use thiserror::Error;

/// Cracks that the finite-element engine cannot represent.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum XfemError {
    /// A crack that leaves the mesh.
    #[error("crack {crack} leaves the mesh: {covered} of {length} mm lie inside")]
    OutsideMesh {
        /// Number of the crack, from 1.
        crack: usize,
        /// Length inside of the mesh, mm.
        covered: f64,
        /// Its length, mm.
        length: f64,
    },
    /// Grid lines that make no mesh.
    #[error("the mesh cannot be made: {0}")]
    Mesh(#[from] MeshError),
    /// The uncracked rail.
    #[error("the rail cannot be computed: {0}")]
    Bulk(#[from] BulkError),
    /// Linear algebra.
    #[error("the enriched system cannot be solved: {0}")]
    Linear(#[from] LinearError),
    /// Face points that the jump in the elements cannot follow.
    #[error(
        "the elements cannot follow face points as close as {spacing} mm (interface_spacing_mm; that of the elements \
         always works): {reason}"
    )]
    FacePoints {
        /// The largest distance that was asked for, mm.
        spacing: f64,
        /// The inverse of C that does not exist.
        reason: LinearError,
    },
    /// Given up on request.
    #[error("{0}")]
    Interrupted(#[from] Interrupted),
}
