//! Residual stress of a plastic strain in the half-space, by elastic redistribution exact in every
//! layer.

use super::super::complex::Complex;
use super::super::eigenstress::LONG_WAVES;
use super::super::fourier::{Fourier, Signals};
use super::super::layer_factors::LayerFactors;
use super::super::streamline::{Driven, Elasticity, Field, SteadyPassage};
use super::grid::{Image, SpaceGrid};
use super::rail::Symmetry;

use super::section_waves::{Section, Slow};
use super::wave_pair::{Direction, Entries, WavePair};
use crate::material::IsotropicElastic;
use crate::math::Tensor;
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Linear elasticity of the half-space z ≥ 0 with a free surface under plastic strains that are
/// constant across each layer, by waves along and across the rail ([`WavePair`]).
///
/// The rail is infinitely long and wide. Along it, let the strain be U(y, z) far upstream and U + D
/// far downstream. A ramp that rises by D over one period makes the remainder periodic. Ramp and U
/// do not depend on x, or linearly: their stress R(0) U, and R(0) D x/L − i R′(0) D/L, is that of
/// the section in generalised plane strain, with R(k_x) the response to a wave (k_x, k_y). R is
/// smooth at k_x = 0, and the sum over waves is the integral to e^(−k_y L), but for k_y = 0, where
/// it has the kink of the plane ([`super::super::eigenstress::Eigenstress`]).
///
/// Across the rail the strain is confined and the waves have a period W. What varies along the rail
/// with the period L and without a mean decays within L/2π beside the strain: its images at ±W are
/// not felt. What does not vary along the rail, or linearly, is felt much farther: the waves of the
/// section have a period of several W ([`WIDER`]), and the kink of their response at k_y = 0 is
/// again represented by its value at Δk/6.
pub(super) struct SpaceEigenstress {
    pub(super) steel: IsotropicElastic,
    pub(super) grid: SpaceGrid,
    /// The transforms along x and across.
    fourier: [Fourier; 2],
    /// Layers in groups: lane l of row m and column i at (i · rows + m) · lanes + l; the lanes of a
    /// layer are xx + i yy, zz + i xz, yz + i xy.
    groups: Vec<Signals>,
    /// The response of wave (i, j) in layer l at (i · (rows/2 + 1) + j) · layers + l; those of i =
    /// 0 are not used.
    factors: Vec<LayerFactors>,
    pub(super) section: Section,
    /// The responses to waves along and across that represent those longer than the period.
    pub(super) long: [[Vec<LayerFactors>; 2]; 2],
    /// Stresses of the waves of each column i from 1: layer l of row j at j · layers + l.
    waves: Vec<Vec<Entries>>,
    /// The stress of the last redistribution, MPa: xx, yy, zz, yz, xz, xy.
    pub stress: Field<6>,
}

/// Layers in a group, whose signals fit into the cache.
const GROUP: usize = 2;
/// Lanes of a layer.
pub(super) const LANES: usize = 3;
/// Entries of the lanes of a layer.
pub(super) const PAIRS: [(usize, usize); LANES] = [(0, 1), (2, 4), (3, 5)];
/// Entries that change sign in the mirror image in a plane y = constant: those of the last lane.
const ODD: usize = 2;

impl SpaceEigenstress {
    pub(super) fn new(steel: &IsotropicElastic, grid: SpaceGrid) -> Self {
        let layers = grid.layers.count();
        let factors_of = |wave_number: f64| -> Vec<LayerFactors> {
            let of = |j| LayerFactors::new(wave_number, grid.layers.top(j), grid.layers.thickness(j));
            (0..layers).map(of).collect()
        };
        let [along, across] = [TAU / grid.length(), TAU / grid.width()];
        let halves = [grid.columns / 2 + 1, grid.rows / 2 + 1];
        let of_wave = |at: usize| {
            let (i, j) = (at / halves[1], at % halves[1]);
            // The wave of infinite length is not used.
            factors_of((along * i as f64).hypot(across * j as f64).max(across * 1e-3))
        };
        let factors = (0..halves[0] * halves[1]).into_par_iter().map(of_wave).collect::<Vec<_>>().concat();
        let section = Section::new(&grid, &factors_of);
        let section_unit = across * grid.rows as f64 / section.rows as f64;
        let long = [along, section_unit].map(|unit| LONG_WAVES.map(|long| factors_of(unit * long)));
        let samples = grid.columns * grid.rows * LANES;
        let in_group = |first: usize| GROUP.min(layers - first);
        let groups =
            (0..layers).step_by(GROUP).map(|first| Signals::zeros(samples * in_group(first))).collect();
        let kept = match grid.symmetry {
            Symmetry::Mirrored => halves[1],
            Symmetry::None => grid.rows,
        };
        let waves = (1..halves[0]).map(|_| vec![[Complex::ZERO; 6]; kept * layers]).collect();
        let size = grid.columns * grid.streamlines();
        Self {
            steel: *steel,
            fourier: [Fourier::new(grid.columns), Fourier::new(grid.rows)],
            groups,
            factors,
            section,
            long,
            waves,
            stress: std::array::from_fn(|_| vec![0.0; size]),
            grid,
        }
    }

