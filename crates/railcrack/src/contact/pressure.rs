//! Pressures of trapped fluid as unknowns of the contact problem.

use super::condition::Degenerate;
use super::problem::ROUND_OFF;
use super::tableau::FaceRate;
use super::{FaceProblem, FaceScale, FaceSolution, FluidModel, Pocket, PocketState, PocketStatus};
use crate::linear::SmallFactor;
use crate::math::Matrix;
use std::borrow::Cow;

/// Share of its volume with free faces below which the response of a pocket to a pressure is that
/// of closed faces: slip along a kink, which is an error of the interpolation there. A few open
/// points next to a tip respond by 1e-9.
const CLOSED: f64 = 1e-13;
/// Largest exponent of e^x during the iteration.
const MOST_EXPONENT: f64 = 50.0;
/// Largest number of Newton iterations for a compressible fluid; two or three suffice.
const ITERATIONS: usize = 40;
/// Largest decrease of a pressure in one iteration, over B. Below the solution the iterations
/// converge from any distance, but e^(-p/B) must not overflow during the iteration.
const LARGEST_FALL: f64 = 2.0;
/// Relative change of the pressure at which the iterations end.
const SETTLED: f64 = 1e-13;
/// Volume of a pocket over the largest jump (mm), in mm, below which it holds no fluid.
const NO_VOLUME: f64 = 1e-9;
/// Relative increase of the content of a leaking pocket that is tolerated. Fluid does not return;
/// the loss in a step has no such limit.
const GROWN: f64 = 1e-9;

/// e^(−p/B).
pub(crate) fn compressed(pressure: f64, bulk: f64) -> f64 {
    (-pressure / bulk).clamp(-MOST_EXPONENT, MOST_EXPONENT).exp()
}

/// Whether a pocket in `state` may be or come under pressure: a cavity and a pocket that is open to
/// a mouth without pressure cannot. `driven` says whether the pressure over its mouth differs from
/// zero or changes.
pub(super) fn may_press(state: &PocketState, driven: bool) -> bool {
    let follows = match state.status {
        PocketStatus::Sealed => true,
        PocketStatus::Vented | PocketStatus::Leaking => driven,
        PocketStatus::Cavity => false,
    };
    follows || state.pressure != 0.0
}

/// The conditions of all pockets: one row for each pressure.
///
/// With fixed statuses jumps and contact forces are linear in the pressures; `units` are the
/// responses to a unit pressure of each pocket, empty where the pressure is zero and stays so. The
/// matrix of volumes per unit pressure is positive on the diagonal of a sealed pocket as soon as
/// one of its points can move.
pub(super) struct PocketRows<'e> {
    pub pockets: &'e [Pocket],
    /// Volumes of a unit pressure on free faces, mm²/MPa.
    pub free: &'e [f64],
    pub bulk: f64,
    pub units: &'e [FaceRate],
}

