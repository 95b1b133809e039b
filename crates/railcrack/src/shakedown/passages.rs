//! Passages one after the other: the strain that one leaves enters the next.

use super::rail::ShakedownError;
use super::streamline::{Elasticity, Field, SteadyPassage, SteadyProblem, Upstream, first_column};
use crate::interruption::Interruption;

/// The passages over a rail so far.
pub(super) struct Passages<E, const N: usize> {
    pub problem: SteadyProblem<E, N>,
    /// The last two passages.
    pub last: Option<SteadyPassage<N>>,
    before: Option<Field<N>>,
    /// The strain that they have left, by streamline.
    pub entering: Vec<[f64; N]>,
    /// Number of passages.
    count: usize,
}

impl<E: Elasticity<N>, const N: usize> Passages<E, N> {
    /// A rail without plastic strain.
    pub(super) fn new(problem: SteadyProblem<E, N>, streamlines: usize) -> Self {
        Self { problem, last: None, before: None, entering: vec![[0.0; N]; streamlines], count: 0 }
    }

    /// The next passage, iterated from the strain `start`, which becomes the last one.
    ///
    /// Errors: it does not converge; an interruption.
    pub(super) fn advance(
        &mut self,
        start: Field<N>,
        upstream: Upstream,
        interruption: Interruption<'_>,
    ) -> Result<&SteadyPassage<N>, ShakedownError> {
        let passage = self.problem.solve(start, &self.entering, upstream, interruption)?;
        self.count += 1;
        if passage.change.is_nan() || passage.change > self.problem.tolerance {
            return Err(ShakedownError::NotConverged {
                pass: self.count,
                iterations: passage.iterations,
                change: passage.change,
                tolerance: self.problem.tolerance,
            });
        }
        self.entering = first_column(&passage.strain, self.entering.len());
        self.before = self.last.take().map(|last| last.strain);
        Ok(self.last.insert(passage))
    }

    /// The plastic strain of the next passage of the same wheel, as earlier ones suggest: their
    /// last change times the ratio of the last two.
    pub(super) fn guess(&self) -> Field<N> {
        let Some(last) = &self.last else { return self.unstrained() };
        let mut guess = last.strain.clone();
        let Some(before) = &self.before else { return guess };
        let streamlines = self.entering.len();
        let (mut product, mut square) = (0.0, 0.0);
        for (last, before) in last.strain.iter().zip(before) {
            for j in 0..streamlines {
                // Upstream is the passage before the last.
                let upstream = last.len() - streamlines + j;
                let newer = last[j] - last[upstream];
                let older = before[j] - before[upstream];
                product += newer * older;
                square += older * older;
            }
        }
        let ratio = if square > 0.0 { (product / square).clamp(0.0, 1.0) } else { 0.0 };
        for (guess, before) in guess.iter_mut().zip(before) {
            for (g, b) in guess.iter_mut().zip(before) {
                *g += ratio * (*g - b);
            }
        }
        guess
    }

    /// The plastic strain of the next passage of one wheel of several: what enters, and what the
    /// wheel had added to it in its `previous` passage.
    pub(super) fn guess_like(&self, previous: Option<&SteadyPassage<N>>) -> Field<N> {
        let streamlines = self.entering.len();
        let of = |c: usize| {
            let count = self.problem.background[c].len();
            let of_place = |at: usize| {
                let j = at % streamlines;
                let added = previous.map_or(0.0, |own| own.strain[c][at] - own.entering[j][c]);
                self.entering[j][c] + added
            };
            (0..count).map(of_place).collect()
        };
        std::array::from_fn(of)
    }

    /// No strain on all columns.
    pub(super) fn unstrained(&self) -> Field<N> {
        std::array::from_fn(|c| vec![0.0; self.problem.background[c].len()])
    }

    /// The last passage; one without plastic strain before the first.
    pub(super) fn into_last(self) -> (SteadyProblem<E, N>, SteadyPassage<N>) {
        let (strain, entering) = (self.unstrained(), self.entering);
        let none = || SteadyPassage {
            path: vec![0.0; entering.len()],
            strain,
            entering,
            iterations: 0,
            change: 0.0,
        };
        (self.problem, self.last.unwrap_or_else(none))
    }
}
