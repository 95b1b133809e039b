//! A tip in two runs: the differences of K, of its place and of its growth.

use railcrack::growth::RunStop;

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

/// A tip at a step in both runs.
#[derive(Debug, Clone, PartialEq)]
pub struct TipComparison {
    /// Growth step.
    pub step: usize,
    /// Crack, from 1.
    pub crack: usize,
    /// Tip, from 1 within its crack.
    pub tip: usize,
    /// Differences of K; none where the passages have no position in common.
    pub sifs: Option<TipSifs>,
    /// The largest |K_I| or |K_II| of both runs at this step, all tips, MPa √m.
    pub step_peak: f64,
    /// Place of the tip in each run, [x, y] in mm.
    pub places: [[f64; 2]; 2],
    /// Distance of these, mm.
    pub distance: f64,
    /// Length of the crack in each run, mm.
    pub lengths: [f64; 2],
    /// Load cycles up to the step in each run.
    pub load_cycles: [f64; 2],
    /// Chosen kink of each run, degrees.
    pub kink_deg: [Option<f64>; 2],
    /// Secondary maximum of the direction criterion in each run, degrees.
    pub rival_deg: [Option<f64>; 2],
    /// Growth rate at the secondary maximum over that at the chosen angle, of each run.
    pub rival_ratio: [Option<f64>; 2],
    /// Why the tip, or in the last step the run, stopped in each run.
    pub stops: [Option<RunStop>; 2],
}

impl TipComparison {
    /// `k` (MPa √m) in per cent of the largest |K| of the step.
    pub fn percent(&self, k: f64) -> f64 {
        percent(k, self.step_peak)
    }
}

/// `k` in per cent of `peak`; 0 where nothing is loaded.
pub(super) fn percent(k: f64, peak: f64) -> f64 {
    if peak > 0.0 { 100.0 * k / peak } else { 0.0 }
}