impl PocketRows<'_> {
    fn coefficient(&self, k: usize, q: usize, state: &PocketState) -> f64 {
        match state.status {
            PocketStatus::Vented | PocketStatus::Cavity | PocketStatus::Leaking => f64::from(k == q),
            PocketStatus::Sealed => {
                let own = state.content / self.bulk * compressed(state.pressure, self.bulk);
                self.pockets[k].volume(&self.units[q].jump) + if k == q { own } else { 0.0 }
            }
        }
    }

    /// Solves the linearised conditions for the right-hand sides `right`.
    pub(super) fn solve(&self, states: &[PocketState], mut right: Vec<f64>) -> Result<Vec<f64>, Degenerate> {
        let m = states.len();
        if m == 1 {
            let own = self.coefficient(0, 0, &states[0]);
            return if own == 0.0 { Err(Degenerate) } else { Ok(vec![right[0] / own]) };
        }
        let mut rows = Matrix::from_fn(m, m, |k, q| self.coefficient(k, q, &states[k]));
        for (k, value) in right.iter_mut().enumerate() {
            let own = rows[(k, k)];
            if own == 0.0 {
                return Err(Degenerate);
            }
            rows.row_mut(k).iter_mut().for_each(|entry| *entry /= own);
            *value /= own;
        }
        let factor = SmallFactor::new(rows).map_err(|_| Degenerate)?;
        factor.solve(&mut right).map_err(|_| Degenerate)?;
        Ok(right)
    }

    /// The residuals of the conditions at `states`, with the jumps `jump` (mm, 2p) that include the
    /// effect of these pressures.
    pub(super) fn defects(&self, states: &[PocketState], outside: &[f64], jump: &[f64]) -> Vec<f64> {
        let of = |(k, state): (usize, &PocketState)| match state.status {
            PocketStatus::Vented | PocketStatus::Leaking => outside[k] - state.pressure,
            PocketStatus::Cavity => -state.pressure,
            PocketStatus::Sealed => {
                state.content * compressed(state.pressure, self.bulk) - self.pockets[k].volume(jump)
            }
        };
        states.iter().enumerate().map(of).collect()
    }

    /// Adds the response to pressures (MPa) to jumps and contact forces.
    pub(super) fn add(&self, pressures: &[f64], jump: &mut [f64], contact: &mut [f64]) {
        for (unit, &pressure) in self.units.iter().zip(pressures) {
            if pressure != 0.0 {
                crate::math::axpy(pressure, &unit.jump, jump);
                crate::math::axpy(pressure, &unit.contact, contact);
            }
        }
    }

    /// The pressures of `states` at which all conditions hold, with the points that are `open`.
    /// `jump` and `contact` are given without the pressures and include them afterwards.
    pub(super) fn press(
        &self,
        states: &mut [PocketState],
        open: impl Fn(usize) -> bool,
        outside: &[f64],
        jump: &mut [f64],
        contact: &mut [f64],
    ) -> Result<(), Degenerate> {
        let mut given = outside.to_vec();
        let mut solved = states.to_vec();
        for (k, state) in solved.iter_mut().enumerate() {
            let pocket = &self.pockets[k];
            let yields = || pocket.volume(&self.units[k].jump) > CLOSED * self.free[k];
            let is_open = || pocket.points.iter().any(|&j| open(j));
            if state.status == PocketStatus::Sealed && !(is_open() && yields()) {
                // The faces are closed: the pressure rises until the first point opens.
                let opens = |&j: &usize| {
                    let (force, by) = (contact[2 * j + 1], -self.units[k].contact[2 * j + 1]);
                    (by > 0.0 && force > 0.0).then(|| force / by)
                };
                let first = pocket.points.iter().filter_map(opens).fold(f64::INFINITY, f64::min);
                given[k] = if first.is_finite() && state.content > 0.0 { 1.000_001 * first } else { 0.0 };
                state.status = PocketStatus::Vented;
            }
        }
        let pressures: Vec<f64> = solved.iter().map(|state| state.pressure).collect();
        self.add(&pressures, jump, contact);
        for _ in 0..ITERATIONS {
            let mut change = self.solve(&solved, self.defects(&solved, &given, jump))?;
            let fall = (0..change.len())
                .filter(|&k| solved[k].status == PocketStatus::Sealed)
                .fold(0.0f64, |m, k| m.max(-change[k]));
            if fall > LARGEST_FALL * self.bulk {
                change.iter_mut().for_each(|change| *change *= LARGEST_FALL * self.bulk / fall);
            }
            if change.iter().any(|change| !change.is_finite()) {
                return Err(Degenerate);
            }
            self.add(&change, jump, contact);
            solved.iter_mut().zip(&change).for_each(|(state, change)| state.pressure += change);
            let largest = |of: &dyn Fn(usize) -> f64| (0..change.len()).map(of).fold(0.0f64, f64::max);
            let pressure = largest(&|k| solved[k].pressure.abs());
            if largest(&|k| change[k].abs()) <= SETTLED * pressure {
                break;
            }
        }
        states.iter_mut().zip(&solved).for_each(|(state, solved)| state.pressure = solved.pressure);
        Ok(())
    }
}

/// Round-off of the pressure (MPa) and of the volume (mm²) of `pocket` at forces and jumps of the
/// size `scale`.
pub(super) fn round_off(pocket: &Pocket, scale: FaceScale) -> (f64, f64) {
    let widest = pocket.unit.iter().fold(f64::MIN_POSITIVE, |m, v| m.max(v.abs()));
    let length: f64 = pocket.unit.iter().map(|v| v.abs()).sum();
    (ROUND_OFF * scale.force / widest, ROUND_OFF * scale.jump * length)
}

