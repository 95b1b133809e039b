//! Waves of plastic shear across the plane of their direction and the depth.

use super::complex::Complex;
use super::layer_factors::LayerFactors;
use super::wave::{Effect, Side, Wave};

/// A wave e^(iκn) of antiplane strain, with t the direction normal to n and to the depth z: e_nt,
/// e_tz give σ_nt, σ_tz over G.
///
/// With p the sources above and q those below,
///
///   p = ∫ (e_tz − i e_nt) e^(−κ(z − z′)) κ dz′,  q = −∫ (e_tz + i e_nt) e^(−κ(z′ − z)) κ dz′,
///
/// the displacement along t is (p + q)/κ, σ_nt/G = i (p + q) − 2 e_nt and σ_tz/G = q − p. The free
/// surface reflects: q comes back as p.
pub(super) type AntiplaneWave = Wave<Antiplane, 2, 1>;

/// p or q.
#[derive(Clone, Copy, Default)]
pub(super) struct Antiplane(Complex);

impl Effect<2, 1> for Antiplane {
    type Image = Self;

    const UNIT: f64 = 1.0;

    #[inline(always)]
    fn across(self, layer: &LayerFactors, &[nt, tz]: &[Complex; 2], side: Side) -> Self {
        let source = match side {
            Side::Above => tz - nt.turned(),
            Side::Below => -(tz + nt.turned()),
        };
        Self(self.0 * layer.decay + source * layer.source[0])
    }

    #[inline(always)]
    fn mean(self, layer: &LayerFactors) -> Self {
        Self(self.0 * layer.mean[0])
    }

    #[inline(always)]
    fn stress(self, side: Side) -> [Complex; 2] {
        let down = match side {
            Side::Above => -self.0,
            Side::Below => self.0,
        };
        [self.0.turned(), down]
    }

    #[inline(always)]
    fn own_stress(layer: &LayerFactors, &[nt, tz]: &[Complex; 2]) -> [Complex; 2] {
        [nt * (layer.own[0] - 2.0), -(tz * layer.own[0])]
    }

    fn image(self) -> Self {
        self
    }

    #[inline(always)]
    fn image_stress(image: Self, plain: f64, _: f64) -> [Complex; 2] {
        Self(image.0 * plain).stress(Side::Above)
    }

    fn on_border([_, tz]: [Complex; 2]) -> [Complex; 1] {
        [-tz]
    }

    fn on_front([nt, _]: [Complex; 2]) -> [Complex; 1] {
        [nt]
    }
}
