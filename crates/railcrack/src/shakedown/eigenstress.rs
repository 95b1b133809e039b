//! The stress that a plastic strain leaves in the half-plane: the elastic redistribution, exact in every layer.

use super::fourier::{Fourier, Signals};
use super::layers::Layers;
use super::wave::{Complex, LayerFactors, Strains, Wave};
use crate::material::IsotropicElastic;

/// Fields on columns (evenly spaced abscissae) and layers: component c of column i and layer j is at `[c][i · layers + j]`.
pub(super) type Columns = [Vec<f64>; 3];

/// Linear elasticity of the half-plane y ≤ 0 with a free surface under plastic strains that are constant across each layer.
///
/// With the strain e = (ε_xx + ν ε_zz, ε_yy + ν ε_zz, ε_xy) that acts in the plane, Airy's function of the wave e^(ikx) solves
/// (∂² − k²)² φ = −E′ (∂² e_xx − k² e_yy − 2 i k ∂ e_xy); see [`Wave`]. Stresses are averages over layers: the operator
/// is then symmetric, like the energy that it comes from.
///
/// Waves have a period, the rail has none. Let the strain be U(y) far upstream and U + D far downstream. U is carried
/// exactly. To the rest, a ramp that rises by D over one period is added; this makes it periodic, and the exact stress of
/// such a ramp in the endless half-plane,
///
///   σ_xx = −E′ (D_xx + ν D_zz) x/L + (2 E′/L) ∫_(−∞)^y D_xy,   σ_xy = −(E′/L) ∫_y^0 (D_xx + ν D_zz),
///
/// is subtracted. What remains of the period falls with its square.
pub(super) struct Eigenstress {
    plane_strain_modulus: f64,
    poisson: f64,
    columns: usize,
    period: f64,
    layers: Layers,
    fourier: Fourier,
    /// Of wave k > 0 and layer j at (k − 1) · layers + j.
    factors: Vec<LayerFactors>,
    /// Of the mean over the period, see [`Eigenstress::mean`].
    mean_factors: Vec<LayerFactors>,
    signals: Signals,
    wave: Wave,
}

/// The mean over a period stands for the waves that are longer than it. Between −Δk/2 and Δk/2 the stress of a wave has
/// a kink at k = 0; the sum over waves is the integral up to Δk⁴ if the kink is represented by the wave Δk/6 (Euler and
/// Maclaurin).
const MEAN_WAVE: f64 = 1.0 / 6.0;

impl Eigenstress {
    /// `columns` (a power of two) abscissae at `spacing` (mm); `layers` of the rail; its elasticity `steel`.
    pub(super) fn new(steel: &IsotropicElastic, columns: usize, spacing: f64, layers: Layers) -> Self {
        let period = columns as f64 * spacing;
        let unit = 2.0 * std::f64::consts::PI / period;
        let factors_of = |wave_number: f64| {
            let layers = &layers;
            (0..layers.count()).map(move |j| LayerFactors::new(wave_number, layers.top(j), layers.thickness(j)))
        };
        let factors = (1..=columns / 2).flat_map(|k| factors_of(unit * k as f64)).collect();
        let mean_factors = factors_of(unit * MEAN_WAVE).collect();
        let lanes = layers.count() + layers.count().div_ceil(2);
        Self {
            plane_strain_modulus: steel.plane_strain_modulus(),
            poisson: steel.poisson(),
            columns,
            period,
            fourier: Fourier::new(columns),
            factors,
            mean_factors,
            signals: Signals::zeros(columns * lanes),
            wave: Wave::new(layers.count()),
            layers,
        }
    }

    /// The layers.
    pub(super) fn layers(&self) -> &Layers {
        &self.layers
    }

    /// σ_xx, σ_yy and σ_xy, MPa, averaged over the layers, into `stress`, of the plastic strain `strain` (coordinates
    /// of [`super::PlasticStrain::deviator`]) in the layers, which enters as `upstream` in the last column and leaves by the
    /// first.
    pub(super) fn stress(&mut self, strain: &Columns, upstream: &[[f64; 3]], stress: &mut Columns) {
        let layers = self.layers.count();
        let gain: Vec<Strains> = (0..layers)
            .map(|j| self.in_plane([0, 1, 2].map(|c| strain[c][j] - upstream[j][c])))
            .collect();
        let entering: Vec<Strains> = upstream.iter().map(|u| self.in_plane(*u)).collect();
        self.load(strain, upstream, &gain);
        self.fourier.forward(&mut self.signals);
        for k in 1..=self.columns / 2 {
            self.balance_wave(k);
        }
        self.balance_mean();
        self.fourier.backward(&mut self.signals);
        self.unload(&gain, &entering, stress);
    }

    /// e = (ε_xx + ν ε_zz, ε_yy + ν ε_zz, ε_xy).
    fn in_plane(&self, deviator: [f64; 3]) -> Strains {
        let strain = super::PlasticStrain::from_deviator(deviator);
        let out = self.poisson * strain.zz;
        Strains { xx: strain.xx + out, yy: strain.yy + out, xy: strain.xy }
    }