    /// Redistributes the strain of `passage`.
    pub(super) fn redistribute_for(&mut self, passage: &SteadyPassage<5>) {
        self.redistribute(&passage.strain, &passage.entering);
    }

    /// The largest out-of-balance force per mm² on a layer or on the surface between neighbouring
    /// columns, MPa: a sum over waves, which cannot cancel each other.
    pub(super) fn imbalance(&mut self, passage: &SteadyPassage<5>) -> f64 {
        let streamlines = self.grid.streamlines();
        let of = |j: usize| std::array::from_fn(|c| passage.strain[c][j] - passage.entering[j][c]);
        let gain: Vec<[f64; 5]> = (0..streamlines).map(of).collect();
        self.load(&passage.strain, &passage.entering, &gain);
        let layers = self.grid.layers.count();
        let this = &*self;
        let of_column = |i: usize| {
            let mut pair = WavePair::new(&this.steel, layers);
            let mut stresses = vec![[Complex::ZERO; 6]; layers];
            let of_wave = |j: usize| {
                let strains: Vec<Entries> = (0..layers).map(|l| this.wave_of_layer(i, j, l)).collect();
                let factors = this.factors(i, j.min(this.grid.rows - j));
                pair.stresses(factors, this.direction(i, j), &strains, &mut stresses);
                pair.imbalance(factors)
            };
            (0..this.grid.rows).map(of_wave).sum::<f64>()
        };
        let by_column: Vec<f64> = (1..=self.grid.columns / 2).into_par_iter().map(of_column).collect();
        2.0 / (self.grid.columns * self.grid.rows) as f64 * by_column.iter().sum::<f64>()
    }

    /// The factors of wave (i, j), i and j up to half of the columns and rows.
    fn factors(&self, i: usize, j: usize) -> &[LayerFactors] {
        let layers = self.grid.layers.count();
        let at = (i * (self.grid.rows / 2 + 1) + j) * layers;
        &self.factors[at..at + layers]
    }

    /// The direction of wave (i, j), j the index of any row.
    fn direction(&self, i: usize, j: usize) -> Direction {
        let rows = self.grid.rows;
        let signed = if 2 * j > rows { j as f64 - rows as f64 } else { j as f64 };
        let (x, y) = (i as f64 / self.grid.length(), signed / self.grid.width());
        let size = x.hypot(y);
        Direction { x: x / size, y: y / size }
    }

    /// The periodic strain as signals, transformed.
    fn load(&mut self, strain: &Field<5>, upstream: &[[f64; 5]], gain: &[[f64; 5]]) {
        let Self { grid, groups, fourier, .. } = self;
        let layers = grid.layers.count();
        let streamlines = grid.streamlines();
        groups.par_iter_mut().enumerate().for_each(|(group, signals)| {
            let lanes = signals.re.len() / (grid.columns * grid.rows);
            signals.re.fill(0.0);
            signals.im.fill(0.0);
            for i in 0..grid.columns {
                let ramp = i as f64 / grid.columns as f64;
                for (row, m) in grid.active.clone().enumerate() {
                    for l in 0..lanes / LANES {
                        let j = row * layers + group * GROUP + l;
                        let at = i * streamlines + j;
                        let own = |c: usize| strain[c][at] - upstream[j][c] + ramp * gain[j][c];
                        let entries = Tensor::from_deviator(std::array::from_fn(own)).entries();
                        for (m, image) in grid.images(m) {
                            let to = (i * grid.rows + m) * lanes + l * LANES;
                            put(signals, to, image, &entries);
                        }
                    }
                }
            }
            fourier[1].forward_blocks(signals, grid.rows * lanes);
            fourier[0].forward(signals);
        });
    }

