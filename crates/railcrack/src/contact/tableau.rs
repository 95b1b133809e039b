//! Tableau of the jumps and contact forces of the faces, with components held or free.

use super::condition::{Condition, Degenerate};
use super::differences::Differences;
use super::loads::{Answer, Loads};
use super::probe::Probe;
use crate::linear::{LinearError, SmallFactor, add_product, general_inverse, product};
use crate::math::{Matrix, add_rows_to_each, axpy};
use std::mem::take;

/// The equations A w = load + q of the faces under a condition for each component: its jump w_i is
/// held, or it is free with q_i + c_i q_{i+1} = 0, where c_i ≠ 0 couples the shear of a slipping
/// point to its pressure.
///
/// A basis of such conditions has a tableau: with the prescribed quantity of each component as
/// input (w_i, or with p = A w the force p_i + c_i p_{i+1}) and the other one as output (p_i, or
/// w_i), output = T · input. Where the present conditions differ from those of the basis, the
/// inputs there are unknown instead, and follow from an equal number of equations whose
/// coefficients are entries of T. A change of status thus costs one row of a small system, and
/// undoing it costs nothing. Many differences are combined into a new basis by a block principal
/// pivot (Cottle, Pang & Stone, The Linear Complementarity Problem, 2.3).
pub(super) struct Tableau<'a> {
    /// Aᵀ: the forces of a unit of each jump.
    columns: &'a Matrix,
    /// Ratio (N/mm per mm) of the units of forces and jumps in the tableau, which makes stiffnesses
    /// and compliances of order one.
    unit: f64,
    /// Conditions of the basis, regardless of the jumps of held components.
    basis: Vec<Condition>,
    /// Tᵀ: the outputs for a unit of each input.
    responses: Matrix,
    now: Vec<Condition>,
    kept: Vec<Condition>,
    /// Jumps (mm) at which the basis holds components, zero for free ones, and the outputs for
    /// these; held components seldom move.
    held: Vec<f64>,
    of_held: Vec<f64>,
    probe: Probe,
    loads: Loads,
    /// Components that are free in the basis.
    free: Vec<usize>,
    differences: Differences,
}

/// An action on the faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Action {
    /// One of the loads, if any.
    load: Option<usize>,
    /// Whether the held components are at the jumps of their conditions, or at zero.
    held: bool,
}

/// Rates of jumps and contact forces.
#[derive(Debug, Clone, Default)]
pub(super) struct FaceRate {
    /// mm
    pub jump: Vec<f64>,
    /// N/mm
    pub contact: Vec<f64>,
}

impl FaceRate {
    /// Zero rates of `components` components.
    pub(super) fn zero(components: usize) -> Self {
        Self { jump: vec![0.0; components], contact: vec![0.0; components] }
    }
}

/// Number of components per difference beyond which a new basis is computed, within limits of the
/// number of differences; a larger system costs more than a basis.
const MANY: usize = 12;
const FEW: usize = 10;
const MOST: usize = 80;
/// Multiple of that number of differences beyond which a new basis is computed immediately.
const URGENT: usize = 3;
/// Residual of the probe, relative to its terms so far, above which a basis is recomputed.
const DRIFT: f64 = 1e-13;

impl<'a> Tableau<'a> {
    /// The tableau with all components held at zero; `columns` is Aᵀ.
    pub(super) fn new(columns: &'a Matrix) -> Self {
        let n = columns.rows();
        let held = vec![Condition::Held(0.0); n];
        let unit = (0..n).map(|i| columns[(i, i)]).fold(f64::MIN_POSITIVE, f64::max);
        Self {
            columns,
            unit,
            basis: held.clone(),
            responses: in_units(columns, unit),
            now: held.clone(),
            kept: held,
            held: vec![0.0; n],
            of_held: vec![0.0; n],
            probe: Probe::new(columns),
            loads: Loads::default(),
            free: Vec::new(),
            differences: Differences::default(),
        }
    }

