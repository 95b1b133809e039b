//! The differences of K of a tip in two runs.

/// Difference of K_I or K_II of a tip over the stabilised passage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SifDifference {
    /// The largest, MPa √m, ≥ 0.
    pub largest: f64,
    /// Where: x_c/a.
    pub xc_over_a: f64,
    /// Root of the mean of its square over the positions, MPa √m.
    pub rms: f64,
}

/// Differences of both modes of a tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TipSifs {
    /// Number of positions compared.
    pub positions: usize,
    /// K_I.
    pub ki: SifDifference,
    /// K_II.
    pub kii: SifDifference,
}

/// `k` in per cent of `peak`; 0 where nothing is loaded.
pub(super) fn percent(k: f64, peak: f64) -> f64 {
    if peak > 0.0 { 100.0 * k / peak } else { 0.0 }
}
