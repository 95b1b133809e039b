//! Return mapping along streamlines, and the steady state that moves with the wheel.

use super::eigenstress::{Columns, Eigenstress};
use crate::interruption::{Interrupted, Interruption};
use crate::material::{IsotropicElastic, KinematicHardening};
use crate::math::Anderson;
use pulp::{Arch, Simd, WithSimd};
use std::ops::Range;

/// Integration of the constitutive law along horizontal streamlines.
///
/// In the frame of the load a material point passes the stresses of its layer one after the other,
/// d/dt = −V ∂/∂x. With B = s + H ε_p of the previous iterate, which the redistribution leaves
/// unchanged if H is the stiffness of the response of the surroundings, the plastic strain is such
/// that ξ = B − (H + 2 C/3) ε_p stays in the yield ball: return mapping along the normal (Wilkins
/// 1964; Simo & Hughes 1998, Computational Inelasticity, 3.3). At the fixed point B − H ε_p is the
/// stress deviator s itself for any H.
#[derive(Debug, Clone, Copy)]
pub(super) struct FlowLaw {
    radius: f64,
    /// H, MPa.
    stiffness: f64,
    /// H + 2 C/3, MPa.
    modulus: f64,
    /// Factors of the stress deviator from σ_xx + σ_yy and from ε_zz: √(3/2) (2 ν − 1)/3 and −2
    /// E/3.
    out_of_trace: f64,
    out_of_strain: f64,
}

/// H over 2 G. The redistribution has stiffnesses from 0 (a shear that the surroundings follow) to
/// 2 G (which they do not follow at all): half of this is the constant with the best convergence in
/// the worse of the two limits.
const STIFFNESS: f64 = 0.5;

/// Substeps of the interval between columns in which there is plastic flow; the path within an
/// interval is straight. See `docs/dev/shakedown.md` for the effect of substeps and columns.
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

    /// Computes the plastic strain `new` of material points that enter with `upstream` at the last
    /// column, from the plastic strain `old`, its residual `stress` and the deviators `background`
    /// of all other stress. Returns the accumulated plastic strain √(2/3) ∫ |dε_p| of each layer.
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
        let mut strain = [0, 1, 2].map(|c| upstream.iter().map(|u| u[c]).collect::<Vec<f64>>());
        let zeros = || [vec![0.0; layers], vec![0.0; layers], vec![0.0; layers]];
        let (mut before, mut here) = (zeros(), zeros());
        let mut size = vec![0.0; layers];
        let mut path = vec![0.0; layers];
        for i in (0..columns).rev() {
            let column = i * layers..(i + 1) * layers;
            Arch::new().dispatch(Drive {
                law: self,
                stress: part(stress, column.clone()),
                background: part(background, column.clone()),
                old: part(old, column.clone()),
                strain: part(&strain, 0..layers),
                driver: &mut here,
                size: &mut size,
            });
            for j in 0..layers {
                if size[j] > self.radius * self.radius {
                    let to = [0, 1, 2].map(|c| here[c][j]);
                    let from = if i + 1 == columns { to } else { [0, 1, 2].map(|c| before[c][j]) };
                    let mut flowing = [0, 1, 2].map(|c| strain[c][j]);
                    path[j] += self.flow(from, to, &mut flowing);
                    for c in 0..3 {
                        strain[c][j] = flowing[c];
                    }
                }
            }
            std::mem::swap(&mut before, &mut here);
            for c in 0..3 {
                new[c][column.clone()].copy_from_slice(&strain[c]);
            }
        }
        path
    }

    /// Plastic flow on the straight path of the driving variable B; returns the accumulated plastic
    /// strain.
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

/// One column of a field.
fn part(field: &Columns, column: Range<usize>) -> [&[f64]; 3] {
    [0, 1, 2].map(|c| &field[c][column.clone()])
}

