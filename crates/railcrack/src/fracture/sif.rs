//! Stress intensity factors of a tip, and their history.

use std::ops::{Add, Mul};

/// Stress intensity factors of a tip, MPa √mm. K_II > 0 means τ12 > 0 ahead of the tip: the + face
/// moves along +x1.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sif {
    /// K_I.
    pub k1: f64,
    /// K_II.
    pub k2: f64,
}

impl Add for Sif {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self { k1: self.k1 + o.k1, k2: self.k2 + o.k2 }
    }
}

impl Mul<f64> for Sif {
    type Output = Self;
    fn mul(self, s: f64) -> Self {
        Self { k1: self.k1 * s, k2: self.k2 * s }
    }
}

/// The stress intensity factors of one tip through a passage: all accepted substeps in order, both
/// unloaded ends included.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SifHistory {
    /// The samples in the order of events.
    pub samples: Vec<Sif>,
}

impl SifHistory {
    /// The largest |K_I| or |K_II|, MPa √mm.
    pub fn peak(&self) -> f64 {
        self.samples.iter().fold(0.0, |m, k| m.max(k.k1.abs()).max(k.k2.abs()))
    }
}
