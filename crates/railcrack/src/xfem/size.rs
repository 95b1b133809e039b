//! Size of the system of a cracked rail in finite elements.

/// Entries of the factor over n log2 n: nested dissection of a plane grid, measured from 20k to 60k
/// unknowns.
const FACTOR_ENTRIES: f64 = 6.0;

/// Estimated number of entries of the factor of a mesh with this number of unknowns.
pub(super) fn factor_entries(unknowns: usize) -> usize {
    (FACTOR_ENTRIES * unknowns as f64 * (unknowns as f64).log2()) as usize
}

/// Size of the system of a cracked rail in finite elements.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct XfemSize {
    /// Displacement unknowns of the mesh.
    pub mesh_unknowns: usize,
    /// Unknowns of the enrichments.
    pub enriched_unknowns: usize,
    /// Points of the crack faces.
    pub face_points: usize,
    /// Estimated number of entries of the factor.
    pub factor_entries: usize,
}
