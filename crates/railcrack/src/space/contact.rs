//! Contact of the crack faces in space with Coulomb friction in two directions.
//!
//! With r the nodal forces that the faces exert on each other, A ⟦w⟧ = f + r. At each point
//!
//!   ⟦w_n⟧ ≥ 0, r_n ≥ 0, r_n ⟦w_n⟧ = 0,   |r_t| ≤ μ r_n, and slip increments against r_t.
//!
//! The augmented equations of Alart & Curnier (1991) are solved by semismooth Newton iterations:
//! each point is open, sticks or slips. The unknowns are either the jumps that are not held or,
//! with ⟦w⟧ = C (f + r), the forces between touching faces, whichever are fewer. The linear systems
//! are solved by minimal residuals, preconditioned with the factor of an earlier system. The origin
//! of slip, and with it the error of the load step, is left to the passage.

use super::body::SpaceBody;
use super::linearised::{Change, FaceProblem, Form, LaggedFactor, Linearised, size};
use super::states::{PointState, SpaceFaces, SpaceStatus};
use super::trapped::{PocketsOfStep, TrappedPressures};
use crate::interruption::Interrupted;
use crate::linear::LinearError;
use thiserror::Error;

/// Largest number of iterations of a step.
const ITERATIONS: usize = 60;
/// Largest change of a jump in a converged step, relative to the largest jump before or after it.
const TOLERANCE: f64 = 1e-9;
/// Residuals of the linear systems, relative to their right-hand sides: while points still change
/// their state, and at the end when none does.
const COARSEST: f64 = 1e-2;
const FINEST: f64 = 1e-9;
/// Residual of the conditions in a converged step, relative to the forces on the faces.
const CONVERGED: f64 = 1e-13;
/// A residual this small relative to the forces on the faces is round-off.
const ROUNDING: f64 = 1e-13;
/// Relative residual of the response to a unit pressure, at most.
const OF_A_PRESSURE: f64 = 1e-4;

/// Reasons why a contact step fails.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SpaceContactError {
    /// The iterations do not converge.
    #[error(
        "contact of the faces of a crack in space: change {change:e} after {iterations} iterations, allowed {tolerance:e}"
    )]
    NotConverged {
        /// Number of iterations made.
        iterations: usize,
        /// Last change of a jump, relative to the largest jump.
        change: f64,
        /// The admissible change.
        tolerance: f64,
    },
    /// A linear system that has no solution.
    #[error(transparent)]
    Linear(#[from] LinearError),
    /// Interrupted on request.
    #[error("{0}")]
    Interrupted(#[from] Interrupted),
}

/// Solver effort and accuracy of a step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StepReport {
    /// Newton iterations.
    pub iterations: usize,
    /// Largest violation of the contact conditions: penetration over the largest jump, tension and
    /// friction beyond the cone over the largest force, r_n ⟦w_n⟧ over both. The reference values
    /// include the jumps before the step and the forces required for them.
    pub violation: f64,
}

/// Jumps (mm) with which the iterations of a step begin, and the forces A ⟦w⟧ (N) that resist them
/// where they are known.
#[derive(Debug, Clone)]
pub(super) struct Guess {
    pub jumps: Vec<f64>,
    pub resisted: Option<Vec<f64>>,
}

/// The end of a step.
#[derive(Debug)]
pub(super) struct ContactStep {
    pub faces: SpaceFaces,
    pub report: StepReport,
    /// A ⟦w⟧ (N): the forces that resist the jumps.
    pub resisted: Vec<f64>,
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
        SpaceFaces::virgin(self.body.points().len())
    }

    /// The faces under the nodal forces `forces` (N), after `before`.
    ///
    /// Errors: iterations that do not converge; a singular system.
    pub fn step(
        &self,
        before: &SpaceFaces,
        forces: &[f64],
    ) -> Result<(SpaceFaces, StepReport), SpaceContactError> {
        let dry = PocketsOfStep { pockets: &[], states: &[], bulk_modulus: f64::INFINITY };
        let friction = self.friction_of_points();
        let factor = &mut LaggedFactor::default();
        let guess = Guess { jumps: before.jumps.clone(), resisted: None };
        let ContactStep { faces, report, .. } =
            self.problem(&friction).step_from(&guess, factor, &before.jumps, (forces, dry))?;
        Ok((faces, report))
    }

    /// The friction coefficient μ at each point: zero on folds.
    pub(super) fn friction_of_points(&self) -> Vec<f64> {
        let mut friction: Vec<f64> =
            (0..self.body.points().len()).map(|a| self.friction[self.body.crack_of(a)]).collect();
        self.body.cracks().iter().flat_map(|part| &part.fold).for_each(|&a| friction[a] = 0.0);
        friction
    }

    /// The contact problem of the whole faces, with the friction coefficient at each point.
    pub(super) fn problem<'b>(&'b self, friction: &'b [f64]) -> FaceProblem<'b> {
        FaceProblem { stiffness: self.body.stiffness(), compliance: self.body.compliance(), friction }
    }
}

