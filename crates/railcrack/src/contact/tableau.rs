//! Jumps and contact forces of the faces, as components are held and freed.

use super::condition::{Condition, Degenerate};
use crate::linear::{BorderedFactor, LinearError, SmallFactor, add_product, general_inverse, product};
use crate::math::{Matrix, add_rows_to_each, axpy};

/// The equations A w = load + q of the faces under a condition for each component: its jump w_i is
/// held, or it is free with q_i + c_i q_{i+1} = 0, where c_i ≠ 0 couples the shear of a slipping
/// point to its pressure.
///
/// A basis of such conditions has a tableau: with the prescribed quantity of each component as
/// input (w_i, or with p = A w the force p_i + c_i p_{i+1}) and the other one as output (p_i, or
/// w_i), output = T · input. Where the present conditions differ from those of the basis, the
/// inputs there are unknown instead, and follow from as many equations, all of whose coefficients
/// are entries of T. A change of status thus costs one row of a small system, and undoing it
/// costs nothing. Many differences together become a new basis, by a block principal
/// pivot (Cottle, Pang & Stone, The Linear Complementarity Problem, 2.3).
pub(super) struct Tableau<'a> {
    stiffness: &'a Matrix,
    /// Unit (N/mm per mm) of the forces in the tableau over those of the jumps: stiffnesses and
    /// compliances are about one then.
    unit: f64,
    /// Conditions of the basis; of held components the jump does not count.
    basis: Vec<Condition>,
    /// Tᵀ: the outputs for a unit of each input.
    responses: Matrix,
    now: Vec<Condition>,
    kept: Vec<Condition>,
    /// Where the basis holds components (mm), zero where it does not, and its outputs for that:
    /// what is held seldom moves.
    held: Vec<f64>,
    of_held: Vec<f64>,
    probe: Probe,
    loads: Vec<Load>,
    /// Memory for answers.
    spare: Vec<Answer>,
    differences: Differences,
}

/// Nodal forces, and what the basis makes of them.
struct Load {
    /// N/mm.
    forces: Vec<f64>,
    /// The basis where all that it holds is held at zero; none before that is asked for.
    answer: Option<Answer>,
}

/// The basis under some action.
#[derive(Debug, Default)]
struct Answer {
    input: Vec<f64>,
    output: Vec<f64>,
    /// Of the inputs where the present conditions differ.
    changes: Vec<f64>,
}

/// An action on the faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Action {
    /// One of the loads, if any.
    load: Option<usize>,
    /// Whether the held components are where their conditions say, or at zero.
    held: bool,
}

/// How jumps and contact forces change.
#[derive(Debug, Clone)]
pub(super) struct FaceRate {
    /// mm
    pub jump: Vec<f64>,
    /// N/mm
    pub contact: Vec<f64>,
}

impl FaceRate {
    /// None of `components` changes.
    pub(super) fn zero(components: usize) -> Self {
        Self { jump: vec![0.0; components], contact: vec![0.0; components] }
    }
}

/// Where the present conditions differ from those of the basis.
#[derive(Default)]
struct Differences {
    /// In the order in which they came.
    components: Vec<usize>,
    /// The factor of the equations of the first of them.
    factor: BorderedFactor,
    /// That of all, with exchange of rows, where the other one finds no pivot.
    whole: Option<SmallFactor>,
}

impl Differences {
    /// Takes note that the condition of `component` has changed, and whether it `differs` from that
    /// of the basis.
    fn change(&mut self, component: usize, differs: bool) {
        self.whole = None;
        if let Some(place) = self.components.iter().position(|&other| other == component) {
            self.components.remove(place);
            self.factor.truncate(place);
        }
        if differs {
            self.components.push(component);
        }
    }

    /// Solves their equations in place.
    fn solve(&self, right: &mut [f64]) -> Result<(), LinearError> {
        match &self.whole {
            Some(whole) => whole.solve(right),
            None => self.factor.solve(right),
        }
    }
}

/// A weighted sum of all equations, cheap to form: every equation has a weight of its own, so that
/// errors do not cancel.
struct Probe {
    weights: Vec<f64>,
    /// A times the weights, N/mm.
    of_jumps: Vec<f64>,
    /// The largest sum of absolute terms so far, N/mm.
    size: f64,
}

impl Probe {
    fn new(stiffness: &Matrix) -> Self {
        // Between 1/2 and 3/2, without order, of either sign.
        let golden = |i: usize| (i as f64 * 0.618_033_988_749_895).fract();
        let weight = |i: usize| (0.5 + golden(i)).copysign(golden(i + 7 * i * i) - 0.5);
        let weights: Vec<f64> = (0..stiffness.rows()).map(weight).collect();
        Self { of_jumps: stiffness.times(&weights), weights, size: 0.0 }
    }
}

