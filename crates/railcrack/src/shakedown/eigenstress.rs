//! Residual stress of a plastic strain in the half-plane, by elastic redistribution exact in every
//! layer.

use super::complex::Complex;
use super::fourier::{Fourier, Layers, Signals};
use super::in_plane::PlaneWave;
use super::layer_factors::LayerFactors;
use super::streamline::Field;
use crate::material::IsotropicElastic;

/// Fields of three components in the plane, where each layer is a streamline.
pub(super) type Columns = Field<3>;

/// Linear elasticity of the half-plane y ≤ 0 with a free surface under plastic strains that are
/// constant across each layer.
///
/// With the in-plane strain e = (ε_xx + ν ε_zz, ε_yy + ν ε_zz, ε_xy), Airy's function of the wave
/// e^(ikx) solves (∂² − k²)² φ = −E′ (∂² e_xx − k² e_yy − 2 i k ∂ e_xy); see [`Wave`]. Stresses are
/// averages over layers: the operator is then symmetric, like the energy from which it derives.
///
/// Waves have a period L, whereas the rail is infinitely long. Let the strain be U(y) far upstream
/// and U + D far downstream. U is treated exactly. A ramp that rises by D over one period is added
/// to the remainder, which makes it periodic, and the stress of this ramp in the infinite
/// half-plane is subtracted. The ramp, and the mean over the period, represent the waves longer
/// than the period: the stress σ(k) of a wave has a kink at k = 0, and the sum over waves becomes
/// the integral up to L⁻⁴ if the kink is represented by its value at Δk/6, Δk = 2π/L (Euler and
/// Maclaurin). With K the response to that wave, as far as it is linear in k,
///
///   σ_xx = −E′ mean + (K_xx + E′)(q − D x/L) + E′ D_xx x/L + …,
///
/// q the mean of the strain less the step of height D at x = 0, and −Im K D/(L Δk/6) for stresses
/// that are odd in k. Together they are in equilibrium like the wave itself.
/// `docs/dev/shakedown.md` shows the remaining effect of the period.
pub(super) struct Eigenstress {
    plane_strain_modulus: f64,
    poisson: f64,
    columns: usize,
    layers: Layers,
    fourier: Fourier,
    /// The response to wave k > 0 in layer j at (k − 1) · layers + j.
    factors: Vec<LayerFactors>,
    /// The response to each of [`LONG_WAVES`], ordered likewise.
    long_factors: Vec<LayerFactors>,
    signals: Signals,
    wave: PlaneWave,
}

/// The wave that represents all waves longer than the period, over Δk.
pub(super) const LONG_WAVE: f64 = 1.0 / 6.0;
/// Only the part linear in k is needed. It is extrapolated from two waves that are longer by this
/// factor and twice this factor, …
pub(super) const NEAR: f64 = 0.01;
/// … over Δk.
pub(super) const LONG_WAVES: [f64; 2] = [NEAR * LONG_WAVE, 2.0 * NEAR * LONG_WAVE];

impl Eigenstress {
    /// The operator on `columns` (a power of two) abscissae at a `spacing` (mm), for the `layers`
    /// of a rail of `steel`.
    pub(super) fn new(steel: &IsotropicElastic, columns: usize, spacing: f64, layers: Layers) -> Self {
        let period = columns as f64 * spacing;
        let unit = 2.0 * std::f64::consts::PI / period;
        let factors_of = |wave_number: f64| {
            let layers = &layers;
            (0..layers.count())
                .map(move |j| LayerFactors::new(wave_number, layers.top(j), layers.thickness(j)))
        };
        let factors = (1..=columns / 2).flat_map(|k| factors_of(unit * k as f64)).collect();
        let long_factors = LONG_WAVES.into_iter().flat_map(|long| factors_of(unit * long)).collect();
        let lanes = layers.count() + layers.count().div_ceil(2);
        Self {
            plane_strain_modulus: steel.plane_strain_modulus(),
            poisson: steel.poisson(),
            columns,
            fourier: Fourier::new(columns),
            factors,
            long_factors,
            signals: Signals::zeros(columns * lanes),
            wave: PlaneWave::new(layers.count()),
            layers,
        }
    }

