//! Return mapping along streamlines, and the steady state that moves with the wheel: the same in
//! the plane and in space.

use crate::interruption::{Interrupted, Interruption};
use crate::material::{IsotropicElastic, KinematicHardening};
use crate::math::Anderson;
use std::array::from_fn;
use std::ops::Range;

/// N components on columns (evenly spaced abscissae) and streamlines: component c of column i and
/// streamline j is at `[c][i · streamlines + j]`.
pub(super) type Field<const N: usize> = [Vec<f64>; N];

/// Elasticity of the rail: the stress of a plastic strain, whose deviators have N coordinates.
pub(super) trait Elasticity<const N: usize> {
    /// Redistributes `strain`, which enters as `upstream` in the last column and leaves by the
    /// first.
    fn redistribute(&mut self, strain: &Field<N>, upstream: &[[f64; N]]);

    /// B and |ξ|² of all streamlines of a column, from the stress of the last redistribution.
    fn drive(&self, column: Driven<'_, N>);
}

/// One column of the fields that drive the flow.
pub(super) struct Driven<'a, const N: usize> {
    /// The column in all fields.
    pub at: Range<usize>,
    pub law: &'a FlowLaw,
    /// Deviators of all stress but that of the plastic strain.
    pub background: &'a Field<N>,
    /// The plastic strain that was redistributed.
    pub old: &'a Field<N>,
    /// The plastic strain that arrives at the column.
    pub strain: &'a Field<N>,
    /// B.
    pub driver: &'a mut Field<N>,
    /// |ξ|².
    pub size: &'a mut [f64],
}

/// Integration of the constitutive law along horizontal streamlines.
///
/// In the frame of the load a material point passes the stresses of its streamline one after the
/// other, d/dt = −V ∂/∂x. With B = s + H ε_p of the previous iterate, which the redistribution
/// leaves unchanged if H is the stiffness of the response of the surroundings, the plastic strain
/// is such that ξ = B − (H + 2 C/3) ε_p stays in the yield ball: return mapping along the normal
/// (Wilkins 1964; Simo & Hughes 1998, Computational Inelasticity, 3.3). At the fixed point B − H
/// ε_p is the stress deviator s itself for any H. Deviators have any number of coordinates in which
/// their Euclidean norm is the Frobenius norm.
#[derive(Debug, Clone, Copy)]
pub(super) struct FlowLaw {
    radius: f64,
    /// H, MPa.
    pub stiffness: f64,
    /// H + 2 C/3, MPa.
    pub modulus: f64,
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
        }
    }

    /// Computes the plastic strain `new` of material points that enter with `upstream` at the last
    /// column, from the plastic strain `old`, which `elasticity` has redistributed, and the
    /// deviators `background` of all other stress. Returns the accumulated plastic strain
    /// √(2/3) ∫ |dε_p| of each streamline.
    pub(super) fn follow<const N: usize>(
        &self,
        elasticity: &impl Elasticity<N>,
        background: &Field<N>,
        old: &Field<N>,
        upstream: &[[f64; N]],
        new: &mut Field<N>,
    ) -> Vec<f64> {
        let streamlines = upstream.len();
        let columns = old[0].len() / streamlines;
        let mut strain: Field<N> = from_fn(|c| upstream.iter().map(|u| u[c]).collect());
        let zeros = || from_fn(|_| vec![0.0; streamlines]);
        let (mut before, mut here): (Field<N>, Field<N>) = (zeros(), zeros());
        let mut size = vec![0.0; streamlines];
        let mut path = vec![0.0; streamlines];
        for i in (0..columns).rev() {
            let column = i * streamlines..(i + 1) * streamlines;
            elasticity.drive(Driven {
                at: column.clone(),
                law: self,
                background,
                old,
                strain: &strain,
                driver: &mut here,
                size: &mut size,
            });
            for j in 0..streamlines {
                if size[j] > self.radius * self.radius {
                    let to: [f64; N] = from_fn(|c| here[c][j]);
                    let from = if i + 1 == columns { to } else { from_fn(|c| before[c][j]) };
                    let mut flowing = from_fn(|c| strain[c][j]);
                    path[j] += self.flow(from, to, &mut flowing);
                    for c in 0..N {
                        strain[c][j] = flowing[c];
                    }
                }
            }
            std::mem::swap(&mut before, &mut here);
            for c in 0..N {
                new[c][column.clone()].copy_from_slice(&strain[c]);
            }
        }
        path
    }

    /// Plastic flow on the straight path of the driving variable B; returns the accumulated plastic
    /// strain.
    fn flow<const N: usize>(&self, from: [f64; N], to: [f64; N], strain: &mut [f64; N]) -> f64 {
        let mut path = 0.0;
        for part in 1..=PARTS {
            let t = part as f64 / PARTS as f64;
            let xi: [f64; N] = from_fn(|c| from[c] + t * (to[c] - from[c]) - self.modulus * strain[c]);
            let size = xi.iter().map(|x| x * x).sum::<f64>().sqrt();
            if size > self.radius {
                let step = (size - self.radius) / (self.modulus * size);
                for c in 0..N {
                    strain[c] += step * xi[c];
                }
                path += step * size;
            }
        }
        (2.0 / 3.0_f64).sqrt() * path
    }
}