/// Components per difference that it takes to make a new basis, and how many differences at least
/// and at most: a system of more costs more than a basis.
const MANY: usize = 12;
const FEW: usize = 10;
const MOST: usize = 80;
/// A new basis is made at once beyond this multiple of that number.
const URGENT: usize = 3;
/// Residual of the probe, relative to its terms so far, above which a basis is computed anew.
const DRIFT: f64 = 1e-13;

impl<'a> Tableau<'a> {
    /// All components held at zero. `stiffness` is A, symmetric.
    pub(super) fn new(stiffness: &'a Matrix) -> Self {
        let n = stiffness.rows();
        let held = vec![Condition::Held(0.0); n];
        let unit = (0..n).map(|i| stiffness[(i, i)]).fold(f64::MIN_POSITIVE, f64::max);
        Self {
            stiffness,
            unit,
            basis: held.clone(),
            responses: in_units(stiffness, unit),
            now: held.clone(),
            kept: held,
            held: vec![0.0; n],
            of_held: vec![0.0; n],
            probe: Probe::new(stiffness),
            loads: Vec::new(),
            spare: Vec::new(),
            differences: Differences::default(),
        }
    }

    /// Makes `loads` (N/mm) those to answer.
    pub(super) fn load(&mut self, loads: impl IntoIterator<Item = Vec<f64>>) {
        self.loads = loads.into_iter().map(|forces| Load { forces, answer: None }).collect();
    }

    /// One more load (N/mm) to answer.
    pub(super) fn load_also(&mut self, forces: Vec<f64>) {
        self.loads.push(Load { forces, answer: None });
    }

    /// Sets the condition of `component`. Only one that another follows may be coupled, and only to
    /// one that is free without coupling or held.
    pub(super) fn set(&mut self, component: usize, condition: Condition) {
        if !condition.is_like(self.now[component]) {
            self.differences.change(component, !condition.is_like(self.basis[component]));
        }
        self.now[component] = condition;
    }

    /// Makes the present conditions those to return to.
    pub(super) fn keep(&mut self) {
        self.kept.clone_from(&self.now);
    }

    /// Returns to what was kept.
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
    /// Errors: conditions that leave a component without equation.
    pub(super) fn solve(&mut self, jump: &mut [f64], contact: &mut [f64]) -> Result<(), Degenerate> {
        self.change_basis_beyond(self.many());
        self.solve_checked(jump, contact)
    }

    /// [`Tableau::solve`] in an iteration, whose conditions may well be undone.
    pub(super) fn solve_again(&mut self, jump: &mut [f64], contact: &mut [f64]) -> Result<(), Degenerate> {
        self.change_basis_beyond(URGENT * self.many());
        self.solve_checked(jump, contact)
    }

    /// Contributions of the loads from number `first` on to jumps and contact forces while nothing
    /// that is held moves, one after the other in `rates`.
    ///
    /// Errors: conditions that leave a component without equation.
    pub(super) fn rates(&mut self, first: usize, rates: &mut [FaceRate]) -> Result<(), Degenerate> {
        self.change_basis_beyond(self.many());
        let action = |k| Action { load: Some(first + k), held: false };
        let actions: Vec<Action> = (0..rates.len()).map(action).collect();
        let answers = self.answers(&actions)?;
        for ((k, answer), rate) in answers.iter().enumerate().zip(rates) {
            self.write(first + k, false, answer, (&mut rate.jump, &mut rate.contact));
        }
        self.spare.extend(answers);
        Ok(())
    }

    /// Makes a basis of the present conditions, if more than `most` differ.
    fn change_basis_beyond(&mut self, most: usize) {
        if self.differences.components.len() > most {
            // Where that fails, the differences remain, and their own system decides.
            let _ = self.change_basis();
        }
    }

    /// Jumps and contact forces under the first load. A basis that has become inaccurate is
    /// computed anew.
    fn solve_checked(&mut self, jump: &mut [f64], contact: &mut [f64]) -> Result<(), Degenerate> {
        let sound = self.equilibrium(jump, contact);
        if sound.is_ok() && self.fulfils(jump, contact) {
            return Ok(());
        }
        self.refresh()?;
        self.equilibrium(jump, contact)
    }

