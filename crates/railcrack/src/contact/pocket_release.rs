//! Sealing of fluid in pockets, and its release along open faces.

use super::pressure::{content, has_open_path, is_empty};
use super::{FaceSolution, LoadPath, PocketState, PocketStatus, Stepper, SteppingError};

/// Excess of the pressure on open faces over that at the mouth at which fluid is released, over the
/// tolerance times the largest pressure so far. Without this threshold fluid could leave in ever
/// smaller portions.
const RELEASE_EXCESS: f64 = 0.5;
/// Share of that threshold that suffices at the end of a step that was meant to end beyond it.
const ALMOST: f64 = 0.9;

/// A constant load under which the pressure of pockets changes from one value to another.
struct PressureChange {
    load: Vec<f64>,
    /// First and last pressure of each pocket, MPa.
    pressures: Vec<[f64; 2]>,
}

impl LoadPath for PressureChange {
    fn nodal_forces(&self, _: f64) -> Vec<f64> {
        self.load.clone()
    }

    fn over_mouths(&self, at: f64) -> Vec<f64> {
        self.pressures.iter().map(|[from, to]| from + at * (to - from)).collect()
    }
}

impl Stepper<'_> {
    /// Seals pocket `k` with the fluid that it holds now, at zero pressure.
    pub fn seal(&mut self, k: usize) {
        let empty = is_empty(self.problem, &self.current, self.largest, k);
        let content = if empty { 0.0 } else { self.problem.pockets()[k].volume(&self.current.jump) };
        let status = if empty { PocketStatus::Cavity } else { PocketStatus::Sealed };
        self.set_pocket(k, PocketState { status, pressure: 0.0, content });
    }

    /// Releases the pressure of pocket `k` under the present load; its mouth is free afterwards.
    /// `accepted` as in [`Stepper::advance`].
    ///
    /// Errors: as [`Stepper::advance`].
    pub(crate) fn release(
        &mut self,
        k: usize,
        accepted: &mut dyn FnMut(&FaceSolution, &[f64]),
    ) -> Result<(), SteppingError> {
        self.change_pressure(k, 0.0, accepted)?;
        self.outside[k] = 0.0;
        self.set_pocket(k, PocketState::FREE);
        Ok(())
    }

    /// Changes the pressure of pocket `k` to `to` (MPa) under the present load. The faces follow
    /// the pressure event by event, like a load, because friction makes the result path-dependent.
    fn change_pressure(
        &mut self,
        k: usize,
        to: f64,
        accepted: &mut dyn FnMut(&FaceSolution, &[f64]),
    ) -> Result<(), SteppingError> {
        let state = self.current.fluid[k];
        let from = state.pressure;
        if from != to {
            let mut pressures: Vec<[f64; 2]> = self.outside.iter().map(|&outside| [outside; 2]).collect();
            pressures[k] = [from, to];
            self.set_pocket(k, PocketState { status: PocketStatus::Vented, ..state });
            let (at, outside) = (self.at, self.outside.clone());
            self.outside[k] = from;
            self.begin(0.0);
            let path = PressureChange { load: self.load.clone(), pressures };
            let result = self.advance(&path, 1.0, accepted);
            self.begin(at);
            self.outside = outside;
            result?;
        }
        Ok(())
    }

    pub(super) fn set_pocket(&mut self, k: usize, state: PocketState) {
        self.current.fluid[k] = state;
        self.faces.set_pocket(k, state);
    }

    /// Releases fluid that is above the pressure over the mouth and has an open path to it, and the
    /// pressure of pockets without fluid.
    pub(super) fn release_all(
        &mut self,
        accepted: &mut dyn FnMut(&FaceSolution, &[f64]),
    ) -> Result<(), SteppingError> {
        if !self.problem.leaks() {
            return Ok(());
        }
        for k in 0..self.current.fluid.len() {
            let state = self.current.fluid[k];
            let outside = self.outside[k];
            let exceeds = state.pressure > outside + ALMOST * self.release_excess();
            if state.status == PocketStatus::Sealed
                && exceeds
                && has_open_path(self.problem, &self.current, k)
            {
                self.change_pressure(k, outside, accepted)?;
                // Pockets that have closed in the meantime keep the remaining fluid.
                let open = has_open_path(self.problem, &self.current, k);
                let status = if open { PocketStatus::Leaking } else { PocketStatus::Sealed };
                let content = content(self.problem, &self.current, k);
                self.set_pocket(k, PocketState { status, content, ..self.current.fluid[k] });
            } else if state.status != PocketStatus::Leaking {
                continue;
            }
            if is_empty(self.problem, &self.current, self.largest, k) {
                self.change_pressure(k, 0.0, accepted)?;
                let dry = PocketState { status: PocketStatus::Cavity, pressure: 0.0, content: 0.0 };
                self.set_pocket(k, dry);
            }
        }
        Ok(())
    }

    /// Excess of a pressure (MPa) over that outside at which fluid is released.
    pub(super) fn release_excess(&self) -> f64 {
        RELEASE_EXCESS * self.tolerance * self.largest_pressure
    }
}