impl FaceProblem<'_> {
    /// The faces under `forces` (N), with slip that is measured from the jumps `origin` (mm). The
    /// iterations begin with `guess` and, if they
    /// fail to converge, again with `origin`. On entry `factor` is that of a similar step, on
    /// return that of this one. The pressures of `pockets` act on the faces in addition to
    /// `forces`.
    ///
    /// Errors: iterations that do not converge; a singular system.
    pub(super) fn step_from(
        &self,
        guess: &Guess,
        factor: &mut LaggedFactor,
        origin: &[f64],
        load: (&[f64], PocketsOfStep<'_>),
    ) -> Result<ContactStep, SpaceContactError> {
        match self.iterated(guess, factor, origin, load) {
            Err(SpaceContactError::NotConverged { .. }) if guess.jumps != origin => {
                let guess = Guess { jumps: origin.to_vec(), resisted: None };
                self.iterated(&guess, factor, origin, load)
            }
            result => result,
        }
    }

    fn iterated(
        &self,
        guess: &Guess,
        factor: &mut LaggedFactor,
        origin: &[f64],
        (forces, pockets): (&[f64], PocketsOfStep<'_>),
    ) -> Result<ContactStep, SpaceContactError> {
        let points = origin.len() / 3;
        let mut jumps = guess.jumps.clone();
        let mut fluid = TrappedPressures::of(pockets);
        let mut forces = fluid.added_to(forces);
        let mut reactions = match &guess.resisted {
            Some(resisted) => difference(resisted, &forces),
            None => difference(&self.stiffness.times(&jumps), &forces),
        };
        let mut last = (Vec::new(), f64::INFINITY);
        for iteration in 1..=ITERATIONS {
            let states: Vec<PointState> =
                (0..points).map(|a| self.state(a, &jumps, &reactions, origin)).collect();
            let kinds: Vec<_> = states.iter().map(|state| std::mem::discriminant(&state.status)).collect();
            let form = Form::of(&states, factor.form());
            let held = self.held(form, &states, &jumps, &reactions, origin);
            let conditions = Linearised::new(form, self, &states);
            let mut moved = sum(&jumps, &held.jumps);
            (0..moved.len()).filter(|i| i % 3 > 0).for_each(|i| moved[i] -= origin[i]);
            let mut right = conditions.of(&sum(&reactions, &held.forces), &moved);
            right.iter_mut().for_each(|value| *value = -*value);
            let whole = size(&sum(&reactions, &forces));
            if kinds == last.0 && size(&right) <= CONVERGED * whole && fluid.holds(&jumps) {
                return Ok(self.converged(jumps, &states, origin, (&forces, &fluid), iteration - 1));
            }
            let wanted = wanted_residual(&states, (kinds == last.0).then_some(last.1));
            let rounding = ROUNDING * whole / size(&right).max(f64::MIN_POSITIVE);
            let mut change = held;
            factor.solve(&conditions, &right, wanted.max(rounding.min(0.5)), &mut change)?;
            let units = fluid.pressing().into_iter().map(|k| {
                let unit = &pockets.pockets[k].unit;
                let mut response = self.unit_pressure(form, unit);
                let mut right = conditions.of(&response.forces, &response.jumps);
                right.iter_mut().for_each(|value| *value = -*value);
                factor.solve(&conditions, &right, wanted.min(OF_A_PRESSURE), &mut response)?;
                Ok((k, response))
            });
            let units = units.collect::<Result<Vec<_>, LinearError>>()?;
            fluid.press(&jumps, &mut change, &units, &mut forces);
            jumps = sum(&jumps, &change.jumps);
            reactions = sum(&reactions, &change.forces);
            // Prescribed components are set to their exact values after a sum with round-off.
            match form {
                Form::Jumps => hold(&mut jumps, &states, origin),
                Form::Forces => let_go(&mut reactions, &states),
            }
            // Earlier jumps count as well, since the jumps of faces that come to rest may all
            // vanish.
            let scale = largest(&jumps).max(largest(origin)).max(f64::MIN_POSITIVE);
            last = (kinds, largest(&change.jumps) / scale);
            if last.1 <= TOLERANCE && fluid.holds(&jumps) {
                return Ok(self.converged(jumps, &states, origin, (&forces, &fluid), iteration));
            }
        }
        Err(SpaceContactError::NotConverged { iterations: ITERATIONS, change: last.1, tolerance: TOLERANCE })
    }

    /// The faces at the end of the iterations.
    fn converged(
        &self,
        mut jumps: Vec<f64>,
        states: &[PointState],
        origin: &[f64],
        (forces, fluid): (&[f64], &TrappedPressures<'_>),
        iterations: usize,
    ) -> ContactStep {
        hold(&mut jumps, states, origin);
        let resisted = self.stiffness.times(&jumps);
        let mut reactions = difference(&resisted, forces);
        // Remaining forces on open faces are round-off.
        let_go(&mut reactions, states);
        let status = states.iter().map(|state| state.status).collect();
        let faces = SpaceFaces { jumps, reactions, status, fluid: fluid.states().to_vec() };
        let violation = self.violation(&faces, origin);
        ContactStep { faces, report: StepReport { iterations, violation }, resisted }
    }

    /// The effect of a unit pressure of a pocket while no unknown changes.
    fn unit_pressure(&self, form: Form, unit: &[f64]) -> Change {
        match form {
            Form::Jumps => {
                Change { jumps: vec![0.0; unit.len()], forces: unit.iter().map(|force| -force).collect() }
            }
            Form::Forces => Change { jumps: self.compliance.times(unit), forces: vec![0.0; unit.len()] },
        }
    }

    /// The state of point a, where α is its augmentation stiffness.
    fn state(&self, a: usize, jumps: &[f64], reactions: &[f64], origin: &[f64]) -> PointState {
        let weight = self.stiffness.entry(3 * a, 3 * a);
        let normal = reactions[3 * a] - weight * jumps[3 * a];
        let [s, t] = [1, 2].map(|c| reactions[3 * a + c] - weight * (jumps[3 * a + c] - origin[3 * a + c]));
        let size = s.hypot(t);
        let friction = self.friction[a];
        if normal <= 0.0 {
            PointState { status: SpaceStatus::Open, friction, turning: 0.0 }
        } else if size <= friction * normal || size == 0.0 {
            PointState { status: SpaceStatus::Stick, friction, turning: 0.0 }
        } else {
            let status = SpaceStatus::Slip { direction: [s / size, t / size] };
            PointState { status, friction, turning: friction * normal / size }
        }
    }

    /// The change of the prescribed components: of jumps to the values at which they are held, or
    /// of forces on open faces to zero.
    fn held(
        &self,
        form: Form,
        states: &[PointState],
        jumps: &[f64],
        reactions: &[f64],
        origin: &[f64],
    ) -> Change {
        let mut moved = vec![0.0; jumps.len()];
        for (a, state) in states.iter().enumerate() {
            match (form, state.status) {
                (Form::Forces, SpaceStatus::Open) => {
                    (3 * a..3 * a + 3).for_each(|i| moved[i] = -reactions[i])
                }
                (Form::Jumps, SpaceStatus::Slip { .. }) => moved[3 * a] = -jumps[3 * a],
                (Form::Jumps, SpaceStatus::Stick) => {
                    moved[3 * a] = -jumps[3 * a];
                    (3 * a + 1..3 * a + 3).for_each(|i| moved[i] = origin[i] - jumps[i]);
                }
                _ => {}
            }
        }
        match form {
            Form::Jumps => Change { forces: self.stiffness.times(&moved), jumps: moved },
            Form::Forces => Change { jumps: self.compliance.times(&moved), forces: moved },
        }
    }

    fn violation(&self, faces: &SpaceFaces, origin: &[f64]) -> f64 {
        let jump = largest(&faces.jumps).max(largest(origin)).max(f64::MIN_POSITIVE);
        let stiffness = self.stiffness;
        let stiffest = (0..faces.jumps.len()).fold(0.0f64, |m, i| m.max(stiffness.entry(i, i)));
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
                .max((shear - self.friction[a] * r.max(0.0)).max(0.0) / force)
        })
    }
}

