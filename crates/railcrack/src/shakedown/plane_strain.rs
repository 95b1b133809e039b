//! Elasticity of the rolled rail in plane strain, as its streamlines see it.

use super::eigenstress::{Columns, Eigenstress};
use super::fourier::RailGrid;
use super::streamline::{Driven, Elasticity};
use crate::material::IsotropicElastic;
use pulp::{Arch, Simd, WithSimd};

/// Redistribution in plane strain: σ_xx, σ_yy and σ_xy by waves along the rail, the stress out of
/// plane from the strain in the same place.
pub(super) struct PlaneStrain {
    pub eigenstress: Eigenstress,
    /// σ_xx, σ_yy, σ_xy of the last redistribution, MPa.
    stress: Columns,
    /// Factors of the stress deviator from σ_xx + σ_yy and from ε_zz: √(3/2) (2 ν − 1)/3 and −2
    /// E/3.
    out_of_trace: f64,
    out_of_strain: f64,
}

impl PlaneStrain {
    /// A rail of `steel` on `grid`.
    pub(super) fn new(steel: &IsotropicElastic, grid: &RailGrid) -> Self {
        let size = grid.columns * grid.layers.count();
        Self {
            eigenstress: Eigenstress::new(steel, grid.columns, grid.spacing, grid.layers.clone()),
            stress: [0, 1, 2].map(|_| vec![0.0; size]),
            out_of_trace: 1.5_f64.sqrt() * (2.0 * steel.poisson() - 1.0) / 3.0,
            out_of_strain: -2.0 / 3.0 * steel.young(),
        }
    }
}

impl Elasticity<3> for PlaneStrain {
    fn redistribute(&mut self, strain: &Columns, upstream: &[[f64; 3]]) {
        self.eigenstress.stress(strain, upstream, &mut self.stress);
    }

    fn drive(&self, column: Driven<'_, 3>) {
        Arch::new().dispatch(Drive { elasticity: self, column });
    }
}

/// B and |ξ|² of all layers of a column.
struct Drive<'a> {
    elasticity: &'a PlaneStrain,
    column: Driven<'a, 3>,
}

impl WithSimd for Drive<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        const ROOT_2: f64 = std::f64::consts::SQRT_2;
        let PlaneStrain { out_of_trace, out_of_strain, stress, .. } = self.elasticity;
        let (out_of_trace, out_of_strain) = (*out_of_trace, *out_of_strain);
        let Driven { at, law, background, old, strain, driver, size } = self.column;
        let (stiffness, modulus) = (law.stiffness, law.modulus);
        let n = size.len();
        let [xx, yy, xy] = [0, 1, 2].map(|c| &stress[c][at.clone()][..n]);
        let [b0, b1, b2] = [0, 1, 2].map(|c| &background[c][at.clone()][..n]);
        let [o0, o1, o2] = [0, 1, 2].map(|c| &old[c][at.clone()][..n]);
        let [p0, p1, p2] = [0, 1, 2].map(|c| &strain[c][..n]);
        let [d0, d1, d2] = driver;
        let (d0, d1, d2) = (&mut d0[..n], &mut d1[..n], &mut d2[..n]);
        for j in 0..n {
            d0[j] = (xx[j] - yy[j]) / ROOT_2 + b0[j] + stiffness * o0[j];
            d1[j] = out_of_trace * (xx[j] + yy[j]) + b1[j] + (stiffness + out_of_strain) * o1[j];
            d2[j] = ROOT_2 * xy[j] + b2[j] + stiffness * o2[j];
            let (x0, x1, x2) = (d0[j] - modulus * p0[j], d1[j] - modulus * p1[j], d2[j] - modulus * p2[j]);
            size[j] = x0 * x0 + x1 * x1 + x2 * x2;
        }
    }
}