    /// Stresses of all waves with k_x > 0.
    fn balance(&mut self) {
        let mut waves = std::mem::take(&mut self.waves);
        let this = &*self;
        let layers = this.grid.layers.count();
        waves.par_iter_mut().enumerate().for_each_init(
            || (WavePair::new(&this.steel, layers), vec![[Complex::ZERO; 6]; layers]),
            |(pair, strains), (before, stresses)| {
                let i = before + 1;
                for (j, stresses) in stresses.chunks_exact_mut(layers).enumerate() {
                    // The shortest waves along the rail come in pairs.
                    let is_shortest = 2 * i == this.grid.columns;
                    if is_shortest && 2 * j > this.grid.rows {
                        continue;
                    }
                    for (l, strain) in strains.iter_mut().enumerate() {
                        *strain = this.wave_of_layer(i, j, l);
                    }
                    this.stresses_of_wave(pair, [i, j], strains, stresses);
                }
            },
        );
        self.waves = waves;
    }

    /// The strain of wave (i, j) in layer `l`.
    fn wave_of_layer(&self, i: usize, j: usize, l: usize) -> Entries {
        let SpaceGrid { columns, rows, .. } = self.grid;
        let signals = &self.groups[l / GROUP];
        let lanes = signals.re.len() / (columns * rows);
        let plus = (i * rows + j) * lanes + l % GROUP * LANES;
        let minus = ((columns - i) % columns * rows + (rows - j) % rows) * lanes + l % GROUP * LANES;
        let mut entries = [Complex::ZERO; 6];
        for (lane, (re, im)) in PAIRS.into_iter().enumerate() {
            (entries[re], entries[im]) = signals.separated(plus + lane, minus + lane);
        }
        entries
    }

    /// Stresses of wave (i, j), times the number of samples. The shortest waves, which are their
    /// own images along or across the rail, have the mean response of both.
    fn stresses_of_wave(
        &self,
        pair: &mut WavePair,
        [i, j]: [usize; 2],
        strains: &[Entries],
        stresses: &mut [Entries],
    ) {
        let SpaceGrid { columns, rows, .. } = self.grid;
        let factors = self.factors(i, j.min(rows - j));
        let Direction { x, y } = self.direction(i, j);
        let mut directions = vec![Direction { x, y }];
        if 2 * j == rows {
            directions.push(Direction { x, y: -y });
        }
        if 2 * i == columns && j > 0 {
            for k in 0..directions.len() {
                let Direction { x, y } = directions[k];
                directions.push(Direction { x: -x, y });
            }
        } else if 2 * i == columns {
            directions.push(Direction { x: -x, y: -y });
        }
        if let [one] = directions[..] {
            return pair.stresses(factors, one, strains, stresses);
        }
        let share = 1.0 / directions.len() as f64;
        let mut own = stresses.to_vec();
        stresses.fill([Complex::ZERO; 6]);
        for direction in directions {
            pair.stresses(factors, direction, strains, &mut own);
            for (sum, own) in stresses.iter_mut().zip(&own) {
                for c in 0..6 {
                    sum[c] = sum[c] + own[c] * share;
                }
            }
        }
    }

    /// The signals of all stresses, transformed back.
    fn unload(&mut self) {
        let Self { grid, groups, fourier, waves, .. } = self;
        let (layers, rows) = (grid.layers.count(), grid.rows);
        let scale = 1.0 / (grid.columns * rows) as f64;
        groups.par_iter_mut().enumerate().for_each(|(group, signals)| {
            let lanes = signals.re.len() / (grid.columns * rows);
            signals.re[..rows * lanes].fill(0.0);
            signals.im[..rows * lanes].fill(0.0);
            for (before, stresses) in waves.iter().enumerate() {
                let i = before + 1;
                let is_shortest = 2 * i == grid.columns;
                for (j, stresses) in stresses.chunks_exact(layers).enumerate() {
                    if is_shortest && 2 * j > rows {
                        continue;
                    }
                    let mirrored = (grid.symmetry == Symmetry::Mirrored).then(|| (rows - j) % rows);
                    let mirrored = mirrored.filter(|&other| other != j && !is_shortest);
                    for l in 0..lanes / LANES {
                        let stress = &stresses[group * GROUP + l];
                        for (lane, (re, im)) in PAIRS.into_iter().enumerate() {
                            let (re, im) = (stress[re] * scale, stress[im] * scale);
                            let place = |i: usize, j: usize| (i * rows + j) * lanes + l * LANES + lane;
                            let opposite = (grid.columns - i) % grid.columns;
                            signals.combine(place(i, j), place(opposite, (rows - j) % rows), re, im);
                            if let Some(other) = mirrored {
                                let (re, im) = if lane == ODD { (-re, -im) } else { (re, im) };
                                signals.combine(place(i, other), place(opposite, j), re, im);
                            }
                        }
                    }
                }
            }
            fourier[0].backward(signals);
            fourier[1].backward_blocks(signals, rows * lanes);
        });
    }

