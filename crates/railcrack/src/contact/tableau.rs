//! Jumps and contact forces of the faces, as components are held and freed.

use super::condition::{Condition, Degenerate};
use super::span::Combination;
use crate::linear::{LinearError, SmallFactor, add_product, general_inverse, product};
use crate::math::{Matrix, add_rows, axpy, dot};

/// The equations A w = load + q of the faces under a condition for each component: its jump w_i is held, or it is free with
/// q_i + c_i q_{i+1} = 0, where c_i ≠ 0 couples the shear of a slipping point to its pressure.
///
/// A base of such conditions has a tableau: with the prescribed quantity of each component as input (w_i, or with p = A w the force
/// p_i + c_i p_{i+1}) and the other one as output (p_i, or w_i), output = T · input. Where the conditions of today differ from those of the base,
/// the inputs there are unknown instead, and follow from as many equations, all of whose coefficients are entries of T. So a
/// change of status costs nothing but a row of a small system, and to undo it costs nothing at all. Many
/// differences together become a new base, by a block principal pivot (Cottle, Pang & Stone, The Linear Complementarity Problem, 2.3).
pub(super) struct Tableau<'a> {
    stiffness: &'a Matrix,
    /// Unit (N/mm per mm) of the forces in the tableau over those of the jumps: stiffnesses and compliances are about one then.
    unit: f64,
    /// Conditions of the base; of held components the jump does not count.
    base: Vec<Condition>,
    /// Tᵀ: the outputs for a unit of each input.
    responses: Matrix,
    now: Vec<Condition>,
    kept: Vec<Condition>,
    /// Inputs under the last load, as if the conditions of the base held, and their outputs.
    input: Vec<f64>,
    output: Vec<f64>,
    /// The part of the outputs that comes from what the base holds: it seldom moves.
    of_held: Vec<f64>,
    base_state: BaseState,
    remembered: Remembered,
    /// None where conditions have changed since.
    differences: Option<Differences>,
}

/// Where the conditions of today differ from those of the base.
struct Differences {
    components: Vec<usize>,
    /// Their system, once it was needed.
    factor: Option<SmallFactor>,
}

/// Loads of which others are combined.
struct Remembered {
    /// Nodal forces (N/mm), each load a row.
    loads: Matrix,
    /// Outputs of the base for them, without what is held; none before they are asked for.
    outputs: Option<Matrix>,
}

/// Whether the numbers of a base can be relied on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum BaseState {
    /// Its first solution has not been set against the equations yet.
    New,
    Checked,
}

/// Components per difference that it takes to make a new base, and how many differences at least and at most: a system of more costs
/// more than a base.
const MANY: usize = 16;
const FEW: usize = 8;
const MOST: usize = 80;
/// A new base is made at once beyond this multiple of that number.
const URGENT: usize = 3;
/// Residual of the equations, relative to the largest force, above which a base is made afresh.
const DRIFT: f64 = 1e-11;

impl<'a> Tableau<'a> {
    /// All components held at zero. `stiffness` is A, symmetric.
    pub(super) fn new(stiffness: &'a Matrix) -> Self {
        let n = stiffness.rows();
        let held = vec![Condition::Held(0.0); n];
        let unit = (0..n).map(|i| stiffness[(i, i)]).fold(f64::MIN_POSITIVE, f64::max);
        Self {
            stiffness,
            unit,
            base: held.clone(),
            responses: in_units(stiffness, unit),
            now: held.clone(),
            kept: held,
            input: vec![0.0; n],
            output: vec![0.0; n],
            of_held: vec![0.0; n],
            base_state: BaseState::Checked,
            remembered: Remembered { loads: Matrix::zeros(0, n), outputs: None },
            differences: None,
        }
    }

    /// Remembers `loads` (N/mm, each a row) instead of others.
    pub(super) fn remember(&mut self, loads: Matrix) {
        self.remembered = Remembered { loads, outputs: None };
    }

    /// Sets the condition of `component`. Only one that another follows may be coupled, and only to one that is free without
    /// coupling or held.
    pub(super) fn set(&mut self, component: usize, condition: Condition) {
        if !condition.is_like(self.now[component]) {
            self.differences = None;
        }
        self.now[component] = condition;
    }

