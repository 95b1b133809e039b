//! Residual stress of a single wave of plastic strain along the rail.

use std::ops::{Add, Mul, Neg, Sub};

/// A complex number.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Complex {
    pub re: f64,
    pub im: f64,
}

impl Complex {
    pub(super) const ZERO: Self = Self { re: 0.0, im: 0.0 };

    /// |z|.
    fn size(self) -> f64 {
        self.re.hypot(self.im)
    }

    /// i times this number.
    #[inline(always)]
    fn turned(self) -> Self {
        Self { re: -self.im, im: self.re }
    }
}

impl Add for Complex {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self { re: self.re + o.re, im: self.im + o.im }
    }
}

impl Sub for Complex {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self { re: self.re - o.re, im: self.im - o.im }
    }
}

impl Neg for Complex {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { re: -self.re, im: -self.im }
    }
}

impl Mul<f64> for Complex {
    type Output = Self;
    #[inline(always)]
    fn mul(self, s: f64) -> Self {
        Self { re: self.re * s, im: self.im * s }
    }
}

/// The in-plane strain: (ε_xx + ν ε_zz, ε_yy + ν ε_zz, ε_xy).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Strains {
    pub xx: f64,
    pub yy: f64,
    pub xy: f64,
}

/// Transfer factors of a layer of thickness h for a wave of wave number κ; τ = κ h.
#[derive(Debug, Clone, Copy)]
pub(super) struct LayerFactors {
    /// τ, and e^(−τ).
    thickness: f64,
    decay: f64,
    /// ∫_0^τ e^(−t) dt and ∫_0^τ t e^(−t) dt: effect of a source in the layer at the border of the
    /// layer.
    source: [f64; 2],
    /// These integrals over τ: mean effect in the layer of a source at its border.
    mean: [f64; 2],
    /// (1/τ) ∫∫ e^(−|t − t'|) and (1/τ) ∫∫ |t − t'| e^(−|t − t'|): mean effect in the layer of a
    /// source in the same layer.
    own: [f64; 2],
    /// κ d and e^(−κ d), d the depth of the upper border.
    depth: f64,
    depth_decay: f64,
}

/// Value of τ below which the closed forms of `source[1]` and `own` suffer from cancellation; the
/// first neglected term of the series is τ⁵/840 of them.
const THIN: f64 = 1e-2;

impl LayerFactors {
    /// The factors for `wave_number` κ > 0 (1/mm) of a layer with its upper border at the depth
    /// `top` (mm), of `thickness` (mm).
    pub(super) fn new(wave_number: f64, top: f64, thickness: f64) -> Self {
        let tau = wave_number * thickness;
        let decay = (-tau).exp();
        let whole = -(-tau).exp_m1();
        let (first, own) = if tau < THIN {
            let first = tau * tau * (0.5 - tau * (1.0 / 3.0 - tau * (0.125 - tau / 30.0)));
            let plain =
                tau * (1.0 - tau * (1.0 / 3.0 - tau * (1.0 / 12.0 - tau * (1.0 / 60.0 - tau / 360.0))));
            let moment = tau * tau * (1.0 / 3.0 - tau * (1.0 / 6.0 - tau * (0.05 - tau / 90.0)));
            (first, [plain, moment])
        } else {
            let plain = 2.0 / tau * (tau - whole);
            (whole - tau * decay, [plain, 2.0 / tau * (tau - 2.0 * whole + tau * decay)])
        };
        let depth = wave_number * top;
        Self {
            thickness: tau,
            decay,
            source: [whole, first],
            mean: [whole / tau, first / tau],
            own,
            depth,
            depth_decay: (-depth).exp(),
        }
    }
}

/// Effect at a border of the sources on one side: ∫ z e^(−t), ∫ t z e^(−t), ∫ w e^(−t),
/// t = κ |y − y′|.
#[derive(Clone, Copy, Default)]
struct Far {
    z0: Complex,
    z1: Complex,
    w0: Complex,
}

impl Far {
    /// The effect at the opposite border of a layer with the sources z and w.
    #[inline(always)]
    fn across(self, layer: &LayerFactors, z: Complex, w: Complex) -> Self {
        Self {
            z1: (self.z1 + self.z0 * layer.thickness) * layer.decay + z * layer.source[1],
            z0: self.z0 * layer.decay + z * layer.source[0],
            w0: self.w0 * layer.decay + w * layer.source[0],
        }
    }

