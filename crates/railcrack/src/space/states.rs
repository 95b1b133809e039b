//! Contact states of the face points of cracks in space.

use crate::contact::PocketState;

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

/// The faces of a crack at one instant.
#[derive(Debug, Clone, PartialEq)]
pub struct SpaceFaces {
    /// ⟦w⟧ (mm), 3p: opening, slip along the dip and along the trace.
    pub jumps: Vec<f64>,
    /// r (N), 3p: forces between the faces.
    pub reactions: Vec<f64>,
    /// The state of each point.
    pub status: Vec<SpaceStatus>,
    /// The fluid of each pocket that the contact traps; empty without such fluid.
    pub fluid: Vec<PocketState>,
}

impl SpaceFaces {
    /// Faces of `points` points that are closed, without slip and force.
    pub(super) fn virgin(points: usize) -> Self {
        Self {
            jumps: vec![0.0; 3 * points],
            reactions: vec![0.0; 3 * points],
            status: vec![SpaceStatus::Stick; points],
            fluid: Vec::new(),
        }
    }

    /// Whether every point has the same state as in the other faces: open, sticking or slipping.
    pub(super) fn keeps_states_of(&self, other: &Self) -> bool {
        let kind = |status: &SpaceStatus| std::mem::discriminant(status);
        self.status.iter().zip(&other.status).all(|(one, other)| kind(one) == kind(other))
    }
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
