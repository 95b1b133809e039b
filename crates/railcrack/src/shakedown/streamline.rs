//! Plastic flow along the streamlines.

use super::eigenstress::Columns;
use crate::material::{IsotropicElastic, KinematicHardening};

/// The law of the material along horizontal streamlines.
///
/// In the frame of the load a particle meets the stresses of its layer one after the other, d/dt = −V ∂/∂x. With
/// B = s + H ε_p of the iterate before, which is what the redistribution leaves alone if H is the stiffness with which
/// the surroundings answer, the plastic strain is such that ξ = B − (H + 2 C/3) ε_p stays in the yield ball: the return along
/// the normal (Wilkins 1964; Simo & Hughes 1998, Computational Inelasticity, 3.3). At the fixed point B − H ε_p is the
/// deviator s itself, whatever H.
#[derive(Debug, Clone, Copy)]
pub(super) struct FlowLaw {
    radius: f64,
    /// H, MPa.
    stiffness: f64,
    /// H + 2 C/3, MPa.
    modulus: f64,
    /// Deviator from σ_xx + σ_yy and from ε_zz: √(3/2) (2 ν − 1)/3 and −2 E/3.
    out_of_trace: f64,
    out_of_strain: f64,
}

/// H over 2 G. The redistribution has stiffnesses from 0 (a shear that the surroundings follow) to 2 G (none do): half of it
/// is the constant for which the worse of the two ends converges best.
const STIFFNESS: f64 = 0.5;

/// Parts of a step between columns in which there is plastic flow; the path is straight in between. See `docs/shakedown.md`
/// for what they and the columns change.
const PARTS: usize = 4;

impl FlowLaw {
    pub(super) fn new(steel: &IsotropicElastic, hardening: &KinematicHardening) -> Self {
        let stiffness = STIFFNESS * 2.0 * steel.shear_modulus();
        Self {
            radius: hardening.yield_radius(),
            stiffness,
            modulus: stiffness + hardening.back_stress_modulus(),
            out_of_trace: 1.5_f64.sqrt() * (2.0 * steel.poisson() - 1.0) / 3.0,
            out_of_strain: -2.0 / 3.0 * steel.young(),
        }
    }

    /// The deviator of the residual stress with in-plane components `stress` of the plastic strain `strain`.
    #[inline(always)]
    pub(super) fn deviator(&self, [xx, yy, xy]: [f64; 3], strain: [f64; 3]) -> [f64; 3] {
        const ROOT_2: f64 = std::f64::consts::SQRT_2;
        [
            (xx - yy) / ROOT_2,
            self.out_of_trace * (xx + yy) + self.out_of_strain * strain[1],
            ROOT_2 * xy,
        ]
    }

    /// From the plastic strain `old`, its residual `stress` and the deviators `background` of all other stress: the
    /// plastic strain `new` of particles that enter with `upstream` at the last column. Returns the length of the plastic
    /// path √(2/3) ∫ |dε_p| of each layer.
    pub(super) fn follow(
        &self,
        stress: &Columns,
        background: &Columns,
        old: &Columns,
        upstream: &[[f64; 3]],
        new: &mut Columns,
    ) -> Vec<f64> {
        let layers = upstream.len();
        let columns = old[0].len() / layers;
        let mut strain = upstream.to_vec();
        let mut before = vec![[0.0; 3]; layers];
        let mut path = vec![0.0; layers];
        for i in (0..columns).rev() {
            for j in 0..layers {
                let at = i * layers + j;
                let was = [old[0][at], old[1][at], old[2][at]];
                let residual = self.deviator([stress[0][at], stress[1][at], stress[2][at]], was);
                let driver = [0, 1, 2].map(|c| residual[c] + background[c][at] + self.stiffness * was[c]);
                if self.overshoot(driver, strain[j]) > 0.0 {
                    let from = if i + 1 == columns { driver } else { before[j] };
                    path[j] += self.flow(from, driver, &mut strain[j]);
                }
                before[j] = driver;
                for c in 0..3 {
                    new[c][at] = strain[j][c];
                }
            }
        }
        path
    }

    /// |ξ| − R.
    #[inline(always)]
    fn overshoot(&self, driver: [f64; 3], strain: [f64; 3]) -> f64 {
        let xi = [0, 1, 2].map(|c| driver[c] - self.modulus * strain[c]);
        (xi[0] * xi[0] + xi[1] * xi[1] + xi[2] * xi[2]).sqrt() - self.radius
    }

    /// Flow on the straight path of the driver; returns the length of the plastic path.
    fn flow(&self, from: [f64; 3], to: [f64; 3], strain: &mut [f64; 3]) -> f64 {
        let mut path = 0.0;
        for part in 1..=PARTS {
            let t = part as f64 / PARTS as f64;
            let xi = [0, 1, 2].map(|c| from[c] + t * (to[c] - from[c]) - self.modulus * strain[c]);
            let size = (xi[0] * xi[0] + xi[1] * xi[1] + xi[2] * xi[2]).sqrt();
            if size > self.radius {
                let step = (size - self.radius) / (self.modulus * size);
                for c in 0..3 {
                    strain[c] += step * xi[c];
                }
                path += step * size;
            }
        }
        (2.0 / 3.0_f64).sqrt() * path
    }
}