/// V e^(p/B) (mm²): the content of pocket `k`.
pub(super) fn content(problem: &FaceProblem, solution: &FaceSolution, k: usize) -> f64 {
    let volume = problem.pockets()[k].volume(&solution.jump);
    volume.max(0.0) / compressed(solution.fluid[k].pressure, problem.bulk_modulus())
}

/// Whether pocket `k` holds no fluid, for jumps of the size `scale`. Faces that are closed
/// everywhere hold no fluid: a volume due to slip along a kink is an error of the interpolation
/// there.
pub(super) fn is_empty(problem: &FaceProblem, solution: &FaceSolution, scale: FaceScale, k: usize) -> bool {
    let pocket = &problem.pockets()[k];
    let is_closed = |&j: &usize| solution.status[j].is_closed();
    pocket.volume(&solution.jump) <= NO_VOLUME * scale.jump || pocket.points.iter().all(is_closed)
}

impl Pocket {
    /// V (mm²) of the fluid in `solution`: of faces that are closed everywhere, and of jumps that
    /// enclose less than nothing by an error of the interpolation, it is zero.
    pub fn fluid_volume(&self, solution: &FaceSolution) -> f64 {
        if self.points.iter().all(|&point| solution.status[point].is_closed()) {
            return 0.0;
        }
        self.volume(&solution.jump).max(0.0)
    }
}

/// Whether open faces connect all open points of pocket `k` with its mouth.
pub(super) fn has_open_path(problem: &FaceProblem, solution: &FaceSolution, k: usize) -> bool {
    let pocket = &problem.pockets()[k];
    let Some(mouth) = pocket.mouth else { return false };
    let is_open = |j: usize| !solution.status[j].is_closed();
    if !is_open(mouth.point) {
        return false;
    }
    let mut reached = vec![false; problem.points()];
    reached[mouth.point] = true;
    reach_open(&mut reached, &pocket.neighbours, is_open);
    pocket.points.iter().all(|&j| !is_open(j) || reached[j])
}

/// Extends the face points `reached` to all that open points connect with them, by pairs of
/// `neighbours`.
pub(crate) fn reach_open(
    reached: &mut [bool],
    neighbours: &[(usize, usize)],
    is_open: impl Fn(usize) -> bool,
) {
    let mut further = true;
    while further {
        further = false;
        for &(one, other) in neighbours {
            if is_open(one) && is_open(other) && reached[one] != reached[other] {
                (reached[one], reached[other], further) = (true, true, true);
            }
        }
    }
}

/// The status that the conditions of pocket `k` require, if it differs from the present one. Fluid
/// with an open path and too high a pressure is released between load steps.
pub(super) fn demanded(
    problem: &FaceProblem,
    solution: &FaceSolution,
    scale: FaceScale,
    k: usize,
) -> Option<PocketStatus> {
    use PocketStatus::{Cavity, Leaking, Sealed, Vented};
    let pocket = &problem.pockets()[k];
    let PocketState { status, pressure, content: filled } = solution.fluid[k];
    let (small_pressure, small_volume) = round_off(pocket, scale);
    match status {
        Vented => None,
        Sealed => (pressure < -small_pressure).then_some(Cavity),
        Cavity => (filled > 0.0 && pocket.volume(&solution.jump) < filled - small_volume).then_some(Sealed),
        Leaking => {
            let grown = || content(problem, solution, k) > filled * (1.0 + GROWN) + small_volume;
            let closed = || !has_open_path(problem, solution, k) && !is_empty(problem, solution, scale, k);
            (closed() || grown()).then_some(Sealed)
        }
    }
}

/// The largest violation of the conditions of the pockets in `solution`: negative pressure relative
/// to `scale.force`, a difference between the volumes of pocket and fluid relative to `scale.jump`.
pub(super) fn violation(problem: &FaceProblem, solution: &FaceSolution, scale: FaceScale) -> f64 {
    let of = |(k, pocket): (usize, &Pocket)| {
        let PocketState { status, pressure, content } = solution.fluid[k];
        let widest = pocket.unit.iter().fold(0.0f64, |m, v| m.max(v.abs()));
        let length: f64 = pocket.unit.iter().map(|v| v.abs()).sum();
        let missing = content * compressed(pressure, problem.bulk_modulus()) - pocket.volume(&solution.jump);
        let volume = match status {
            PocketStatus::Sealed => missing.abs(),
            PocketStatus::Cavity if content > 0.0 => missing.max(0.0),
            _ => 0.0,
        };
        (-pressure * widest / scale.force).max(volume / (length * scale.jump))
    };
    problem.pockets().iter().enumerate().map(of).fold(0.0, f64::max)
}

