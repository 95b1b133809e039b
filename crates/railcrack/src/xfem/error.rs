//! Errors of the finite-element engine.

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
        /// Length inside the mesh, mm.
        covered: f64,
        /// Its length, mm.
        length: f64,
    },
    /// Invalid grid lines.
    #[error("the mesh cannot be made: {0}")]
    Mesh(#[from] MeshError),
    /// An error of the uncracked rail.
    #[error("the rail cannot be computed: {0}")]
    Bulk(#[from] BulkError),
    /// An error of the linear algebra.
    #[error("the enriched system cannot be solved: {0}")]
    Linear(#[from] LinearError),
    /// Face points that are too dense for the jump functions of the elements.
    #[error(
        "the elements cannot follow face points as close as {spacing} mm (interface_spacing_mm; that of the elements \
         always works): {reason}"
    )]
    FacePoints {
        /// The largest requested distance, mm.
        spacing: f64,
        /// The error of inverting C.
        reason: LinearError,
    },
    /// Elements that are too coarse for the jumps of the faces.
    #[error("the elements are too coarse for a crack: use smaller ones (element_size_mm): {reason}")]
    TooCoarse {
        /// The error of inverting C.
        reason: LinearError,
    },
    /// Interrupted on request.
    #[error("{0}")]
    Interrupted(#[from] Interrupted),
}
