//! Residual stress of a single wave of plastic strain along the rail, exact in every layer.

use super::complex::Complex;
use super::layer_factors::LayerFactors;

/// The side on which sources lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    Above,
    Below,
}

/// Effect at a border of the sources on one side of it, in the components of strain and stress that
/// a wave couples: N of them, T of which act on the borders of layers.
pub(super) trait Effect<const N: usize, const T: usize>: Copy + Default {
    /// Its contribution by the free surface.
    type Image: Copy;

    /// The unit of stress over that of the sums below.
    const UNIT: f64;

    /// The effect at the opposite border of a layer with a plastic `strain`.
    fn across(self, layer: &LayerFactors, strain: &[Complex; N], side: Side) -> Self;

    /// The mean over the layer that begins at the border.
    fn mean(self, layer: &LayerFactors) -> Self;

    /// The stress of this effect.
    fn stress(self, side: Side) -> [Complex; N];

    /// Mean stress in a layer of its own strain.
    fn own_stress(layer: &LayerFactors, strain: &[Complex; N]) -> [Complex; N];

    /// The part that removes the tractions of all sources on the surface.
    fn image(self) -> Self::Image;

    /// The stress of an image with e^(−κd) = `plain` and κ d e^(−κd) = `moment`.
    fn image_stress(image: Self::Image, plain: f64, moment: f64) -> [Complex; N];

    /// The components of stress on borders of layers, heights upwards, …
    fn on_border(stress: [Complex; N]) -> [Complex; T];

    /// … and those in the same directions on planes across the wave.
    fn on_front(stress: [Complex; N]) -> [Complex; T];
}

/// One wave e^(iκx) through all layers.
///
/// Sums over the sources above and below are propagated from border to border, so the stress is
/// exact in depth.
pub(super) struct Wave<E, const N: usize, const T: usize> {
    /// Plastic strain of each layer.
    pub strains: Vec<[Complex; N]>,
    /// Stresses in the unit of the effect, means over each layer.
    pub stresses: Vec<[Complex; N]>,
    /// Effect of the sources below at the upper border of each layer; the last entry is below all
    /// layers.
    borders: Vec<E>,
}

impl<E: Effect<N, T>, const N: usize, const T: usize> Wave<E, N, T> {
    pub(super) fn new(layers: usize) -> Self {
        let zeros = || vec![[Complex::ZERO; N]; layers];
        Self { strains: zeros(), stresses: zeros(), borders: vec![E::default(); layers + 1] }
    }

    /// Stresses from strains; `layers` from the surface down.
    pub(super) fn balance(&mut self, layers: &[LayerFactors]) {
        let mut below = E::default();
        for (j, layer) in layers.iter().enumerate().rev() {
            self.stresses[j] = below.mean(layer).stress(Side::Below);
            self.borders[j + 1] = below;
            below = below.across(layer, &self.strains[j], Side::Below);
        }
        self.borders[0] = below;
        let image = below.image();
        let mut above = E::default();
        for (j, layer) in layers.iter().enumerate() {
            let strain = &self.strains[j];
            let far = above.mean(layer).stress(Side::Above);
            let plain = layer.depth_decay * layer.mean[0];
            let moment = layer.depth_decay * (layer.depth * layer.mean[0] + layer.mean[1]);
            let free = E::image_stress(image, plain, moment);
            let own = E::own_stress(layer, strain);
            for c in 0..N {
                self.stresses[j][c] = (self.stresses[j][c] + far[c] + free[c] + own[c]) * E::UNIT;
            }
            above = above.across(layer, strain, Side::Above);
        }
    }

    /// Tractions of the last balance, at the upper border of each layer and below the last one.
    fn tractions(&self, layers: &[LayerFactors]) -> Vec<[Complex; T]> {
        let image = self.borders[0].image();
        let mut above = E::default();
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
            let below = E::on_border(self.borders[j].stress(Side::Below));
            let top = E::on_border(above.stress(Side::Above));
            let free = E::on_border(E::image_stress(image, plain, moment));
            tractions.push(std::array::from_fn(|c| (below[c] + top[c] + free[c]) * E::UNIT));
            if let Some(layer) = layers.get(j) {
                above = above.across(layer, &self.strains[j], Side::Above);
            }
        }
        tractions
    }

    /// The largest out-of-balance force, in the unit of stress, per wave length/2π on a layer, or
    /// on the surface, after a balance.
    pub(super) fn imbalance(&self, layers: &[LayerFactors]) -> f64 {
        let borders = self.tractions(layers);
        let mut largest = borders[0].iter().map(|own| own.size()).fold(0.0, f64::max);
        for (j, layer) in layers.iter().enumerate() {
            let front = E::on_front(self.stresses[j]);
            for c in 0..T {
                let rest = front[c].turned() * layer.thickness + borders[j][c] - borders[j + 1][c];
                largest = largest.max(rest.size());
            }
        }
        largest
    }
}

#[cfg(test)]
#[path = "wave_tests.rs"]
mod tests;
