//! The contact problem of the faces of a body: unknowns, statuses and the states that are reported.

use super::wheel_surface::SurfaceSystem;
use super::{FaceFluid, PocketState, WheelSurface};
use crate::body::{CrackedBody, FacePoint};
use crate::fracture::Sif;
use crate::linear::LinearError;
use crate::math::{Matrix, dot};
use crate::words::{Choice, Word};
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Contact status of a face point; the sign of slip is that of s12.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PointStatus {
    /// No contact.
    Open,
    /// Contact, no slip.
    Stick,
    /// Contact, slip towards +x1: s12 = +μ |s22|.
    SlipForward,
    /// Contact, slip towards −x1: s12 = −μ |s22|.
    SlipBackward,
}

impl PointStatus {
    /// Whether the faces touch.
    pub(crate) fn is_closed(self) -> bool {
        self != Self::Open
    }

    /// The status of an open point that touches, having moved by `along` while it closed by
    /// `closing` > 0. It fulfils the contact conditions along this motion for equal stiffnesses in
    /// shear and pressure.
    pub(super) fn of_touching(along: f64, closing: f64, friction: f64) -> Self {
        if friction > 0.0 && along.abs() <= friction * closing {
            Self::Stick
        } else if along >= 0.0 {
            Self::SlipForward
        } else {
            Self::SlipBackward
        }
    }

    /// The direction of slip: +1, −1, or 0 without slip.
    pub(crate) fn direction(self) -> f64 {
        match self {
            Self::SlipForward => 1.0,
            Self::SlipBackward => -1.0,
            Self::Open | Self::Stick => 0.0,
        }
    }
}

/// Invalid crack-face friction.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum CrackFrictionError {
    /// A number of coefficients that differs from the number of cracks.
    #[error("{given} coefficients of crack-face friction: must be one for each of {cracks} cracks")]
    Count {
        /// The number given.
        given: usize,
        /// The number of cracks in the body.
        cracks: usize,
    },
    /// An inadmissible coefficient.
    #[error("crack-face friction of crack {crack} = {value}: must be finite and not negative")]
    Value {
        /// Number of the crack, from 1.
        crack: usize,
        /// The value given.
        value: f64,
    },
}

/// Unilateral contact with Coulomb friction at the face points of a body.
pub struct FaceProblem<'a> {
    body: &'a CrackedBody,
    friction: Vec<f64>,
    fluid: Option<FaceFluid>,
    /// Volume (mm²/MPa) that a unit pressure on free faces produces in each pocket whose pressure
    /// is an unknown.
    pub(super) free_volumes: Vec<f64>,
    wheel: Option<SurfaceSystem>,
}

impl<'a> FaceProblem<'a> {
    /// `crack_friction[crack]` is the crack-face friction μ_c ≥ 0 of each crack of the body.
    ///
    /// Errors: a number of coefficients that differs from the number of cracks; a negative or
    /// infinite coefficient.
    pub fn new(body: &'a CrackedBody, crack_friction: &[f64]) -> Result<Self, CrackFrictionError> {
        let points = &body.faces.points;
        let cracks = points.iter().map(|point| point.crack + 1).max().unwrap_or(0);
        if crack_friction.len() != cracks {
            return Err(CrackFrictionError::Count { given: crack_friction.len(), cracks });
        }
        let refused = crack_friction.iter().position(|mu| !(*mu >= 0.0 && mu.is_finite()));
        if let Some(crack) = refused {
            return Err(CrackFrictionError::Value { crack: crack + 1, value: crack_friction[crack] });
        }
        let friction = points.iter().map(|point| crack_friction[point.crack]).collect();
        Ok(Self { body, friction, fluid: None, free_volumes: Vec::new(), wheel: None })
    }

    /// This problem with `fluid` in the cracks.
    #[must_use]
    pub fn with_fluid(self, fluid: Option<FaceFluid>) -> Self {
        let mut wet = Self { fluid, ..self };
        let compliance = &wet.body.compliance;
        wet.free_volumes =
            wet.pockets().iter().map(|pocket| dot(&pocket.unit, &compliance.times(&pocket.unit))).collect();
        wet.extended()
    }

    /// This problem, whose fluid is known, under a wheel that feels the cracks, with the running
    /// `surface` under it.
    ///
    /// Errors: a surface without a solution of its contact.
    pub fn with_wheel(self, surface: Option<WheelSurface>) -> Result<Self, LinearError> {
        let stiffness = &self.body.stiffness;
        let wheel = surface.map(|surface| SurfaceSystem::new(surface, stiffness)).transpose()?;
        Ok(Self { wheel, ..self }.extended())
    }

