//! Loads on the faces, and what the basis of a tableau makes of them.

use crate::math::{add_rows_to_each, axpy};

/// Nodal forces, and what the basis makes of them where all that it holds is held at zero.
#[derive(Default)]
struct AnsweredLoad {
    /// N/mm.
    forces: Vec<f64>,
    /// None before it is asked for.
    answer: Option<Answer>,
}

/// The basis under some action.
#[derive(Debug, Default)]
pub(super) struct Answer {
    pub(super) input: Vec<f64>,
    pub(super) output: Vec<f64>,
    /// Of the inputs where the present conditions differ.
    pub(super) changes: Vec<f64>,
}

/// The loads to be answered.
#[derive(Default)]
pub(super) struct Loads {
    list: Vec<AnsweredLoad>,
    onward: Option<Onward>,
    /// Memory.
    spare: Vec<Answer>,
    answering: Answering,
}

/// The first load as a sum: that of before, whose output is known, and two others.
struct Onward {
    output: Vec<f64>,
    others: [usize; 2],
}

/// Memory of [`Loads::answer`].
#[derive(Default)]
struct Answering {
    loads: Vec<usize>,
    weights: Vec<Vec<f64>>,
    outputs: Vec<Vec<f64>>,
}

impl Loads {
    /// Makes `loads` (N/mm) those to answer.
    pub(super) fn set(&mut self, loads: impl IntoIterator<Item = impl AsRef<[f64]>>) {
        self.begin_basis();
        let mut count = 0;
        for forces in loads {
            if count == self.list.len() {
                self.list.push(AnsweredLoad::default());
            }
            forces.as_ref().clone_into(&mut self.list[count].forces);
            count += 1;
        }
        self.list.truncate(count);
    }

    /// The same for `end` (N/mm) and `others`, where `end` is `start` with the last two of them:
    /// its answer is a sum where `start` was the first load so far.
    pub(super) fn set_on<'l>(
        &mut self,
        start: &[f64],
        end: &'l [f64],
        others: impl Iterator<Item = &'l [f64]>,
    ) {
        let before = self.list.first_mut().filter(|load| load.forces == start);
        let known = before.and_then(|load| load.answer.as_mut());
        let known = known.map(|answer| std::mem::take(&mut answer.output));
        self.set(std::iter::once(end).chain(others));
        let count = self.list.len();
        self.onward = known.map(|output| Onward { output, others: [count - 2, count - 1] });
    }

    /// One more load (N/mm).
    pub(super) fn add(&mut self, forces: Vec<f64>) {
        self.list.push(AnsweredLoad { forces, answer: None });
    }

    /// How many.
    pub(super) fn len(&self) -> usize {
        self.list.len()
    }

    /// Those of load `k`, N/mm.
    pub(super) fn forces(&self, k: usize) -> &[f64] {
        &self.list[k].forces
    }

    /// Forgets all answers.
    pub(super) fn begin_basis(&mut self) {
        self.onward = None;
        for load in &mut self.list {
            self.spare.extend(load.answer.take());
        }
    }

    /// Whether the basis has answered all of them.
    pub(super) fn are_answered(&self) -> bool {
        self.list.iter().all(|load| load.answer.is_some())
    }

    /// Whether the answer to the first load will be a sum.
    #[cfg(test)]
    pub(super) fn is_sum(&self) -> bool {
        self.onward.is_some()
    }

    /// Makes `answers` those of the basis.
    pub(super) fn take_over(&mut self, answers: Vec<Answer>) {
        for (load, answer) in self.list.iter_mut().zip(answers) {
            load.answer = Some(answer);
        }
    }

    /// Lets a basis of `n` components answer all loads that it has not answered yet, in one pass
    /// over it: it leaves `free` components free, whose inputs under some forces are `driven`, and
    /// has a row of responses to each.
    pub(super) fn answer<'m>(
        &mut self,
        n: usize,
        free: &[usize],
        driven: impl Fn(&[f64], usize) -> f64,
        row: impl Fn(usize) -> &'m [f64],
    ) {
        if self.are_answered() {
            return;
        }
        let onward = self.onward.take();
        let mut memory = std::mem::take(&mut self.answering);
        let Answering { loads, weights, outputs } = &mut memory;
        loads.clear();
        for k in 0..self.list.len() {
            if self.list[k].answer.is_some() {
                continue;
            }
            let mut answer = self.blank(n);
            free.iter().for_each(|&i| answer.input[i] = driven(&self.list[k].forces, i));
            if k > 0 || onward.is_none() {
                loads.push(k);
                outputs.push(std::mem::take(&mut answer.output));
            }
            self.list[k].answer = Some(answer);
        }
        weights.resize_with(loads.len(), Vec::new);
        for (weights, answer) in weights.iter_mut().zip(loads.iter().map(|&k| &self.list[k].answer)) {
            weights.clear();
            weights.extend(answer.iter().flat_map(|answer| free.iter().map(|&i| answer.input[i])));
        }
        add_rows_to_each(weights, |m| row(free[m]), outputs);
        for (&k, output) in loads.iter().zip(outputs.drain(..)) {
            if let Some(answer) = &mut self.list[k].answer {
                answer.output = output;
            }
        }
        self.answering = memory;
        if let Some(Onward { mut output, others }) = onward {
            for answer in others.iter().filter_map(|&k| self.list[k].answer.as_ref()) {
                axpy(1.0, &answer.output, &mut output);
            }
            if let Some(answer) = &mut self.list[0].answer {
                answer.output = output;
            }
        }
    }

    /// The answer of the basis of `n` components to load `k`, or to none: zeros.
    pub(super) fn of_basis(&mut self, k: Option<usize>, n: usize) -> Answer {
        let Some(of_load) = k.and_then(|k| self.list[k].answer.as_ref()) else { return self.blank(n) };
        let mut answer = self.spare.pop().unwrap_or_default();
        answer.input.clone_from(&of_load.input);
        answer.output.clone_from(&of_load.output);
        answer
    }

    /// An answer of zeros.
    fn blank(&mut self, n: usize) -> Answer {
        let mut answer = self.spare.pop().unwrap_or_default();
        let Answer { input, output, .. } = &mut answer;
        for values in [input, output] {
            values.clear();
            values.resize(n, 0.0);
        }
        answer
    }

    /// Takes an answer that is not needed any more.
    pub(super) fn take_back(&mut self, answer: Answer) {
        self.spare.push(answer);
    }
}