/// The relative residual to which the linear system of `states` is solved; `last` is the last
/// change of a jump, where no point has changed its state in it. Without slip the conditions are
/// linear; if no point changes its state, the error falls as the square of the change.
fn wanted_residual(states: &[PointState], last: Option<f64>) -> f64 {
    if states.iter().all(|state| state.turning == 0.0) {
        return FINEST;
    }
    last.map_or(COARSEST, |change| (0.1 * change).clamp(FINEST, COARSEST))
}

/// Sets the jumps that are held by `states` to the values at which they are held.
fn hold(jumps: &mut [f64], states: &[PointState], origin: &[f64]) {
    for (a, state) in states.iter().enumerate() {
        if state.status != SpaceStatus::Open {
            jumps[3 * a] = 0.0;
        }
        if state.status == SpaceStatus::Stick {
            jumps[3 * a + 1..3 * a + 3].copy_from_slice(&origin[3 * a + 1..3 * a + 3]);
        }
    }
}

/// Clears the forces on open faces.
fn let_go(reactions: &mut [f64], states: &[PointState]) {
    for (a, state) in states.iter().enumerate() {
        if state.status == SpaceStatus::Open {
            reactions[3 * a..3 * a + 3].fill(0.0);
        }
    }
}

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

fn sum(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a + b).collect()
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m, v| m.max(v.abs()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::IsotropicElastic;
    use crate::space::{SpaceCrack, SpaceResolution, Surroundings};

    #[test]
    fn few_jumps_or_few_forces_are_the_same_iteration() {
        let steel = IsotropicElastic::new(210e3, 0.3).unwrap();
        let crack = SpaceCrack::surface_breaking(0.5, 3.0, 2.0).unwrap();
        let resolution = SpaceResolution::new(2, 2);
        let body = SpaceBody::new(std::slice::from_ref(&crack), &steel, Surroundings::HalfSpace, resolution)
            .unwrap();
        let whole = SpaceContact { body: &body, friction: &[0.4] };
        let friction = whole.friction_of_points();
        let contact = whole.problem(&friction);
        let count = 3 * body.points().len();
        let states: Vec<PointState> = (0..body.points().len())
            .map(|a| match a % 3 {
                0 => PointState { status: SpaceStatus::Open, friction: 0.4, turning: 0.0 },
                1 => PointState { status: SpaceStatus::Stick, friction: 0.4, turning: 0.0 },
                _ => {
                    let (sin, cos) = (a as f64).sin_cos();
                    PointState {
                        status: SpaceStatus::Slip { direction: [cos, sin] },
                        friction: 0.4,
                        turning: 0.6,
                    }
                }
            })
            .collect();
        let of =
            |scale: f64, turn: f64| (0..count).map(|i| scale * (turn * i as f64).sin()).collect::<Vec<_>>();
        let (jumps, origin, forces) = (of(1e-3, 1.7), of(1e-3, 0.9), of(50.0, 0.3));
        let reactions = difference(&contact.stiffness.times(&jumps), &forces);
        let [one, other] = [Form::Jumps, Form::Forces].map(|form| {
            let mut change = contact.held(form, &states, &jumps, &reactions, &origin);
            let conditions = Linearised::new(form, &contact, &states);
            let mut moved = sum(&jumps, &change.jumps);
            (0..count).filter(|i| i % 3 > 0).for_each(|i| moved[i] -= origin[i]);
            let mut right = conditions.of(&sum(&reactions, &change.forces), &moved);
            right.iter_mut().for_each(|value| *value = -*value);
            LaggedFactor::default().solve(&conditions, &right, 1e-13, &mut change).unwrap();
            change
        });
        for (one, other) in [(&one.jumps, &other.jumps), (&one.forces, &other.forces)] {
            let gap = one.iter().zip(other).fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
            assert!(gap < 1e-10 * largest(one), "{gap:e} of {:e}", largest(one));
        }
        assert_eq!(Form::of(&states, None), Form::Jumps);
        assert_eq!(Form::of(&states[..1], Some(Form::Jumps)), Form::Forces);
        assert_eq!(Form::of(&states[..2], Some(Form::Forces)), Form::Forces);
    }
}
