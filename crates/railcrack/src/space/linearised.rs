//! The contact problem of faces in space, linearised for given states of the points.

use super::face_matrix::FaceMatrix;
use super::states::{PointState, SpaceStatus};
use crate::linear::{LargeFactor, LinearError, least_residual};
use crate::math::{axpy, dot};
use rayon::prelude::*;

/// The choice of unknowns: few jumps change where most points touch, few forces act where most are
/// open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    /// The jumps that are not held; A maps them to forces.
    Jumps,
    /// The forces between touching faces; C maps them to jumps.
    Forces,
}

/// The form is changed only if the other one has less than this share of its unknowns.
const CLEARLY_LESS: f64 = 0.8;

impl Form {
    /// The form with the fewest unknowns for points in `states`, or the form `present`, for which a
    /// factor exists, unless it has many more.
    pub fn of(states: &[PointState], present: Option<Self>) -> Self {
        let (mut jumps, mut forces) = (0, 0);
        for state in states {
            let (free, pressed) = match state.status {
                SpaceStatus::Open => (3, 0),
                SpaceStatus::Stick => (0, 3),
                SpaceStatus::Slip { .. } => (2, 3),
            };
            jumps += free;
            forces += pressed;
        }
        let less = |one: usize, other: usize| (one as f64) < CLEARLY_LESS * other as f64;
        match present {
            Some(Self::Jumps) if less(forces, jumps) => Self::Forces,
            Some(Self::Forces) if less(jumps, forces) => Self::Jumps,
            Some(present) => present,
            None if forces < jumps => Self::Forces,
            None => Self::Jumps,
        }
    }
}

/// The condition of an unknown: a linear combination (N) of the unknowns at its point and of the
/// product of the matrix with all unknowns vanishes.
#[derive(Debug, Clone, Copy)]
struct Condition {
    /// The unknown, 3a + c.
    unknown: usize,
    image: [f64; 3],
    own: [f64; 3],
}

/// The conditions of all unknowns.
#[derive(Debug, Clone)]
pub(super) struct Linearised<'a> {
    form: Form,
    /// A (N/mm) for unknown jumps, C (mm/N) for unknown forces.
    matrix: &'a FaceMatrix,
    conditions: Vec<Condition>,
}

impl<'a> Linearised<'a> {
    /// The conditions of points in `states` on the faces of `problem`.
    pub fn new(form: Form, problem: &FaceProblem<'a>, states: &[PointState]) -> Self {
        let mut conditions = Vec::new();
        for (a, PointState { status, friction, turning }) in states.iter().enumerate() {
            let weight = problem.stiffness.entry(3 * a, 3 * a);
            let alone = |c: usize, factor: f64| {
                let mut one = [0.0; 3];
                one[c] = factor;
                one
            };
            let mut add = |c: usize, of_forces: [f64; 3], of_jumps: [f64; 3]| {
                let (image, own) = match form {
                    Form::Jumps => (of_forces, of_jumps),
                    Form::Forces => (of_jumps, of_forces),
                };
                conditions.push(Condition { unknown: 3 * a + c, image, own });
            };
            match (status, form) {
                (SpaceStatus::Open, Form::Jumps) => (0..3).for_each(|c| add(c, alone(c, 1.0), [0.0; 3])),
                (SpaceStatus::Stick, Form::Forces) => {
                    (0..3).for_each(|c| add(c, [0.0; 3], alone(c, weight)));
                }
                (SpaceStatus::Open, Form::Forces) | (SpaceStatus::Stick, Form::Jumps) => {}
                (SpaceStatus::Slip { direction }, _) => {
                    if form == Form::Forces {
                        add(0, [0.0; 3], alone(0, weight));
                    }
                    for c in 1..3 {
                        let mut forces = [-friction * direction[c - 1], 0.0, 0.0];
                        let mut slip = [0.0; 3];
                        for e in 1..3 {
                            let same = f64::from(u8::from(e == c));
                            let across = turning * (same - direction[c - 1] * direction[e - 1]);
                            forces[e] = same - across;
                            slip[e] = across * weight;
                        }
                        add(c, forces, slip);
                    }
                }
            }
        }
        let matrix = match form {
            Form::Jumps => problem.stiffness,
            Form::Forces => problem.compliance,
        };
        Self { form, matrix, conditions }
    }