    /// The loads.
    pub(super) fn loads(&mut self) -> &mut Loads {
        &mut self.loads
    }

    /// Sets the condition of `component`. Only a component with a successor may be coupled, and its
    /// successor must be held or free without coupling.
    pub(super) fn set(&mut self, component: usize, condition: Condition) {
        if !condition.is_like(self.now[component]) {
            self.differences.change(component, !condition.is_like(self.basis[component]));
        }
        self.now[component] = condition;
    }

    /// Saves the present conditions for [`Self::restore`].
    pub(super) fn keep(&mut self) {
        self.kept.clone_from(&self.now);
    }

    /// Restores the saved conditions.
    pub(super) fn restore(&mut self) {
        for component in 0..self.now.len() {
            self.set(component, self.kept[component]);
        }
    }

    fn many(&self) -> usize {
        (self.now.len() / MANY).clamp(FEW, MOST)
    }

    /// The jumps (mm) and contact forces q (N/mm) of all components under the first load.
    ///
    /// Errors: conditions that leave a component undetermined.
    pub(super) fn solve(&mut self, jump: &mut [f64], contact: &mut [f64]) -> Result<(), Degenerate> {
        self.change_basis_beyond(self.many());
        self.solve_checked(jump, contact)
    }

    /// [`Tableau::solve`] within an iteration, whose conditions are likely to be undone.
    pub(super) fn solve_again(&mut self, jump: &mut [f64], contact: &mut [f64]) -> Result<(), Degenerate> {
        self.change_basis_beyond(URGENT * self.many());
        self.solve_checked(jump, contact)
    }

    /// Contributions of loads, each given by its number, to jumps and contact forces with held
    /// components fixed. The responses of the basis are read once for all of them.
    ///
    /// Errors: conditions that leave a component undetermined.
    pub(super) fn rates(&mut self, rates: &mut [(usize, &mut FaceRate)]) -> Result<(), Degenerate> {
        self.change_basis_beyond(self.many());
        self.prepare()?;
        let mut answers = Vec::with_capacity(rates.len());
        for &(load, _) in &*rates {
            let action = Action { load: Some(load), held: false };
            let mut answer = self.of_basis(action);
            self.meet_conditions(action, &mut answer)?;
            answers.push(answer);
        }
        let components = &self.differences.components;
        let of_answer = |Answer { changes, output, .. }: &mut Answer| (take(changes), take(output));
        let (changes, mut outputs): (Vec<_>, Vec<_>) = answers.iter_mut().map(of_answer).unzip();
        add_rows_to_each(&changes, |k| self.responses.row(components[k]), &mut outputs);
        let all = rates.iter_mut().zip(answers).zip(changes.into_iter().zip(outputs));
        for (((load, rate), mut answer), (changes, output)) in all {
            (answer.changes, answer.output) = (changes, output);
            self.write(*load, false, &answer, (&mut rate.jump, &mut rate.contact));
            self.loads.take_back(answer);
        }
        Ok(())
    }

    /// Contributions (mm) of load number `load` to the jumps of `components` with held components
    /// fixed.
    ///
    /// Errors: conditions that leave a component undetermined.
    pub(super) fn jumps_under<const N: usize>(
        &mut self,
        load: usize,
        components: [usize; N],
    ) -> Result<[f64; N], Degenerate> {
        self.change_basis_beyond(self.many());
        self.prepare()?;
        let mut answer = self.of_basis(Action { load: Some(load), held: false });
        self.meet_conditions(Action { load: Some(load), held: false }, &mut answer)?;
        let jump = |i: usize| match (self.now[i], self.basis[i]) {
            (Condition::Held(_), _) => 0.0,
            (_, Condition::Held(_)) => answer.input[i],
            (_, Condition::Free(_)) => {
                let changes = self.differences.components.iter().zip(&answer.changes);
                changes.fold(answer.output[i], |sum, (&m, change)| sum + change * self.responses[(m, i)])
            }
        };
        let jumps = components.map(jump);
        self.loads.take_back(answer);
        Ok(jumps)
    }

