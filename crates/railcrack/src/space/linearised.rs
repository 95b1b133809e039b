//! Contact conditions of the faces in space, linearised at given states of the points.

use super::states::{PointState, SpaceStatus};
use crate::linear::{LargeFactor, LinearError, least_residual};
use crate::math::{Matrix, add_rows_to_each, axpy, dot};
use rayon::prelude::*;

/// Rows of a product that one thread computes: their sums do not depend on the thread.
const ROWS: usize = 450;

/// A ⟦w⟧ of jumps of which many may be zero.
pub(super) fn resisted(stiffness: &Matrix, jumps: &[f64]) -> Vec<f64> {
    let (moving, values): (Vec<usize>, Vec<f64>) =
        jumps.iter().enumerate().filter(|(_, jump)| **jump != 0.0).unzip();
    let mut forces = vec![0.0; jumps.len()];
    forces.par_chunks_mut(ROWS).enumerate().for_each(|(k, chunk)| {
        let (from, to) = (k * ROWS, k * ROWS + chunk.len());
        // A is symmetric: its rows are its columns.
        add_rows_to_each(&[&values], |i| &stiffness.row(moving[i])[from..to], &mut [chunk]);
    });
    forces
}

/// The condition of a jump that is not held: this combination of the forces at its point, and of
/// the slip since the last step, is zero.
#[derive(Debug, Clone, Copy)]
struct Condition {
    /// The jump, 3a + c.
    unknown: usize,
    forces: [f64; 3],
    slip: [f64; 2],
}

/// The conditions of all jumps that are not held.
#[derive(Debug, Clone)]
pub(super) struct Linearised<'a> {
    stiffness: &'a Matrix,
    conditions: Vec<Condition>,
}

impl<'a> Linearised<'a> {
    /// Of points in `states`.
    pub fn new(stiffness: &'a Matrix, states: &[PointState]) -> Self {
        let mut conditions = Vec::new();
        for (a, PointState { status, friction, turning }) in states.iter().enumerate() {
            match status {
                SpaceStatus::Open => conditions.extend((0..3).map(|c| Condition {
                    unknown: 3 * a + c,
                    forces: std::array::from_fn(|e| f64::from(u8::from(e == c))),
                    slip: [0.0; 2],
                })),
                SpaceStatus::Stick => {}
                SpaceStatus::Slip { direction } => conditions.extend((1..3).map(|c| {
                    let mut forces = [-friction * direction[c - 1], 0.0, 0.0];
                    let mut slip = [0.0; 2];
                    for e in 0..2 {
                        let same = f64::from(u8::from(e + 1 == c));
                        let across = turning * (same - direction[c - 1] * direction[e]);
                        forces[e + 1] = same - across;
                        slip[e] = across * stiffness[(3 * a, 3 * a)];
                    }
                    Condition { unknown: 3 * a + c, forces, slip }
                })),
            }
        }
        Self { stiffness, conditions }
    }

    /// The combinations of `forces` (N) and `slip` (mm), both 3p.
    pub fn of(&self, forces: &[f64], slip: &[f64]) -> Vec<f64> {
        let value = |condition: &Condition| {
            let at = condition.unknown / 3 * 3;
            let pushed: f64 = (0..3).map(|e| condition.forces[e] * forces[at + e]).sum();
            pushed + (0..2).map(|e| condition.slip[e] * slip[at + 1 + e]).sum::<f64>()
        };
        self.conditions.iter().map(value).collect()
    }

    fn factor(&self) -> Result<LargeFactor, LinearError> {
        let order = self.conditions.len();
        let mut columns = Matrix::zeros(order, order);
        columns.entries_mut().par_chunks_mut(order.max(1)).enumerate().for_each(|(k, column)| {
            let unknown = self.conditions[k].unknown;
            let own = self.stiffness.row(unknown);
            for (condition, entry) in self.conditions.iter().zip(column) {
                let at = condition.unknown / 3 * 3;
                *entry = (0..3).map(|e| condition.forces[e] * own[at + e]).sum();
                if unknown / 3 * 3 == at && unknown > at {
                    *entry += condition.slip[unknown - at - 1];
                }
            }
        });
        LargeFactor::of_columns(columns)
    }
}

/// A change of the jumps (mm) and the forces (N) that resist it.
#[derive(Debug, Clone)]
pub(super) struct Change {
    pub jumps: Vec<f64>,
    pub forces: Vec<f64>,
}

/// Factors of conditions that are solved again and again with small changes: those of some earlier
/// iteration precondition minimal residuals of the present one, until they no longer help.
#[derive(Debug, Default)]
pub(super) struct LaggedFactor {
    factor: Option<LargeFactor>,
    /// The place of each jump among the unknowns of the factor.
    places: Vec<Option<usize>>,
    /// Products that a new factor would have saved.
    wasted: usize,
}

/// Wasted products after which a factor is made anew, and per unknown: what making it costs in
/// products.
const PRODUCTS: usize = 5;
const UNKNOWNS_PER_PRODUCT: usize = 30;
/// Products of a solution with a new factor.
const NEEDED: usize = 2;

impl LaggedFactor {
    /// Adds to `change` what makes the combinations of `conditions` change by `right`, to
    /// `tolerance` of the size of `right`.
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
        if self.factor.is_some() && !is_worn && self.improves(conditions, right, tolerance, most, change)? {
            return Ok(());
        }
        self.wasted = 0;
        self.places = vec![None; change.jumps.len()];
        for (place, condition) in conditions.conditions.iter().enumerate() {
            self.places[condition.unknown] = Some(place);
        }
        self.factor = Some(conditions.factor()?);
        self.improves(conditions, right, tolerance, most, change)?;
        Ok(())
    }

    /// [`Self::solve`] by this factor; changes nothing, and says so, if it takes more than `most`
    /// products.
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
            let jumps = self.preconditioned(conditions, direction)?;
            let forces = resisted(conditions.stiffness, &jumps);
            let product = conditions.of(&forces, &jumps);
            directions.push(Change { jumps, forces });
            Ok::<_, LinearError>(product)
        })?;
        self.wasted += directions.len().saturating_sub(NEEDED);
        if least.residual > tolerance {
            return Ok(false);
        }
        for (factor, direction) in least.factors.iter().zip(&directions) {
            axpy(*factor, &direction.jumps, &mut change.jumps);
            axpy(*factor, &direction.forces, &mut change.forces);
        }
        Ok(true)
    }

    /// Jumps (3p) that nearly make the combinations `values`: unknowns that are new to the factor
    /// move alone.
    fn preconditioned(&self, conditions: &Linearised<'_>, values: &[f64]) -> Result<Vec<f64>, LinearError> {
        let mut jumps = vec![0.0; self.places.len()];
        let Some(factor) = &self.factor else { return Ok(jumps) };
        let mut right = vec![0.0; factor.order()];
        for (condition, value) in conditions.conditions.iter().zip(values) {
            match self.places[condition.unknown] {
                Some(place) => right[place] = *value,
                None => {
                    let own = conditions.stiffness[(condition.unknown, condition.unknown)];
                    jumps[condition.unknown] = value / own;
                }
            }
        }
        let solution = factor.solve(&right)?;
        for condition in &conditions.conditions {
            if let Some(place) = self.places[condition.unknown] {
                jumps[condition.unknown] = solution[place];
            }
        }
        Ok(jumps)
    }
}

/// √Σ v².
pub(super) fn size(values: &[f64]) -> f64 {
    dot(values, values).sqrt()
}
