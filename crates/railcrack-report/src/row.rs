//! Rows of many cracks: the state of every crack in every step, and the few that are highlighted.

use crate::chart::CATEGORIES;
use railcrack::growth::{RunStop, TipStop};
use railcrack_run::CrackSummary;
use railcrack_run::csv::TipRow;
use std::collections::BTreeMap;

/// Whether there are more `cracks` than distinguishable colours.
pub(crate) fn is_many(cracks: usize) -> bool {
    cracks > CATEGORIES
}

/// State of a crack in a step, with the largest values of its tips.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CrackState {
    /// Length along its path, mm.
    pub(crate) length: f64,
    /// Depth of its deepest tip, mm.
    pub(crate) depth: f64,
    /// ΔK_eq, MPa√m.
    pub(crate) delta_keq: f64,
    /// Growth rate, mm per load cycle.
    pub(crate) rate: f64,
    /// Reason why its last tip has stopped; none while a tip grows.
    pub(crate) stop: Option<TipStop>,
}

/// A crack of a row.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CrackHistory {
    /// Number of the crack, from 1.
    pub(crate) crack: usize,
    /// Start along the rail, mm: its mouth, or the first end of a buried crack.
    pub(crate) mouth: f64,
    /// States in the order of [`CrackRow::steps`].
    pub(crate) states: Vec<CrackState>,
    /// The first step in which it has stopped.
    pub(crate) stopped: Option<usize>,
}

impl CrackHistory {
    /// The initial crack.
    pub(crate) fn first(&self) -> &CrackState {
        &self.states[0]
    }

    /// The crack in the last step.
    pub(crate) fn last(&self) -> &CrackState {
        &self.states[self.states.len() - 1]
    }

    /// Growth in length so far, mm.
    pub(crate) fn growth(&self) -> f64 {
        self.last().length - self.first().length
    }
}

/// A row of cracks, with at least one step.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CrackRow {
    /// Step numbers.
    pub(crate) steps: Vec<usize>,
    /// Load cycles at their start.
    pub(crate) cycles: Vec<f64>,
    /// By number.
    pub(crate) cracks: Vec<CrackHistory>,
}

/// A crack under construction.
struct Followed {
    history: CrackHistory,
    /// By number of the tip.
    stops: BTreeMap<usize, Option<TipStop>>,
}

impl CrackRow {
    /// The cracks of a run in all its steps; none without a finished step. A crack that has joined
    /// others with all its tips keeps its last length.
    pub(crate) fn of(cracks: &[CrackSummary], growth: &[TipRow]) -> Option<Self> {
        let begin = |(place, crack): (usize, &CrackSummary)| Followed {
            history: CrackHistory {
                crack: place + 1,
                mouth: crack.initial_points_mm.first().map_or(0.0, |point| point[0]),
                states: Vec::new(),
                stopped: None,
            },
            stops: BTreeMap::new(),
        };
        let mut followed: Vec<Followed> = cracks.iter().enumerate().map(begin).collect();
        let mut row = Self { steps: Vec::new(), cycles: Vec::new(), cracks: Vec::new() };
        for rows in growth.chunk_by(|one, next| one.step == next.step) {
            row.steps.push(rows[0].step);
            row.cycles.push(rows[0].load_cycles);
            let mut of_cracks: Vec<Vec<&TipRow>> = vec![Vec::new(); followed.len()];
            for tip in rows {
                if let Some(tips) = tip.crack.checked_sub(1).and_then(|place| of_cracks.get_mut(place)) {
                    tips.push(tip);
                }
            }
            for ((crack, tips), initial) in followed.iter_mut().zip(of_cracks).zip(cracks) {
                crack.take(rows[0].step, &tips, &initial.initial_points_mm);
            }
        }
        row.cracks = followed.into_iter().map(|crack| crack.history).collect();
        (!row.steps.is_empty() && !row.cracks.is_empty()).then_some(row)
    }
}

