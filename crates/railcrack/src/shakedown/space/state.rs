//! The stabilised state in space.

use super::super::fourier::Layers;
use super::super::rail::PlasticStrain;
use super::super::state::{
    Admissibility, Cycle, DepthRange, LayerState, Method, PassRecord, RailState, StabilisedRail,
};
use super::rail::RailInSpace;
use crate::math::{Stress, Tensor};
use std::ops::Range;

/// Residual stress and plastic strain of one layer at one lateral place.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SpaceLayer {
    /// Depth of its midplane, mm.
    pub depth: f64,
    /// Lateral place, mm.
    pub lateral: f64,
    /// Residual stress, including the initial one, MPa.
    pub stress: Tensor,
    /// Plastic strain.
    pub strain: Tensor,
    /// Accumulated plastic strain per passage of all wheels, √(2/3) ∫ |dε_p|, in the stabilised
    /// state.
    pub plastic_per_pass: f64,
    /// The largest deviator of the elastic passage over the radius of the yield surface: more than
    /// 1 where the rail yields in the first passage. 0 where no strain is computed.
    pub yield_utilisation: f64,
    /// The radius of the smallest ball around the elastic path over that of the yield surface: more
    /// than 1 where the rail cannot shake down elastically (Melan).
    pub shakedown_utilisation: f64,
    /// Whether plastic strain alternates there, in plastic shakedown.
    pub alternates: bool,
}

/// Stress around the load in the last passage of a wheel, in the order of travel.
#[derive(Debug, Clone, PartialEq)]
pub struct SpaceCycle {
    /// The number of its patch.
    pub patch: usize,
    /// Abscissae of the columns from the centre of the wheel, mm, upstream first.
    pub abscissae: Vec<f64>,
    /// The rows of the section that are computed; of a state that is its own mirror image, those on
    /// one side and the one in the middle.
    pub rows: Range<usize>,
    /// Stress due to the wheel, plastic strain and manufacturing, MPa: layer l of the n-th of these
    /// rows in column i at (i · rows + n) · layers + l.
    pub stress: Vec<Tensor>,
    /// Plastic strain, likewise.
    pub strain: Vec<Tensor>,
}

/// The rail after its passages, in space.
#[derive(Debug, Clone, PartialEq)]
pub struct StabilisedSpace {
    /// The asymptotic response.
    pub state: RailState,
    /// The passages in order.
    pub passes: Vec<PassRecord>,
    /// The layers of the rail.
    pub layers: Layers,
    /// Lateral places of the rows, increasing, mm.
    pub laterals: Vec<f64>,
    /// Layer l of row m at m · layers + l.
    pub section: Vec<SpaceLayer>,
    /// The last passage of each wheel, at least one, by the number of its patch.
    pub cycles: Vec<SpaceCycle>,
    /// Residuals of the yield condition, of periodicity and of equilibrium.
    pub admissibility: Admissibility,
}

impl StabilisedSpace {
    /// Number of elastic redistributions in all passages, a measure of the cost.
    #[must_use]
    pub fn iterations(&self) -> usize {
        self.passes.iter().map(|pass| pass.iterations).sum()
    }

    /// Columns along the rail, rows across it and layers.
    #[must_use]
    pub fn grid(&self) -> [usize; 3] {
        [self.cycles[0].abscissae.len(), self.laterals.len(), self.layers.count()]
    }

    /// The layers at the lateral place `y` (mm), linear between rows; beyond the outermost rows,
    /// those of these rows.
    #[must_use]
    pub fn layers_at(&self, y: f64) -> Vec<SpaceLayer> {
        let count = self.layers.count();
        let last = self.laterals.len() - 1;
        let next = self.laterals.partition_point(|lateral| *lateral < y).clamp(1, last.max(1)).min(last);
        let before = next.saturating_sub(1);
        let (from, to) = (self.laterals[before], self.laterals[next]);
        let t = if to > from { ((y - from) / (to - from)).clamp(0.0, 1.0) } else { 0.0 };
        let between = |l: usize| {
            let (a, b) = (&self.section[before * count + l], &self.section[next * count + l]);
            let mix = |one: f64, other: f64| (1.0 - t) * one + t * other;
            SpaceLayer {
                depth: a.depth,
                lateral: y,
                stress: a.stress * (1.0 - t) + b.stress * t,
                strain: a.strain * (1.0 - t) + b.strain * t,
                plastic_per_pass: mix(a.plastic_per_pass, b.plastic_per_pass),
                yield_utilisation: mix(a.yield_utilisation, b.yield_utilisation),
                shakedown_utilisation: mix(a.shakedown_utilisation, b.shakedown_utilisation),
                alternates: if t < 0.5 { a.alternates } else { b.alternates },
            }
        };
        (0..count).map(between).collect()
    }

