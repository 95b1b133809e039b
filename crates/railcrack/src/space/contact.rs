//! Contact of the crack faces in space with Coulomb friction in two directions.
//!
//! With r the nodal forces that the faces exert on each other, A ⟦w⟧ = f + r. At each point
//!
//!   ⟦w_n⟧ ≥ 0, r_n ≥ 0, r_n ⟦w_n⟧ = 0,   |r_t| ≤ μ r_n, and slip increments against r_t.
//!
//! The augmented equations of Alart & Curnier (1991) are solved by semismooth Newton iterations:
//! each point is open, sticks or slips, and the unknowns are the jumps that are not held. Their
//! linear systems are solved by minimal residuals, preconditioned by the factor of an earlier one.
//! Slip is integrated by backward Euler: an error of first order in the step, which the passage
//! controls.

use super::body::SpaceBody;
use super::linearised::{Change, LaggedFactor, Linearised, resisted, size};
use super::states::{PointState, SpaceStatus};
use crate::interruption::Interrupted;
use crate::linear::LinearError;
use thiserror::Error;

/// Iterations of a step, at most.
const ITERATIONS: usize = 60;
/// Largest change of a jump, over the largest jump before or after it, of a converged step.
const TOLERANCE: f64 = 1e-9;
/// Residuals of the linear systems, over their right-hand sides: where points change their state,
/// and where none does at the end.
const COARSEST: f64 = 1e-2;
const FINEST: f64 = 1e-9;
/// A residual this small over the forces of the faces is round-off.
const ROUNDING: f64 = 1e-13;

/// A step of the contact that fails.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SpaceContactError {
    /// The iterations do not end.
    #[error(
        "contact of the faces of a crack in space: change {change:e} after {iterations} iterations, allowed {tolerance:e}"
    )]
    NotConverged {
        /// Iterations made.
        iterations: usize,
        /// Last change of a jump over the largest.
        change: f64,
        /// The change allowed.
        tolerance: f64,
    },
    /// A linear system without a solution.
    #[error(transparent)]
    Linear(#[from] LinearError),
    /// Given up on request.
    #[error("{0}")]
    Interrupted(#[from] Interrupted),
}

/// The faces of a crack at one moment.
#[derive(Debug, Clone, PartialEq)]
pub struct SpaceFaces {
    /// ⟦w⟧ (mm), 3p: opening, slip along the dip and along the trace.
    pub jumps: Vec<f64>,
    /// r (N), 3p: forces between the faces.
    pub reactions: Vec<f64>,
    /// The state of each point.
    pub status: Vec<SpaceStatus>,
}

impl SpaceFaces {
    /// Whether every point is open, sticks or slips as it does there.
    pub(super) fn keeps_states_of(&self, other: &Self) -> bool {
        let kind = |status: &SpaceStatus| std::mem::discriminant(status);
        self.status.iter().zip(&other.status).all(|(one, other)| kind(one) == kind(other))
    }
}

/// The numbers of a step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StepReport {
    /// Newton iterations.
    pub iterations: usize,
    /// Largest violation of the contact conditions: penetration over the largest jump, tension and
    /// friction beyond the cone over the largest force, r_n ⟦w_n⟧ over both. The jumps before the
    /// step and the forces that they need count.
    pub violation: f64,
}

/// The contact problem of the faces of a body.
#[derive(Debug, Clone, Copy)]
pub struct SpaceContact<'a> {
    /// The body.
    pub body: &'a SpaceBody,
    /// Crack-face friction coefficient μ of each crack, not negative.
    pub friction: &'a [f64],
}

