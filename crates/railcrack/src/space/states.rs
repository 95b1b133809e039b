//! Contact states of the face points of cracks in space.

/// Contact state of a point.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub enum SpaceStatus {
    /// The faces are apart.
    Open,
    /// They touch without slipping.
    Stick,
    /// They touch and slip, with the direction of the friction force.
    Slip {
        /// Unit vector along the dip and the trace.
        direction: [f64; 2],
    },
}

/// State of a point in the Newton iteration.
#[derive(Debug, Clone, Copy)]
pub(super) struct PointState {
    pub status: SpaceStatus,
    /// Coulomb's coefficient μ of its crack.
    pub friction: f64,
    /// Ratio of the friction force to the augmented tangential force: μ (r_n − α w_n) / |r_t − α
    /// Δw_t|.
    pub turning: f64,
}
