//! Contact of the crack faces in space with Coulomb friction in two directions.
//!
//! With r the nodal forces that the faces exert on each other, A ⟦w⟧ = f + r. At each point
//!
//!   ⟦w_n⟧ ≥ 0, r_n ≥ 0, r_n ⟦w_n⟧ = 0,   |r_t| ≤ μ r_n, and slip increments against r_t.
//!
//! The augmented equations of Alart & Curnier (1991) are solved by semismooth Newton iterations:
//! each point is open, sticks or slips, and the unknowns are the jumps that are not held. Slip is
//! integrated by backward Euler: an error of first order in the step, which the passage controls.

use super::body::SpaceBody;
use crate::interruption::Interrupted;
use crate::linear::{LinearError, SmallFactor};
use crate::math::{Matrix, dot};
use thiserror::Error;

/// Iterations of a step, at most.
const ITERATIONS: usize = 60;
/// Largest change of a jump, over the largest jump, of a converged step.
const TOLERANCE: f64 = 1e-11;

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

/// Whether the faces touch at a point.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub enum SpaceStatus {
    /// The faces are apart.
    Open,
    /// They touch without slipping.
    Stick,
    /// They slip; the direction of the friction force.
    Slip {
        /// Unit vector along the dip and the trace.
        direction: [f64; 2],
    },
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

/// The numbers of a step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StepReport {
    /// Newton iterations.
    pub iterations: usize,
    /// Largest violation of the contact conditions: penetration and r_n ⟦w_n⟧ over the largest of
    /// each, friction beyond the cone over the largest force.
    pub violation: f64,
}