    /// This problem with forces of pockets that have an entry for every component.
    fn extended(mut self) -> Self {
        let components = self.components();
        for pocket in self.fluid.iter_mut().flat_map(|fluid| &mut fluid.pockets) {
            pocket.unit.resize(components, 0.0);
            pocket.profile.resize(components, 0.0);
        }
        self
    }

    /// Whether the pressures of a wheel that feels the cracks over their mouths act on the fluid in
    /// them, and are given.
    pub(crate) fn has_given_mouth_pressures(&self) -> bool {
        self.wheel.is_some() && self.fluid.is_some()
    }

    /// The wheel, if it feels the cracks.
    pub(crate) fn wheel(&self) -> Option<&SurfaceSystem> {
        self.wheel.as_ref()
    }

    /// Number of components of the problem: 2p, and those of a wheel that feels the cracks.
    pub(crate) fn components(&self) -> usize {
        self.wheel.as_ref().map_or(2 * self.points(), |wheel| wheel.columns.rows())
    }

    /// Transposed matrix of all components.
    pub(super) fn columns(&self) -> &Matrix {
        self.wheel.as_ref().map_or(&self.body.stiffness, |wheel| &wheel.columns)
    }

    /// The fluid in the cracks, if any.
    pub(crate) fn fluid(&self) -> Option<&FaceFluid> {
        self.fluid.as_ref()
    }

    /// The body.
    pub fn body(&self) -> &'a CrackedBody {
        self.body
    }

    /// Number of face points p.
    pub fn points(&self) -> usize {
        self.friction.len()
    }

    /// μ_c of face point `point`.
    pub fn friction(&self, point: usize) -> f64 {
        self.friction[point]
    }

    /// Whether any face point has friction: only then does the history matter.
    pub(crate) fn has_friction(&self) -> bool {
        self.friction.iter().any(|&mu| mu > 0.0)
    }

    pub(super) fn stiffness(&self) -> &'a Matrix {
        &self.body.stiffness
    }
}

/// The equilibrium and contact state of the faces after a load step.
#[derive(Debug, Default, PartialEq)]
pub struct FaceSolution {
    /// ⟦w⟧, mm: `[2 j]` slip, `[2 j + 1]` opening of point j. Further entries belong to a wheel
    /// that feels the cracks.
    pub jump: Vec<f64>,
    /// Contact forces on the + faces, N/mm, same order: s22 = −force / weight. Further entries
    /// belong to a wheel that feels the cracks.
    pub contact: Vec<f64>,
    /// Status of each point.
    pub status: Vec<PointStatus>,
    /// Whether each node of a coupled wheel is in contact; empty while the wheel is not coupled.
    pub loaded: Vec<bool>,
    /// The fluid of each pocket whose pressure is an unknown.
    pub fluid: Vec<PocketState>,
}

impl Clone for FaceSolution {
    fn clone(&self) -> Self {
        let Self { jump, contact, status, loaded, fluid } = self;
        Self {
            jump: jump.clone(),
            contact: contact.clone(),
            status: status.clone(),
            loaded: loaded.clone(),
            fluid: fluid.clone(),
        }
    }

    /// Reuses the memory of `self`, because each load step copies some solutions.
    fn clone_from(&mut self, source: &Self) {
        self.jump.clone_from(&source.jump);
        self.contact.clone_from(&source.contact);
        self.status.clone_from(&source.status);
        self.loaded.clone_from(&source.loaded);
        self.fluid.clone_from(&source.fluid);
    }
}

impl FaceSolution {
    /// Unloaded virgin faces that just touch, dry.
    pub(crate) fn virgin(points: usize) -> Self {
        Self {
            jump: vec![0.0; 2 * points],
            contact: vec![0.0; 2 * points],
            status: vec![PointStatus::Stick; points],
            loaded: Vec::new(),
            fluid: Vec::new(),
        }
    }

    /// Virgin faces of `problem`, with the mouths of all pockets free.
    pub(super) fn virgin_of(problem: &FaceProblem) -> Self {
        let mut virgin = Self::virgin(problem.points());
        virgin.jump.resize(problem.components(), 0.0);
        virgin.contact.resize(problem.components(), 0.0);
        Self { fluid: vec![PocketState::FREE; problem.pockets().len()], ..virgin }
    }

    /// The stress intensity factors of each tip under the nodal forces `load` (N/mm, 2p) of the
    /// step, including those of the fluid.
    #[must_use]
    pub fn sifs(&self, body: &CrackedBody, load: &[f64]) -> Vec<Sif> {
        let influence = &body.sif_influence;
        let faces = self.contact.iter().zip(load).take(influence.columns());
        let total: Vec<f64> = faces.map(|(c, l)| c + l).collect();
        let row = |i: usize| dot(influence.row(i), &total);
        (0..influence.rows() / 2).map(|tip| Sif { ki: row(2 * tip), kii: row(2 * tip + 1) }).collect()
    }

