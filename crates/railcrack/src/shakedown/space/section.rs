//! Stresses of the section in generalised plane strain, under strain that does not vary along the
//! rail, or linearly.

use super::super::complex::Complex;
use super::super::eigenstress::{LONG_WAVES, NEAR};
use super::super::fourier::Signals;
use super::eigenstress::{LANES, PAIRS, SpaceEigenstress, put};
use super::grid::Across;
use super::section_waves::{Section, Slow};
use super::wave_pair::{Direction, Entries, WavePair, filled_layer};
use crate::math::Tensor;
use std::f64::consts::TAU;

/// Cosine by which the response of the section is differentiated with respect to k_x.
const TILT: f64 = 1e-4;

/// The direction of the longest waves.
#[derive(Clone, Copy)]
enum Longest {
    Along,
    Across,
}

impl SpaceEigenstress {
    /// Stresses of wave `j` ≥ 1 of the section, times the number of its rows.
    fn stresses_of_section(
        &self,
        pair: &mut WavePair,
        j: usize,
        strains: &[Entries],
        stresses: &mut [Entries],
    ) {
        let factors = self.section.factors(j);
        pair.stresses(factors, Direction { x: 0.0, y: 1.0 }, strains, stresses);
        if 2 * j == self.section.rows {
            let mut own = stresses.to_vec();
            pair.stresses(factors, Direction { x: 0.0, y: -1.0 }, strains, &mut own);
            for (stress, own) in stresses.iter_mut().zip(&own) {
                *stress = std::array::from_fn(|c| (stress[c] + own[c]) * 0.5);
            }
        }
    }

    /// Stresses of the entering strain `upstream`, of the ramp and of the mean over a period.
    pub(super) fn slow(&self, mean: &[[f64; 5]], upstream: &[[f64; 5]], gain: &[[f64; 5]]) -> Slow {
        let total: Vec<[f64; 5]> =
            mean.iter().zip(upstream).map(|(m, u)| std::array::from_fn(|c| m[c] + u[c])).collect();
        let [total, gain, upstream] = [&total, gain, upstream].map(|field| self.section_waves(field));
        let layers = self.grid.layers.count();
        let mut pair = WavePair::new(&self.steel, layers);
        let halves = self.section.rows / 2 + 1;
        let zeros = || vec![[Complex::ZERO; 6]; layers];
        let (mut constant, mut fall) = (vec![zeros(); halves], vec![zeros(); halves]);
        for j in 1..halves {
            self.stresses_of_section(&mut pair, j, &total[j], &mut constant[j]);
            self.stresses_of_section(&mut pair, j, &gain[j], &mut fall[j]);
            let slope = self.slope(&mut pair, j, &gain[j]);
            for (constant, slope) in constant[j].iter_mut().zip(slope) {
                for c in 0..6 {
                    constant[c] = constant[c] + slope[c];
                }
            }
        }
        let real = |wave: &[Entries]| -> Vec<[f64; 6]> { wave.iter().map(|own| own.map(|z| z.re)).collect() };
        let (total, gain, upstream) = (real(&total[0]), real(&gain[0]), real(&upstream[0]));
        let filled = |strain: &[f64; 6]| filled_layer(&self.steel, *strain);
        let less_step: Vec<[f64; 6]> = total
            .iter()
            .zip(&upstream)
            .zip(&gain)
            .map(|((t, u), g)| std::array::from_fn(|c| t[c] - u[c] - g[c]))
            .collect();
        let (kink, odd) =
            (self.long(&mut pair, Longest::Along, &less_step), self.long(&mut pair, Longest::Along, &gain));
        let none = || vec![[0.0; 6]; layers];
        let [total_across, gain_across] = match self.grid.across {
            Across::Confined => [&total, &gain].map(|own| self.long(&mut pair, Longest::Across, own).0),
            Across::Periodic => [none(), none()],
        };
        // The longest waves along the rail have the period across it of all other waves along it.
        let narrower = self.section.rows as f64 / self.grid.rows as f64;
        for l in 0..layers {
            let (full, fallen) = (filled(&total[l]), filled(&gain[l]));
            for c in 0..6 {
                let along = kink.0[l][c] + 0.5 * odd.0[l][c];
                let own = full[c] + narrower * along - odd.1[l][c] + total_across[l][c];
                constant[0][l][c] = Complex { re: own, im: 0.0 };
                fall[0][l][c] =
                    Complex { re: fallen[c] + narrower * odd.0[l][c] + gain_across[l][c], im: 0.0 };
            }
        }
        Slow { constant: self.in_active_rows(&constant), fall: self.in_active_rows(&fall) }
    }

    /// i R′(0) D/L of section wave j ≥ 1.
    fn slope(&self, pair: &mut WavePair, j: usize, gain: &[Entries]) -> Vec<Entries> {
        let factors = self.section.factors(j);
        if 2 * j == self.section.rows {
            return vec![[Complex::ZERO; 6]; gain.len()];
        }
        let y = (1.0 - TILT * TILT).sqrt();
        let (mut ahead, mut behind) = (gain.to_vec(), gain.to_vec());
        pair.stresses(factors, Direction { x: TILT, y }, gain, &mut ahead);
        pair.stresses(factors, Direction { x: -TILT, y }, gain, &mut behind);
        let wave_number = TAU * j as f64 / (self.section.rows as f64 * self.grid.row_spacing);
        let scale = 1.0 / (2.0 * TILT * wave_number * self.grid.length());
        let of = |(a, b): (&Entries, &Entries)| std::array::from_fn(|c| ((a[c] - b[c]) * scale).turned());
        ahead.iter().zip(&behind).map(of).collect()
    }