/// The contact problem of the faces of a body.
#[derive(Debug, Clone, Copy)]
pub struct SpaceContact<'a> {
    /// The body.
    pub body: &'a SpaceBody,
    /// Crack-face friction coefficient μ, not negative.
    pub friction: f64,
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
        let stiffness = self.body.stiffness();
        let points = before.status.len();
        let mut jumps = before.jumps.clone();
        let mut reactions = self.reactions(&jumps, forces);
        let mut change = f64::INFINITY;
        for iteration in 1..=ITERATIONS {
            let status: Vec<SpaceStatus> =
                (0..points).map(|a| self.status(a, &jumps, &reactions, &before.jumps)).collect();
            let next = self.solve(&status, &jumps, &reactions, before, forces)?;
            let size = next.iter().fold(f64::MIN_POSITIVE, |m, v| m.max(v.abs()));
            change = next.iter().zip(&jumps).fold(0.0f64, |m, (a, b)| m.max((a - b).abs())) / size;
            jumps = next;
            reactions = self.reactions(&jumps, forces);
            if change <= TOLERANCE {
                // Open faces exert no force: what is left is round-off.
                for (a, status) in status.iter().enumerate() {
                    if *status == SpaceStatus::Open {
                        reactions[3 * a..3 * a + 3].fill(0.0);
                    }
                }
                let faces = SpaceFaces { jumps, reactions, status };
                let violation = self.violation(&faces);
                return Ok((faces, StepReport { iterations: iteration, violation }));
            }
        }
        debug_assert_eq!(stiffness.rows(), 3 * points);
        Err(SpaceContactError::NotConverged { iterations: ITERATIONS, change, tolerance: TOLERANCE })
    }

    fn reactions(&self, jumps: &[f64], forces: &[f64]) -> Vec<f64> {
        let stiffness = self.body.stiffness();
        (0..jumps.len()).map(|i| dot(stiffness.row(i), jumps) - forces[i]).collect()
    }

    /// Stiffness of the augmentation of point a.
    fn weight(&self, a: usize) -> f64 {
        self.body.stiffness()[(3 * a, 3 * a)]
    }

    /// r_t − α (w_t − w_t before).
    fn pushed(&self, a: usize, jumps: &[f64], reactions: &[f64], before: &[f64]) -> [f64; 2] {
        [1, 2].map(|c| reactions[3 * a + c] - self.weight(a) * (jumps[3 * a + c] - before[3 * a + c]))
    }

    fn pressed(&self, a: usize, jumps: &[f64], reactions: &[f64]) -> f64 {
        reactions[3 * a] - self.weight(a) * jumps[3 * a]
    }

    fn status(&self, a: usize, jumps: &[f64], reactions: &[f64], before: &[f64]) -> SpaceStatus {
        let normal = self.pressed(a, jumps, reactions);
        if normal <= 0.0 {
            return SpaceStatus::Open;
        }
        let [s, t] = self.pushed(a, jumps, reactions, before);
        let size = s.hypot(t);
        if size <= self.friction * normal || size == 0.0 {
            SpaceStatus::Stick
        } else {
            SpaceStatus::Slip { direction: [s / size, t / size] }
        }
    }

    /// One Newton step: the jumps of given states.
    fn solve(
        &self,
        status: &[SpaceStatus],
        jumps: &[f64],
        reactions: &[f64],
        before: &SpaceFaces,
        forces: &[f64],
    ) -> Result<Vec<f64>, SpaceContactError> {
        let stiffness = self.body.stiffness();
        let mut unknowns = Vec::new();
        let mut next = vec![0.0; jumps.len()];
        for (a, status) in status.iter().enumerate() {
            match status {
                SpaceStatus::Open => unknowns.extend([3 * a, 3 * a + 1, 3 * a + 2]),
                SpaceStatus::Slip { .. } => unknowns.extend([3 * a + 1, 3 * a + 2]),
                SpaceStatus::Stick => {
                    next[3 * a + 1..3 * a + 3].copy_from_slice(&before.jumps[3 * a + 1..3 * a + 3]);
                }
            }
        }
        if unknowns.is_empty() {
            return Ok(next);
        }
        let mut matrix = Matrix::zeros(unknowns.len(), unknowns.len());
        let mut right = vec![0.0; unknowns.len()];
        for (row, &unknown) in unknowns.iter().enumerate() {
            let (a, c) = (unknown / 3, unknown % 3);
            // The row is a combination of rows of A w − f, and of w_t itself.
            let mut combination = [0.0; 3];
            let mut own = [0.0; 2];
            match status[a] {
                SpaceStatus::Slip { direction } => {
                    let pushed = self.pushed(a, jumps, reactions, &before.jumps);
                    let normal = self.pressed(a, jumps, reactions);
                    let turning = self.friction * normal / pushed[0].hypot(pushed[1]);
                    for e in 0..2 {
                        let same = f64::from(u8::from(e + 1 == c));
                        let across = turning * (same - direction[c - 1] * direction[e]);
                        combination[e + 1] = same - across;
                        own[e] = across * self.weight(a);
                    }
                    combination[0] = -self.friction * direction[c - 1];
                }
                _ => combination[c] = 1.0,
            }
            for (e, factor) in combination.into_iter().enumerate().filter(|(_, factor)| *factor != 0.0) {
                let full = stiffness.row(3 * a + e);
                right[row] += factor * (forces[3 * a + e] - dot(full, &next));
                let entries = matrix.row_mut(row);
                unknowns.iter().zip(entries).for_each(|(&k, entry)| *entry += factor * full[k]);
            }
            for (e, factor) in own.into_iter().enumerate().filter(|(_, factor)| *factor != 0.0) {
                right[row] += factor * before.jumps[3 * a + 1 + e];
                if let Ok(column) = unknowns.binary_search(&(3 * a + 1 + e)) {
                    matrix[(row, column)] += factor;
                }
            }
        }
        SmallFactor::new(matrix)?.solve(&mut right)?;
        unknowns.iter().zip(right).for_each(|(&k, value)| next[k] = value);
        Ok(next)
    }

    fn violation(&self, faces: &SpaceFaces) -> f64 {
        let largest = |from: usize, values: &[f64]| {
            values.iter().skip(from).step_by(3).fold(f64::MIN_POSITIVE, |m: f64, v| m.max(v.abs()))
        };
        let (opening, force) = (largest(0, &faces.jumps), largest(0, &faces.reactions));
        faces.status.iter().enumerate().fold(0.0, |worst: f64, (a, _)| {
            let [w, r] = [faces.jumps[3 * a], faces.reactions[3 * a]];
            let shear = faces.reactions[3 * a + 1].hypot(faces.reactions[3 * a + 2]);
            let open = (-w).max(0.0) / opening;
            let pull = (-r).max(0.0) / force;
            let both = (w / opening) * (r / force);
            worst
                .max(open)
                .max(pull)
                .max(both.abs())
                .max((shear - self.friction * r.max(0.0)).max(0.0) / force)
        })
    }
}
