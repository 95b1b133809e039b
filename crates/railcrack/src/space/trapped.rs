//! Pressures of trapped fluid as unknowns of a step: p ≥ 0, V ≥ V₀ e^(−p/B), one of them an
//! equality.
//!
//! With the states of the points fixed, jumps and forces are linear in the pressures. An iteration
//! solves for the response to a unit pressure of each sealed pocket and then for the pressures.

use super::fluid::SpacePocket;
use super::linearised::Change;
use crate::contact::{PocketState, PocketStatus, compressed};
use crate::linear::SmallFactor;
use crate::math::{Matrix, axpy};

/// The pockets during a step: their states at its beginning.
#[derive(Debug, Clone, Copy)]
pub(super) struct PocketsOfStep<'a> {
    /// The pockets.
    pub pockets: &'a [SpacePocket],
    /// Their states, or none where no fluid is trapped.
    pub states: &'a [PocketState],
    /// B, MPa.
    pub bulk_modulus: f64,
}

/// Pressures and states of the pockets during the iterations of a step.
#[derive(Debug)]
pub(super) struct TrappedPressures<'a> {
    of: PocketsOfStep<'a>,
    states: Vec<PocketState>,
    /// Whether a pocket changed between sealed and cavity in the last iteration.
    is_unsettled: bool,
}

/// Difference of the volumes of pocket and fluid that is accepted, over the volume of the fluid.
const VOLUME: f64 = 1e-8;
/// Share of its volume on free faces below which a unit pressure opens practically nothing.
const CLOSED: f64 = 1e-6;

impl<'a> TrappedPressures<'a> {
    pub fn of(of: PocketsOfStep<'a>) -> Self {
        Self { of, states: of.states.to_vec(), is_unsettled: false }
    }

    /// The states of the pockets.
    pub fn states(&self) -> &[PocketState] {
        &self.states
    }

    /// `forces` (N, 3p) with those of the pressures.
    pub fn added_to(&self, forces: &[f64]) -> Vec<f64> {
        let mut all = forces.to_vec();
        for (pocket, state) in self.of.pockets.iter().zip(&self.states) {
            if state.pressure != 0.0 {
                axpy(state.pressure, &pocket.unit, &mut all);
            }
        }
        all
    }

    /// The pockets whose volume determines their pressure.
    pub fn pressing(&self) -> Vec<usize> {
        let is_sealed = |&k: &usize| self.states[k].status == PocketStatus::Sealed;
        (0..self.states.len()).filter(is_sealed).collect()
    }

    /// Adds to `change`, from the jumps `jumps` (mm), the effect of the pressures at which the
    /// volumes are those of the fluid, with the responses `units` to unit pressures, and changes
    /// `forces` (N) by them.
    pub fn press(
        &mut self,
        jumps: &[f64],
        change: &mut Change,
        units: &[(usize, Change)],
        forces: &mut [f64],
    ) {
        let pockets = self.of.pockets;
        let held = |state: &PocketState| state.content * compressed(state.pressure, self.of.bulk_modulus);
        let rows = Matrix::from_fn(units.len(), units.len(), |i, j| {
            let k = units[i].0;
            let volume = pockets[k].volume(&units[j].1.jumps);
            // Closed faces: the pressure rises as if they were free, until the first point opens.
            let volume = if i == j { volume.max(CLOSED * pockets[k].free) } else { volume };
            let own = held(&self.states[k]) / self.of.bulk_modulus;
            volume + if i == j { own } else { 0.0 }
        });
        let missing = |&(k, _): &(usize, Change)| {
            let now = pockets[k].volume(jumps) + pockets[k].volume(&change.jumps);
            held(&self.states[k]) - now
        };
        let mut pressures: Vec<f64> = units.iter().map(missing).collect();
        let solved = SmallFactor::new(rows).and_then(|factor| factor.solve(&mut pressures));
        if solved.is_err() {
            pressures.fill(0.0);
        }
        self.is_unsettled = false;
        for ((k, unit), by) in units.iter().zip(&pressures) {
            let state = &mut self.states[*k];
            let by = if state.pressure + by < 0.0 {
                (state.status, self.is_unsettled) = (PocketStatus::Cavity, true);
                -state.pressure
            } else {
                *by
            };
            state.pressure += by;
            axpy(by, &unit.jumps, &mut change.jumps);
            axpy(by, &unit.forces, &mut change.forces);
            axpy(by, &pockets[*k].unit, forces);
        }
        for (pocket, state) in pockets.iter().zip(&mut self.states) {
            let volume = || pocket.volume(jumps) + pocket.volume(&change.jumps);
            if state.status == PocketStatus::Cavity
                && state.content > 0.0
                && !units.iter().any(|(k, _)| std::ptr::eq(&pockets[*k], pocket))
                && volume() < state.content * (1.0 - VOLUME)
            {
                (state.status, self.is_unsettled) = (PocketStatus::Sealed, true);
            }
        }
    }

    /// Whether the conditions of all pockets hold at the jumps `jumps` (mm).
    pub fn holds(&self, jumps: &[f64]) -> bool {
        let is_held = |(pocket, state): (&SpacePocket, &PocketState)| {
            let content = state.content * compressed(state.pressure, self.of.bulk_modulus);
            let excess = pocket.volume(jumps) - content;
            match state.status {
                PocketStatus::Sealed => excess.abs() <= VOLUME * state.content,
                // The volume of closed faces that slip over a fold may be negative by the length of
                // a cell.
                PocketStatus::Cavity if state.content == 0.0 => true,
                PocketStatus::Cavity => excess >= -VOLUME * state.content,
                PocketStatus::Vented | PocketStatus::Leaking => true,
            }
        };
        !self.is_unsettled && self.of.pockets.iter().zip(&self.states).all(is_held)
    }
}
