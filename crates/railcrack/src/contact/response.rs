//! Linear response of the faces for fixed statuses.

use super::condition::{Condition, Degenerate};
use super::pressure::{PocketRows, may_press};
use super::tableau::{FaceRate, Tableau};
use super::{FaceProblem, FaceSolution, PocketState, PointStatus};

/// The faces with fixed statuses, for which the jumps of the free components and the forces of the
/// held ones are linear in the loads. Newton's method solves load steps with it, and the step
/// control predicts events.
pub struct FaceResponse<'a> {
    problem: &'a FaceProblem<'a>,
    tableau: Tableau<'a>,
    solution: FaceSolution,
    kept: FaceSolution,
    /// Responses to a unit pressure of each pocket whose pressure may differ from zero, with the
    /// statuses of the last equilibrium; empty for other pockets.
    units: Vec<FaceRate>,
    /// Pressure (MPa) over the mouth of each pocket.
    outside: Vec<f64>,
}

impl<'a> FaceResponse<'a> {
    /// Virgin unloaded faces that just touch.
    pub(super) fn virgin(problem: &'a FaceProblem<'a>) -> Self {
        Self {
            problem,
            tableau: Tableau::new(problem.columns()),
            solution: FaceSolution::virgin_of(problem),
            kept: FaceSolution::virgin_of(problem),
            units: vec![FaceRate::default(); problem.pockets().len()],
            outside: vec![0.0; problem.pockets().len()],
        }
    }

    /// Saves the present statuses and values for [`Self::restore`].
    pub(super) fn keep(&mut self) {
        self.tableau.keep();
        self.kept.clone_from(&self.solution);
    }

    /// Restores the saved statuses and values.
    pub(super) fn restore(&mut self) {
        self.tableau.restore();
        self.solution.clone_from(&self.kept);
    }

    /// The last equilibrium and its statuses.
    pub fn solution(&self) -> &FaceSolution {
        &self.solution
    }

    /// Gives `point` another status from the next equilibrium on; a sticking point is held at the
    /// slip `reference` (mm).
    pub(super) fn set_status(&mut self, point: usize, status: PointStatus, reference: f64) {
        self.solution.status[point] = status;
        let coupling = status.direction() * self.problem.friction(point);
        let (shear, normal) = match status {
            PointStatus::Open => (Condition::Free(0.0), Condition::Free(0.0)),
            PointStatus::Stick => (Condition::Held(reference), Condition::Held(0.0)),
            PointStatus::SlipForward | PointStatus::SlipBackward => {
                (Condition::Free(coupling), Condition::Held(0.0))
            }
        };
        self.tableau.set(2 * point, shear);
        self.tableau.set(2 * point + 1, normal);
    }

    /// Brings the surface nodes of a coupled wheel into contact, or out of it, as `loaded`; an
    /// empty list uncouples the wheel.
    pub(super) fn couple(&mut self, loaded: &[bool]) {
        let Some(wheel) = self.problem.wheel() else { return };
        loaded.clone_into(&mut self.solution.loaded);
        for node in 0..wheel.nodes() {
            self.tableau.set(wheel.component(node), in_contact(loaded.get(node) == Some(&true)));
        }
        self.tableau.set(wheel.approach(), in_contact(!loaded.is_empty()));
    }

    /// Brings surface node `node` of a coupled wheel into contact, or out of it.
    pub(super) fn set_loaded(&mut self, node: usize, loaded: bool) {
        let Some(wheel) = self.problem.wheel() else { return };
        self.solution.loaded[node] = loaded;
        self.tableau.set(wheel.component(node), in_contact(loaded));
    }

    /// Sets the load to `acting` (N/mm, 2p).
    pub(super) fn load(&mut self, acting: &[f64]) {
        let units = self.problem.pockets().iter().map(|pocket| &pocket.unit[..]);
        self.tableau.loads().set(std::iter::once(acting).chain(units));
    }

    /// Sets the load to `end` (N/mm, 2p), which is the sum of `start` and both `rates`; the rates
    /// become loads 1 and 2.
    pub(super) fn load_on(&mut self, start: &[f64], end: &[f64], rates: [&[f64]; 2]) {
        let units = self.problem.pockets().iter().map(|pocket| &pocket.unit[..]);
        // Unit pressures are appended after the acting load.
        self.tableau.loads().set_on(start, end, units.chain(rates));
    }

