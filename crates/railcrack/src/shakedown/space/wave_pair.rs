//! Residual stress of a single wave of plastic strain along and across the rail.

use super::super::antiplane::AntiplaneWave;
use super::super::complex::Complex;
use super::super::in_plane::PlaneWave;
use super::super::layer_factors::LayerFactors;
use crate::material::IsotropicElastic;

/// Entries xx, yy, zz, yz, xz, xy of a wave in a layer.
pub(super) type Entries = [Complex; 6];

/// The direction n of a wave: its cosines with x and y.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Direction {
    pub x: f64,
    pub y: f64,
}

/// A wave e^(iκn) through all layers, n horizontal. With t normal to n and to the depth, nothing
/// depends on t: the entries in the plane of n and z are those of a [`PlaneWave`], nt
/// and tz those of an [`AntiplaneWave`], and σ_tt = ν (σ_nn + σ_zz) − E ε_tt.
pub(super) struct WavePair {
    young: f64,
    poisson: f64,
    plane_strain_modulus: f64,
    shear_modulus: f64,
    plane: PlaneWave,
    antiplane: AntiplaneWave,
    /// ε_tt of each layer.
    across: Vec<Complex>,
}

impl WavePair {
    pub(super) fn new(steel: &IsotropicElastic, layers: usize) -> Self {
        Self {
            young: steel.young(),
            poisson: steel.poisson(),
            plane_strain_modulus: steel.plane_strain_modulus(),
            shear_modulus: steel.shear_modulus(),
            plane: PlaneWave::new(layers),
            antiplane: AntiplaneWave::new(layers),
            across: vec![Complex::ZERO; layers],
        }
    }

    /// Stresses (MPa, means over each layer) of the plastic `strains` of a wave in `direction`;
    /// `layers` from the surface down.
    pub(super) fn stresses(
        &mut self,
        layers: &[LayerFactors],
        direction: Direction,
        strains: &[Entries],
        stresses: &mut [Entries],
    ) {
        for (j, strain) in strains.iter().enumerate() {
            self.take(j, direction, strain);
        }
        self.plane.balance(layers);
        self.antiplane.balance(layers);
        for (j, stress) in stresses.iter_mut().enumerate() {
            *stress = self.give(j, direction);
        }
    }

    /// The largest out-of-balance force (MPa) per wave length/2π on a layer or the surface, of the
    /// last stresses.
    pub(super) fn imbalance(&self, layers: &[LayerFactors]) -> f64 {
        let plane = self.plane_strain_modulus * self.plane.imbalance(layers);
        plane.max(self.shear_modulus * self.antiplane.imbalance(layers))
    }

    /// The strain of layer `j` in the axes of the wave.
    #[inline(always)]
    fn take(&mut self, j: usize, Direction { x: c, y: s }: Direction, strain: &Entries) {
        let [xx, yy, zz, yz, xz, xy] = *strain;
        let (cc, ss, cs) = (c * c, s * s, c * s);
        let nn = xx * cc + yy * ss + xy * (2.0 * cs);
        let tt = xx * ss + yy * cc - xy * (2.0 * cs);
        let out = tt * self.poisson;
        // The wave in plane strain counts heights upwards.
        self.plane.strains[j] = [nn + out, zz + out, -(xz * c + yz * s)];
        self.antiplane.strains[j] = [(yy - xx) * cs + xy * (cc - ss), yz * c - xz * s];
        self.across[j] = tt;
    }

    /// The stress of layer `j` in the axes of the rail.
    #[inline(always)]
    fn give(&self, j: usize, Direction { x: c, y: s }: Direction) -> Entries {
        let [nn, zz, nz] = self.plane.stresses[j].map(|own| own * -self.plane_strain_modulus);
        let [nt, tz] = self.antiplane.stresses[j].map(|own| own * self.shear_modulus);
        let (nz, tt) = (-nz, (nn + zz) * self.poisson - self.across[j] * self.young);
        let (cc, ss, cs) = (c * c, s * s, c * s);
        [
            nn * cc + tt * ss - nt * (2.0 * cs),
            nn * ss + tt * cc + nt * (2.0 * cs),
            zz,
            nz * s + tz * c,
            nz * c - tz * s,
            (nn - tt) * cs + nt * (cc - ss),
        ]
    }
}

/// The stress (MPa) of a plastic strain that fills its layer: all waves of length ∞, whatever their
/// direction.
pub(super) fn filled_layer(steel: &IsotropicElastic, [xx, yy, _, _, _, xy]: [f64; 6]) -> [f64; 6] {
    let (modulus, poisson) = (steel.plane_strain_modulus(), steel.poisson());
    let along = -modulus * (xx + poisson * yy);
    let across = -modulus * (yy + poisson * xx);
    [along, across, 0.0, 0.0, 0.0, -2.0 * steel.shear_modulus() * xy]
}