    /// Makes the present conditions those to return to.
    pub(super) fn keep(&mut self) {
        self.kept.clone_from(&self.now);
    }

    /// Returns to what was kept.
    pub(super) fn restore(&mut self) {
        if self.now.iter().zip(&self.kept).any(|(now, kept)| !now.is_like(*kept)) {
            self.differences = None;
        }
        self.now.clone_from(&self.kept);
    }

    /// The components whose condition is of another kind than in the base.
    fn take_differences(&mut self) -> Differences {
        self.differences.take().unwrap_or_else(|| {
            let differs = |&i: &usize| !self.now[i].is_like(self.base[i]);
            Differences { components: (0..self.now.len()).filter(differs).collect(), factor: None }
        })
    }

    /// How many there are.
    fn different(&mut self) -> usize {
        let differences = self.take_differences();
        self.differences.insert(differences).components.len()
    }

    fn many(&self) -> usize {
        (self.now.len() / MANY).clamp(FEW, MOST)
    }

    /// The jumps (mm) and contact forces q (N/mm) of all components under the nodal forces `load`; `combination` is how it is combined of the loads
    /// remembered, if it is.
    ///
    /// Errors: conditions that leave a component without equation.
    pub(super) fn solve(
        &mut self,
        load: &[f64],
        combination: Option<&Combination>,
        jump: &mut [f64],
        contact: &mut [f64],
    ) -> Result<(), Degenerate> {
        if self.different() > self.many() {
            // Where that fails, the differences remain, and their own system decides.
            let _ = self.rebase();
        }
        match combination {
            Some(combination) => self.respond_combined(load, combination),
            None => self.respond(load),
        }
        self.solve_again(load, jump, contact)
    }

    /// [`Tableau::solve`] under the same `load`, with other conditions.
    pub(super) fn solve_again(
        &mut self,
        load: &[f64],
        jump: &mut [f64],
        contact: &mut [f64],
    ) -> Result<(), Degenerate> {
        if self.different() > URGENT * self.many() && self.rebase().is_ok() {
            self.respond(load);
        }
        let sound = self.equilibrium(load, jump, contact);
        if sound.is_ok() && self.base_state == BaseState::Checked {
            return Ok(());
        }
        let held = |condition: &Condition| condition.held().unwrap_or(0.0);
        let pushed = self.stiffness.times(&self.now.iter().map(held).collect::<Vec<f64>>());
        let scale = load.iter().chain(&pushed).fold(0.0f64, |m, v| m.max(v.abs()));
        if sound.is_err() || self.residual(load, jump, contact) > DRIFT * scale {
            self.refresh()?;
            self.respond(load);
            self.equilibrium(load, jump, contact)?;
        }
        self.base_state = BaseState::Checked;
        Ok(())
    }

    /// The largest |A w − load − q|, N/mm.
    fn residual(&self, load: &[f64], jump: &[f64], contact: &[f64]) -> f64 {
        let gap = |i: usize| (dot(self.stiffness.row(i), jump) - load[i] - contact[i]).abs();
        (0..load.len()).map(gap).fold(0.0, f64::max)
    }

    /// Inputs and outputs of the base under `load`.
    fn respond(&mut self, load: &[f64]) {
        self.begin_response(load);
        self.add_outputs(load);
    }

    /// [`Tableau::respond`], where most of the outputs are known.
    fn respond_combined(&mut self, load: &[f64], combination: &Combination) {
        let loads = &self.remembered.loads;
        let outputs = match self.remembered.outputs.take() {
            Some(outputs) => Ok(outputs),
            None => {
                let inputs =
                    Matrix::from_fn(loads.rows(), load.len(), |k, i| self.driven_input(loads.row(k), i));
                product(&inputs, &self.responses)
            }
        };
        let Ok(outputs) = outputs else { return self.respond(load) };
        self.begin_response(load);
        add_rows(&combination.weights, |k| outputs.row(k), &mut self.output);
        self.remembered.outputs = Some(outputs);
        self.add_outputs(&combination.rest);
    }

    /// The inputs under `load`, and the outputs of what is held.
    fn begin_response(&mut self, load: &[f64]) {
        self.move_held();
        for i in 0..load.len() {
            if let Condition::Free(coupling) = self.base[i] {
                self.input[i] = self.driven(load, i, coupling);
            }
        }
        self.output.clone_from(&self.of_held);
    }

