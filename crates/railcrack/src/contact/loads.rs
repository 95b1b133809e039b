//! Loads on the faces, and the responses of a basis to them.

use crate::math::{add_rows_to_each, axpy};

/// Nodal forces, and the response of the basis to them with all held components at zero.
#[derive(Default)]
struct AnsweredLoad {
    /// N/mm.
    forces: Vec<f64>,
    /// None until it is computed.
    answer: Option<Answer>,
    origin: Origin,
}

/// Origin of the response to a load.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Origin {
    /// Computed from the forces: it holds for these forces as long as the basis does.
    #[default]
    Forces,
    /// A sum of other responses, or that of a previous basis under other conditions, either with
    /// its round-off.
    OtherResponses,
}

/// Response of the basis to an action.
#[derive(Debug, Default)]
pub(super) struct Answer {
    pub(super) input: Vec<f64>,
    pub(super) output: Vec<f64>,
    /// Changes of the inputs of components whose present conditions differ from the basis.
    pub(super) changes: Vec<f64>,
}

/// The loads on a tableau, with their responses.
#[derive(Default)]
pub(super) struct Loads {
    list: Vec<AnsweredLoad>,
    onward: Option<Onward>,
    /// Answers whose memory is reused.
    spare: Vec<Answer>,
    answering: Answering,
}

/// The first load as the sum of its predecessor, whose output is known, and two other loads.
struct Onward {
    output: Vec<f64>,
    others: [usize; 2],
}

/// Work arrays of [`Loads::answer`].
#[derive(Default)]
struct Answering {
    loads: Vec<usize>,
    weights: Vec<Vec<f64>>,
    outputs: Vec<Vec<f64>>,
}

impl Loads {
    /// Replaces the loads by `loads` (N/mm). The response to a load that stays in its place is
    /// kept.
    pub(super) fn set(&mut self, loads: impl IntoIterator<Item = impl AsRef<[f64]>>) {
        self.onward = None;
        let mut count = 0;
        for forces in loads {
            let forces = forces.as_ref();
            if count == self.list.len() {
                self.list.push(AnsweredLoad::default());
            }
            let load = &mut self.list[count];
            if load.origin != Origin::Forces || load.forces != forces {
                self.spare.extend(load.answer.take());
                forces.clone_into(&mut load.forces);
            }
            count += 1;
        }
        self.spare.extend(self.list.drain(count..).filter_map(|load| load.answer));
    }

    /// Replaces the loads by `end` (N/mm) and `others`, where `end` is the sum of `start` and the
    /// last two of `others`. The response to `end` is a sum of known ones if `start` was the first
    /// load so far.
    pub(super) fn set_on<'l>(
        &mut self,
        start: &[f64],
        end: &'l [f64],
        others: impl Iterator<Item = &'l [f64]>,
    ) {
        let before = self.list.first_mut().filter(|load| load.forces == start);
        let known = before.and_then(|load| load.answer.take()).map(|answer| answer.output);
        self.set(std::iter::once(end).chain(others));
        let count = self.list.len();
        self.onward = known.map(|output| Onward { output, others: [count - 2, count - 1] });
    }

    /// Appends a load (N/mm).
    pub(super) fn add(&mut self, forces: Vec<f64>) {
        self.list.push(AnsweredLoad { forces, ..AnsweredLoad::default() });
    }

    /// Number of loads.
    pub(super) fn len(&self) -> usize {
        self.list.len()
    }

    /// Nodal forces of load `k`, N/mm.
    pub(super) fn forces(&self, k: usize) -> &[f64] {
        &self.list[k].forces
    }

    /// Discards all responses.
    pub(super) fn begin_basis(&mut self) {
        self.onward = None;
        for load in &mut self.list {
            self.spare.extend(load.answer.take());
        }
    }

    /// Whether the responses to all loads are known.
    pub(super) fn are_answered(&self) -> bool {
        self.list.iter().all(|load| load.answer.is_some())
    }

    /// The loads whose responses are unknown.
    #[cfg(test)]
    pub(super) fn missing(&self) -> Vec<usize> {
        (0..self.list.len()).filter(|&k| self.list[k].answer.is_none()).collect()
    }

    /// Whether the response to the first load will be a sum.
    #[cfg(test)]
    pub(super) fn is_sum(&self) -> bool {
        self.onward.is_some()
    }

    /// Stores `answers` as the responses of the basis.
    pub(super) fn take_over(&mut self, answers: Vec<Answer>) {
        for (load, answer) in self.list.iter_mut().zip(answers) {
            (load.answer, load.origin) = (Some(answer), Origin::OtherResponses);
        }
    }

    /// Computes the missing responses of a basis of `n` components in one pass over it. Its `free`
    /// components have the inputs `driven` under given forces, and `responses` gives a row for
    /// each.
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
            let origin = if k == 0 && onward.is_some() { Origin::OtherResponses } else { Origin::Forces };
            if origin == Origin::Forces {
                loads.push(k);
                outputs.push(std::mem::take(&mut answer.output));
            }
            (self.list[k].answer, self.list[k].origin) = (Some(answer), origin);
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

    /// The response of the basis of `n` components to load `k`; zeros for no load.
    pub(super) fn of_basis(&mut self, k: Option<usize>, n: usize) -> Answer {
        let Some(of_load) = k.and_then(|k| self.list[k].answer.as_ref()) else { return self.blank(n) };
        let mut answer = self.spare.pop().unwrap_or_default();
        answer.input.clone_from(&of_load.input);
        answer.output.clone_from(&of_load.output);
        answer
    }

    /// A response of zeros.
    fn blank(&mut self, n: usize) -> Answer {
        let mut answer = self.spare.pop().unwrap_or_default();
        let Answer { input, output, .. } = &mut answer;
        for values in [input, output] {
            values.clear();
            values.resize(n, 0.0);
        }
        answer
    }

    /// Takes back an answer whose memory can be reused.
    pub(super) fn take_back(&mut self, answer: Answer) {
        self.spare.push(answer);
    }
}
