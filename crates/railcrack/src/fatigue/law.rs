//! The growth law.

use std::ops::RangeInclusive;

/// Paris' law da/dN = C ΔK_eq^m with ΔK_eq² = ΔK_I² + w ΔK_II² (Trollé et al. 2014, eqs 30 and 31).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ParisLaw {
    /// C, mm per cycle with ΔK_eq in MPa√m.
    pub c: f64,
    /// m.
    pub m: f64,
    /// w, weight of mode II.
    pub mode_2_weight: f64,
    /// ΔK_eq (MPa√m) at or below which nothing grows.
    pub threshold: f64,
}

impl ParisLaw {
    /// Rail steel as in Trollé et al. 2014, eqs 30 and 31, read in mm per cycle.
    pub const RAIL_STEEL: Self = Self { c: 2e-9, m: 3.33, mode_2_weight: 0.772, threshold: 0.0 };
}

/// What the direction of growth maximises over the kink angle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DirectionCriterion {
    /// The growth rate of the virtual kink, from the ranges of k1 and k2 (Hourlier & Pineau).
    #[default]
    MaxRate,
    /// The range of k1.
    MaxDeltaK1,
    /// The largest k1.
    MaxK1,
}

/// Kink angles that are searched, radians: the kink functions hold to about ±110°.
pub const KINK_ANGLES: RangeInclusive<f64> =
    -110.0 * std::f64::consts::PI / 180.0..=110.0 * std::f64::consts::PI / 180.0;