    /// The periodic strain as signals: xx + i yy of each layer, then xy of pairs of layers.
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

    /// Wave ±k of all layers, from strain to stress.
    fn balance_wave(&mut self, k: usize) {
        let layers = self.layers.count();
        let lanes = layers + layers.div_ceil(2);
        let (plus, minus) = (k * lanes, (self.columns - k) * lanes);
        let signals = &mut self.signals;
        for j in 0..layers {
            let (xx, yy) = separate(signals, plus + j, minus + j);
            let pair = layers + j / 2;
            let (even, odd) = separate(signals, plus + pair, minus + pair);
            self.wave.strains[j] = [xx, yy, if j % 2 == 0 { even } else { odd }];
        }
        self.wave.balance(&self.factors[(k - 1) * layers..k * layers]);
        // −E′/N: the inverse transform is not yet divided by N. The shortest wave, which is its own mirror image, has no
        // imaginary part; `combine` drops it because it writes that wave twice.
        let scale = -self.plane_strain_modulus / self.columns as f64;
        for j in 0..layers {
            let [xx, yy, xy] = self.wave.stresses[j].map(|s| s * scale);
            combine(signals, plus + j, minus + j, xx, yy);
            if j % 2 == 1 {
                let even = self.wave.stresses[j - 1][2] * scale;
                combine(signals, plus + layers + j / 2, minus + layers + j / 2, even, xy);
            } else if j + 1 == layers {
                combine(signals, plus + layers + j / 2, minus + layers + j / 2, xy, Complex::ZERO);
            }
        }
    }

    /// The mean over the period: σ_xx alone, which no equilibrium involves.
    fn balance_mean(&mut self) {
        let layers = self.layers.count();
        let lanes = layers + layers.div_ceil(2);
        for j in 0..layers {
            let real = |value: f64| Complex { re: value, im: 0.0 };
            // Shear strain has a part of σ_xx that is odd in k, hence smooth.
            self.wave.strains[j] = [real(self.signals.re[j]), real(self.signals.im[j]), Complex::ZERO];
        }
        self.wave.balance(&self.mean_factors);
        let scale = -self.plane_strain_modulus / self.columns as f64;
        self.signals.re[..lanes].fill(0.0);
        self.signals.im[..lanes].fill(0.0);
        for j in 0..layers {
            self.signals.re[j] = scale * self.wave.stresses[j][0].re;
        }
    }

    /// Stress from the signals, with the ramp taken out and the strain that enters put in.
    fn unload(&self, gain: &[Strains], entering: &[Strains], stress: &mut Columns) {
        let layers = self.layers.count();
        let lanes = layers + layers.div_ceil(2);
        let modulus = self.plane_strain_modulus;
        let mut constant_xx = vec![0.0; layers];
        let mut constant_xy = vec![0.0; layers];
        let (mut above, mut below) = (0.0, 0.0);
        for j in 0..layers {
            let half = 0.5 * self.layers.thickness(j);
            constant_xy[j] = modulus / self.period * (above + half * gain[j].xx);
            above += 2.0 * half * gain[j].xx;
        }
        for j in (0..layers).rev() {
            let half = 0.5 * self.layers.thickness(j);
            constant_xx[j] = -modulus * entering[j].xx - 2.0 * modulus / self.period * (below + half * gain[j].xy);
            below += 2.0 * half * gain[j].xy;
        }
        let [xx, yy, xy] = stress;
        for i in 0..self.columns {
            let ramp = modulus * i as f64 / self.columns as f64;
            for j in 0..layers {
                let (at, lane, pair) = (i * layers + j, i * lanes + j, i * lanes + layers + j / 2);
                xx[at] = self.signals.re[lane] + constant_xx[j] + ramp * gain[j].xx;
                yy[at] = self.signals.im[lane];
                let shear = if j % 2 == 0 { self.signals.re[pair] } else { self.signals.im[pair] };
                xy[at] = shear + constant_xy[j];
            }
        }
    }
}

/// Waves k of two real signals that were transformed as one complex one.
#[inline(always)]
fn separate(signals: &Signals, plus: usize, minus: usize) -> (Complex, Complex) {
    let (a, b) = (signals.re[plus], signals.im[plus]);
    let (c, d) = (signals.re[minus], signals.im[minus]);
    (Complex { re: 0.5 * (a + c), im: 0.5 * (b - d) }, Complex { re: 0.5 * (b + d), im: 0.5 * (c - a) })
}

/// The inverse of [`separate`].
#[inline(always)]
fn combine(signals: &mut Signals, plus: usize, minus: usize, one: Complex, other: Complex) {
    if plus == minus {
        (signals.re[plus], signals.im[plus]) = (one.re, other.re);
        return;
    }
    (signals.re[plus], signals.im[plus]) = (one.re - other.im, one.im + other.re);
    (signals.re[minus], signals.im[minus]) = (one.re + other.im, other.re - one.im);
}
