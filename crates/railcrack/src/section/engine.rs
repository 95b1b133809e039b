//! Cracked bodies in a rail with head, web and foot.

use super::layers::SectionLayers;
use super::modes::{Amplitude, Support, reflection, wave_numbers};
use crate::body::{BodyEngine, BodyError, CrackedBody, FaceMesh};
use crate::crack::CrackNetwork;
use crate::interruption::{Interrupted, Interruption};
use crate::linear::{LinearError, product, spd_inverse};
use crate::material::IsotropicElastic;
use crate::math::{Matrix, OutOfRange, Vec2};
use thiserror::Error;

/// Cracks that the section of a rail does not hold.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SectionError {
    /// A crack below the part of the head in which the reflected waves are resolved.
    #[error("a crack is {depth:.2} mm deep; in the section of the rail, cracks are computed to {limit:.2} mm, {:.0} % of the head", 100.0 * SectionEngine::DEEPEST)]
    BelowHead {
        /// Depth of the deepest point, mm.
        depth: f64,
        /// Largest depth, mm.
        limit: f64,
    },
    /// The compliance cannot be computed.
    #[error("the compliance of the rail with its section: {0}")]
    Unresolved(#[from] LinearError),
    /// Interrupted on request.
    #[error("{0}")]
    Interrupted(#[from] Interrupted),
}

/// An engine of cracks in a half-plane, with its bodies in a rail of finite section: head, web and
/// foot as [`SectionLayers`], on a foundation.
///
/// A becomes A − U Q Uᵀ, with U the nodal forces of the waves and Q their reflection, both for all
/// wave numbers; C = A⁻¹, and K = S f with the forces f that the half-plane would need for the same
/// jumps. The kernel of Q is regular, so that K² (1 − ν²)/E stays the energy release.
pub struct SectionEngine {
    engine: Box<dyn BodyEngine + Send>,
    steel: IsotropicElastic,
    layers: SectionLayers,
    foundation: f64,
}

impl SectionEngine {
    /// Largest depth of a crack over the height of the head.
    pub const DEEPEST: f64 = 0.95;

    /// The half-plane `engine` for rails of `layers` and `steel` on a `foundation` (N/mm per mm of
    /// deflection of one rail, 0 for a free rail).
    ///
    /// Errors: layers without extent, a negative foundation modulus.
    pub fn new(
        engine: Box<dyn BodyEngine + Send>,
        steel: IsotropicElastic,
        layers: SectionLayers,
        foundation: f64,
    ) -> Result<Self, OutOfRange> {
        layers.check()?;
        let stands = foundation.is_finite() && foundation >= 0.0;
        OutOfRange::unless(stands, "foundation modulus k (N/mm\u{b2})", foundation, "zero or positive")?;
        Ok(Self { engine, steel, layers, foundation })
    }

    /// U Q Uᵀ for the points of `faces`.
    fn reflected(&self, faces: &FaceMesh, interruption: Interruption<'_>) -> Result<Matrix, SectionError> {
        let points = || faces.points.iter().map(|point| point.position);
        let samples = || faces.samples.iter().map(|sample| sample.point);
        let of = |value: fn(Vec2) -> f64| points().chain(samples()).map(value);
        let depth = of(|point| -point.y).fold(0.0, f64::max);
        let limit = SectionEngine::DEEPEST * self.layers.head.height;
        if depth > limit {
            return Err(SectionError::BelowHead { depth, limit });
        }
        let (left, right) = (
            of(|point| point.x).fold(f64::INFINITY, f64::min),
            of(|point| point.x).fold(f64::NEG_INFINITY, f64::max),
        );
        let middle = 0.5 * (left + right);
        let waves = wave_numbers(&self.layers, self.layers.head.height - depth, right - left);
        let size = 2 * faces.points.len();
        let mut work = Matrix::zeros(4 * waves.len(), size);
        let mut amplitudes = Matrix::zeros(4 * waves.len(), size);
        let support = Support { steel: &self.steel, foundation: self.foundation };
        for (i, &(k, weight)) in waves.iter().enumerate() {
            interruption.check()?;
            let q = reflection(k, &self.layers, support);
            // The phase is counted from the middle of the cracks.
            let field = |point: Vec2, mode: usize, wave: usize| {
                let amplitude = Amplitude::below_free_surface(k, -point.y, self.layers.head.height)[mode];
                amplitude.stress(k, point - Vec2::new(middle, 0.0))[wave]
            };
            for wave in [0, 1] {
                let row = 4 * i + 2 * wave;
                for mode in [0, 1] {
                    let forces = faces.nodal_forces(|point| field(point, mode, wave));
                    work.row_mut(row + mode).copy_from_slice(&forces);
                }
                for column in 0..size {
                    let [one, two] = [work[(row, column)], work[(row + 1, column)]];
                    for mode in [0, 1] {
                        amplitudes[(row + mode, column)] = weight * (q[mode][0] * one + q[mode][1] * two);
                    }
                }
            }
        }
        Ok(product(&work.transposed(), &amplitudes)?)
    }

    /// `body` of the half-plane in the rail.
    fn in_section(
        &self,
        body: CrackedBody,
        interruption: Interruption<'_>,
    ) -> Result<CrackedBody, SectionError> {
        let reflected = self.reflected(&body.faces, interruption)?;
        let size = reflected.rows();
        let entry = |i: usize, j: usize| {
            let reflected = 0.5 * (reflected[(i, j)] + reflected[(j, i)]);
            0.5 * (body.stiffness[(i, j)] + body.stiffness[(j, i)]) - reflected
        };
        let stiffness = Matrix::from_fn(size, size, entry);
        let compliance = spd_inverse(&stiffness)?;
        let gains = product(&body.sif_influence, &body.stiffness)?;
        let sif_influence = product(&gains, &compliance)?;
        Ok(CrackedBody { compliance, stiffness, sif_influence, fields: None, ..body })
    }
}

impl BodyEngine for SectionEngine {
    fn body_unless(
        &mut self,
        interruption: Interruption<'_>,
        network: &CrackNetwork,
    ) -> Result<CrackedBody, BodyError> {
        let body = self.engine.body_unless(interruption, network)?;
        self.in_section(body, interruption).map_err(|reason| BodyError { reason: Box::new(reason) })
    }

    fn resolution(&self, network: &CrackNetwork) -> f64 {
        self.engine.resolution(network)
    }

    fn forget(&mut self) {
        self.engine.forget();
    }
}