    /// The linear combinations of `forces` (N) with the slip and opening `moved` (mm), both 3p.
    pub fn of(&self, forces: &[f64], moved: &[f64]) -> Vec<f64> {
        match self.form {
            Form::Jumps => self.combined(forces, moved),
            Form::Forces => self.combined(moved, forces),
        }
    }

    /// The linear combinations of the unknowns with their product with the matrix, both 3p.
    fn combined(&self, image: &[f64], own: &[f64]) -> Vec<f64> {
        let value = |condition: &Condition| {
            let at = condition.unknown / 3 * 3;
            (0..3).map(|e| condition.image[e] * image[at + e] + condition.own[e] * own[at + e]).sum()
        };
        self.conditions.iter().map(value).collect()
    }

    /// The effect of unknown `k` on its own condition.
    fn alone(&self, k: usize) -> f64 {
        let Condition { unknown, image, own } = self.conditions[k];
        image[unknown % 3] * self.matrix.entry(unknown, unknown) + own[unknown % 3]
    }

    fn factor(&self) -> Result<LargeFactor, LinearError> {
        let order = self.conditions.len();
        let mut points: Vec<usize> = self.conditions.iter().map(|condition| condition.unknown / 3).collect();
        points.dedup();
        let mut columns = vec![0.0f32; order * order];
        columns.par_chunks_mut(order.max(1)).enumerate().for_each(|(k, column)| {
            let unknown = self.conditions[k].unknown;
            let row = self.matrix.row_at(unknown, points.iter().copied());
            let mut conditions = self.conditions.iter().zip(column).peekable();
            for (point, image) in points.iter().zip(&row) {
                while let Some((condition, entry)) =
                    conditions.next_if(|(next, _)| next.unknown / 3 == *point)
                {
                    let mut value: f64 = (0..3).map(|e| condition.image[e] * image[e]).sum();
                    if unknown / 3 == *point {
                        value += condition.own[unknown % 3];
                    }
                    *entry = value as f32;
                }
            }
        });
        LargeFactor::of_columns(order, columns)
    }
}

/// A change of the jumps (mm) with the corresponding change of the forces between the faces (N).
#[derive(Debug, Clone)]
pub(super) struct Change {
    pub jumps: Vec<f64>,
    pub forces: Vec<f64>,
}

impl Change {
    /// The unknowns and their product with the matrix.
    fn parts_mut(&mut self, form: Form) -> [&mut [f64]; 2] {
        match form {
            Form::Jumps => [&mut self.jumps, &mut self.forces],
            Form::Forces => [&mut self.forces, &mut self.jumps],
        }
    }
}

/// Factor of conditions that are solved repeatedly with small changes, in single precision: that of
/// an earlier iteration preconditions minimal residuals for the present one, until it no longer
/// pays.
#[derive(Debug, Default)]
pub(super) struct LaggedFactor {
    factor: Option<(Form, LargeFactor)>,
    /// The index of each component among the unknowns of the factor.
    places: Vec<Option<usize>>,
    /// Number of products that a new factor would have saved.
    wasted: usize,
}

/// Wasted products after which a new factor is made, constant and per unknown: the cost of a
/// factorisation in products.
const PRODUCTS: usize = 4;
const UNKNOWNS_PER_PRODUCT: usize = 60;
/// Number of products of a solution with a new factor.
const NEEDED: usize = 2;

impl LaggedFactor {
    /// The form of the conditions for which a factor exists.
    pub fn form(&self) -> Option<Form> {
        self.factor.as_ref().map(|(form, _)| *form)
    }