    /// Whether A w = load + q holds under the first load, as far as a sum of all equations with the
    /// weights of the probe tells.
    fn fulfils(&mut self, jump: &[f64], contact: &[f64]) -> bool {
        let (mut sum, mut size) = (0.0f64, 0.0f64);
        let load = &self.loads[0].forces;
        for (i, (&weight, &of_jump)) in self.probe.weights.iter().zip(&self.probe.of_jumps).enumerate() {
            for term in [of_jump * jump[i], -weight * load[i], -weight * contact[i]] {
                sum += term;
                size += term.abs();
            }
        }
        self.probe.size = self.probe.size.max(size);
        sum.abs() <= DRIFT * self.probe.size
    }

    /// Lets the basis answer all loads that it has not answered yet, in one pass over it.
    fn answer(&mut self) {
        let n = self.now.len();
        let open: Vec<usize> = (0..self.loads.len()).filter(|&k| self.loads[k].answer.is_none()).collect();
        if open.is_empty() {
            return;
        }
        let free: Vec<usize> = (0..n).filter(|&i| self.basis[i].held().is_none()).collect();
        let driven = |&k: &usize| (0..n).map(|i| self.driven_input(&self.loads[k].forces, i)).collect();
        let inputs: Vec<Vec<f64>> = open.iter().map(driven).collect();
        let chosen = |input: &Vec<f64>| free.iter().map(|&i| input[i]).collect();
        let weights: Vec<Vec<f64>> = inputs.iter().map(chosen).collect();
        let mut outputs = vec![vec![0.0; n]; open.len()];
        add_rows_to_each(&weights, |m| self.responses.row(free[m]), &mut outputs);
        for (k, (input, output)) in open.into_iter().zip(inputs.into_iter().zip(outputs)) {
            self.loads[k].answer = Some(Answer { input, output, changes: Vec::new() });
        }
    }

    /// Jumps and contact forces under the first load.
    fn equilibrium(&mut self, jump: &mut [f64], contact: &mut [f64]) -> Result<(), Degenerate> {
        self.move_held();
        let action = Action { load: Some(0), held: true };
        let answers = self.answers(&[action])?;
        self.write(0, true, &answers[0], (jump, contact));
        self.spare.extend(answers);
        Ok(())
    }

    /// The basis under each of `actions` with the inputs at which the present conditions are met.
    fn answers(&mut self, actions: &[Action]) -> Result<Vec<Answer>, Degenerate> {
        self.answer();
        self.factor()?;
        let mut answers: Vec<Answer> = Vec::with_capacity(actions.len());
        for &action in actions {
            let spare = self.spare.pop().unwrap_or_default();
            answers.push(self.answer_to(action, spare));
        }
        let components = &self.differences.components;
        for (&action, answer) in actions.iter().zip(&mut answers) {
            let Answer { input, output, changes } = answer;
            changes.clear();
            changes.extend(components.iter().map(|&i| self.defect(i, action, input, output)));
            self.differences.solve(changes).map_err(|_| Degenerate)?;
            components.iter().zip(changes).for_each(|(&i, change)| input[i] += *change);
        }
        let (changes, mut outputs): (Vec<&[f64]>, Vec<&mut [f64]>) =
            answers.iter_mut().map(|a| (a.changes.as_slice(), a.output.as_mut_slice())).unzip();
        add_rows_to_each(&changes, |k| self.responses.row(components[k]), &mut outputs);
        Ok(answers)
    }