    /// Makes the present conditions the basis, if more than `most` differ from it.
    fn change_basis_beyond(&mut self, most: usize) {
        if self.differences.components.len() > most {
            // If this fails, the differences remain, and their own equations are solved.
            let _ = self.change_basis();
        }
    }

    /// Jumps and contact forces under the first load. A basis that has become inaccurate is
    /// recomputed.
    fn solve_checked(&mut self, jump: &mut [f64], contact: &mut [f64]) -> Result<(), Degenerate> {
        let sound = self.equilibrium(jump, contact);
        if sound.is_ok() && self.fulfils(jump, contact) {
            return Ok(());
        }
        self.refresh()?;
        self.equilibrium(jump, contact)
    }

    /// Whether A w = load + q holds under the first load, according to the sum of all equations
    /// with the weights of the probe.
    fn fulfils(&mut self, jump: &[f64], contact: &[f64]) -> bool {
        let (mut sum, mut size) = (0.0f64, 0.0f64);
        let load = self.loads.forces(0);
        for (i, (&weight, &of_jump)) in self.probe.weights.iter().zip(&self.probe.of_jumps).enumerate() {
            for term in [of_jump * jump[i], -weight * load[i], -weight * contact[i]] {
                sum += term;
                size += term.abs();
            }
        }
        self.probe.size = self.probe.size.max(size);
        sum.abs() <= DRIFT * self.probe.size
    }

    /// Jumps and contact forces under the first load.
    fn equilibrium(&mut self, jump: &mut [f64], contact: &mut [f64]) -> Result<(), Degenerate> {
        self.move_held();
        self.prepare()?;
        let answer = self.answer_to(Action { load: Some(0), held: true })?;
        self.write(0, true, &answer, (jump, contact));
        self.loads.take_back(answer);
        Ok(())
    }

    /// Computes the data that [`Tableau::answer_to`] needs.
    fn prepare(&mut self) -> Result<(), Degenerate> {
        let (basis, unit) = (&self.basis, self.unit);
        let driven = |forces: &[f64], i: usize| match basis[i] {
            Condition::Held(_) => 0.0,
            Condition::Free(coupling) => driven(forces, i, coupling, unit),
        };
        self.loads.answer(basis.len(), &self.free, driven, |i| self.responses.row(i));
        self.factor()
    }

    /// The response of the basis to `action` with the inputs at which the present conditions hold.
    fn answer_to(&mut self, action: Action) -> Result<Answer, Degenerate> {
        let mut answer = self.of_basis(action);
        self.meet_conditions(action, &mut answer)?;
        let components = &self.differences.components;
        let Answer { changes, output, .. } = &mut answer;
        add_rows_to_each(&[changes], |k| self.responses.row(components[k]), &mut [output]);
        Ok(answer)
    }

    /// Sets the inputs of `answer`, the response of the basis to `action`, so that the present
    /// conditions hold.
    fn meet_conditions(&self, action: Action, answer: &mut Answer) -> Result<(), Degenerate> {
        let Answer { input, output, changes } = answer;
        let components = &self.differences.components;
        changes.clear();
        changes.extend(components.iter().map(|&i| self.defect(i, action, input, output)));
        self.differences.solve(changes).map_err(|_| Degenerate)?;
        components.iter().zip(changes).for_each(|(&i, change)| input[i] += *change);
        Ok(())
    }

    /// Factors the equations of the components that differ from the basis.
    fn factor(&mut self) -> Result<(), Degenerate> {
        let mut differences = take(&mut self.differences);
        let entry =
            |k: usize, m: usize| self.coefficient(differences.components[k], differences.components[m]);
        let n = differences.components.len();
        for new in differences.factor.order()..n {
            let row: Vec<f64> = (0..new).map(|m| entry(new, m)).collect();
            let column: Vec<f64> = (0..new).map(|k| entry(k, new)).collect();
            if differences.factor.push(&row, &column, entry(new, new)).is_err() {
                break;
            }
        }
        let mut solvable = Ok(());
        if differences.factor.order() < n && differences.whole.is_none() {
            match SmallFactor::new(Matrix::from_fn(n, n, entry)) {
                Ok(whole) => differences.whole = Some(whole),
                Err(_) => solvable = Err(Degenerate),
            }
        }
        self.differences = differences;
        solvable
    }