    /// The response to `strain` of a wave that represents all those longer than the period, beyond
    /// that of filled layers: its part even in k, and the part odd in k over k L.
    fn long(
        &self,
        pair: &mut WavePair,
        longest: Longest,
        strain: &[[f64; 6]],
    ) -> (Vec<[f64; 6]>, Vec<[f64; 6]>) {
        let (direction, factors) = match longest {
            Longest::Along => (Direction { x: 1.0, y: 0.0 }, &self.long[0]),
            Longest::Across => (Direction { x: 0.0, y: 1.0 }, &self.long[1]),
        };
        let waves: Vec<Entries> = strain.iter().map(|own| own.map(|re| Complex { re, im: 0.0 })).collect();
        let mut stresses = [waves.clone(), waves.clone()];
        for (stress, factors) in stresses.iter_mut().zip(factors) {
            pair.stresses(factors, direction, &waves, stress);
        }
        let extrapolated = |near: f64, far: f64| near + (1.0 / NEAR - 1.0) * (far - near);
        let of = |l: usize| {
            let filled = filled_layer(&self.steel, strain[l]);
            let even =
                |c: usize| extrapolated(stresses[0][l][c].re - filled[c], stresses[1][l][c].re - filled[c]);
            let odd = |c: usize| {
                let over = |which: usize| stresses[which][l][c].im / (TAU * LONG_WAVES[which]);
                extrapolated(over(0), over(1))
            };
            (std::array::from_fn(even), std::array::from_fn(odd))
        };
        (0..strain.len()).map(of).unzip()
    }

    /// The waves across the rail of a strain by streamline.
    fn section_waves(&self, strain: &[[f64; 5]]) -> Vec<Vec<Entries>> {
        let (layers, Section { rows, first, fourier, .. }) = (self.grid.layers.count(), &self.section);
        let (rows, lanes) = (*rows, layers * LANES);
        let mut signals = Signals::zeros(rows * lanes);
        for (row, m) in self.grid.active.clone().enumerate() {
            for l in 0..layers {
                let entries = Tensor::from_deviator(strain[row * layers + l]).entries();
                for (m, image) in self.grid.images(m) {
                    put(&mut signals, (first + m) * lanes + l * LANES, image, &entries);
                }
            }
        }
        fourier.forward(&mut signals);
        let wave = |j: usize| {
            let of_layer = |l: usize| {
                let mut entries = [Complex::ZERO; 6];
                for (lane, (re, im)) in PAIRS.into_iter().enumerate() {
                    let at = |j: usize| j * lanes + l * LANES + lane;
                    (entries[re], entries[im]) = signals.separated(at(j), at((rows - j) % rows));
                }
                entries
            };
            (0..layers).map(of_layer).collect()
        };
        (0..=rows / 2).map(wave).collect()
    }

    /// The sum of waves across the rail, in all rows of the grid and layers.
    fn whole_section(&self, waves: &[Vec<Entries>]) -> Vec<[f64; 6]> {
        let (layers, Section { rows, first, fourier, .. }) = (self.grid.layers.count(), &self.section);
        let (rows, lanes) = (*rows, layers * LANES);
        let mut signals = Signals::zeros(rows * lanes);
        let per_row = 1.0 / rows as f64;
        for (j, wave) in waves.iter().enumerate() {
            for (l, stress) in wave.iter().enumerate() {
                for (lane, (re, im)) in PAIRS.into_iter().enumerate() {
                    let at = |j: usize| j * lanes + l * LANES + lane;
                    signals.combine(at(j), at((rows - j) % rows), stress[re] * per_row, stress[im] * per_row);
                }
            }
        }
        fourier.backward(&mut signals);
        let of = |at: usize| {
            let mut entries = [0.0; 6];
            for (lane, (re, im)) in PAIRS.into_iter().enumerate() {
                (entries[re], entries[im]) = (signals.re[at * LANES + lane], signals.im[at * LANES + lane]);
            }
            entries
        };
        (first * layers..(first + self.grid.rows) * layers).map(of).collect()
    }

    /// The same in the active rows.
    fn in_active_rows(&self, waves: &[Vec<Entries>]) -> Vec<[f64; 6]> {
        let (layers, active) = (self.grid.layers.count(), &self.grid.active);
        self.whole_section(waves)[active.start * layers..active.end * layers].to_vec()
    }

    /// The stress (MPa) far behind the load of a strain by streamline, which does not vary along
    /// the rail: row m of the period and layer l at m · layers + l.
    pub(super) fn section_stress(&self, strain: &[[f64; 5]]) -> Vec<Tensor> {
        let layers = self.grid.layers.count();
        let waves = self.section_waves(strain);
        let mut pair = WavePair::new(&self.steel, layers);
        let mut stresses = waves.clone();
        for (j, (strains, stresses)) in waves.iter().zip(&mut stresses).enumerate().skip(1) {
            self.stresses_of_section(&mut pair, j, strains, stresses);
        }
        let mean: Vec<[f64; 6]> = waves[0].iter().map(|own| own.map(|z| z.re)).collect();
        let images = match self.grid.across {
            Across::Confined => self.long(&mut pair, Longest::Across, &mean).0,
            Across::Periodic => vec![[0.0; 6]; layers],
        };
        for l in 0..layers {
            let filled = filled_layer(&self.steel, mean[l]);
            stresses[0][l] = std::array::from_fn(|c| Complex { re: filled[c] + images[l][c], im: 0.0 });
        }
        self.whole_section(&stresses).into_iter().map(Tensor::of).collect()
    }
}