    /// The mean over the layer that begins at the border.
    #[inline(always)]
    fn mean(self, layer: &LayerFactors) -> Self {
        Self {
            z1: self.z0 * layer.mean[1] + self.z1 * layer.mean[0],
            z0: self.z0 * layer.mean[0],
            w0: self.w0 * layer.mean[0],
        }
    }

    /// 4 σ / −E′ of this effect; `side` is +1 for sources below, −1 for sources above.
    #[inline(always)]
    fn stress(self, side: f64) -> [Complex; 3] {
        let Self { z0, z1, w0 } = self;
        [z1 - z0 * 2.0 - w0, w0 - z1, (z1 - z0 - w0).turned() * side]
    }
}

/// One wave e^(iκx) through all layers.
///
/// Green's function of (∂² − κ²)² is (1 + t) e^(−t) / 4κ³, t = κ|y − y′|. With w = e_xx + e_yy and
/// z = e_xx − e_yy ± 2 i e_xy (+ for sources below), the infinite plane has
///
///   4 σ_xx/−E′ = 4 e_xx + ∫ ((t − 2) z − w) e^(−t) κ dy′,  4 σ_yy/−E′ = ∫ (w − t z) e^(−t) κ dy′,
///   4 σ_xy/−E′ = ± i ∫ ((t − 1) z − w) e^(−t) κ dy′,
///
/// and φ = (A + B κ y) e^(κy) removes the tractions on the surface. Sums over the sources above and
/// below are propagated from border to border.
pub(super) struct Wave {
    /// e_xx, e_yy, e_xy of each layer.
    pub strains: Vec<[Complex; 3]>,
    /// σ_xx, σ_yy, σ_xy over −E′, means over each layer.
    pub stresses: Vec<[Complex; 3]>,
    /// Effect of the sources below at the upper border of each layer; the last entry is below all
    /// layers.
    borders: Vec<Far>,
}

impl Wave {
    pub(super) fn new(layers: usize) -> Self {
        Self {
            strains: vec![[Complex::ZERO; 3]; layers],
            stresses: vec![[Complex::ZERO; 3]; layers],
            borders: vec![Far::default(); layers + 1],
        }
    }

    /// Stresses from strains; `layers` from the surface down.
    pub(super) fn balance(&mut self, layers: &[LayerFactors]) {
        let mut below = Far::default();
        for (j, layer) in layers.iter().enumerate().rev() {
            let [xx, yy, xy] = self.strains[j];
            self.stresses[j] = below.mean(layer).stress(1.0);
            self.borders[j + 1] = below;
            below = below.across(layer, xx - yy + xy.turned() * 2.0, xx + yy);
        }
        self.borders[0] = below;
        let image = Image::of(below);
        let mut above = Far::default();
        for (j, layer) in layers.iter().enumerate() {
            let [xx, yy, xy] = self.strains[j];
            let far = above.mean(layer).stress(-1.0);
            let free = image.mean(layer);
            let (difference, shear) = (xx - yy, xy * 2.0);
            let [plain, moment] = layer.own;
            let own = [
                difference * moment + (yy - xx * 3.0) * plain + xx * 4.0,
                (xx + yy) * plain - difference * moment,
                shear * (plain - moment),
            ];
            for c in 0..3 {
                self.stresses[j][c] = (self.stresses[j][c] + far[c] + free[c] + own[c]) * 0.25;
            }
            above = above.across(layer, difference - xy.turned() * 2.0, xx + yy);
        }
    }
}

impl Wave {
    /// Tractions (σ_yy, σ_xy) over −E′ of the last balance, at the upper border of each layer and
    /// below the last one.
    fn tractions(&self, layers: &[LayerFactors]) -> Vec<[Complex; 2]> {
        let image = Image::of(self.borders[0]);
        let mut above = Far::default();
        let mut tractions = Vec::with_capacity(layers.len() + 1);
        for j in 0..=layers.len() {
            let (plain, moment) = match layers.get(j) {
                Some(layer) => (layer.depth_decay, layer.depth * layer.depth_decay),
                None => {
                    let last = layers[j - 1];
                    let (depth, decay) = (last.depth + last.thickness, last.depth_decay * last.decay);
                    (decay, depth * decay)
                }
            };
            let (below, top, free) =
                (self.borders[j].stress(1.0), above.stress(-1.0), image.stress(plain, moment));
            tractions.push([1, 2].map(|c| (below[c] + top[c] + free[c]) * 0.25));
            if let Some(layer) = layers.get(j) {
                let [xx, yy, xy] = self.strains[j];
                above = above.across(layer, xx - yy - xy.turned() * 2.0, xx + yy);
            }
        }
        tractions
    }

