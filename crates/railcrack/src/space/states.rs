//! States of the points of faces in space.

/// Whether the faces touch at a point.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub enum SpaceStatus {
    /// The faces are apart.
    Open,
    /// They touch without slipping.
    Stick,
    /// They slip; the direction of the friction force.
    Slip {
        /// Unit vector along the dip and the trace.
        direction: [f64; 2],
    },
}

/// A point as the iteration sees it.
#[derive(Debug, Clone, Copy)]
pub(super) struct PointState {
    pub status: SpaceStatus,
    /// Coulomb's coefficient μ of its crack.
    pub friction: f64,
    /// Friction force over what pushes the point along: μ (r_n − α w_n) / |r_t − α Δw_t|.
    pub turning: f64,
}