    /// Writes σ_xx, σ_yy and σ_xy (MPa, averaged over the layers) to `stress`. The plastic strain
    /// `strain` (coordinates of [`super::PlasticStrain::deviator`]) in the layers enters as
    /// `upstream` in the last column and leaves by the first.
    pub(super) fn stress(&mut self, strain: &Columns, upstream: &[[f64; 3]], stress: &mut Columns) {
        let layers = self.layers.count();
        let gain: Vec<Strains> =
            (0..layers).map(|j| self.in_plane([0, 1, 2].map(|c| strain[c][j] - upstream[j][c]))).collect();
        let entering: Vec<Strains> = upstream.iter().map(|u| self.in_plane(*u)).collect();
        self.load(strain, upstream, &gain);
        self.fourier.forward(&mut self.signals);
        for k in 1..=self.columns / 2 {
            self.balance_wave(k);
        }
        let mean = self.take_mean();
        let long = self.long_waves(&mean, &gain, &entering);
        self.fourier.backward(&mut self.signals);
        self.unload(&long, stress);
    }

    /// e = (ε_xx + ν ε_zz, ε_yy + ν ε_zz, ε_xy).
    fn in_plane(&self, deviator: [f64; 3]) -> Strains {
        let strain = super::PlasticStrain::from_deviator(deviator);
        let out = self.poisson * strain.zz;
        Strains { xx: strain.xx + out, yy: strain.yy + out, xy: strain.xy }
    }

    /// The periodic strain as complex signals: xx + i yy of each layer, then xy of pairs of layers.
    fn load(&mut self, strain: &Columns, upstream: &[[f64; 3]], gain: &[Strains]) {
        let layers = self.layers.count();
        let lanes = layers + layers.div_ceil(2);
        for i in 0..self.columns {
            let ramp = i as f64 / self.columns as f64;
            for j in 0..layers {
                let at = i * layers + j;
                let here = self.in_plane([0, 1, 2].map(|c| strain[c][at] - upstream[j][c]));
                self.signals.re[i * lanes + j] = here.xx + ramp * gain[j].xx;
                self.signals.im[i * lanes + j] = here.yy + ramp * gain[j].yy;
                let shear = here.xy + ramp * gain[j].xy;
                let pair = i * lanes + layers + j / 2;
                if j % 2 == 0 {
                    (self.signals.re[pair], self.signals.im[pair]) = (shear, 0.0);
                } else {
                    self.signals.im[pair] = shear;
                }
            }
        }
    }

    /// The largest out-of-balance force per mm² on a layer or on the surface between neighbouring
    /// columns, MPa: a sum over waves, which cannot cancel each other.
    pub(super) fn imbalance(&mut self, strain: &Columns, upstream: &[[f64; 3]]) -> f64 {
        let layers = self.layers.count();
        let gain: Vec<Strains> =
            (0..layers).map(|j| self.in_plane([0, 1, 2].map(|c| strain[c][j] - upstream[j][c]))).collect();
        self.load(strain, upstream, &gain);
        self.fourier.forward(&mut self.signals);
        let mut sum = 0.0;
        for k in 1..=self.columns / 2 {
            self.take_wave(k);
            sum += self.wave.imbalance(&self.factors[(k - 1) * layers..k * layers]);
        }
        2.0 * self.plane_strain_modulus / self.columns as f64 * sum
    }

    /// Balances wave k of the transformed strain.
    fn take_wave(&mut self, k: usize) {
        let layers = self.layers.count();
        let lanes = layers + layers.div_ceil(2);
        let (plus, minus) = (k * lanes, (self.columns - k) * lanes);
        let signals = &self.signals;
        for j in 0..layers {
            let (xx, yy) = signals.separated(plus + j, minus + j);
            let pair = layers + j / 2;
            let (even, odd) = signals.separated(plus + pair, minus + pair);
            self.wave.strains[j] = [xx, yy, if j % 2 == 0 { even } else { odd }];
        }
        self.wave.balance(&self.factors[(k - 1) * layers..k * layers]);
    }

    /// Wave ±k of all layers, from strain to stress.
    fn balance_wave(&mut self, k: usize) {
        let layers = self.layers.count();
        let lanes = layers + layers.div_ceil(2);
        let (plus, minus) = (k * lanes, (self.columns - k) * lanes);
        self.take_wave(k);
        let signals = &mut self.signals;
        // −E′/N: the inverse transform is not yet divided by N. The shortest wave, which is its own
        // mirror image, has no imaginary part; `combine` drops it because it writes that wave
        // twice.
        let scale = -self.plane_strain_modulus / self.columns as f64;
        for j in 0..layers {
            let [xx, yy, xy] = self.wave.stresses[j].map(|s| s * scale);
            signals.combine(plus + j, minus + j, xx, yy);
            if j % 2 == 1 {
                let even = self.wave.stresses[j - 1][2] * scale;
                signals.combine(plus + layers + j / 2, minus + layers + j / 2, even, xy);
            } else if j + 1 == layers {
                signals.combine(plus + layers + j / 2, minus + layers + j / 2, xy, Complex::ZERO);
            }
        }
    }