    /// The largest out-of-balance force over −E′ per wave length/2π on a layer, or on the surface,
    /// after a balance.
    pub(super) fn imbalance(&self, layers: &[LayerFactors]) -> f64 {
        let borders = self.tractions(layers);
        let mut largest = borders[0][0].size().max(borders[0][1].size());
        for (j, layer) in layers.iter().enumerate() {
            let [xx, _, xy] = self.stresses[j];
            let along = xx.turned() * layer.thickness + borders[j][1] - borders[j + 1][1];
            let down = xy.turned() * layer.thickness + borders[j][0] - borders[j + 1][0];
            largest = largest.max(along.size()).max(down.size());
        }
        largest
    }
}

/// Contribution of the free surface: φ = (A + B κ y) e^(κy), in the unit −E′/4κ².
#[derive(Clone, Copy)]
struct Image {
    a: Complex,
    b: Complex,
}

impl Image {
    /// The contribution that removes the surface tractions of the sources below the surface.
    fn of(below: Far) -> Self {
        let Far { z0, z1, w0 } = below;
        Self { a: w0 - z1, b: z1 * 2.0 - z0 - w0 * 2.0 }
    }

    /// 4 σ / −E′, mean over the layer.
    #[inline(always)]
    fn mean(self, layer: &LayerFactors) -> [Complex; 3] {
        let plain = layer.depth_decay * layer.mean[0];
        let moment = layer.depth_decay * (layer.depth * layer.mean[0] + layer.mean[1]);
        self.stress(plain, moment)
    }

    /// 4 σ / −E′ with e^(−κd) = `plain` and κ d e^(−κd) = `moment`.
    #[inline(always)]
    fn stress(self, plain: f64, moment: f64) -> [Complex; 3] {
        let Self { a, b } = self;
        let falling = b * moment;
        [(a + b * 2.0) * plain - falling, falling - a * plain, -((a + b) * plain - falling).turned()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn example(wave_number: f64) -> (Wave, Vec<LayerFactors>) {
        let thickness = [0.3, 0.2, 0.5, 0.1, 0.7];
        let mut top = 0.0;
        let mut wave = Wave::new(thickness.len());
        let mut layers = Vec::new();
        for (j, h) in thickness.into_iter().enumerate() {
            layers.push(LayerFactors::new(wave_number, top, h));
            top += h;
            let at = |c: usize| {
                let n = (7 * j + 3 * c) as f64;
                Complex { re: n.sin(), im: (1.7 * n).cos() }
            };
            wave.strains[j] = [at(0), at(1), at(2)];
        }
        wave.balance(&layers);
        (wave, layers)
    }

    /// Each layer is in equilibrium between the tractions on its borders, and the surface is
    /// traction-free: to round-off.
    #[test]
    fn every_layer_is_in_equilibrium() {
        for wave_number in [0.01, 0.3, 2.0, 30.0] {
            let (wave, layers) = example(wave_number);
            let scale = wave.stresses.iter().flatten().map(|s| s.size()).fold(0.0, f64::max);
            let imbalance = wave.imbalance(&layers);
            assert!(imbalance < 1e-13 * scale.max(1.0), "κ = {wave_number}: {imbalance:e}");
        }
    }

    /// Series and closed forms agree.
    #[test]
    fn thin_layers() {
        let (below, above) =
            (LayerFactors::new(1.0, 0.0, THIN * (1.0 - 1e-9)), LayerFactors::new(1.0, 0.0, THIN));
        for (a, b) in
            [(below.source[1], above.source[1]), (below.own[0], above.own[0]), (below.own[1], above.own[1])]
        {
            // The closed forms amplify round-off by τ⁻³.
            assert!((a / b - 1.0).abs() < 1e-8, "{a} {b}");
        }
    }
}