    /// Jumps and contact forces of `answer` to `load`, with held components at their jumps or at
    /// zero.
    fn write(&self, load: usize, held: bool, answer: &Answer, (jump, contact): (&mut [f64], &mut [f64])) {
        let conditions = self.basis.iter().zip(&self.now);
        let answers = answer.input.iter().zip(&answer.output).zip(self.loads.forces(load));
        let results = jump.iter_mut().zip(contact);
        // In descending order, because a coupled component needs its successor.
        let (mut force, mut next_contact) = (0.0, 0.0);
        for (((basis, now), ((&input, &output), load)), (jump, contact)) in
            conditions.zip(answers).zip(results).rev()
        {
            let free_jump;
            (free_jump, force) = basis.state(input, output, force);
            (*jump, *contact) = match *now {
                // Set exactly, so that sticking points do not creep and slipping points lie on the
                // friction cone.
                Condition::Held(at) => (if held { at } else { 0.0 }, force * self.unit - load),
                Condition::Free(coupling) => (free_jump, -times(coupling, || next_contact)),
            };
            next_contact = *contact;
        }
    }

    /// The response of the basis to `action`.
    fn of_basis(&mut self, action: Action) -> Answer {
        let mut answer = self.loads.of_basis(action.load, self.now.len());
        if action.held {
            // Zero for components that the basis does not hold.
            axpy(1.0, &self.held, &mut answer.input);
            axpy(1.0, &self.of_held, &mut answer.output);
        }
        answer
    }

    /// Moves components that are held in the basis and now at different jumps. Where a component of
    /// the basis is now free, its input is unknown, and its last value is kept as an estimate.
    fn move_held(&mut self) {
        for i in 0..self.now.len() {
            if let (Condition::Held(_), Condition::Held(at)) = (self.basis[i], self.now[i])
                && at != self.held[i]
            {
                axpy(at - self.held[i], self.responses.row(i), &mut self.of_held);
                self.held[i] = at;
            }
        }
    }

    /// Contribution of a unit of the input of component `input` to the left-hand side of the
    /// present condition of `component`, which differs from that in the basis.
    fn coefficient(&self, component: usize, input: usize) -> f64 {
        let response = self.responses.row(input);
        let own = f64::from(component == input);
        let next = || match self.basis[component + 1] {
            Condition::Held(_) => response[component + 1],
            Condition::Free(_) => f64::from(component + 1 == input),
        };
        match (self.basis[component], self.now[component]) {
            (Condition::Held(_), Condition::Free(coupling)) => response[component] + times(coupling, next),
            (Condition::Free(before), Condition::Free(coupling)) => own + times(coupling - before, next),
            (_, Condition::Held(_)) => response[component],
        }
    }

    /// Deficit of `input` and `output` of the basis in the present condition of component `i`.
    fn defect(&self, i: usize, action: Action, input: &[f64], output: &[f64]) -> f64 {
        let driven =
            |coupling| action.load.map_or(0.0, |k| driven(self.loads.forces(k), i, coupling, self.unit));
        let next = || match self.basis[i + 1] {
            Condition::Held(_) => output[i + 1],
            Condition::Free(_) => input[i + 1],
        };
        match (self.basis[i], self.now[i]) {
            (Condition::Held(_), Condition::Free(coupling)) => {
                driven(coupling) - output[i] - times(coupling, next)
            }
            (Condition::Free(before), Condition::Free(coupling)) => {
                driven(coupling) - input[i] - times(coupling - before, next)
            }
            (_, Condition::Held(at)) => (if action.held { at } else { 0.0 }) - output[i],
        }
    }

