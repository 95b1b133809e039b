//! Steady passages in the frame of the load.

use super::eigenstress::{Columns, Eigenstress};
use super::streamline::FlowLaw;
use crate::interruption::{Interrupted, Interruption};
use crate::math::Anderson;
use std::ops::Range;

/// Steady state of one passage: stress and plastic strain around the load, which are constant in
/// its frame.
#[derive(Debug, Clone)]
pub(super) struct SteadyPassage {
    /// Plastic strain in coordinates of a deviator.
    pub strain: Columns,
    /// The entering plastic strain by layer.
    pub entering: Vec<[f64; 3]>,
    /// √(2/3) ∫ |dε_p| of each layer.
    pub path: Vec<f64>,
    /// Number of elastic redistributions.
    pub iterations: usize,
    /// Largest change of the plastic strain in the last of them, times 2 G over the radius of the
    /// yield surface.
    pub change: f64,
}

/// The plastic strain that enters the passage.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Upstream {
    /// A given strain.
    Given,
    /// The strain that leaves, for a periodic passage.
    Downstream,
}

/// The data that are common to all passages.
pub(super) struct SteadyProblem {
    pub eigenstress: Eigenstress,
    pub law: FlowLaw,
    /// Stress deviators of wheel and initial residual stress, MPa.
    pub background: Columns,
    /// Columns around the contact in which the extrapolation acts; the values outside follow from
    /// these.
    pub active: Range<usize>,
    /// 2 G over the radius of the yield surface.
    pub strain_scale: f64,
    /// Change at or below which the iteration ends.
    pub tolerance: f64,
    /// Largest number of redistributions.
    pub max_iterations: usize,
}

/// Number of iterates that Anderson's extrapolation combines; with 4 to 10 the number of
/// redistributions is about the same.
const DEPTH: usize = 6;

impl SteadyProblem {
    /// Alternates redistribution and return mapping from `start` until the plastic strain repeats,
    /// or until `max_iterations`; `entering` is the plastic strain upstream, by layer.
    ///
    /// Errors: an interruption.
    pub(super) fn solve(
        &mut self,
        start: Columns,
        entering: &[[f64; 3]],
        upstream: Upstream,
        interruption: Interruption<'_>,
    ) -> Result<SteadyPassage, Interrupted> {
        let layers = entering.len();
        let mut entering = entering.to_vec();
        let mut strain = start;
        if upstream == Upstream::Given {
            for c in 0..3 {
                for at in self.active.end * layers..strain[c].len() {
                    strain[c][at] = entering[at % layers][c];
                }
            }
        }
        let mut image = strain.clone();
        let mut stress = strain.clone();
        let mut anderson = Anderson::new(DEPTH);
        let mut iterations = 0;
        loop {
            interruption.check()?;
            iterations += 1;
            if upstream == Upstream::Downstream {
                entering = first_column(&strain, layers);
            }
            self.eigenstress.stress(&strain, &entering, &mut stress);
            let path = self.law.follow(&stress, &self.background, &strain, &entering, &mut image);
            let change = largest_difference(&image, &strain) * self.strain_scale;
            if change <= self.tolerance || iterations >= self.max_iterations || !change.is_finite() {
                return Ok(SteadyPassage { strain: image, entering, path, iterations, change });
            }
            let active = self.active.start * layers..self.active.end * layers;
            let part = |field: &Columns| -> Vec<f64> {
                field.iter().flat_map(|component| &component[active.clone()]).copied().collect()
            };
            let mut next = part(&strain);
            let residual: Vec<f64> = part(&image).iter().zip(&next).map(|(g, x)| g - x).collect();
            anderson.advance(&mut next, &residual);
            for (c, values) in next.chunks_exact(active.len()).enumerate() {
                strain[c][active.clone()].copy_from_slice(values);
                strain[c][active.end..].copy_from_slice(&image[c][active.end..]);
                // Downstream of the active columns the extrapolated strain continues like its image
                // under the iteration.
                for at in (0..active.start).rev() {
                    strain[c][at] = strain[c][at + layers] + (image[c][at] - image[c][at + layers]);
                }
            }
        }
    }
}

/// The strain of the first column, by layer.
pub(super) fn first_column(strain: &Columns, layers: usize) -> Vec<[f64; 3]> {
    (0..layers).map(|j| [0, 1, 2].map(|c| strain[c][j])).collect()
}

/// Largest Frobenius norm of a − b; NaN if either contains one.
fn largest_difference(a: &Columns, b: &Columns) -> f64 {
    let mut largest = 0.0_f64;
    for at in 0..a[0].len() {
        let d = [0, 1, 2].map(|c| a[c][at] - b[c][at]);
        let square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        // `max` would ignore NaN.
        if square.is_nan() {
            return f64::NAN;
        }
        largest = largest.max(square);
    }
    largest.sqrt()
}
