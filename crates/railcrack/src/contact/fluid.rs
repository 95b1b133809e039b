//! Fluid in cracks: models, and the pockets of the faces that it fills.

use crate::words::{Choice, Word};

/// Model of the pressure of the fluid under the wheel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FluidModel {
    /// The pressure of the contact over the mouth acts in the crack (Bower 1988).
    Mouth {
        /// Upper limit of the pressure, MPa; infinite for no limit.
        cap: f64,
    },
    /// The fluid in a crack whose mouth the contact covers keeps its volume (Bower 1988).
    Trapped {
        /// B, MPa: V = V0 e^(−p/B); infinite for an incompressible fluid.
        bulk_modulus: f64,
        /// Whether fluid above the pressure over the mouth leaves through the mouth as soon as no
        /// closed face blocks its path.
        leak: bool,
    },
}

/// Pressure profile along a crack whose mouth is under the contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PressureProfile {
    /// p(s) = p(mouth) (1 − s/l), s along the faces from the mouth, l the farthest tip.
    #[default]
    Linear,
    /// p(s) = p(mouth).
    Constant,
}

impl Choice for PressureProfile {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Linear, Word::now("linear", "p(s) = p(mouth) (1 - s/l)")),
        (Self::Constant, Word::now("constant", "p(s) = p(mouth)")),
    ];
}

/// Fluid in the cracks of a rail.
#[derive(Debug, Clone, PartialEq)]
pub struct CrackFluid {
    /// The model of its pressure.
    pub model: FluidModel,
    /// The profile along a crack, for a model with the pressure over the mouth.
    pub profile: PressureProfile,
    /// Indices (from 0) of the cracks with fluid; `None` for all cracks. Joined cracks share the
    /// fluid.
    pub cracks: Option<Vec<usize>>,
}

impl CrackFluid {
    /// Whether crack `crack` (from 0) contains fluid.
    pub(crate) fn wets(&self, crack: usize) -> bool {
        self.cracks.as_ref().is_none_or(|wet| wet.contains(&crack))
    }
}

/// The mouth of a pocket.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PocketMouth {
    /// Its abscissa, mm.
    pub x: f64,
    /// The face point there.
    pub point: usize,
}

/// Connected cracks that contain fluid at one pressure.
#[derive(Debug, Clone, PartialEq)]
pub struct Pocket {
    /// Its cracks, by index from 0.
    pub cracks: Vec<usize>,
    /// Nodal forces (N/mm per MPa, 2p) of a unit pressure on its faces. They also give its volume
    /// per width, V = unit · ⟦w⟧ (mm²).
    pub unit: Vec<f64>,
    /// Nodal forces of a unit pressure over the mouth, with the profile of the pressure along the
    /// crack.
    pub profile: Vec<f64>,
    /// Its mouth at the running surface; none for buried cracks. Cracks with two mouths would
    /// detach a piece of the rail.
    pub mouth: Option<PocketMouth>,
    /// Its face points.
    pub points: Vec<usize>,
    /// Pairs of adjacent face points.
    pub neighbours: Vec<(usize, usize)>,
}

/// The fluid on the faces of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct FaceFluid {
    /// Model of its pressure.
    pub model: FluidModel,
    /// Its pockets.
    pub pockets: Vec<Pocket>,
}

/// The fluid in a crack.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FluidState {
    /// p, MPa; with a profile, the pressure at the mouth.
    pub pressure: f64,
    /// V, mm² (mm³ per mm of width).
    pub volume: f64,
}

impl Pocket {
    /// V (mm²) at the jumps ⟦w⟧ (mm, 2p).
    pub fn volume(&self, jump: &[f64]) -> f64 {
        crate::math::dot(&self.unit, jump)
    }
}

/// Condition that determines the pressure of a pocket.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PocketStatus {
    /// The pressure outside: zero while the mouth is free, or a pressure that is being released.
    Vented,
    /// The volume of the fluid: V = V0 e^(−p/B).
    Sealed,
    /// The fluid does not fill the pocket: p = 0, V ≥ V0.
    Cavity,
    /// Fluid leaves along open faces: p is the pressure over the mouth.
    Leaking,
}

/// State of the fluid in a pocket.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PocketState {
    /// Condition that determines its pressure.
    pub status: PocketStatus,
    /// p, MPa.
    pub pressure: f64,
    /// V0, mm²: the volume of the fluid without pressure.
    pub content: f64,
}

impl PocketState {
    /// A pocket whose mouth is free.
    pub(crate) const FREE: Self = Self { status: PocketStatus::Vented, pressure: 0.0, content: 0.0 };
}
