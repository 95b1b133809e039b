//! A of many cracks in blocks between units of cracks.

use super::{FaceMesh, FacePoint, FaceSample};
use crate::crack::CrackTip;
use crate::math::{Matrix, axpy};
use std::sync::Arc;

/// A of many cracks. Cracks that have joined each other are one unit, every other crack is a unit
/// of its own; units are ordered along the rail. Blocks of A between units that are near to each
/// other are stored, all others are expansions.
///
/// Component 2 i of a unit is the slip of its point i, 2 i + 1 the opening.
#[derive(Debug, Clone)]
pub struct BlockStiffness {
    /// The face points of each unit.
    pub units: Vec<Vec<usize>>,
    /// Ends of the faces of each unit along the rail, mm.
    pub extents: Vec<(f64, f64)>,
    /// For each unit k the units l that are near to it, itself included, with A_kl, N/mm per mm.
    pub near: Vec<Vec<(usize, Matrix)>>,
    /// A between all other units.
    pub far: FarStiffness,
    /// K of each tip in terms of the jumps.
    pub tips: Vec<TipGain>,
}

/// K of a tip in terms of the jumps at face points.
#[derive(Debug, Clone, PartialEq)]
pub struct TipGain {
    /// Face points with K_I and K_II per slip and per opening there, MPa √mm per mm.
    pub points: Vec<(usize, [[f64; 2]; 2])>,
}

impl TipGain {
    fn scaled(mut self, factor: f64) -> Self {
        self.points
            .iter_mut()
            .flat_map(|(_, gains)| gains.iter_mut().flatten())
            .for_each(|gain| *gain *= factor);
        self
    }

    /// K_I = `gain` × opening and K_II = `gain` × slip at the face point `point` next to the tip.
    pub(crate) fn at(point: usize, gain: f64) -> Self {
        Self { points: vec![(point, [[0.0, gain], [gain, 0.0]])] }
    }

    /// S of tips with these `gains` for faces of C = `compliance`, mm^(−1/2).
    pub(crate) fn sif_influence(gains: &[Self], compliance: &Matrix) -> Matrix {
        let mut influence = Matrix::zeros(2 * gains.len(), compliance.columns());
        for (tip, Self { points }) in gains.iter().enumerate() {
            for (point, gains) in points {
                for (mode, gains) in gains.iter().enumerate() {
                    for (component, &gain) in gains.iter().enumerate() {
                        if gain != 0.0 {
                            axpy(
                                gain,
                                compliance.row(2 * point + component),
                                influence.row_mut(2 * tip + mode),
                            );
                        }
                    }
                }
            }
        }
        influence
    }
}

/// A between units that are not near to each other, A_kl ≈ U_k E_kl U_lᵀ.
#[derive(Debug, Clone)]
pub struct FarStiffness {
    /// U of each unit: its components in terms of r amplitudes.
    pub moments: Vec<Matrix>,
    /// For each unit k the units l that are not near to it, with E_kl, N/mm per mm.
    pub between: Vec<Vec<(usize, Matrix)>>,
    /// The largest error of A between units that are nearest to each other, over its norm.
    pub error: f64,
}

/// Some units of a row as a separate body.
#[derive(Debug, Clone)]
pub(crate) struct RowPart {
    /// The faces: points, and cracks counted from 0 among those of the part.
    pub faces: FaceMesh,
    /// The tips, their cracks counted likewise.
    pub tips: Vec<CrackTip>,
    /// K of these tips in terms of the jumps in the part.
    pub gains: Vec<TipGain>,
    /// A, N/mm per mm.
    pub stiffness: Matrix,
    /// Index in the whole row of each face point of the part.
    pub points: Vec<usize>,
    /// See `points`.
    pub cracks: Vec<usize>,
    /// See `points`.
    pub tip_numbers: Vec<usize>,
}

impl BlockStiffness {
    /// The same with K of each tip times a factor.
    pub(super) fn with_sif_factors(mut self, factors: &[f64]) -> Self {
        let tips = self.tips.into_iter().zip(factors);
        self.tips = tips.map(|(tip, factor)| tip.scaled(*factor)).collect();
        self
    }

    /// Number of components of unit `k`.
    pub(crate) fn components(&self, k: usize) -> usize {
        2 * self.units[k].len()
    }

    /// The block of A between units `k` and `l`, if they are near to each other.
    pub(crate) fn near_block(&self, k: usize, l: usize) -> Option<&Matrix> {
        self.near[k].iter().find(|(other, _)| *other == l).map(|(_, block)| block)
    }

    /// A of the units `members` without expanded blocks.
    fn between_near(&self, members: &[usize]) -> Matrix {
        let order = members.iter().map(|&k| self.components(k)).sum();
        let mut stiffness = Matrix::zeros(order, order);
        let mut row = 0;
        for &k in members {
            let mut column = 0;
            for &l in members {
                if let Some(block) = self.near_block(k, l) {
                    for i in 0..block.rows() {
                        stiffness.row_mut(row + i)[column..column + block.columns()]
                            .copy_from_slice(block.row(i));
                    }
                }
                column += self.components(l);
            }
            row += self.components(k);
        }
        stiffness
    }

    /// The units `members` of the row with these `faces` and `tips`, all near to each other;
    /// expanded blocks are left out.
    pub(crate) fn part(&self, faces: &FaceMesh, tips: &[CrackTip], members: &[usize]) -> RowPart {
        let points: Vec<usize> = members.iter().flat_map(|&k| self.units[k].iter().copied()).collect();
        let mut place = vec![None; faces.points.len()];
        points.iter().enumerate().for_each(|(own, &all)| place[all] = Some(own));
        let mut cracks: Vec<usize> = points.iter().map(|&p| faces.points[p].crack).collect();
        cracks.sort_unstable();
        cracks.dedup();
        let own_crack = |crack: usize| cracks.binary_search(&crack).ok();
        let own_point = |&p: &usize| {
            let point = faces.points[p];
            FacePoint { crack: own_crack(point.crack).unwrap_or(0), ..point }
        };
        let own_sample = |sample: &FaceSample| {
            let mut shares = [(0, 0.0); 2];
            let mut any = false;
            for (share, &(point, length)) in shares.iter_mut().zip(&sample.shares) {
                if length != 0.0 {
                    *share = (place[point]?, length);
                    any = true;
                }
            }
            any.then_some(FaceSample { shares, ..*sample })
        };
        let mesh = FaceMesh {
            points: points.iter().map(own_point).collect(),
            samples: faces.samples.iter().filter_map(own_sample).collect(),
            graded: Vec::new(),
            lines: Arc::clone(&faces.lines),
        };
        let own_tips = tips.iter().zip(&self.tips).enumerate().filter_map(|(number, (tip, gain))| {
            let tip = CrackTip { crack: own_crack(tip.crack)?, ..*tip };
            let points = gain.points.iter().filter_map(|&(point, gains)| Some((place[point]?, gains)));
            Some((number, tip, TipGain { points: points.collect() }))
        });
        let mut part = RowPart {
            faces: mesh,
            tips: Vec::new(),
            gains: Vec::new(),
            stiffness: self.between_near(members),
            points,
            cracks: cracks.clone(),
            tip_numbers: Vec::new(),
        };
        for (number, tip, gain) in own_tips {
            part.tip_numbers.push(number);
            part.tips.push(tip);
            part.gains.push(gain);
        }
        part
    }
}