    /// Sets the pressures (MPa) over the mouths of the pockets.
    pub(super) fn set_outside(&mut self, pressures: &[f64]) {
        self.outside.clone_from_slice(pressures);
    }

    /// Gives pocket `k` another state from the next equilibrium on.
    pub(super) fn set_pocket(&mut self, k: usize, state: PocketState) {
        self.solution.fluid[k] = state;
    }

    /// Responses to a unit pressure of each pocket with the present statuses, in `units`; empty for
    /// pockets that are not `needed`.
    pub(super) fn unit_rates(
        &mut self,
        needed: impl Fn(usize) -> bool,
        units: &mut [FaceRate],
    ) -> Result<(), Degenerate> {
        let components = self.problem.components();
        let mut rates = Vec::with_capacity(units.len());
        for (k, unit) in units.iter_mut().enumerate() {
            let components = if needed(k) { components } else { 0 };
            unit.jump.resize(components, 0.0);
            unit.contact.resize(components, 0.0);
            if components > 0 {
                rates.push((1 + k, unit));
            }
        }
        if rates.is_empty() { Ok(()) } else { self.tableau.rates(&mut rates) }
    }

    /// Adds the response to the pressures of the pockets.
    fn press(&mut self) -> Result<(), Degenerate> {
        if self.units.is_empty() {
            return Ok(());
        }
        let mut units = std::mem::take(&mut self.units);
        let (states, outside) = (self.solution.fluid.clone(), self.outside.clone());
        let answered = self.unit_rates(|k| may_press(&states[k], outside[k] != 0.0), &mut units);
        self.units = units;
        answered?;
        let (problem, units) = (self.problem, &self.units[..]);
        let rows = PocketRows {
            pockets: problem.pockets(),
            free: &problem.free_volumes,
            bulk: problem.bulk_modulus(),
            units,
        };
        let FaceSolution { jump, contact, fluid, status, .. } = &mut self.solution;
        let open = |point: usize| !status[point].is_closed();
        rows.press(fluid, open, &self.outside, jump, contact)
    }

    /// Appends a load (N/mm, 2p) whose response is a rate.
    pub(super) fn load_also(&mut self, load: Vec<f64>) {
        self.tableau.loads().add(load);
    }

    /// Jumps and contact forces under the load with the present statuses.
    pub(super) fn equilibrate(&mut self) -> Result<(), Degenerate> {
        let FaceSolution { jump, contact, .. } = &mut self.solution;
        self.tableau.solve(jump, contact)?;
        self.press()
    }

    /// [`FaceResponse::equilibrate`] after changes of status that may be undone.
    pub(super) fn equilibrate_again(&mut self) -> Result<(), Degenerate> {
        let FaceSolution { jump, contact, .. } = &mut self.solution;
        self.tableau.solve_again(jump, contact)?;
        self.press()
    }

    /// Contributions of the loads from number `first` on to jumps and contact forces with the
    /// present statuses, one after the other in `rates`.
    pub(super) fn rates(&mut self, first: usize, rates: &mut [FaceRate]) -> Result<(), Degenerate> {
        let first = first + self.units.len();
        let mut numbered: Vec<_> = rates.iter_mut().enumerate().map(|(k, rate)| (first + k, rate)).collect();
        self.tableau.rates(&mut numbered)
    }

    /// Contributions (mm) of load number `load` to the slip and the opening of `point` with the
    /// present statuses.
    pub(super) fn jump_under(&mut self, load: usize, point: usize) -> Result<[f64; 2], Degenerate> {
        self.tableau.jumps_under(load + self.units.len(), [2 * point, 2 * point + 1])
    }

    /// Adopts the statuses and values of `solution`, which is in equilibrium.
    pub(super) fn adopt(&mut self, solution: &FaceSolution) {
        for (point, &status) in solution.status.iter().enumerate() {
            self.set_status(point, status, solution.jump[2 * point]);
        }
        self.couple(&solution.loaded);
        self.solution.clone_from(solution);
    }
}

/// The condition of the pressure of a surface node, or of the approach of a wheel.
fn in_contact(touches: bool) -> Condition {
    if touches { Condition::Free(0.0) } else { Condition::Held(0.0) }
}
