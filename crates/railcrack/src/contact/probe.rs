//! Check of the equations of the faces by one weighted sum.

use crate::math::Matrix;

/// A weighted sum of all equations, which is cheap to form. Every equation has a different weight,
/// so that errors do not cancel.
pub(super) struct Probe {
    pub(super) weights: Vec<f64>,
    /// A times the weights, N/mm.
    pub(super) of_jumps: Vec<f64>,
    /// The largest sum of absolute terms so far, N/mm.
    pub(super) size: f64,
}

impl Probe {
    /// The probe of the equations with the matrix Aᵀ.
    pub(super) fn new(columns: &Matrix) -> Self {
        // Irregular weights of either sign, between 1/2 and 3/2 in magnitude.
        let golden = |i: usize| (i as f64 * 0.618_033_988_749_895).fract();
        let weight = |i: usize| (0.5 + golden(i)).copysign(golden(i + 7 * i * i) - 0.5);
        let weights: Vec<f64> = (0..columns.rows()).map(weight).collect();
        Self { of_jumps: columns.times(&weights), weights, size: 0.0 }
    }
}
