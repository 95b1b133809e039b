//! One passage in the frame of the load.

use super::anderson::Anderson;
use super::eigenstress::{Columns, Eigenstress};
use super::streamline::FlowLaw;

/// The steady state of one passage: stress and plastic strain around the load, which do not change as it moves on.
#[derive(Debug, Clone)]
pub(super) struct SteadyPassage {
    /// Plastic strain, coordinates of a deviator.
    pub strain: Columns,
    /// Its residual stress σ_xx, σ_yy, σ_xy, MPa.
    pub stress: Columns,
    /// √(2/3) ∫ |dε_p| of each layer.
    pub path: Vec<f64>,
    /// Elastic redistributions that it took.
    pub iterations: usize,
    /// Largest change of the plastic strain in the last of them, times 2 G over the radius of the yield surface.
    pub change: f64,
}

/// How the strain that enters follows from the one that leaves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Upstream {
    /// It is given.
    Given,
    /// It is the one that leaves: the same passage for ever.
    Downstream,
}

/// What does not change from passage to passage.
pub(super) struct SteadyProblem {
    pub eigenstress: Eigenstress,
    pub law: FlowLaw,
    /// Deviators of the stress of wheel and initial state, MPa.
    pub background: Columns,
    /// 2 G over the radius of the yield surface.
    pub strain_scale: f64,
    pub tolerance: f64,
    pub max_iterations: usize,
}

/// Iterates that Anderson's extrapolation combines.
const DEPTH: usize = 6;

impl SteadyProblem {
    /// Iterates redistribution and flow from `start` until the plastic strain repeats or `max_iterations`.
    pub(super) fn solve(&mut self, start: Columns, entering: &[[f64; 3]], upstream: Upstream) -> SteadyPassage {
        let layers = entering.len();
        let columns = start[0].len() / layers;
        let size = columns * layers;
        let mut entering = entering.to_vec();
        let mut strain = start;
        let mut image = strain.clone();
        let mut stress: Columns = strain.clone();
        let mut anderson = Anderson::new(DEPTH);
        let mut iterations = 0;
        loop {
            iterations += 1;
            if upstream == Upstream::Downstream {
                entering = (0..layers).map(|j| [0, 1, 2].map(|c| strain[c][j])).collect();
            }
            self.eigenstress.stress(&strain, &entering, &mut stress);
            let path = self.law.follow(&stress, &self.background, &strain, &entering, &mut image);
            let mut change = 0.0_f64;
            for at in 0..size {
                let d = [0, 1, 2].map(|c| image[c][at] - strain[c][at]);
                change = change.max(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
            }
            let change = change.sqrt() * self.strain_scale;
            if change <= self.tolerance || iterations >= self.max_iterations {
                return SteadyPassage { strain: image, stress, path, iterations, change };
            }
            let next = anderson.next(&strain.concat(), &image.concat());
            for c in 0..3 {
                strain[c].copy_from_slice(&next[c * size..(c + 1) * size]);
            }
        }
    }
}