/// B and |ξ|² of all layers of a column.
struct Drive<'a> {
    law: &'a FlowLaw,
    stress: [&'a [f64]; 3],
    background: [&'a [f64]; 3],
    old: [&'a [f64]; 3],
    strain: [&'a [f64]; 3],
    driver: &'a mut Columns,
    size: &'a mut [f64],
}

impl WithSimd for Drive<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        const ROOT_2: f64 = std::f64::consts::SQRT_2;
        let FlowLaw { stiffness, modulus, out_of_trace, out_of_strain, .. } = *self.law;
        let n = self.size.len();
        let [xx, yy, xy] = self.stress.map(|s| &s[..n]);
        let [b0, b1, b2] = self.background.map(|s| &s[..n]);
        let [o0, o1, o2] = self.old.map(|s| &s[..n]);
        let [p0, p1, p2] = self.strain.map(|s| &s[..n]);
        let [d0, d1, d2] = self.driver;
        let (d0, d1, d2) = (&mut d0[..n], &mut d1[..n], &mut d2[..n]);
        for j in 0..n {
            d0[j] = (xx[j] - yy[j]) / ROOT_2 + b0[j] + stiffness * o0[j];
            d1[j] = out_of_trace * (xx[j] + yy[j]) + b1[j] + (stiffness + out_of_strain) * o1[j];
            d2[j] = ROOT_2 * xy[j] + b2[j] + stiffness * o2[j];
            let (x0, x1, x2) = (d0[j] - modulus * p0[j], d1[j] - modulus * p1[j], d2[j] - modulus * p2[j]);
            self.size[j] = x0 * x0 + x1 * x1 + x2 * x2;
        }
    }
}

/// Steady state of one passage: stress and plastic strain around the load, which are constant in
/// its frame.
#[derive(Debug, Clone)]
pub(super) struct SteadyPassage {
    /// Plastic strain in coordinates of a deviator.
    pub strain: Columns,
    /// The entering plastic strain by layer.
    pub entering: Vec<[f64; 3]>,
    /// √(2/3) ∫ |dε_p| of each layer.
    pub path: Vec<f64>,
    /// Number of elastic redistributions.
    pub iterations: usize,
    /// Largest change of the plastic strain in the last of them, times 2 G over the radius of the
    /// yield surface.
    pub change: f64,
}

/// The plastic strain that enters the passage.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Upstream {
    /// A given strain.
    Given,
    /// The strain that leaves, for a periodic passage.
    Downstream,
}

/// The data that are common to all passages.
pub(super) struct SteadyProblem {
    pub eigenstress: Eigenstress,
    pub law: FlowLaw,
    /// Stress deviators of wheel and initial residual stress, MPa.
    pub background: Columns,
    /// Columns around the contact in which the extrapolation acts; the values outside follow from
    /// these.
    pub active: Range<usize>,
    /// 2 G over the radius of the yield surface.
    pub strain_scale: f64,
    /// Change at or below which the iteration ends.
    pub tolerance: f64,
    /// Largest number of redistributions.
    pub max_iterations: usize,
}

/// Number of iterates that Anderson's extrapolation combines; with 4 to 10 the number of
/// redistributions is about the same.
const DEPTH: usize = 6;

impl SteadyProblem {
    /// Alternates redistribution and return mapping from `start` until the plastic strain repeats,
    /// or until `max_iterations`; `entering` is the plastic strain upstream, by layer.
    ///
    /// Errors: an interruption.
    pub(super) fn solve(
        &mut self,
        start: Columns,
        entering: &[[f64; 3]],
        upstream: Upstream,
        interruption: Interruption<'_>,
    ) -> Result<SteadyPassage, Interrupted> {
        let layers = entering.len();
        let mut entering = entering.to_vec();
        let mut strain = start;
        if upstream == Upstream::Given {
            for c in 0..3 {
                for at in self.active.end * layers..strain[c].len() {
                    strain[c][at] = entering[at % layers][c];
                }
            }
        }
        let mut image = strain.clone();
        let mut stress = strain.clone();
        let mut anderson = Anderson::new(DEPTH);
        let mut iterations = 0;
        loop {
            interruption.check()?;
            iterations += 1;
            if upstream == Upstream::Downstream {
                entering = first_column(&strain, layers);
            }
            self.eigenstress.stress(&strain, &entering, &mut stress);
            let path = self.law.follow(&stress, &self.background, &strain, &entering, &mut image);
            let change = largest_difference(&image, &strain) * self.strain_scale;
            if change <= self.tolerance || iterations >= self.max_iterations || !change.is_finite() {
                return Ok(SteadyPassage { strain: image, entering, path, iterations, change });
            }
            let active = self.active.start * layers..self.active.end * layers;
            let part = |field: &Columns| -> Vec<f64> {
                field.iter().flat_map(|component| &component[active.clone()]).copied().collect()
            };
            let mut next = part(&strain);
            let residual: Vec<f64> = part(&image).iter().zip(&next).map(|(g, x)| g - x).collect();
            anderson.advance(&mut next, &residual);
            for (c, values) in next.chunks_exact(active.len()).enumerate() {
                strain[c][active.clone()].copy_from_slice(values);
                strain[c][active.end..].copy_from_slice(&image[c][active.end..]);
                // Downstream of the active columns the extrapolated strain continues like its image
                // under the iteration.
                for at in (0..active.start).rev() {
                    strain[c][at] = strain[c][at + layers] + (image[c][at] - image[c][at + layers]);
                }
            }
        }
    }
}

/// The strain of the first column, by layer.
pub(super) fn first_column(strain: &Columns, layers: usize) -> Vec<[f64; 3]> {
    (0..layers).map(|j| [0, 1, 2].map(|c| strain[c][j])).collect()
}

/// Largest Frobenius norm of a − b; NaN if either contains one.
fn largest_difference(a: &Columns, b: &Columns) -> f64 {
    let mut largest = 0.0_f64;
    for at in 0..a[0].len() {
        let d = [0, 1, 2].map(|c| a[c][at] - b[c][at]);
        let square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        // `max` would ignore NaN.
        if square.is_nan() {
            return f64::NAN;
        }
        largest = largest.max(square);
    }
    largest.sqrt()
}