    /// Adds to `change` the solution for which the combinations of `conditions` change by `right`,
    /// to within `tolerance` relative to `right`.
    ///
    /// Errors: a singular system.
    pub fn solve(
        &mut self,
        conditions: &Linearised<'_>,
        right: &[f64],
        tolerance: f64,
        change: &mut Change,
    ) -> Result<(), LinearError> {
        if right.iter().all(|value| *value == 0.0) {
            return Ok(());
        }
        let most = PRODUCTS + right.len() / UNKNOWNS_PER_PRODUCT;
        let is_worn = self.wasted >= most;
        if self.form() == Some(conditions.form)
            && !is_worn
            && self.improves(conditions, right, tolerance, most, change)?
        {
            return Ok(());
        }
        self.wasted = 0;
        self.places = vec![None; change.jumps.len()];
        for (place, condition) in conditions.conditions.iter().enumerate() {
            self.places[condition.unknown] = Some(place);
        }
        self.factor = Some((conditions.form, conditions.factor()?));
        // Behind a factor that rounding has spoilt, minimal residuals take as many products as
        // there are unknowns at most.
        if self.improves(conditions, right, tolerance, right.len().max(most), change)? {
            Ok(())
        } else {
            Err(LinearError::Singular { order: right.len() })
        }
    }

    /// [`Self::solve`] with this factor; if more than `most` products are required, nothing changes
    /// and the result says so.
    fn improves(
        &mut self,
        conditions: &Linearised<'_>,
        right: &[f64],
        tolerance: f64,
        most: usize,
        change: &mut Change,
    ) -> Result<bool, LinearError> {
        let mut directions = Vec::new();
        let least = least_residual(right, tolerance, most, |direction| {
            let unknowns = self.preconditioned(conditions, direction)?;
            let image = conditions.matrix.times(&unknowns);
            let product = conditions.combined(&image, &unknowns);
            directions.push([unknowns, image]);
            Ok::<_, LinearError>(product)
        })?;
        self.wasted += directions.len().saturating_sub(NEEDED);
        if least.residual > tolerance {
            return Ok(false);
        }
        for (factor, direction) in least.factors.iter().zip(&directions) {
            for (part, direction) in change.parts_mut(conditions.form).into_iter().zip(direction) {
                axpy(*factor, direction, part);
            }
        }
        Ok(true)
    }

    /// Unknowns (3p) that approximately produce the combinations `values`; unknowns that the factor
    /// does not contain are treated as uncoupled.
    fn preconditioned(&self, conditions: &Linearised<'_>, values: &[f64]) -> Result<Vec<f64>, LinearError> {
        let mut unknowns = vec![0.0; self.places.len()];
        let Some((_, factor)) = &self.factor else { return Ok(unknowns) };
        let mut right = vec![0.0; factor.order()];
        for (k, (condition, value)) in conditions.conditions.iter().zip(values).enumerate() {
            match self.places[condition.unknown] {
                Some(place) => right[place] = *value,
                None => unknowns[condition.unknown] = value / conditions.alone(k),
            }
        }
        let solution = factor.solve(&right)?;
        for condition in &conditions.conditions {
            if let Some(place) = self.places[condition.unknown] {
                unknowns[condition.unknown] = solution[place];
            }
        }
        Ok(unknowns)
    }
}

/// √Σ v².
pub(super) fn size(values: &[f64]) -> f64 {
    dot(values, values).sqrt()
}

/// Points in contact, those of whole faces or of one half of symmetric ones.
#[derive(Debug, Clone, Copy)]
pub(super) struct FaceProblem<'a> {
    /// A (N/mm), 3p × 3p.
    pub stiffness: &'a FaceMatrix,
    /// C = A⁻¹ (mm/N).
    pub compliance: &'a FaceMatrix,
    /// Crack-face friction coefficient μ of each point.
    pub friction: &'a [f64],
}