    /// The stress in the columns of the active rows.
    fn write(&mut self, slow: &Slow) {
        let Self { grid, groups, stress, .. } = self;
        let (layers, streamlines) = (grid.layers.count(), grid.streamlines());
        for i in 0..grid.columns {
            let ramp = i as f64 / grid.columns as f64;
            for (row, m) in grid.active.clone().enumerate() {
                for l in 0..layers {
                    let signals = &groups[l / GROUP];
                    let lanes = signals.re.len() / (grid.columns * grid.rows);
                    let from = (i * grid.rows + m) * lanes + l % GROUP * LANES;
                    let j = row * layers + l;
                    let (constant, fall) = (&slow.constant[j], &slow.fall[j]);
                    let rest = |c: usize| constant[c] - ramp * fall[c];
                    for (lane, (re, im)) in PAIRS.into_iter().enumerate() {
                        stress[re][i * streamlines + j] = signals.re[from + lane] + rest(re);
                        stress[im][i * streamlines + j] = signals.im[from + lane] + rest(im);
                    }
                }
            }
        }
    }
}

/// Writes the lanes of a layer from `to` on.
#[inline(always)]
pub(super) fn put(signals: &mut Signals, to: usize, image: Image, entries: &[f64; 6]) {
    for (lane, (re, im)) in PAIRS.into_iter().enumerate() {
        let sign = if image == Image::Mirrored && lane == ODD { -1.0 } else { 1.0 };
        (signals.re[to + lane], signals.im[to + lane]) = (sign * entries[re], sign * entries[im]);
    }
}

impl Elasticity<5> for SpaceEigenstress {
    fn redistribute(&mut self, strain: &Field<5>, upstream: &[[f64; 5]]) {
        let streamlines = self.grid.streamlines();
        let of = |j: usize| std::array::from_fn(|c| strain[c][j] - upstream[j][c]);
        let gain: Vec<[f64; 5]> = (0..streamlines).map(of).collect();
        let columns = self.grid.columns as f64;
        // The mean of the ramp is that of i/N.
        let ramp = 0.5 * (1.0 - 1.0 / columns);
        let mut mean: Vec<[f64; 5]> =
            (0..streamlines).map(|j| std::array::from_fn(|c| ramp * gain[j][c] - upstream[j][c])).collect();
        for (c, component) in strain.iter().enumerate() {
            for column in component.chunks_exact(streamlines) {
                for (mean, own) in mean.iter_mut().zip(column) {
                    mean[c] += own / columns;
                }
            }
        }
        let slow = self.slow(&mean, upstream, &gain);
        self.load(strain, upstream, &gain);
        self.balance();
        self.unload();
        self.write(&slow);
    }

    fn drive(&self, column: Driven<'_, 5>) {
        Arch::new().dispatch(Drive { stress: &self.stress, column });
    }
}

/// B and |ξ|² of all streamlines of a column.
struct Drive<'a> {
    stress: &'a Field<6>,
    column: Driven<'a, 5>,
}

impl WithSimd for Drive<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        const ROOT_2: f64 = std::f64::consts::SQRT_2;
        let root_6 = 6.0_f64.sqrt();
        let Driven { at, law, background, old, strain, driver, size } = self.column;
        let (stiffness, modulus) = (law.stiffness, law.modulus);
        let n = size.len();
        let [xx, yy, zz, yz, xz, xy] = std::array::from_fn(|c| &self.stress[c][at.clone()][..n]);
        let [b0, b1, b2, b3, b4] = std::array::from_fn(|c| &background[c][at.clone()][..n]);
        let [o0, o1, o2, o3, o4] = std::array::from_fn(|c| &old[c][at.clone()][..n]);
        let [d0, d1, d2, d3, d4] = driver.each_mut().map(|own| &mut own[..n]);
        for j in 0..n {
            d0[j] = (xx[j] - zz[j]) / ROOT_2 + b0[j] + stiffness * o0[j];
            d1[j] = (2.0 * yy[j] - xx[j] - zz[j]) / root_6 + b1[j] + stiffness * o1[j];
            d2[j] = ROOT_2 * xz[j] + b2[j] + stiffness * o2[j];
            d3[j] = ROOT_2 * xy[j] + b3[j] + stiffness * o3[j];
            d4[j] = ROOT_2 * yz[j] + b4[j] + stiffness * o4[j];
        }
        size.fill(0.0);
        for (own, arriving) in driver.iter().zip(strain) {
            for ((size, own), arriving) in size.iter_mut().zip(&own[..n]).zip(&arriving[..n]) {
                let xi = own - modulus * arriving;
                *size += xi * xi;
            }
        }
    }
}

#[cfg(test)]
#[path = "eigenstress_tests.rs"]
mod tests;