    /// Adds the outputs for the nodal forces `load` on what the base holds free.
    fn add_outputs(&mut self, load: &[f64]) {
        let inputs = (0..load.len()).map(|i| (i, self.driven_input(load, i)));
        let acting = inputs.filter(|(_, input)| *input != 0.0);
        let (acting, inputs): (Vec<usize>, Vec<f64>) = acting.unzip();
        add_rows(&inputs, |k| self.responses.row(acting[k]), &mut self.output);
    }

    /// Jumps and contact forces from the outputs of the base and the inputs where the conditions differ.
    fn equilibrium(&mut self, load: &[f64], jump: &mut [f64], contact: &mut [f64]) -> Result<(), Degenerate> {
        self.move_held();
        let Differences { components, factor } = self.take_differences();
        let n = components.len();
        let factor = match factor {
            Some(factor) => factor,
            None => {
                let entry = |k: usize, m: usize| self.coefficient(components[k], components[m]);
                SmallFactor::new(Matrix::from_fn(n, n, entry)).map_err(|_| Degenerate)?
            }
        };
        let mut changes: Vec<f64> = components.iter().map(|&i| self.defect(i, load)).collect();
        factor.solve(&mut changes).map_err(|_| Degenerate)?;
        let mut output = self.output.clone();
        add_rows(&changes, |k| self.responses.row(components[k]), &mut output);
        let mut input = self.input.clone();
        components.iter().zip(&changes).for_each(|(&i, change)| input[i] += change);
        self.differences = Some(Differences { components, factor: Some(factor) });
        // A w, from the last component on: a coupled one needs the next.
        let mut force = 0.0;
        for i in (0..load.len()).rev() {
            let next = force;
            let free_jump;
            (free_jump, force) = match self.base[i] {
                Condition::Held(_) => (input[i], output[i]),
                Condition::Free(coupling) => (output[i], input[i] - times(coupling, || next)),
            };
            (jump[i], contact[i]) = match self.now[i] {
                // Exactly, so that what sticks does not creep and what slips is on the cone.
                Condition::Held(at) => (at, force * self.unit - load[i]),
                Condition::Free(coupling) => (free_jump, -times(coupling, || contact[i + 1])),
            };
        }
        Ok(())
    }

    /// Moves what is held, as in the base, but elsewhere than at the last response. Where the base holds what is free now, the input is unknown, and
    /// what it was last a good guess.
    fn move_held(&mut self) {
        for i in 0..self.now.len() {
            if let (Condition::Held(_), Condition::Held(at)) = (self.base[i], self.now[i])
                && at != self.input[i]
            {
                let change = at - self.input[i];
                axpy(change, self.responses.row(i), &mut self.of_held);
                axpy(change, self.responses.row(i), &mut self.output);
                self.input[i] = at;
            }
        }
    }

    /// What a unit of the input of component `input` adds to the left-hand side of the condition of `component` today, which is another one than in the
    /// base.
    fn coefficient(&self, component: usize, input: usize) -> f64 {
        let response = self.responses.row(input);
        let own = f64::from(component == input);
        let next = || match self.base[component + 1] {
            Condition::Held(_) => response[component + 1],
            Condition::Free(_) => f64::from(component + 1 == input),
        };
        match (self.base[component], self.now[component]) {
            (Condition::Held(_), Condition::Free(coupling)) => response[component] + times(coupling, next),
            (Condition::Free(before), Condition::Free(coupling)) => own + times(coupling - before, next),
            (_, Condition::Held(_)) => response[component],
        }
    }

    /// What is missing at the outputs of the base for the condition of component `i` today.
    fn defect(&self, i: usize, load: &[f64]) -> f64 {
        let next = || match self.base[i + 1] {
            Condition::Held(_) => self.output[i + 1],
            Condition::Free(_) => self.input[i + 1],
        };
        match (self.base[i], self.now[i]) {
            (Condition::Held(_), Condition::Free(coupling)) => {
                self.driven(load, i, coupling) - self.output[i] - times(coupling, next)
            }
            (Condition::Free(before), Condition::Free(coupling)) => {
                self.driven(load, i, coupling) - self.input[i] - times(coupling - before, next)
            }
            (_, Condition::Held(at)) => at - self.output[i],
        }
    }

