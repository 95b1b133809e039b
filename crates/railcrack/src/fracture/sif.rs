//! Stress intensity factors of a tip, and their histories.

use crate::math::MPA_SQRT_MM;
use std::ops::{Add, Mul};

/// Stress intensity factors of a tip, MPa √mm. K_II > 0 means τ12 > 0 ahead of the tip: the + face
/// moves along +x1.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sif {
    /// K_I.
    pub ki: f64,
    /// K_II.
    pub kii: f64,
}

impl Sif {
    /// K_I, MPa √m.
    #[must_use]
    pub fn ki_mpa_sqrt_m(self) -> f64 {
        self.ki / MPA_SQRT_MM
    }

    /// K_II, MPa √m.
    #[must_use]
    pub fn kii_mpa_sqrt_m(self) -> f64 {
        self.kii / MPA_SQRT_MM
    }
}

impl Add for Sif {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self { ki: self.ki + o.ki, kii: self.kii + o.kii }
    }
}

impl Mul<f64> for Sif {
    type Output = Self;
    fn mul(self, s: f64) -> Self {
        Self { ki: self.ki * s, kii: self.kii * s }
    }
}

/// The stress intensity factors of one tip through a passage: all accepted substeps in order, both
/// unloaded ends included.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SifHistory {
    /// The samples in the order of loading.
    pub samples: Vec<Sif>,
}

impl SifHistory {
    /// The largest |K_I| or |K_II|, MPa √mm.
    #[must_use]
    pub fn peak(&self) -> f64 {
        self.samples.iter().fold(0.0, |m, k| m.max(k.ki.abs()).max(k.kii.abs()))
    }
}
