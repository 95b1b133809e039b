//! The waves of a section that does not vary along the rail, or linearly.

use super::super::fourier::Fourier;
use super::super::layer_factors::LayerFactors;
use super::grid::{Across, SpaceGrid};
use std::f64::consts::TAU;

/// The waves of what does not vary along the rail, or linearly.
pub(super) struct Section {
    /// Number of rows in their period.
    pub rows: usize,
    /// The row of the first row of the grid.
    pub first: usize,
    /// The response of wave j from 1 in layer l at (j − 1) · layers + l.
    factors: Vec<LayerFactors>,
    pub fourier: Fourier,
}

/// Period of the section over that of the waves across the rail.
const WIDER: usize = 4;
impl Section {
    pub fn new(grid: &SpaceGrid, factors_of: &impl Fn(f64) -> Vec<LayerFactors>) -> Self {
        let rows = match grid.across {
            Across::Confined => WIDER * grid.rows,
            Across::Periodic => grid.rows,
        };
        let unit = TAU / (rows as f64 * grid.row_spacing);
        let factors = (1..=rows / 2).flat_map(|j| factors_of(unit * j as f64)).collect();
        Self { rows, first: (rows - grid.rows) / 2, factors, fourier: Fourier::new(rows) }
    }

    /// The factors of wave `j` ≥ 1.
    pub fn factors(&self, j: usize) -> &[LayerFactors] {
        let layers = 2 * self.factors.len() / self.rows;
        &self.factors[(j - 1) * layers..j * layers]
    }
}

/// The stress of the parts that do not vary along the rail, or slowly.
pub(super) struct Slow {
    /// By active row and layer, MPa.
    pub constant: Vec<[f64; 6]>,
    /// Its fall over a period.
    pub fall: Vec<[f64; 6]>,
}