    /// The input of component `i` under `load`; zero where the base holds the jump.
    fn driven_input(&self, load: &[f64], i: usize) -> f64 {
        match self.base[i] {
            Condition::Held(_) => 0.0,
            Condition::Free(coupling) => self.driven(load, i, coupling),
        }
    }

    /// load_i + c load_{i+1}, in units.
    fn driven(&self, load: &[f64], i: usize, coupling: f64) -> f64 {
        (load[i] + times(coupling, || load[i + 1])) / self.unit
    }

    /// Makes the present conditions a base of their own, from A.
    fn refresh(&mut self) -> Result<(), Degenerate> {
        self.base.fill(Condition::Held(0.0));
        self.responses = in_units(self.stiffness, self.unit);
        self.begin_base();
        self.rebase().map_err(|_| Degenerate)
    }

    /// A base that has not answered yet: everything that is held moves there from zero with the next response.
    fn begin_base(&mut self) {
        self.differences = None;
        self.base_state = BaseState::New;
        self.remembered.outputs = None;
        self.input.fill(0.0);
        self.of_held.fill(0.0);
    }

    /// Makes the present conditions the base. With K the components that differ, R the coefficients of all inputs in their conditions and
    /// Z = R_K⁻¹, the inputs of K are u_K = Z (s − R u) in terms of their new ones s and of the others u.
    fn rebase(&mut self) -> Result<(), LinearError> {
        let differences = self.take_differences().components;
        let (n, k) = (self.now.len(), differences.len());
        let mut conditions = Matrix::from_fn(n, k, |j, m| self.coefficient(differences[m], j));
        let own = Matrix::from_fn(k, k, |m, p| conditions[(differences[p], m)]);
        let inverse = general_inverse(&own)?.transposed();
        // Those of K have no say any more.
        differences.iter().for_each(|&i| conditions.row_mut(i).fill(0.0));
        let of_changed = Matrix::from_fn(k, n, |m, j| self.responses[(differences[m], j)]);
        // Old outputs, and old inputs of K, for a unit of each new input.
        let outputs = product(&inverse, &of_changed)?;
        let mut inputs = product(&conditions, &inverse)?;
        inputs.entries_mut().iter_mut().for_each(|value| *value = -*value);
        add_product(-1.0, &conditions, &outputs, &mut self.responses)?;
        for (m, &i) in differences.iter().enumerate() {
            self.responses.row_mut(i).copy_from_slice(outputs.row(m));
            inputs.row_mut(i).copy_from_slice(inverse.row(m));
        }
        for j in 0..n {
            let response = self.responses.row_mut(j);
            for (p, &i) in differences.iter().enumerate() {
                let old_input = inputs[(j, p)];
                match (self.base[i], self.now[i]) {
                    (Condition::Held(_), _) => response[i] = old_input,
                    (Condition::Free(coupling), Condition::Held(_)) => {
                        let next = || match self.base[i + 1] {
                            // Not written over yet: components come in order.
                            Condition::Held(_) => response[i + 1],
                            Condition::Free(_) => match differences.get(p + 1) {
                                Some(&other) if other == i + 1 => inputs[(j, p + 1)],
                                _ => f64::from(j == i + 1),
                            },
                        };
                        response[i] = old_input - times(coupling, next);
                    }
                    (Condition::Free(_), Condition::Free(_)) => {}
                }
            }
        }
        self.base.clone_from(&self.now);
        self.begin_base();
        Ok(())
    }
}

/// A in units of `unit`.
fn in_units(stiffness: &Matrix, unit: f64) -> Matrix {
    Matrix::from_fn(stiffness.rows(), stiffness.columns(), |i, j| stiffness[(i, j)] / unit)
}

/// `coupling` times a value that is there only where the coupling is not zero.
fn times(coupling: f64, value: impl FnOnce() -> f64) -> f64 {
    if coupling == 0.0 { 0.0 } else { coupling * value() }
}

#[cfg(test)]
#[path = "tableau_tests.rs"]
mod tests;
