//! Errors of the cases of a study, each reported once.

use crate::schema::{CaseError, Report};
use std::collections::HashMap;
use std::ops::Range;

/// An error and the runs that have it.
struct Found {
    error: CaseError,
    /// Label of the first run that has it.
    first: (usize, String),
    runs: usize,
}

/// Place and key of an error, and how many others of its run have the same.
type About = (Option<Range<usize>>, Option<String>, usize);

/// The errors of all runs. Two are one when they are about the same key and place: the numbers in
/// their messages may be those of their runs.
pub(super) struct RunErrors {
    /// Places that are reported already.
    known: Vec<Range<usize>>,
    found: Vec<Found>,
    places: HashMap<About, usize>,
}

impl RunErrors {
    /// No error yet; those about the places `known` will not count.
    pub fn new(known: Vec<Range<usize>>) -> Self {
        Self { known, found: Vec::new(), places: HashMap::new() }
    }

    /// Adds the errors of run `number`, whose values are `label`.
    pub fn add(&mut self, number: usize, label: &str, errors: Vec<CaseError>) {
        let mut before: Vec<About> = Vec::new();
        for error in errors {
            let (span, of) = (error.span(), error.key().map(str::to_owned));
            if span.as_ref().is_some_and(|span| self.known.contains(span)) {
                continue;
            }
            let same = before.iter().filter(|(s, k, _)| (s, k) == (&span, &of)).count();
            let about = (span, of, same);
            before.push(about.clone());
            match self.places.get(&about) {
                Some(&place) => self.found[place].runs += 1,
                None => {
                    self.places.insert(about, self.found.len());
                    self.found.push(Found { error, first: (number, label.to_owned()), runs: 1 });
                }
            }
        }
    }

    /// Reports every error once. An error that is not common to all `runs`, nor to all that take
    /// the list element in which it lies, names the first of its runs: there the combination is at
    /// fault. `elements`: where they stand, and how many runs take each.
    pub fn report(self, runs: usize, elements: &[(Range<usize>, usize)], report: &mut Report) {
        for Found { error, first: (number, label), runs: having } in self.found {
            let lies_in = |element: &Range<usize>| {
                error.span().is_some_and(|span| element.start <= span.start && span.end <= element.end)
            };
            let is_its_own = elements.iter().any(|(element, taken)| lies_in(element) && *taken == having);
            if having == runs || is_its_own {
                report.absorb(error);
                continue;
            }
            let others = match having - 1 {
                0 => String::new(),
                1 => " and 1 other".to_owned(),
                others => format!(" and {others} others"),
            };
            report.absorb(error.noting(&format!("in run {number} of the study ({label}){others}")));
        }
    }
}
