//! The verdict on a statement over all set-ups, and the set-up that is closest to the paper.

use crate::results::Results;
use crate::rules::Decision;
use crate::tables::{Claim, MAIN, Paper};

/// A statement with its decision in every set-up.
pub struct Verdict<'a> {
    paper: &'a Paper,
    /// The statement.
    pub claim: &'a Claim,
    /// The decisions, with the places of their set-ups.
    pub decisions: Vec<(usize, Decision)>,
}

/// The verdicts of `results` on the statements that `figures` decide.
pub fn verdicts<'a>(paper: &'a Paper, results: &Results, figures: &[u8]) -> Vec<Verdict<'a>> {
    let wanted = |claim: &&Claim| claim.figures.iter().all(|figure| figures.contains(figure));
    let verdict = |claim: &'a Claim| {
        let decisions = results
            .setups(paper)
            // Runs that a set-up needs only for other figures do not count, so that the verdict
            // does not depend on the selected figures.
            .filter(|r| claim.figures.iter().all(|figure| r.setup().row.figures.contains(figure)))
            .filter_map(|r| Some((r.index, claim.decide(r)?)))
            .collect();
        Verdict::new(paper, claim, decisions)
    };
    let all = paper.claims.iter().filter(wanted).map(verdict);
    all.filter(|verdict| !verdict.decisions.is_empty()).collect()
}

impl<'a> Verdict<'a> {
    /// The verdict on `claim` by its decisions, each with the place of its set-up.
    pub fn new(paper: &'a Paper, claim: &'a Claim, decisions: Vec<(usize, Decision)>) -> Self {
        Self { paper, claim, decisions }
    }

    /// The decision in the set-up at `index`.
    pub fn decision(&self, index: usize) -> Option<&Decision> {
        self.decisions.iter().find(|(at, _)| *at == index).map(|(_, decision)| decision)
    }

    /// `holds`, `holds in the 2 decided` of the four main set-ups, `holds only with …`,
    /// `does not hold`.
    pub fn words(&self) -> String {
        let main = self.decisions.iter().filter(|(at, _)| *at < MAIN).count();
        let holding: Vec<usize> = self.decisions.iter().filter(|(_, d)| d.holds).map(|(at, _)| *at).collect();
        let holding_main: Vec<usize> = holding.iter().copied().filter(|at| *at < MAIN).collect();
        let names = |places: &[usize]| {
            let names: Vec<&str> = places.iter().map(|at| self.paper.setups[*at].name.as_str()).collect();
            names.join("; ")
        };
        match holding_main.len() {
            _ if holding.is_empty() => "does not hold".into(),
            0 => format!("holds only with variant: {}", names(&holding)),
            MAIN => "holds".into(),
            all if all == main => format!("holds in the {main} decided"),
            _ => format!("holds only with: {}", names(&holding_main)),
        }
    }

    /// The decision in the set-up that the one at `index` varies.
    fn decision_of_varied(&self, index: usize) -> Option<&Decision> {
        let name = self.paper.setups[index].varies.as_ref()?;
        self.decision(self.paper.setups.iter().position(|setup| setup.name == *name)?)
    }

    /// Whether the decision in the set-up at `index` differs from that of the set-up that it
    /// varies.
    pub fn departs(&self, index: usize) -> bool {
        match (self.decision(index), self.decision_of_varied(index)) {
            (Some(decision), Some(varied)) => decision.holds != varied.holds,
            _ => false,
        }
    }

    /// The decisions to show: those of the main set-ups, those that differ, and those with nothing
    /// to compare.
    pub fn shown(&self) -> impl Iterator<Item = &(usize, Decision)> {
        self.decisions
            .iter()
            .filter(|(at, _)| *at < MAIN || self.departs(*at) || self.decision_of_varied(*at).is_none())
    }
}

/// Main set-ups, by their places, in which most statements hold.
#[derive(Debug, PartialEq)]
pub struct Closest {
    /// Number of statements that all main set-ups decide.
    pub decided: usize,
    /// Number of statements that hold in each main set-up.
    pub holding: [usize; MAIN],
}

/// Statements that hold in the main set-ups. Only statements that all main set-ups decide are
/// counted, so that the counts can be compared.
pub fn closest(verdicts: &[Verdict]) -> Closest {
    let main: Vec<[bool; MAIN]> = verdicts
        .iter()
        .filter_map(|verdict| {
            let mut holds = [false; MAIN];
            for (at, holds) in holds.iter_mut().enumerate() {
                *holds = verdict.decision(at)?.holds;
            }
            Some(holds)
        })
        .collect();
    let count = |at: usize| main.iter().filter(|holds| holds[at]).count();
    Closest { decided: main.len(), holding: std::array::from_fn(count) }
}

impl Closest {
    /// The result in a sentence.
    pub fn words(&self, paper: &Paper) -> String {
        let most = self.holding.iter().copied().max().unwrap_or(0);
        let named = |is_best: bool| {
            let places = (0..MAIN).filter(move |at| (self.holding[*at] == most) == is_best);
            places.map(|at| (format!("\u{201c}{}\u{201d}", paper.setups[at].name), self.holding[at]))
        };
        let names: Vec<String> = named(true).map(|(name, _)| name).collect();
        let rest: Vec<String> = named(false).map(|(name, count)| format!("{count} in {name}")).collect();
        let all = self.decided;
        if rest.is_empty() {
            return format!(
                "No main set-up is closest to the paper: of the {all} statements decided by all of them, {most} hold in each."
            );
        }
        format!(
            "Closest to the paper is {}: of the {all} statements decided by all main set-ups, {most} hold there, compared with {}.",
            names.join(" and "),
            rest.join(", ")
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn verdict<'a>(paper: &'a Paper, holds: &[(usize, bool)]) -> Verdict<'a> {
        let decisions = holds.iter().map(|(at, holds)| (*at, Decision::new(*holds))).collect();
        Verdict::new(paper, &paper.claims[0], decisions)
    }

    #[test]
    fn only_statements_that_all_main_setups_decide_count() {
        let paper = Paper::read().unwrap();
        let mut verdicts = vec![
            verdict(&paper, &[(0, true), (1, false), (2, false), (3, false), (4, false)]),
            verdict(&paper, &[(0, true), (1, true), (2, true), (3, true)]),
            verdict(&paper, &[(1, true), (2, true)]),
        ];
        let text = closest(&verdicts).words(&paper);
        assert!(text.contains("\u{201c}half-plane, along\u{201d}: of the 2 statements"), "{text}");
        assert!(
            text.contains("2 hold there, compared with 1 in \u{201c}half-plane, against\u{201d}"),
            "{text}"
        );
        verdicts.remove(0);
        assert!(closest(&verdicts).words(&paper).starts_with("No main set-up"));
    }

    #[test]
    fn words_of_verdicts() {
        let paper = Paper::read().unwrap();
        let words = |holds: &[(usize, bool)]| verdict(&paper, holds).words();
        assert_eq!(words(&[(0, true), (1, true), (2, true), (3, true), (4, false)]), "holds");
        assert_eq!(words(&[(2, true), (3, true)]), "holds in the 2 decided");
        assert_eq!(words(&[(0, false), (4, true)]), "holds only with variant: half-plane xfem, along");
        assert_eq!(words(&[(0, true), (1, false)]), "holds only with: half-plane, along");
        assert_eq!(words(&[(0, false)]), "does not hold");
        let variant = verdict(&paper, &[(0, false), (4, true), (5, true)]);
        assert!(variant.departs(4) && !variant.departs(5), "what 5 varies is not decided");
        assert_eq!(variant.shown().count(), 3);
    }
}