    /// Removes the mean over the period, −E′ e_xx, from the signals and returns it.
    fn take_mean(&mut self) -> Vec<Strains> {
        let layers = self.layers.count();
        let lanes = layers + layers.div_ceil(2);
        let per_column = 1.0 / self.columns as f64;
        let mean = (0..layers)
            .map(|j| Strains {
                xx: self.signals.re[j] * per_column,
                yy: self.signals.im[j] * per_column,
                xy: 0.0,
            })
            .collect();
        self.signals.re[..lanes].fill(0.0);
        self.signals.im[..lanes].fill(0.0);
        mean
    }

    /// The contribution of the waves longer than the period, including the entering strain, without
    /// the ramp.
    fn long_waves(&mut self, mean: &[Strains], gain: &[Strains], entering: &[Strains]) -> Vec<LongWaves> {
        let modulus = self.plane_strain_modulus;
        let less_step: Vec<f64> = mean.iter().zip(gain).map(|(mean, gain)| mean.xx - gain.xx).collect();
        let (near, far) = (self.long_wave(0, &less_step, gain), self.long_wave(1, &less_step, gain));
        let of_layer = |j: usize| {
            let of = |c: usize| near[j][c] + (1.0 / NEAR - 1.0) * (far[j][c] - near[j][c]);
            let [kink, along, shear, shear_along] = [of(0), of(1), of(2), of(3)];
            LongWaves {
                // The step is at the load, half a period from the first column.
                xx: -modulus * (mean[j].xx + entering[j].xx + kink + 0.5 * (along - gain[j].xx))
                    + modulus * shear_along,
                slope_xx: modulus * along,
                xy: modulus * shear,
            }
        };
        (0..mean.len()).map(of_layer).collect()
    }

    /// For long wave `which`, over −E′ and by layer: the σ_xx of the strain `less_step` beyond that
    /// of a filled layer, σ_xx of `gain`, and the parts odd in k of σ_xy and σ_xx of `gain`, over κ
    /// L.
    ///
    /// e_yy does not contribute: its stresses begin with k².
    fn long_wave(&mut self, which: usize, less_step: &[f64], gain: &[Strains]) -> Vec<[f64; 4]> {
        let layers = self.layers.count();
        let real = |re: f64| Complex { re, im: 0.0 };
        for j in 0..layers {
            self.wave.strains[j] = [real(less_step[j]), Complex::ZERO, Complex::ZERO];
        }
        self.wave.balance(&self.long_factors[which * layers..(which + 1) * layers]);
        let kinks: Vec<f64> = (0..layers).map(|j| self.wave.stresses[j][0].re - less_step[j]).collect();
        for j in 0..layers {
            self.wave.strains[j] = [real(gain[j].xx), Complex::ZERO, real(gain[j].xy)];
        }
        self.wave.balance(&self.long_factors[which * layers..(which + 1) * layers]);
        let length = 2.0 * std::f64::consts::PI * LONG_WAVES[which];
        let of_layer =
            |(&kink, [xx, _, xy]): (&f64, &[Complex; 3])| [kink, xx.re, xy.im / length, xx.im / length];
        kinks.iter().zip(&self.wave.stresses).map(of_layer).collect()
    }

    /// The stress from the signals and the long waves.
    fn unload(&self, long: &[LongWaves], stress: &mut Columns) {
        let layers = self.layers.count();
        let lanes = layers + layers.div_ceil(2);
        let [xx, yy, xy] = stress;
        for i in 0..self.columns {
            let ramp = i as f64 / self.columns as f64;
            for j in 0..layers {
                let (at, lane, pair) = (i * layers + j, i * lanes + j, i * lanes + layers + j / 2);
                xx[at] = self.signals.re[lane] + long[j].xx + ramp * long[j].slope_xx;
                yy[at] = self.signals.im[lane];
                let shear = if j % 2 == 0 { self.signals.re[pair] } else { self.signals.im[pair] };
                xy[at] = shear + long[j].xy;
            }
        }
    }
}

/// The in-plane strain: (ε_xx + ν ε_zz, ε_yy + ν ε_zz, ε_xy).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Strains {
    xx: f64,
    yy: f64,
    xy: f64,
}

/// Stresses in a layer, MPa, due to the waves longer than the period: σ_xx in the first column and
/// its rise over a period, σ_xy.
#[derive(Debug, Clone, Copy)]
struct LongWaves {
    xx: f64,
    slope_xx: f64,
    xy: f64,
}

#[cfg(test)]
#[path = "eigenstress_tests.rs"]
mod tests;
