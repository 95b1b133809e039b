//! The verdict on a statement over all set-ups.

use crate::claim::{Claim, Decision};
use crate::results::{Results, SetupResults};
use crate::setup::SETUPS;

/// The set-ups that decide first: both bodies, both ways of travel.
pub(super) const MAIN: usize = 4;

/// A statement with its decision in every set-up.
pub struct Verdict {
    /// The statement.
    pub claim: &'static Claim,
    /// The decisions, with the place of their set-ups in [`SETUPS`].
    pub decisions: Vec<(usize, Decision)>,
}

impl Verdict {
    /// The verdict of `results` on `claim`; none where they lack its runs.
    pub fn of(claim: &'static Claim, results: &Results) -> Option<Self> {
        // Runs that a set-up needs only for other figures do not count, so that the verdict does
        // not depend on the selected figures.
        let concerned =
            |r: &SetupResults| claim.figures.iter().all(|figure| r.setup().figures.contains(figure));
        let decisions: Vec<(usize, Decision)> =
            results.setups().filter(concerned).filter_map(|r| Some((r.index, (claim.decide)(r)?))).collect();
        (!decisions.is_empty()).then_some(Self { claim, decisions })
    }

    /// The decision in the set-up at `index`.
    pub fn decision(&self, index: usize) -> Option<&Decision> {
        self.decisions.iter().find(|(at, _)| *at == index).map(|(_, decision)| decision)
    }

    /// `holds`, `holds in the 2 decided` of the four main set-ups, `holds only with …`,
    /// `does not hold`.
    pub fn words(&self) -> String {
        let holding: Vec<usize> = self.decisions.iter().filter(|(_, d)| d.holds).map(|(at, _)| *at).collect();
        if holding.is_empty() {
            return "does not hold".into();
        }
        let main: Vec<usize> = self.decisions.iter().map(|(at, _)| *at).filter(|at| *at < MAIN).collect();
        let holding_main: Vec<usize> = holding.iter().copied().filter(|at| *at < MAIN).collect();
        if holding_main.len() == main.len() && !main.is_empty() {
            return if main.len() == MAIN {
                "holds".into()
            } else {
                format!("holds in the {} decided", main.len())
            };
        }
        if holding_main.is_empty() {
            let names: Vec<&str> = holding.iter().map(|at| SETUPS[*at].name).collect();
            return format!("holds only with variant: {}", names.join("; "));
        }
        let names: Vec<&str> = holding_main.iter().map(|at| SETUPS[*at].name).collect();
        format!("holds only with: {}", names.join("; "))
    }

    /// The decision in the set-up that the one at `index` varies.
    pub(super) fn decision_of_varied(&self, index: usize) -> Option<&Decision> {
        let name = SETUPS[index].varies?;
        self.decision(SETUPS.iter().position(|setup| setup.name == name)?)
    }

    /// The variants whose decision differs from that of the set-up that they vary.
    pub fn departures(&self) -> Vec<(usize, &Decision)> {
        let departs = |(at, decision): &&(usize, Decision)| {
            self.decision_of_varied(*at).is_some_and(|varied| varied.holds != decision.holds)
        };
        self.decisions.iter().filter(departs).map(|(at, decision)| (*at, decision)).collect()
    }
}
