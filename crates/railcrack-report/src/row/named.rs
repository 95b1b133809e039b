//! The few highlighted cracks of a row.

use super::history::{CrackHistory, CrackRow};

/// A highlighted crack and the reason.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct NamedCrack {
    /// Its number, from 1.
    pub(crate) crack: usize,
    /// "longest, fastest at the end".
    pub(crate) words: String,
}

impl NamedCrack {
    /// "crack 38: longest".
    pub(crate) fn title(&self) -> String {
        format!("crack {}: {}", self.crack, self.words)
    }
}

/// The longest crack, the one that has grown most, the fastest at the end, the one with the median
/// growth, the one that has grown least, and the first that has stopped: each once, of equal ones
/// the first along the rail.
pub(crate) fn named(row: &CrackRow) -> Vec<NamedCrack> {
    let cracks = &row.cracks;
    let most = |of: &dyn Fn(&CrackHistory) -> f64| {
        cracks.iter().reduce(|most, next| if of(next) > of(most) { next } else { most })
    };
    let mut by_growth: Vec<&CrackHistory> = cracks.iter().collect();
    by_growth.sort_by(|one, other| one.growth().total_cmp(&other.growth()));
    let median = by_growth.get((by_growth.len().max(1) - 1) / 2).copied();
    let grows = row.steps.len() > 1;
    let stopped = cracks.iter().filter(|crack| crack.stopped.is_some()).min_by_key(|crack| crack.stopped);
    let roles = [
        ("longest", most(&|crack| crack.last().length)),
        ("grew most", most(&CrackHistory::growth).filter(|_| grows)),
        (if grows { "fastest at the end" } else { "fastest" }, most(&|crack| crack.last().rate)),
        ("median growth", median.filter(|_| grows)),
        ("grew least", most(&|crack| -crack.growth()).filter(|_| grows)),
        ("first to stop", stopped),
    ];
    let mut named: Vec<NamedCrack> = Vec::new();
    for (words, crack) in roles.into_iter().filter_map(|(words, crack)| Some((words, crack?.crack))) {
        match named.iter_mut().find(|named| named.crack == crack) {
            Some(known) => known.words.push_str(&format!(", {words}")),
            None => named.push(NamedCrack { crack, words: words.to_owned() }),
        }
    }
    named
}

#[cfg(test)]
mod tests {
    use super::super::history::CrackState;
    use super::*;

    /// Cracks with a length before and after, a rate at the end, and a step in which each stops.
    fn row(cracks: &[([f64; 2], f64, Option<usize>)]) -> CrackRow {
        let state =
            |length: f64, rate: f64| CrackState { length, depth: 1.0, delta_keq: 1.0, rate, stop: None };
        let crack =
            |(place, &(lengths, rate, stopped)): (usize, &([f64; 2], f64, Option<usize>))| CrackHistory {
                crack: place + 1,
                mouth: 3.0 * place as f64,
                states: lengths.map(|length| state(length, rate)).to_vec(),
                stopped,
            };
        CrackRow {
            steps: vec![0, 1],
            cycles: vec![0.0, 1.0],
            cracks: cracks.iter().enumerate().map(crack).collect(),
        }
    }

    #[test]
    fn each_is_named_once_with_all_that_it_is_known_for() {
        let row = row(&[
            ([5.0, 5.1], 1e-6, None),
            ([6.0, 8.0], 3e-6, None),
            ([9.0, 9.5], 2e-6, Some(1)),
            ([5.0, 5.6], 2e-6, None),
            ([5.0, 5.7], 2e-6, Some(0)),
        ]);
        let names: Vec<String> = named(&row).iter().map(NamedCrack::title).collect();
        let want = [
            "crack 3: longest",
            "crack 2: grew most, fastest at the end",
            "crack 4: median growth",
            "crack 1: grew least",
            "crack 5: first to stop",
        ];
        assert_eq!(names, want);
    }

    #[test]
    fn without_growth_there_are_the_longest_and_the_fastest() {
        let mut row = row(&[([5.0, 5.0], 1e-6, None), ([6.0, 6.0], 1e-6, None)]);
        row.steps.truncate(1);
        row.cracks.iter_mut().for_each(|crack| crack.states.truncate(1));
        let names: Vec<String> = named(&row).iter().map(NamedCrack::title).collect();
        assert_eq!(names, ["crack 2: longest", "crack 1: fastest"]);
    }
}
