//! Theories of the shear in rolling contact.

use crate::words::{Choice, Word};

/// A theory of the shear in rolling contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum RollingTheory {
    /// Strips of Carter's form, scaled to Kalker's coefficients (Sichani et al. 2016).
    #[default]
    FaStrip,
    /// The same strips with the shear of Kalker's strip theory (1967), which does not slip where it
    /// sticks.
    Strip,
    /// Kalker's simplified theory (1982).
    Fastsim,
    /// Kalker's linear theory (1967): forces without saturation.
    Linear,
}

impl Choice for RollingTheory {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::FaStrip, Word::now("fastrip", "strips of Carter's form, scaled to Kalker's coefficients")),
        (Self::Strip, Word::now("strip", "the same with the shear of Kalker's strip theory")),
        (
            Self::Fastsim,
            Word::now("fastsim", "Kalker's simplified theory with a parabolic limit of the shear"),
        ),
        (
            Self::Linear,
            Word::now("linear", "Kalker's linear theory; its force is distributed like the pressure"),
        ),
    ];
}