impl SpaceContact<'_> {
    /// Faces that are closed, without slip and force.
    pub fn virgin(&self) -> SpaceFaces {
        let points = self.body.points().len();
        SpaceFaces {
            jumps: vec![0.0; 3 * points],
            reactions: vec![0.0; 3 * points],
            status: vec![SpaceStatus::Stick; points],
        }
    }

    /// The faces under the nodal forces `forces` (N), after `before`.
    ///
    /// Errors: iterations that do not end; a singular system.
    pub fn step(
        &self,
        before: &SpaceFaces,
        forces: &[f64],
    ) -> Result<(SpaceFaces, StepReport), SpaceContactError> {
        self.step_from(&before.jumps, &mut LaggedFactor::default(), before, forces)
    }

    /// [`Self::step`] by iterations that begin with the jumps `guess` (mm), and with those of
    /// `before` where they do not end; `factor` is that of a similar step, and of this one after
    /// it.
    ///
    /// Errors: iterations that do not end; a singular system.
    pub(super) fn step_from(
        &self,
        guess: &[f64],
        factor: &mut LaggedFactor,
        before: &SpaceFaces,
        forces: &[f64],
    ) -> Result<(SpaceFaces, StepReport), SpaceContactError> {
        match self.iterated(guess, factor, before, forces) {
            Err(SpaceContactError::NotConverged { .. }) if guess != before.jumps => {
                self.iterated(&before.jumps, factor, before, forces)
            }
            result => result,
        }
    }

    fn iterated(
        &self,
        guess: &[f64],
        factor: &mut LaggedFactor,
        before: &SpaceFaces,
        forces: &[f64],
    ) -> Result<(SpaceFaces, StepReport), SpaceContactError> {
        let points = before.status.len();
        let mut jumps = guess.to_vec();
        let mut reactions = self.reactions(&jumps, forces);
        let mut last = (Vec::new(), f64::INFINITY);
        for iteration in 1..=ITERATIONS {
            let states: Vec<PointState> =
                (0..points).map(|a| self.state(a, &jumps, &reactions, &before.jumps)).collect();
            let kinds: Vec<_> = states.iter().map(|state| std::mem::discriminant(&state.status)).collect();
            // Where no point changes its state the error falls as the square of the change.
            let wanted = if kinds == last.0 { (0.1 * last.1).clamp(FINEST, COARSEST) } else { COARSEST };
            let mut change = self.held(&states, &jumps, before);
            let conditions = Linearised::new(self.body.stiffness(), &states);
            let sum = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a + b).collect::<Vec<f64>>();
            let slip: Vec<f64> =
                sum(&jumps, &change.jumps).iter().zip(&before.jumps).map(|(new, old)| new - old).collect();
            let mut right = conditions.of(&sum(&reactions, &change.forces), &slip);
            right.iter_mut().for_each(|value| *value = -*value);
            let rounding = ROUNDING * size(&sum(&reactions, forces)) / size(&right).max(f64::MIN_POSITIVE);
            factor.solve(&conditions, &right, wanted.max(rounding.min(0.5)), &mut change)?;
            jumps = sum(&jumps, &change.jumps);
            reactions = sum(&reactions, &change.forces);
            for (a, state) in states.iter().enumerate() {
                // Exactly, after a sum that rounds.
                if state.status != SpaceStatus::Open {
                    jumps[3 * a] = 0.0;
                }
                if state.status == SpaceStatus::Stick {
                    jumps[3 * a + 1..3 * a + 3].copy_from_slice(&before.jumps[3 * a + 1..3 * a + 3]);
                }
            }
            // Jumps that were there before count: those of faces that come to rest may all vanish.
            let scale = largest(&jumps).max(largest(&before.jumps)).max(f64::MIN_POSITIVE);
            last = (kinds, largest(&change.jumps) / scale);
            if last.1 <= TOLERANCE {
                let mut reactions = self.reactions(&jumps, forces);
                let status: Vec<SpaceStatus> = states.iter().map(|state| state.status).collect();
                // Open faces exert no force: what is left is round-off.
                for (a, status) in status.iter().enumerate() {
                    if *status == SpaceStatus::Open {
                        reactions[3 * a..3 * a + 3].fill(0.0);
                    }
                }
                let faces = SpaceFaces { jumps, reactions, status };
                let violation = self.violation(&faces, before);
                return Ok((faces, StepReport { iterations: iteration, violation }));
            }
        }
        Err(SpaceContactError::NotConverged { iterations: ITERATIONS, change: last.1, tolerance: TOLERANCE })
    }

    fn reactions(&self, jumps: &[f64], forces: &[f64]) -> Vec<f64> {
        let resisted = resisted(self.body.stiffness(), jumps);
        resisted.iter().zip(forces).map(|(resisted, force)| resisted - force).collect()
    }

    /// The state of point a. α is the stiffness of its augmentation.
    fn state(&self, a: usize, jumps: &[f64], reactions: &[f64], before: &[f64]) -> PointState {
        let weight = self.body.stiffness()[(3 * a, 3 * a)];
        let normal = reactions[3 * a] - weight * jumps[3 * a];
        let [s, t] = [1, 2].map(|c| reactions[3 * a + c] - weight * (jumps[3 * a + c] - before[3 * a + c]));
        let size = s.hypot(t);
        let friction = self.friction_at(a);
        if normal <= 0.0 {
            PointState { status: SpaceStatus::Open, friction, turning: 0.0 }
        } else if size <= friction * normal || size == 0.0 {
            PointState { status: SpaceStatus::Stick, friction, turning: 0.0 }
        } else {
            let status = SpaceStatus::Slip { direction: [s / size, t / size] };
            PointState { status, friction, turning: friction * normal / size }
        }
    }

    /// μ at point a.
    fn friction_at(&self, a: usize) -> f64 {
        self.friction[self.body.crack_of(a)]
    }

    /// The change of jumps that are held, to where they are held.
    fn held(&self, states: &[PointState], jumps: &[f64], before: &SpaceFaces) -> Change {
        let mut moved = vec![0.0; jumps.len()];
        for (a, state) in states.iter().enumerate() {
            if state.status != SpaceStatus::Open {
                moved[3 * a] = -jumps[3 * a];
            }
            if state.status == SpaceStatus::Stick {
                (3 * a + 1..3 * a + 3).for_each(|i| moved[i] = before.jumps[i] - jumps[i]);
            }
        }
        let forces = resisted(self.body.stiffness(), &moved);
        Change { jumps: moved, forces }
    }

    fn violation(&self, faces: &SpaceFaces, before: &SpaceFaces) -> f64 {
        let jump = largest(&faces.jumps).max(largest(&before.jumps)).max(f64::MIN_POSITIVE);
        let stiffness = self.body.stiffness();
        let stiffest = (0..faces.jumps.len()).fold(0.0f64, |m, i| m.max(stiffness[(i, i)]));
        let force = largest(&faces.reactions).max(stiffest * jump);
        faces.status.iter().enumerate().fold(0.0, |worst: f64, (a, _)| {
            let [w, r] = [faces.jumps[3 * a], faces.reactions[3 * a]];
            let shear = faces.reactions[3 * a + 1].hypot(faces.reactions[3 * a + 2]);
            let open = (-w).max(0.0) / jump;
            let pull = (-r).max(0.0) / force;
            let both = (w / jump) * (r / force);
            worst
                .max(open)
                .max(pull)
                .max(both.abs())
                .max((shear - self.friction_at(a) * r.max(0.0)).max(0.0) / force)
        })
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m, v| m.max(v.abs()))
}
