//! Waves of plastic strain in the plane of their direction and the depth.

use super::complex::Complex;
use super::layer_factors::LayerFactors;
use super::wave::{Effect, Side, Wave};

/// A wave e^(iκx) in plane strain: e_xx, e_yy, e_xy (e_xx and e_yy with ν e_zz added) give σ_xx,
/// σ_yy, σ_xy over −E′, y upwards.
///
/// Green's function of (∂² − κ²)² is (1 + t) e^(−t) / 4κ³, t = κ|y − y′|. With w = e_xx + e_yy and
/// z = e_xx − e_yy ± 2 i e_xy (+ for sources below), the infinite plane has
///
///   4 σ_xx/−E′ = 4 e_xx + ∫ ((t − 2) z − w) e^(−t) κ dy′,  4 σ_yy/−E′ = ∫ (w − t z) e^(−t) κ dy′,
///   4 σ_xy/−E′ = ± i ∫ ((t − 1) z − w) e^(−t) κ dy′,
///
/// and φ = (A + B κ y) e^(κy) removes the tractions on the surface.
pub(super) type PlaneWave = Wave<InPlane, 3, 2>;

/// ∫ z e^(−t), ∫ t z e^(−t), ∫ w e^(−t) over the sources on one side.
#[derive(Clone, Copy, Default)]
pub(super) struct InPlane {
    z0: Complex,
    z1: Complex,
    w0: Complex,
}

/// A and B of the free surface, in the unit −E′/4κ².
#[derive(Clone, Copy)]
pub(super) struct Image {
    a: Complex,
    b: Complex,
}

impl Effect<3, 2> for InPlane {
    type Image = Image;

    const UNIT: f64 = 0.25;

    #[inline(always)]
    fn across(self, layer: &LayerFactors, &[xx, yy, xy]: &[Complex; 3], side: Side) -> Self {
        let shear = xy.turned() * 2.0;
        let z = match side {
            Side::Above => xx - yy - shear,
            Side::Below => xx - yy + shear,
        };
        let w = xx + yy;
        Self {
            z1: (self.z1 + self.z0 * layer.thickness) * layer.decay + z * layer.source[1],
            z0: self.z0 * layer.decay + z * layer.source[0],
            w0: self.w0 * layer.decay + w * layer.source[0],
        }
    }

    #[inline(always)]
    fn mean(self, layer: &LayerFactors) -> Self {
        Self {
            z1: self.z0 * layer.mean[1] + self.z1 * layer.mean[0],
            z0: self.z0 * layer.mean[0],
            w0: self.w0 * layer.mean[0],
        }
    }

    #[inline(always)]
    fn stress(self, side: Side) -> [Complex; 3] {
        let Self { z0, z1, w0 } = self;
        let shear = (z1 - z0 - w0).turned();
        let shear = match side {
            Side::Above => -shear,
            Side::Below => shear,
        };
        [z1 - z0 * 2.0 - w0, w0 - z1, shear]
    }

    #[inline(always)]
    fn own_stress(layer: &LayerFactors, &[xx, yy, xy]: &[Complex; 3]) -> [Complex; 3] {
        let (difference, shear) = (xx - yy, xy * 2.0);
        let [plain, moment] = layer.own;
        [
            difference * moment + (yy - xx * 3.0) * plain + xx * 4.0,
            (xx + yy) * plain - difference * moment,
            shear * (plain - moment),
        ]
    }

    fn image(self) -> Image {
        let Self { z0, z1, w0 } = self;
        Image { a: w0 - z1, b: z1 * 2.0 - z0 - w0 * 2.0 }
    }

    #[inline(always)]
    fn image_stress(Image { a, b }: Image, plain: f64, moment: f64) -> [Complex; 3] {
        let falling = b * moment;
        [(a + b * 2.0) * plain - falling, falling - a * plain, -((a + b) * plain - falling).turned()]
    }

    fn on_border([_, yy, xy]: [Complex; 3]) -> [Complex; 2] {
        [xy, yy]
    }

    fn on_front([xx, _, xy]: [Complex; 3]) -> [Complex; 2] {
        [xx, xy]
    }
}
