//! The run of a decision, with its failures.

use super::course::{Course, FailureMode};
use super::failure::{FailureSummary, Nominal, Question};
use super::path::most_grown;
use crate::log::StepDigest;

/// The run of a decision, with its failures.
#[derive(Debug, Clone)]
pub(crate) struct NominalRun {
    /// What is asked of it.
    pub question: Question,
    /// All its cracks over traffic.
    pub course: Course,
    /// Its failures.
    pub nominal: Nominal,
    /// The crack (from 0) that an inspection looks for: the one that fails first, or where none
    /// does the one that has grown most.
    pub found: usize,
}

impl NominalRun {
    /// The run of `steps`, of which `question` is asked; none without steps.
    pub fn of(steps: &[StepDigest], question: Question) -> Option<Self> {
        let removal = question.removal.over_axles(question.tonnes);
        let run = |found: usize| {
            let course = Course::of(steps, &removal, found);
            let nominal = Nominal::of(&course, &question);
            Self { question, course, nominal, found }
        };
        let first = run(most_grown(steps)?.tip.crack);
        let failing = first.nominal.failure.crack.map_or(first.found, |crack| crack - 1);
        let run = if failing == first.found { first } else { run(failing) };
        (!run.course.points.is_empty()).then_some(run)
    }

    /// Crack and tip (from 0) of the failure.
    pub fn failing_tip(&self) -> Option<(usize, usize)> {
        let FailureSummary { mode, crack, tip, .. } = self.nominal.failure;
        // A length is that of a crack, at any of its tips.
        let tip = tip.filter(|_| mode != Some(FailureMode::Length));
        Some((crack? - 1, tip? - 1))
    }
}