/// The sum of the nodal forces `load` (N/mm, 2p) and those of the pressures in `solution`.
pub(super) fn total<'l>(
    problem: &FaceProblem,
    solution: &FaceSolution,
    load: impl Into<Cow<'l, [f64]>>,
) -> Cow<'l, [f64]> {
    let load = load.into();
    match problem.wheel() {
        Some(wheel) => with_pockets(problem, solution, wheel.on_faces(&load, &solution.jump)),
        None => with_pockets(problem, solution, load),
    }
}

/// [`total`] of nodal forces that contain those of a coupled wheel.
pub(super) fn with_pockets<'l>(
    problem: &FaceProblem,
    solution: &FaceSolution,
    load: impl Into<Cow<'l, [f64]>>,
) -> Cow<'l, [f64]> {
    let mut load = load.into();
    for (pocket, state) in problem.pockets().iter().zip(&solution.fluid) {
        crate::math::axpy(state.pressure, &pocket.unit, load.to_mut());
    }
    load
}

impl FaceProblem<'_> {
    /// The pockets whose pressure is an unknown.
    pub(super) fn pockets(&self) -> &[Pocket] {
        match self.fluid() {
            Some(fluid) if matches!(fluid.model, FluidModel::Trapped { .. }) => &fluid.pockets,
            _ => &[],
        }
    }

    pub(super) fn bulk_modulus(&self) -> f64 {
        match self.fluid().map(|fluid| fluid.model) {
            Some(FluidModel::Trapped { bulk_modulus, .. }) => bulk_modulus,
            _ => f64::INFINITY,
        }
    }

    pub(super) fn leaks(&self) -> bool {
        matches!(self.fluid().map(|fluid| fluid.model), Some(FluidModel::Trapped { leak: true, .. }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::Pocket;

    /// A sealed pocket of two points, the second of which is a short piece next to a tip: a unit
    /// pressure opens it by `response`, over a volume of one with free faces.
    fn pressed(response: f64, is_open: bool, content: f64) -> (f64, [f64; 4]) {
        let pockets = [Pocket {
            cracks: vec![0],
            unit: vec![0.0, 1.0, 0.0, 1e-3],
            profile: Vec::new(),
            mouth: None,
            points: vec![0, 1],
            neighbours: vec![(0, 1)],
        }];
        let unit = FaceRate { jump: vec![0.0, 0.0, 0.0, response], contact: vec![0.0, -1.0, 0.0, -0.5] };
        let rows = PocketRows { pockets: &pockets, free: &[1.0], bulk: f64::INFINITY, units: &[unit] };
        let mut states = [PocketState { status: PocketStatus::Sealed, pressure: 5.0, content }];
        let (mut jump, mut contact) = ([0.0; 4], [0.0, 300.0, 0.0, 0.0]);
        let open = |point: usize| is_open && point == 1;
        rows.press(&mut states, open, &[0.0], &mut jump, &mut contact).unwrap();
        (states[0].pressure, jump)
    }

    /// However little a pocket yields, its fluid keeps its volume as long as a point is open; a
    /// step that is traced from event to event has the same pressure.
    #[test]
    fn a_few_open_points_keep_their_volume() {
        for share in [1e-3, 1e-6, 8e-10, 1e-12] {
            let (pressure, jump) = pressed(1e3 * share, true, 70.0 * share);
            assert!((pressure / 70.0 - 1.0).abs() < 1e-12, "{share}: {pressure}");
            assert!((1e-3 * jump[3] / (70.0 * share) - 1.0).abs() < 1e-12, "{jump:?}");
        }
        // Closed faces open at the first point whose contact the pressure takes over.
        let (pressure, _) = pressed(1e-6, false, 1e-9);
        assert!((pressure / 300.0 - 1.0).abs() < 1e-5, "{pressure}");
    }
}