    /// The profile at the lateral place `y` (mm) as one of plane strain: heights upwards, zz across
    /// the rail.
    #[must_use]
    pub fn profile(&self, y: f64) -> Vec<LayerState> {
        let in_plane = |layer: SpaceLayer| LayerState {
            depth: layer.depth,
            stress: stress_in_plane(layer.stress),
            strain: strain_in_plane(layer.strain),
            plastic_per_pass: layer.plastic_per_pass,
        };
        self.layers_at(y).into_iter().map(in_plane).collect()
    }

    /// The rows that are computed; of a state that is its own mirror image, those on one side and
    /// the one in the middle.
    #[must_use]
    pub fn computed_rows(&self) -> Range<usize> {
        self.cycles[0].rows.clone()
    }

    /// The computed row nearest to the lateral place `y` (mm), counted among those of the cycle; of
    /// a state that is its own mirror image, that of the image.
    #[must_use]
    pub fn computed_row(&self, y: f64) -> usize {
        let rows = self.computed_rows();
        let middle = self.laterals[self.laterals.len() / 2];
        let is_half = rows.start == self.laterals.len() / 2;
        let y = if is_half { middle + (y - middle).abs() } else { y };
        let away = |row: &usize| (self.laterals[*row] - y).abs();
        let nearest = rows.clone().min_by(|a, b| away(a).total_cmp(&away(b)));
        nearest.unwrap_or(rows.start) - rows.start
    }

    /// The state in the vertical plane along the rail at the lateral place `y` (mm), as one of
    /// plane strain: heights upwards, zz across the rail, without the shears of other planes. The
    /// cycle is that of the first patch, in the computed row next to it.
    #[must_use]
    pub fn in_plane(&self, y: f64) -> StabilisedRail {
        let (count, row) = (self.layers.count(), self.computed_row(y));
        let (cycle, streamlines) = (&self.cycles[0], self.computed_rows().len() * count);
        let of_row = |field: &[Tensor]| -> Vec<Tensor> {
            field
                .chunks_exact(streamlines)
                .flat_map(|column| &column[row * count..(row + 1) * count])
                .copied()
                .collect()
        };
        StabilisedRail {
            state: self.state,
            method: Method::PassByPass,
            passes: self.passes.clone(),
            layers: self.layers.clone(),
            profile: self.profile(y),
            alternating: self.alternating(),
            cycle: Cycle {
                abscissae: cycle.abscissae.clone(),
                stress: of_row(&cycle.stress).into_iter().map(stress_in_plane).collect(),
                strain: of_row(&cycle.strain).into_iter().map(strain_in_plane).collect(),
            },
            admissibility: self.admissibility,
        }
    }

    /// The layer with the largest |σ_xx| or |σ_yy|.
    #[must_use]
    pub fn peak(&self) -> Option<&SpaceLayer> {
        let size = |layer: &SpaceLayer| layer.stress.xx.abs().max(layer.stress.yy.abs());
        self.section.iter().reduce(|most, next| if size(next) > size(most) { next } else { most })
    }

    /// The depths between which plastic strain alternates somewhere across the rail.
    #[must_use]
    pub fn alternating(&self) -> Option<DepthRange> {
        let (count, interfaces) = (self.layers.count(), self.layers.interfaces());
        let depths = |l: usize| self.section.iter().skip(l).step_by(count).any(|layer| layer.alternates);
        let from = (0..count).find(|&l| depths(l))?;
        let to = (0..count).rfind(|&l| depths(l))?;
        Some(DepthRange { from: interfaces[from], to: interfaces[to + 1] })
    }

    /// The stress path of layer `l` of the `n`-th computed row over the stabilised `cycle` of a
    /// wheel, MPa: in the order of travel, then the unloaded state.
    #[must_use]
    pub fn stress_path(&self, cycle: &SpaceCycle, n: usize, l: usize) -> Vec<Tensor> {
        let count = self.layers.count();
        let streamlines = cycle.rows.len() * count;
        let path = cycle.stress.iter().skip(n * count + l).step_by(streamlines).copied();
        path.chain([self.section[(cycle.rows.start + n) * count + l].stress]).collect()
    }

    /// The stress path at the running surface in the `n`-th computed row, MPa: the stress of the
    /// patch of `cycle` on `rail` there, and the residual stress of the uppermost layer.
    #[must_use]
    pub fn surface_path(&self, rail: &RailInSpace, cycle: &SpaceCycle, n: usize) -> Vec<Tensor> {
        let mut path = self.stress_path(cycle, n, 0);
        let patch = &rail.patches[cycle.patch];
        let top = &self.section[(cycle.rows.start + n) * self.layers.count()];
        for (stress, &x) in path.iter_mut().zip(&cycle.abscissae) {
            let wheel = |depth: f64| patch.stress.stress(x, top.lateral, depth);
            *stress = *stress + wheel(0.0) - wheel(top.depth);
        }
        path
    }
}

fn stress_in_plane(s: Tensor) -> Stress {
    Stress { xx: s.xx, yy: s.zz, zz: s.yy, xy: -s.xz }
}

fn strain_in_plane(e: Tensor) -> PlasticStrain {
    PlasticStrain { xx: e.xx, yy: e.zz, zz: e.yy, xy: -e.xz }
}