    /// The state of each face point in terms of stresses.
    #[must_use]
    pub fn face_states(&self, problem: &FaceProblem) -> Vec<FaceState> {
        let state = |(j, point): (usize, &FacePoint)| {
            let status = match self.status[j] {
                PointStatus::Open => FaceStatus::Open,
                PointStatus::Stick => FaceStatus::Stick,
                PointStatus::SlipForward | PointStatus::SlipBackward => FaceStatus::Slip,
            };
            FaceState {
                opening: self.jump[2 * j + 1],
                slip: self.jump[2 * j],
                s22: -self.contact[2 * j + 1] / point.weight,
                s12: -self.contact[2 * j] / point.weight,
                status,
            }
        };
        problem.body.faces.points.iter().enumerate().map(state).collect()
    }

    /// The largest violation of the contact conditions: negative opening relative to `scale.jump`;
    /// tension, shear beyond friction, or force across an opening relative to `scale.force`.
    #[must_use]
    pub(crate) fn violation(&self, problem: &FaceProblem, scale: FaceScale) -> f64 {
        let of_wheel = match problem.wheel() {
            Some(wheel) if !self.loaded.is_empty() => wheel.violation(&self.jump, &self.contact),
            _ => 0.0,
        };
        (0..problem.points()).fold(of_wheel, |worst, j| {
            let (tangential, normal) =
                (self.contact[2 * j] / scale.force, self.contact[2 * j + 1] / scale.force);
            let opening = self.jump[2 * j + 1] / scale.jump;
            let cone = tangential.abs() - problem.friction[j] * normal.max(0.0);
            worst.max(-opening).max(-normal).max(cone).max(opening.min(normal))
        })
    }
}

/// Fraction of the largest force or jump below which forces and jumps are round-off.
pub(super) const ROUND_OFF: f64 = 1e-11;

/// Scale of jumps and forces on the faces: the largest values so far.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FaceScale {
    /// Jump, mm.
    pub jump: f64,
    /// Nodal force, N/mm.
    pub force: f64,
}

impl FaceScale {
    /// The scale before any solution.
    pub(crate) const NONE: Self = Self { jump: f64::MIN_POSITIVE, force: f64::MIN_POSITIVE };

    /// The maxima of this scale and the largest values of `solution` and `load`.
    pub(crate) fn including(self, solution: &FaceSolution, load: &[f64]) -> Self {
        let largest = |values: &[f64], so_far: f64| values.iter().fold(so_far, |m, v| m.max(v.abs()));
        let faces = ..2 * solution.status.len();
        let force = largest(&load[faces], largest(&solution.contact[faces], self.force));
        Self { jump: largest(&solution.jump[faces], self.jump), force }
    }
}

/// Contact status of a face point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum FaceStatus {
    /// Not in contact: no traction.
    Open,
    /// In contact, |s12| < μ |s22|: no slip.
    Stick,
    /// In contact, |s12| = μ |s22|.
    Slip,
}

impl Choice for FaceStatus {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Open, Word::now("open", "not in contact")),
        (Self::Stick, Word::now("stick", "in contact, no slip")),
        (Self::Slip, Word::now("slip", "in contact, at the limit of friction")),
    ];
}

/// The state of a face point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FaceState {
    /// ⟦w⟧·x2, mm, not negative.
    pub opening: f64,
    /// ⟦w⟧·x1, mm.
    pub slip: f64,
    /// Normal stress transmitted across the faces, MPa, not positive.
    pub s22: f64,
    /// Shear stress transmitted across the faces, MPa.
    pub s12: f64,
    /// Open, stick or slip.
    pub status: FaceStatus,
}

#[cfg(test)]
mod tests {
    use super::{CrackFrictionError, FaceProblem};
    use crate::contact::fixtures::one_point;

    #[test]
    fn crack_friction_that_does_not_fit_is_refused() {
        let body = one_point(1.0, 0.0);
        let refused = |friction: &[f64]| FaceProblem::new(&body, friction).err();
        assert_eq!(refused(&[]), Some(CrackFrictionError::Count { given: 0, cracks: 1 }));
        assert_eq!(refused(&[0.5, 0.5]), Some(CrackFrictionError::Count { given: 2, cracks: 1 }));
        assert_eq!(refused(&[-0.1]), Some(CrackFrictionError::Value { crack: 1, value: -0.1 }));
        assert!(refused(&[f64::NAN]).is_some() && refused(&[0.0]).is_none());
    }
}
