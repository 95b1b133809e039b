//! A of many cracks, by groups of neighbours.

use crate::math::{Matrix, axpy, dot};

/// A of a long row of cracks. The cracks are divided into groups of neighbours, in the order in
/// which they lie along the rail: A is stored between the points of a group and those of the next
/// one, and expanded between groups that are farther apart.
///
/// Component 2 i of a group is the slip of its point i, 2 i + 1 the opening.
#[derive(Debug, Clone)]
pub struct BlockStiffness {
    /// The face points of each group.
    pub groups: Vec<Vec<usize>>,
    /// Ends of the faces of each group along the rail, mm.
    pub extents: Vec<(f64, f64)>,
    /// A within each group, N/mm per mm.
    pub own: Vec<Matrix>,
    /// A between the components of each group but the last (rows) and those of the next one.
    pub next: Vec<Matrix>,
    /// A between all other groups.
    pub far: FarStiffness,
    /// How K of each tip follows from the jumps.
    pub tips: Vec<TipGain>,
    /// √C_jj of every component with its crack alone, mm per N/mm to the power 1/2.
    pub mobility: Vec<f64>,
    /// C of each crack alone, with its face points.
    pub alone: Vec<(Vec<usize>, Matrix)>,
}

/// K of a tip in terms of the jump at the face point next to it: K_I = gain × opening, K_II = gain
/// × slip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TipGain {
    /// The face point.
    pub point: usize,
    /// MPa √mm per mm.
    pub gain: f64,
}

/// A between groups that are not neighbours, A_kl ≈ U_k E_kl U_lᵀ.
#[derive(Debug, Clone)]
pub struct FarStiffness {
    /// U of each group: its components in terms of r amplitudes.
    pub moments: Vec<Matrix>,
    /// E_kl, `[k][l − k − 2]`, N/mm per mm.
    pub between: Vec<Vec<Matrix>>,
}

impl BlockStiffness {
    /// Number of components of group `k`.
    pub fn components(&self, k: usize) -> usize {
        2 * self.groups[k].len()
    }

    /// The values of group `k` among those of all `values` (2p).
    pub fn gather(&self, k: usize, values: &[f64]) -> Vec<f64> {
        self.groups[k].iter().flat_map(|&point| [values[2 * point], values[2 * point + 1]]).collect()
    }

    /// Puts the values of group `k` among those of all.
    pub fn scatter(&self, k: usize, values: &[f64], all: &mut [f64]) {
        for (&point, pair) in self.groups[k].iter().zip(values.chunks_exact(2)) {
            all[2 * point] = pair[0];
            all[2 * point + 1] = pair[1];
        }
    }

    /// A between the components of group `k` and those of `l`.
    pub fn block(&self, k: usize, l: usize) -> Matrix {
        match (k, l) {
            (k, l) if k == l => self.own[k].clone(),
            (k, l) if l == k + 1 => self.next[k].clone(),
            (k, l) if k > l => self.block(l, k).transposed(),
            _ => {
                let FarStiffness { moments, between } = &self.far;
                let e = &between[k][l - k - 2];
                let rows: Vec<Vec<f64>> = (0..moments[k].rows())
                    .map(|i| {
                        let mut row = vec![0.0; e.columns()];
                        moments[k].row(i).iter().enumerate().for_each(|(r, &m)| axpy(m, e.row(r), &mut row));
                        row
                    })
                    .collect();
                Matrix::from_fn(moments[k].rows(), moments[l].rows(), |i, j| dot(&rows[i], moments[l].row(j)))
            }
        }
    }

    /// The forces A w between neighbours in group `k`, of the jumps `w` by group.
    pub fn near_forces(&self, k: usize, w: &[Vec<f64>]) -> Vec<f64> {
        let mut forces = self.own[k].times(&w[k]);
        if k + 1 < w.len() {
            axpy(1.0, &self.next[k].times(&w[k + 1]), &mut forces);
        }
        if k > 0 {
            for (row, &jump) in w[k - 1].iter().enumerate() {
                axpy(jump, self.next[k - 1].row(row), &mut forces);
            }
        }
        forces
    }
}
