//! Pressures over the mouths of cracks under a wheel that feels them, where they act on the fluid
//! in the cracks.
//!
//! The pressure over a mouth depends on the fluid that it presses into the crack: the fluid lifts
//! the flap, and the wheel bridges the mouth. A step of the wheel assumes how the pressures change;
//! then the wheel is held, and the pressures follow from the contact. Where this has no solution
//! nearby, the flap snaps from one position to another.

use crate::contact::{FaceProblem, FaceSolution, FluidModel, LoadPath, Pocket};
use crate::math::axpy;

/// The pressures along the path of a wheel.
#[derive(Debug, Clone, Default)]
pub(super) struct MouthPressures {
    /// x_c (mm) at which they are known.
    at: f64,
    /// MPa, one for each pocket.
    pub now: Vec<f64>,
    /// Their rates over the last step, MPa/mm.
    rates: Vec<f64>,
}

/// Largest number of changes of the pressures at one position.
pub(super) const MOST_CHANGES: usize = 200;
/// Error of a pressure over p0.
const SETTLED: f64 = 2e-4;
/// Largest change of a pressure at a time, over p0.
const LARGEST_CHANGE: f64 = 0.05;
/// Slope of (pressure that follows − pressure) over the pressure above which the flap is about to
/// snap.
const ABOUT_TO_SNAP: f64 = -0.05;

impl MouthPressures {
    /// No pressure over the mouths of `pockets` pockets, with the wheel at `at` (mm).
    pub fn none(pockets: usize, at: f64) -> Self {
        Self { at, now: vec![0.0; pockets], rates: vec![0.0; pockets] }
    }

    /// The pressures (MPa) that a step to `xc` (mm) assumes.
    pub fn assumed(&self, xc: f64) -> Vec<f64> {
        let values = self.now.iter().zip(&self.rates);
        values.map(|(now, rate)| (now + rate * (xc - self.at)).max(0.0)).collect()
    }

    /// Continues from the pressures `settled` (MPa) at `xc` (mm).
    pub fn advance(&mut self, xc: f64, settled: Vec<f64>) {
        let length = xc - self.at;
        if length != 0.0 {
            self.rates = settled.iter().zip(&self.now).map(|(p, before)| (p - before) / length).collect();
        }
        (self.at, self.now) = (xc, settled);
    }
}

/// The search for the pressures at one position.
pub(super) struct Settling {
    /// Pressures (MPa), and by how much those that follow from the contact exceed them.
    before: Option<(Vec<f64>, Vec<f64>)>,
    peak_pressure: f64,
}

impl Settling {
    pub fn new(peak_pressure: f64) -> Self {
        Self { before: None, peak_pressure }
    }

    /// The next pressures to try after `tried`, from which `found` follow; none where they agree.
    pub fn next(&mut self, tried: &[f64], found: &[f64]) -> Option<Vec<f64>> {
        let excess: Vec<f64> = found.iter().zip(tried).map(|(found, tried)| found - tried).collect();
        if excess.iter().all(|excess| excess.abs() <= SETTLED * self.peak_pressure) {
            return None;
        }
        let most = LARGEST_CHANGE * self.peak_pressure;
        let step = |k: usize| {
            let slope = self.before.as_ref().and_then(|(tried_before, excess_before)| {
                let by = tried[k] - tried_before[k];
                (by != 0.0).then(|| (excess[k] - excess_before[k]) / by)
            });
            let change = match slope {
                None => excess[k],
                Some(slope) if slope < ABOUT_TO_SNAP => -excess[k] / slope,
                Some(_) => most.copysign(excess[k]),
            };
            (tried[k] + change.clamp(-most, most)).max(0.0)
        };
        let next = (0..tried.len()).map(step).collect();
        self.before = Some((tried.to_vec(), excess));
        Some(next)
    }
}

/// A wheel that is held while the pressures over the mouths change from one set to another.
pub(super) struct PressuresChange<'a> {
    pub problem: &'a FaceProblem<'a>,
    /// The load with the first pressures, of all components.
    pub start: Vec<f64>,
    pub from: &'a [f64],
    pub to: &'a [f64],
}

impl PressuresChange<'_> {
    /// The pockets whose fluid has the pressure over the mouth; none for trapped fluid.
    fn fed_by_mouth(&self) -> Option<&[Pocket]> {
        let fluid = self.problem.fluid()?;
        matches!(fluid.model, FluidModel::Mouth { .. }).then_some(&fluid.pockets)
    }
}

impl LoadPath for PressuresChange<'_> {
    fn nodal_forces(&self, at: f64) -> Vec<f64> {
        let mut forces = self.start.clone();
        let pockets = self.fed_by_mouth().unwrap_or_default();
        for (pocket, (from, to)) in pockets.iter().zip(self.from.iter().zip(self.to)) {
            axpy(at * (to - from), &pocket.profile, &mut forces);
        }
        forces
    }

    fn over_mouths(&self, at: f64) -> Vec<f64> {
        if self.fed_by_mouth().is_some() {
            return Vec::new();
        }
        self.from.iter().zip(self.to).map(|(from, to)| from + at * (to - from)).collect()
    }
}

/// The pressures (MPa) of the contact over the mouths of the pockets of `problem` in `solution`;
/// zero for pockets that are not `covered`.
pub(super) fn over_mouths(problem: &FaceProblem, solution: &FaceSolution, covered: &[bool]) -> Vec<f64> {
    let pockets = problem.fluid().map_or(&[][..], |fluid| &fluid.pockets);
    let over = |(k, pocket): (usize, &Pocket)| match (problem.wheel(), pocket.mouth) {
        (Some(wheel), Some(mouth)) if covered[k] => wheel.mean(&solution.jump, mouth.x).max(0.0),
        _ => 0.0,
    };
    pockets.iter().enumerate().map(over).collect()
}

/// Whether the contact of a wheel in `solution` reaches both sides of the mouth of each pocket of
/// `problem`.
pub(super) fn covered(problem: &FaceProblem, solution: &FaceSolution) -> Vec<bool> {
    let pockets = problem.fluid().map_or(&[][..], |fluid| &fluid.pockets);
    let extent = problem.wheel().and_then(|wheel| wheel.extent(&solution.loaded));
    let covers = |mouth: f64| extent.is_some_and(|(from, to)| from <= mouth && mouth <= to);
    pockets.iter().map(|pocket| pocket.mouth.is_some_and(|mouth| covers(mouth.x))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The pressure at which `follows` settles from `start`.
    fn settle(start: f64, follows: impl Fn(f64) -> f64) -> f64 {
        let (mut settling, mut pressure) = (Settling::new(1000.0), start);
        for _ in 0..MOST_CHANGES {
            match settling.next(&[pressure], &[follows(pressure)]) {
                Some(next) => pressure = next[0],
                None => return pressure,
            }
        }
        panic!("{pressure}");
    }

    #[test]
    fn settles_where_the_contact_has_the_assumed_pressure() {
        let falling = settle(0.0, |p| 400.0 - 0.3 * p);
        assert!((falling - 400.0 / 1.3).abs() < 0.2, "{falling}");
        // Between 0 and 500 more follows than is assumed, with hardly any difference at 100.
        let snapping =
            settle(0.0, |p| if p < 500.0 { p + 1.0 + 1e-3 * (p - 100.0).powi(2) } else { 750.0 - 0.5 * p });
        assert!((snapping - 500.0).abs() < 1.0, "{snapping}");
    }
}
