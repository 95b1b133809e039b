//! Contact status and contact state of face points.

use crate::words::{Choice, Word};
use serde::{Deserialize, Serialize};

/// Contact status of a face point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum FaceStatus {
    /// Not in contact: no traction.
    Open,
    /// In contact, |s12| < μ |s22|: no slip.
    Stick,
    /// In contact, |s12| = μ |s22|.
    Slip,
}

impl Choice for FaceStatus {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Open, Word::now("open", "not in contact")),
        (Self::Stick, Word::now("stick", "in contact, no slip")),
        (Self::Slip, Word::now("slip", "in contact, at the limit of friction")),
    ];
}

/// The state of a face point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FaceState {
    /// ⟦w⟧·x2, mm, not negative.
    pub opening: f64,
    /// ⟦w⟧·x1, mm.
    pub slip: f64,
    /// Normal stress transmitted across the faces, MPa, not positive.
    pub s22: f64,
    /// Shear stress transmitted across the faces, MPa.
    pub s12: f64,
    /// Open, stick or slip.
    pub status: FaceStatus,
}
