//! Contact states of faces in space, and what a passage leaves of them.

use super::body::FrontSif;
use crate::contact::{FluidState, PocketState};

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

/// Settings of the load steps of passages.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpacePassageSettings {
    /// Largest difference of K between two steps and one of twice the length, MPa √mm.
    pub tolerance: f64,
    /// How often two intervals between positions may be halved, the first time into one step each;
    /// with 0, each interval is one step and nothing is compared.
    pub halvings: usize,
}

/// K along the front and the faces at all wheel positions.
#[derive(Debug, Clone, PartialEq)]
pub struct SpaceHistory {
    /// Abscissae of the centre of the contact, mm.
    pub positions: Vec<f64>,
    /// K (MPa √mm): by position, then by front point.
    pub sifs: Vec<Vec<FrontSif>>,
    /// K under the constant stress alone, before the wheel arrives.
    pub before: Vec<FrontSif>,
    /// The faces, by position.
    pub faces: Vec<SpaceFaces>,
    /// The fluid in each crack, by position; empty without fluid.
    pub fluid: Vec<Vec<FluidState>>,
    /// Number of load steps, including those of the step control.
    pub steps: usize,
    /// Newton iterations of all steps.
    pub iterations: usize,
    /// Largest number of iterations of a step.
    pub iterations_max: usize,
    /// Largest violation of the contact conditions.
    pub violation: f64,
    /// Largest difference of K (MPa √mm) that was accepted between two steps and one of twice the
    /// length.
    pub step_error: f64,
}

impl SpaceHistory {
    /// The largest |K|, MPa √mm.
    #[must_use]
    pub fn peak(&self) -> f64 {
        let sizes = |k: &FrontSif| k.ki.abs().max(k.kii.abs()).max(k.kiii.abs());
        self.sifs.iter().flatten().map(sizes).fold(0.0, f64::max)
    }

    /// The largest difference of K from another history at the same positions, MPa √mm.
    #[must_use]
    pub fn difference(&self, other: &Self) -> f64 {
        let pairs = self.sifs.iter().flatten().zip(other.sifs.iter().flatten());
        pairs.map(|(a, b)| a.difference(b)).fold(0.0, f64::max)
    }
}