    /// Recomputes the basis of the present conditions from A.
    fn refresh(&mut self) -> Result<(), Degenerate> {
        self.basis.fill(Condition::Held(0.0));
        self.responses = in_units(self.columns, self.unit);
        self.begin_basis();
        self.differences.components = (0..self.now.len()).filter(|&i| self.now[i].held().is_none()).collect();
        self.change_basis().map_err(|_| Degenerate)
    }

    /// Starts a basis without responses: with the next response all held components move from zero.
    fn begin_basis(&mut self) {
        self.differences = Differences::default();
        self.free.clear();
        self.free.extend((0..self.basis.len()).filter(|&i| self.basis[i].held().is_none()));
        self.loads.begin_basis();
        self.held.fill(0.0);
        self.of_held.fill(0.0);
    }

    /// Makes the present conditions the basis. With K the components that differ, R the
    /// coefficients of all inputs in their conditions and Z = R_K⁻¹, the inputs of K are u_K = Z (s
    /// − R u) in terms of their new inputs s and the other inputs u.
    fn change_basis(&mut self) -> Result<(), LinearError> {
        // The responses under the new conditions are computed without the new basis.
        self.move_held();
        let loads = (0..self.loads.len()).map(|k| Action { load: Some(k), held: false });
        let actions = loads.chain([Action { load: None, held: true }]);
        let answers: Result<Vec<Answer>, Degenerate> = match self.prepare() {
            Ok(()) => {
                actions.map(|action| self.answer_to(action).map(|answer| self.renewed(&answer))).collect()
            }
            Err(degenerate) => Err(degenerate),
        };
        let mut differences = self.differences.components.clone();
        differences.sort_unstable();
        let mut conditions = self.conditions(&differences);
        let (n, k) = (self.now.len(), differences.len());
        let own = Matrix::from_fn(k, k, |m, p| conditions[(differences[p], m)]);
        let inverse = general_inverse(&own)?.transposed();
        // The inputs of K are eliminated.
        differences.iter().for_each(|&i| conditions.row_mut(i).fill(0.0));
        conditions.entries_mut().iter_mut().for_each(|value| *value = -*value);
        let mut of_changed = Matrix::zeros(k, n);
        for (m, &i) in differences.iter().enumerate() {
            of_changed.row_mut(m).copy_from_slice(self.responses.row(i));
        }
        // Old outputs, and old inputs of K, for a unit of each new input.
        let outputs = product(&inverse, &of_changed)?;
        let mut inputs = product(&conditions, &inverse)?;
        add_product(1.0, &conditions, &outputs, &mut self.responses)?;
        for (m, &i) in differences.iter().enumerate() {
            self.responses.row_mut(i).copy_from_slice(outputs.row(m));
            inputs.row_mut(i).copy_from_slice(inverse.row(m));
        }
        self.exchange(&differences, &inputs);
        self.basis.clone_from(&self.now);
        self.begin_basis();
        if let Ok(answers) = answers {
            self.take_over(answers);
        }
        Ok(())
    }

    /// The coefficients of all inputs (rows) in the present conditions of `differences` (columns).
    fn conditions(&self, differences: &[usize]) -> Matrix {
        let (n, k) = (self.now.len(), differences.len());
        // Contributions of the responses of the component and of its successor.
        let mut shares = Vec::with_capacity(k);
        for &i in differences {
            shares.push(match (self.basis[i], self.now[i]) {
                (Condition::Held(_), Condition::Free(coupling)) => (1.0, self.of_next(i, coupling)),
                (Condition::Free(before), Condition::Free(coupling)) => {
                    (0.0, self.of_next(i, coupling - before))
                }
                (_, Condition::Held(_)) => (1.0, 0.0),
            });
        }
        let mut conditions = Matrix::zeros(n, k);
        for j in 0..n {
            let response = self.responses.row(j);
            for ((value, &i), &(own, next)) in conditions.row_mut(j).iter_mut().zip(differences).zip(&shares)
            {
                *value = own * response[i];
                if next != 0.0 {
                    *value += next * response[i + 1];
                }
            }
        }
        // For a free component of the basis the input itself contributes.
        for (m, &i) in differences.iter().enumerate() {
            for j in (i..=i + 1).filter(|j| *j < n) {
                conditions[(j, m)] = self.coefficient(i, j);
            }
        }
        conditions
    }

