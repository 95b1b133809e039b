//! Which run is computed next.

use railcrack::case::{Case, RailKey, SharedRail};
use std::collections::{HashMap, VecDeque};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// A rail that several runs share, once one of them has made it; none where it cannot be made: they say why themselves.
pub type RailSlot = Arc<OnceLock<Option<SharedRail>>>;

/// A run to compute.
pub struct Next {
    /// Index of the run in the study, from 0.
    pub run: usize,
    /// Where it finds the rail that it shares with others; none where it shares none.
    pub rail: Option<RailSlot>,
}

/// Runs that share a rail.
struct Group {
    waiting: VecDeque<usize>,
    rail: Option<RailSlot>,
    is_begun: bool,
}

/// The runs that wait for a thread. Threads begin with different rails, so that nobody waits for one that another thread makes, and
/// a rail is kept only as long as runs of its group wait or use it.
pub struct Queue {
    groups: Mutex<Vec<Group>>,
}

impl Queue {
    /// The runs `waiting` (indices), each with its case.
    pub fn new<'a>(waiting: impl IntoIterator<Item = (usize, &'a Case)>) -> Self {
        let mut groups: Vec<Group> = Vec::new();
        let mut places: HashMap<RailKey, usize> = HashMap::new();
        for (run, case) in waiting {
            let next = groups.len();
            let place = case.rail_key().map_or(next, |key| *places.entry(key).or_insert(next));
            match groups.get_mut(place) {
                Some(group) => group.waiting.push_back(run),
                None => groups.push(Group { waiting: [run].into(), rail: None, is_begun: false }),
            }
        }
        for group in groups.iter_mut().filter(|group| group.waiting.len() > 1) {
            group.rail = Some(RailSlot::default());
        }
        Self { groups: Mutex::new(groups) }
    }

    /// The next run; none when all are taken.
    pub fn take(&self) -> Option<Next> {
        let mut groups = self.groups.lock().unwrap_or_else(PoisonError::into_inner);
        let fresh = groups.iter().position(|group| !group.is_begun);
        let longest = || (0..groups.len()).rev().max_by_key(|&i| groups[i].waiting.len());
        let place = fresh.or_else(longest)?;
        let group = &mut groups[place];
        let run = group.waiting.pop_front()?;
        group.is_begun = true;
        let rail = group.rail.clone();
        if group.waiting.is_empty() {
            group.rail = None;
        }
        Some(Next { run, rail })
    }
}

#[cfg(test)]
mod tests {
    use super::Queue;
    use railcrack::case::{Overrides, Study};
    use std::path::Path;

    fn study(lists: &str, engine: &str) -> Study {
        let text = format!(
            "[contact]\npeak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\n{lists}\n[[crack]]\nmouth_mm = 0.0\n\
             length_mm = [5.0, 6.0]\nangle_deg = 15.0\nfriction = 0.5\n[solver]\nengine = \"{engine}\"\n"
        );
        Study::parse_with(&text, "s.toml", Path::new(""), &Overrides::default()).unwrap()
    }

    #[test]
    fn runs_with_the_same_rail_share_it_and_every_run_comes_once() {
        let study = study("friction = [0.1, 0.2, 0.3]", "xfem");
        let queue = Queue::new(study.runs.iter().enumerate().map(|(i, run)| (i, &run.case)));
        let mut taken: Vec<_> = std::iter::from_fn(|| queue.take()).collect();
        // Two threads would make the rails of both lengths at once.
        let length = |i: usize| study.runs[i].choice[1];
        assert_ne!(length(taken[0].run), length(taken[1].run));
        for one in &taken {
            for other in &taken {
                let shared = std::sync::Arc::ptr_eq(one.rail.as_ref().unwrap(), other.rail.as_ref().unwrap());
                assert_eq!(shared, length(one.run) == length(other.run));
            }
        }
        taken.sort_by_key(|next| next.run);
        assert_eq!(taken.iter().map(|next| next.run).collect::<Vec<_>>(), [0, 1, 2, 3, 4, 5]);
    }

    #[test]
    fn nothing_is_kept_for_a_run_that_shares_nothing() {
        for (lists, engine) in [("friction = 0.1", "xfem"), ("friction = [0.1, 0.2]", "dislocation")] {
            let study = study(lists, engine);
            let queue = Queue::new(study.runs.iter().enumerate().map(|(i, run)| (i, &run.case)));
            let taken: Vec<_> = std::iter::from_fn(|| queue.take()).collect();
            assert_eq!(taken.len(), study.runs.len());
            assert!(taken.iter().all(|next| next.rail.is_none()));
        }
    }
}