impl Followed {
    /// Adds the next step with the rows of its `tips`.
    fn take(&mut self, step: usize, tips: &[&TipRow], initial: &[[f64; 2]]) {
        for tip in tips {
            let stop = match tip.stop {
                Some(RunStop::NoTipGrows(stop)) => Some(stop),
                _ => None,
            };
            // A stopped crack does not restart.
            let known = self.stops.entry(tip.tip).or_default();
            *known = known.or(stop);
        }
        let before = self.history.states.last();
        let most = |of: fn(&TipRow) -> f64| tips.iter().map(|tip| of(tip)).reduce(f64::max);
        let stop = match tips {
            [] => before.and_then(|state| state.stop).or(Some(TipStop::Coalescence)),
            _ if self.stops.values().all(Option::is_some) => {
                tips.iter().rev().find_map(|tip| self.stops[&tip.tip])
            }
            _ => None,
        };
        let state = CrackState {
            length: most(|tip| tip.length).or(before.map(|state| state.length)).unwrap_or_else(|| {
                initial.windows(2).map(|p| (p[1][0] - p[0][0]).hypot(p[1][1] - p[0][1])).sum()
            }),
            depth: most(|tip| -tip.place[1])
                .or(before.map(|state| state.depth))
                .unwrap_or_else(|| initial.iter().map(|point| -point[1]).fold(0.0, f64::max)),
            delta_keq: most(|tip| tip.delta_keq).unwrap_or(0.0),
            rate: most(|tip| tip.rate).unwrap_or(0.0),
            stop,
        };
        if state.stop.is_some() && self.history.stopped.is_none() {
            self.history.stopped = Some(step);
        }
        self.history.states.push(state);
    }
}

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
    use super::*;

    fn tip(step: usize, crack: usize, tip: usize, stop: Option<RunStop>) -> TipRow {
        TipRow {
            crack,
            tip,
            place: [0.0, -1.0 - tip as f64],
            length: 6.0 + step as f64,
            delta_keq: 10.0 * tip as f64,
            rate: 1e-6 * tip as f64,
            load_cycles: 100.0 * step as f64,
            stop,
            ..TipRow::idle(step)
        }
    }

    fn crack(x: f64) -> CrackSummary {
        let points = vec![[x, 0.0], [x + 3.0, -4.0]];
        CrackSummary { initial_points_mm: points.clone(), points_mm: points, path_mm: None }
    }

    #[test]
    fn a_crack_stops_with_its_last_tip_and_keeps_its_length() {
        let arrest = Some(RunStop::NoTipGrows(TipStop::Arrest));
        let joins = Some(RunStop::NoTipGrows(TipStop::Coalescence));
        // Crack 1 joins another one in step 1; crack 2 has two tips, of which one is arrested from
        // step 0 on and the other breaks out in step 2; crack 3 has joined another one before the
        // run.
        let growth = [
            tip(0, 1, 1, None),
            tip(0, 2, 1, arrest),
            tip(0, 2, 2, None),
            tip(1, 1, 1, joins),
            tip(1, 2, 1, arrest),
            tip(1, 2, 2, None),
            tip(2, 2, 1, Some(RunStop::StepsDone)),
            tip(2, 2, 2, Some(RunStop::NoTipGrows(TipStop::BreakOut))),
        ];
        let row = CrackRow::of(&[crack(0.0), crack(3.0), crack(6.0)], &growth).unwrap();
        assert_eq!((&row.steps[..], &row.cycles[..]), (&[0, 1, 2][..], &[0.0, 100.0, 200.0][..]));
        let stops = |crack: usize| -> Vec<Option<TipStop>> {
            row.cracks[crack].states.iter().map(|state| state.stop).collect()
        };
        assert_eq!(stops(0), [None, Some(TipStop::Coalescence), Some(TipStop::Coalescence)]);
        assert_eq!(stops(1), [None, None, Some(TipStop::BreakOut)]);
        assert_eq!(stops(2), [Some(TipStop::Coalescence); 3]);
        assert_eq!(
            row.cracks.iter().map(|crack| crack.stopped).collect::<Vec<_>>(),
            [Some(1), Some(2), Some(0)]
        );
        let [first, second, third] = [0, 1, 2].map(|crack| *row.cracks[crack].last());
        assert_eq!((first.length, first.rate, first.delta_keq, first.depth), (7.0, 0.0, 0.0, 2.0));
        assert_eq!((second.length, second.rate, second.delta_keq, second.depth), (8.0, 2e-6, 20.0, 3.0));
        assert_eq!((third.length, third.depth), (5.0, 4.0));
        assert_eq!(row.cracks.iter().map(|crack| crack.mouth).collect::<Vec<_>>(), [0.0, 3.0, 6.0]);
        assert_eq!(CrackRow::of(&[crack(0.0)], &[]), None);
    }
}

#[cfg(test)]
mod named_tests {
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