    /// `coupling` if the basis holds the component after `i`, zero if its response does not
    /// contribute.
    fn of_next(&self, i: usize, coupling: f64) -> f64 {
        match self.basis.get(i + 1) {
            Some(Condition::Held(_)) => coupling,
            _ => 0.0,
        }
    }

    /// Turns the old inputs of `differences`, for a unit of each new input (rows of `inputs`), into
    /// outputs.
    fn exchange(&mut self, differences: &[usize], inputs: &Matrix) {
        for j in 0..self.now.len() {
            let (response, inputs) = (self.responses.row_mut(j), inputs.row(j));
            for (p, &i) in differences.iter().enumerate() {
                match (self.basis[i], self.now[i]) {
                    (Condition::Held(_), _) => response[i] = inputs[p],
                    (Condition::Free(coupling), Condition::Held(_)) => {
                        let next = || match self.basis[i + 1] {
                            // Not overwritten yet, because components are processed in order.
                            Condition::Held(_) => response[i + 1],
                            Condition::Free(_) => match differences.get(p + 1) {
                                Some(&other) if other == i + 1 => inputs[p + 1],
                                _ => f64::from(j == i + 1),
                            },
                        };
                        response[i] = inputs[p] - times(coupling, next);
                    }
                    (Condition::Free(_), Condition::Free(_)) => {}
                }
            }
        }
    }

    /// Input and output in the new basis of `answer` in the previous basis.
    fn renewed(&self, answer: &Answer) -> Answer {
        let n = self.now.len();
        let mut new = Answer { input: vec![0.0; n], output: vec![0.0; n], changes: Vec::new() };
        let (mut force, mut next);
        force = 0.0;
        for i in (0..n).rev() {
            next = force;
            let jump;
            (jump, force) = self.basis[i].state(answer.input[i], answer.output[i], next);
            (new.input[i], new.output[i]) = match self.now[i] {
                Condition::Held(_) => (jump, force),
                Condition::Free(coupling) => (force + times(coupling, || next), jump),
            };
        }
        new
    }

    /// Stores `answers`, the responses to all loads and to the held components, as those of the
    /// basis.
    fn take_over(&mut self, mut answers: Vec<Answer>) {
        if let Some(of_held) = answers.pop() {
            self.held = self.basis.iter().map(|condition| condition.held().unwrap_or(0.0)).collect();
            self.of_held = of_held.output;
        }
        self.loads.take_over(answers);
    }
}

impl Condition {
    /// Jump (mm) and A w (in units) of a component with this condition in the basis, from its input
    /// and output; `next` is A w of its successor.
    fn state(self, input: f64, output: f64, next: f64) -> (f64, f64) {
        match self {
            Self::Held(_) => (input, output),
            Self::Free(coupling) => (output, input - times(coupling, || next)),
        }
    }
}

/// load_i + c load_{i+1}, in units.
fn driven(load: &[f64], i: usize, coupling: f64, unit: f64) -> f64 {
    (load[i] + times(coupling, || load[i + 1])) / unit
}

/// A matrix in units of `unit`.
fn in_units(matrix: &Matrix, unit: f64) -> Matrix {
    Matrix::from_fn(matrix.rows(), matrix.columns(), |i, j| matrix[(i, j)] / unit)
}

/// `coupling` times a value that exists only if the coupling is not zero.
#[inline]
fn times(coupling: f64, value: impl FnOnce() -> f64) -> f64 {
    if coupling == 0.0 { 0.0 } else { coupling * value() }
}

#[cfg(test)]
#[path = "tableau_tests.rs"]
mod tests;