    /// Factors the equations of what differs from the basis.
    fn factor(&mut self) -> Result<(), Degenerate> {
        let mut differences = std::mem::take(&mut self.differences);
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

    /// Jumps and contact forces of `answer` to `load`, with what is held in place or at zero.
    fn write(&self, load: usize, held: bool, answer: &Answer, (jump, contact): (&mut [f64], &mut [f64])) {
        let conditions = self.basis.iter().zip(&self.now);
        let answers = answer.input.iter().zip(&answer.output).zip(&self.loads[load].forces);
        let results = jump.iter_mut().zip(contact);
        // From the last component on: a coupled one needs the next.
        let (mut force, mut next_contact) = (0.0, 0.0);
        for (((basis, now), ((&input, &output), load)), (jump, contact)) in
            conditions.zip(answers).zip(results).rev()
        {
            let free_jump;
            (free_jump, force) = basis.state(input, output, force);
            (*jump, *contact) = match *now {
                // Exactly, so that what sticks does not creep and what slips is on the cone.
                Condition::Held(at) => (if held { at } else { 0.0 }, force * self.unit - load),
                Condition::Free(coupling) => (free_jump, -times(coupling, || next_contact)),
            };
            next_contact = *contact;
        }
    }

    /// The basis under `action`, in the memory of `answer`.
    fn answer_to(&self, action: Action, mut answer: Answer) -> Answer {
        match action.load.and_then(|k| self.loads[k].answer.as_ref()) {
            Some(of_load) => {
                answer.input.clone_from(&of_load.input);
                answer.output.clone_from(&of_load.output);
            }
            None => {
                let Answer { input, output, .. } = &mut answer;
                for values in [input, output] {
                    values.clear();
                    values.resize(self.now.len(), 0.0);
                }
            }
        }
        if action.held {
            // Where the basis holds nothing, this is zero.
            axpy(1.0, &self.held, &mut answer.input);
            axpy(1.0, &self.of_held, &mut answer.output);
        }
        answer
    }

    /// Moves what is held, as in the basis, but elsewhere than before. Where the basis holds what
    /// is free now, the input is unknown, and what it was last a good guess.
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
    /// condition of `component` today, which differs from that in the basis.
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
        let driven = |coupling| action.load.map_or(0.0, |k| self.driven(&self.loads[k].forces, i, coupling));
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

    /// The input of component `i` under `load`; zero where the basis holds the jump.
    fn driven_input(&self, load: &[f64], i: usize) -> f64 {
        match self.basis[i] {
            Condition::Held(_) => 0.0,
            Condition::Free(coupling) => self.driven(load, i, coupling),
        }
    }

    /// load_i + c load_{i+1}, in units.
    fn driven(&self, load: &[f64], i: usize, coupling: f64) -> f64 {
        (load[i] + times(coupling, || load[i + 1])) / self.unit
    }

    /// Makes the present conditions a basis of their own, from A.
    fn refresh(&mut self) -> Result<(), Degenerate> {
        self.basis.fill(Condition::Held(0.0));
        self.responses = in_units(self.stiffness, self.unit);
        self.begin_basis();
        self.differences.components = (0..self.now.len()).filter(|&i| self.now[i].held().is_none()).collect();
        self.change_basis().map_err(|_| Degenerate)
    }

    /// A basis that has not answered yet: everything that is held moves there from zero with the
    /// next response.
    fn begin_basis(&mut self) {
        self.differences = Differences::default();
        self.loads.iter_mut().for_each(|load| load.answer = None);
        self.held.fill(0.0);
        self.of_held.fill(0.0);
    }

    /// Makes the present conditions the basis. With K the components that differ, R the
    /// coefficients of all inputs in their conditions and Z = R_K⁻¹, the inputs of K are u_K = Z (s
    /// − R u) in terms of their new ones s and of the others u.
    fn change_basis(&mut self) -> Result<(), LinearError> {
        // What the loads do under the new conditions is known without the new basis.
        self.move_held();
        let loads = (0..self.loads.len()).map(|k| Action { load: Some(k), held: false });
        let actions: Vec<Action> = loads.chain([Action { load: None, held: true }]).collect();
        let answers = self.answers(&actions).map(|answers| self.renewed(&answers));
        let mut differences = self.differences.components.clone();
        differences.sort_unstable();
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
                match (self.basis[i], self.now[i]) {
                    (Condition::Held(_), _) => response[i] = old_input,
                    (Condition::Free(coupling), Condition::Held(_)) => {
                        let next = || match self.basis[i + 1] {
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
        self.basis.clone_from(&self.now);
        self.begin_basis();
        if let Ok(answers) = answers {
            self.take_over(answers);
        }
        Ok(())
    }

    /// Inputs and outputs under the present conditions of `answers` of the basis before.
    fn renewed(&self, answers: &[Answer]) -> Vec<Answer> {
        let renewed = |answer: &Answer| {
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
        };
        answers.iter().map(renewed).collect()
    }

    /// Makes `answers`, those to all loads and to what is held, those of the basis.
    fn take_over(&mut self, mut answers: Vec<Answer>) {
        if let Some(of_held) = answers.pop() {
            self.held = self.basis.iter().map(|condition| condition.held().unwrap_or(0.0)).collect();
            self.of_held = of_held.output;
        }
        for (load, answer) in self.loads.iter_mut().zip(answers) {
            load.answer = Some(answer);
        }
    }
}

impl Condition {
    /// Jump (mm) and A w (in units) of a component of which the basis has this condition, from its
    /// input and output; `next` is A w of the one after it.
    fn state(self, input: f64, output: f64, next: f64) -> (f64, f64) {
        match self {
            Self::Held(_) => (input, output),
            Self::Free(coupling) => (output, input - times(coupling, || next)),
        }
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