/// Steady state of one passage: stress and plastic strain around the load, which are constant in
/// its frame.
#[derive(Debug, Clone)]
pub(super) struct SteadyPassage<const N: usize> {
    /// Plastic strain in coordinates of a deviator.
    pub strain: Field<N>,
    /// The entering plastic strain by streamline.
    pub entering: Vec<[f64; N]>,
    /// √(2/3) ∫ |dε_p| of each streamline.
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
pub(super) struct SteadyProblem<E, const N: usize> {
    pub elasticity: E,
    pub law: FlowLaw,
    /// Stress deviators of wheel and initial residual stress, MPa.
    pub background: Field<N>,
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

impl<E: Elasticity<N>, const N: usize> SteadyProblem<E, N> {
    /// Alternates redistribution and return mapping from `start` until the plastic strain repeats,
    /// or until `max_iterations`; `entering` is the plastic strain upstream, by streamline.
    ///
    /// Errors: an interruption.
    pub(super) fn solve(
        &mut self,
        start: Field<N>,
        entering: &[[f64; N]],
        upstream: Upstream,
        interruption: Interruption<'_>,
    ) -> Result<SteadyPassage<N>, Interrupted> {
        let streamlines = entering.len();
        let mut entering = entering.to_vec();
        let mut strain = start;
        if upstream == Upstream::Given {
            for (c, component) in strain.iter_mut().enumerate() {
                for (at, value) in component.iter_mut().enumerate().skip(self.active.end * streamlines) {
                    *value = entering[at % streamlines][c];
                }
            }
        }
        let mut image = strain.clone();
        let mut anderson = Anderson::new(DEPTH);
        let mut iterations = 0;
        loop {
            interruption.check()?;
            iterations += 1;
            if upstream == Upstream::Downstream {
                entering = first_column(&strain, streamlines);
            }
            self.elasticity.redistribute(&strain, &entering);
            let path = self.law.follow(&self.elasticity, &self.background, &strain, &entering, &mut image);
            let change = largest_difference(&image, &strain) * self.strain_scale;
            if change <= self.tolerance || iterations >= self.max_iterations || !change.is_finite() {
                return Ok(SteadyPassage { strain: image, entering, path, iterations, change });
            }
            self.extrapolate(&mut anderson, &mut strain, &image, streamlines);
        }
    }

    /// The next iterate, from the last one and its image.
    fn extrapolate(
        &self,
        anderson: &mut Anderson,
        strain: &mut Field<N>,
        image: &Field<N>,
        streamlines: usize,
    ) {
        let active = self.active.start * streamlines..self.active.end * streamlines;
        let part = |field: &Field<N>| -> Vec<f64> {
            field.iter().flat_map(|component| &component[active.clone()]).copied().collect()
        };
        let mut next = part(strain);
        let residual: Vec<f64> = part(image).iter().zip(&next).map(|(g, x)| g - x).collect();
        anderson.advance(&mut next, &residual);
        for (c, values) in next.chunks_exact(active.len()).enumerate() {
            strain[c][active.clone()].copy_from_slice(values);
            strain[c][active.end..].copy_from_slice(&image[c][active.end..]);
            // Downstream of the active columns the extrapolated strain continues like its image
            // under the iteration.
            for at in (0..active.start).rev() {
                strain[c][at] = strain[c][at + streamlines] + (image[c][at] - image[c][at + streamlines]);
            }
        }
    }
}

/// The strain of the first column, by streamline.
pub(super) fn first_column<const N: usize>(strain: &Field<N>, streamlines: usize) -> Vec<[f64; N]> {
    (0..streamlines).map(|j| from_fn(|c| strain[c][j])).collect()
}

/// Largest Frobenius norm of a − b; NaN if either contains one.
fn largest_difference<const N: usize>(a: &Field<N>, b: &Field<N>) -> f64 {
    let mut largest = 0.0_f64;
    for at in 0..a[0].len() {
        let square: f64 = (0..N).map(|c| (a[c][at] - b[c][at]) * (a[c][at] - b[c][at])).sum();
        // `max` would ignore NaN.
        if square.is_nan() {
            return f64::NAN;
        }
        largest = largest.max(square);
    }
    largest.sqrt()
}
