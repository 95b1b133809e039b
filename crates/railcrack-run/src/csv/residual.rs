//! `residual.csv`: the residual stress on the mesh of the cracks.

use super::table;
use railcrack::math::Stress;

table! {
    /// Residual stress at a depth on the middle line of the crack mesh.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct ResidualRow in "residual.csv", [
        "Residual stress on the middle line of the crack mesh, after balancing",
        "depth_mm: below the running surface, mm; stress: MPa, tension positive; x along the rail, y upwards, z out of plane",
    ] {
        /// Depth, mm.
        depth: f64 = "depth_mm";
        /// Stress, MPa; x along the rail, y up, z out of plane.
        stress: Stress = "sxx_mpa" "syy_mpa" "szz_mpa" "sxy_mpa";
    }
}
