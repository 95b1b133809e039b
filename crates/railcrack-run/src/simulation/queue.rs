//! Order of the runs of a study, and the rails that they share.

use crate::setup::{RailKey, SharedRail};
use railcrack_case::Case;
use std::collections::{HashMap, VecDeque};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// A rail that several runs share, once one of them has made it; none if it cannot be built, for
/// which the runs report the reason themselves.
type RailSlot = Arc<OnceLock<Option<SharedRail>>>;

/// A run that waits.
#[derive(Debug, Clone, Copy)]
pub struct WaitingRun<'a> {
    /// Its number among the runs.
    pub run: usize,
    /// Its case.
    pub case: &'a Case,
    /// About how long it takes, in any unit.
    pub effort: f64,
}

/// A run to compute.
#[derive(Debug)]
pub struct NextRun {
    /// Its number among the runs.
    pub run: usize,
    /// Where it finds the rail that it shares with others; none where it shares none.
    rail: Option<RailSlot>,
    group: usize,
}

impl NextRun {
    /// The rail that this run of `case` shares with others, made where it is the first of them;
    /// none if it shares none, or if the rail cannot be built, which the run itself will report.
    pub fn shared_rail(&self, case: &Case) -> Option<&SharedRail> {
        self.rail.as_ref()?.get_or_init(|| SharedRail::build(case).ok().flatten()).as_ref()
    }
}

/// Runs that share a rail.
#[derive(Debug, Default)]
struct Group {
    waiting: VecDeque<usize>,
    effort: f64,
    rail: Option<RailSlot>,
    is_begun: bool,
}

/// Runs that wait for a thread. One that has a rail stays with it as long as runs wait for it, so
/// that few rails are kept at a time; otherwise it begins the rail with the most work, so that the
/// threads end together and none waits for a rail that another one makes. The order of the runs
/// does not affect their results.
#[derive(Debug)]
pub struct RunQueue {
    groups: Mutex<Vec<Group>>,
}

impl RunQueue {
    /// The runs `waiting`.
    pub fn new<'a>(waiting: impl IntoIterator<Item = WaitingRun<'a>>) -> Self {
        let mut groups: Vec<Group> = Vec::new();
        let mut places: HashMap<RailKey, usize> = HashMap::new();
        for WaitingRun { run, case, effort } in waiting {
            let fresh = groups.len();
            let place = RailKey::of_case(case).map_or(fresh, |key| *places.entry(key).or_insert(fresh));
            if place == fresh {
                groups.push(Group::default());
            }
            groups[place].waiting.push_back(run);
            groups[place].effort += effort;
        }
        for group in groups.iter_mut().filter(|group| group.waiting.len() > 1) {
            group.rail = Some(RailSlot::default());
        }
        groups.sort_by(|a, b| b.effort.total_cmp(&a.effort));
        Self { groups: Mutex::new(groups) }
    }

    /// The next run of a thread that has done `last`; none when all are taken.
    pub fn take(&self, last: Option<&NextRun>) -> Option<NextRun> {
        let mut groups = self.groups.lock().unwrap_or_else(PoisonError::into_inner);
        let waits = |group: &Group| !group.waiting.is_empty();
        let same = last.map(|last| last.group).filter(|&i| groups.get(i).is_some_and(waits));
        let fresh = || groups.iter().position(|group| !group.is_begun);
        let longest = || (0..groups.len()).rev().max_by_key(|&i| groups[i].waiting.len());
        let place = same.or_else(fresh).or_else(longest)?;
        let group = &mut groups[place];
        let run = group.waiting.pop_front()?;
        group.is_begun = true;
        let rail = group.rail.clone();
        if group.waiting.is_empty() {
            group.rail = None;
        }
        Some(NextRun { run, rail, group: place })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use railcrack_case::{Overrides, Study, StudyRun};
    use std::path::Path;

    fn study(lists: &str, engine: &str) -> Study {
        let text = format!(
            "[contact]\npeak_pressure_mpa = 845.0\nhalf_width_mm = 6.75\n{lists}\n[[crack]]\nmouth_mm = 0.0\n\
             length_mm = [5.0, 6.0, 7.0]\nangle_deg = 15.0\nfriction = 0.5\n[solver]\nengine = \"{engine}\"\n"
        );
        Study::parse_with(&text, "s.toml", Path::new(""), &Overrides::default()).unwrap()
    }

    /// The runs of a study; those of long cracks take longer.
    fn queue(study: &Study) -> RunQueue {
        let runs = study.runs.iter().enumerate();
        RunQueue::new(runs.map(|(run, StudyRun { case, choice, .. })| WaitingRun {
            run,
            case,
            effort: choice.iter().sum::<usize>() as f64,
        }))
    }

    #[test]
    fn threads_stay_with_their_rail_and_every_run_comes_once() {
        let study = study("friction = [0.1, 0.2, 0.3, 0.4]", "xfem");
        let queue = queue(&study);
        let length = |next: &NextRun| study.runs[next.run].choice[1];
        let mut threads = [queue.take(None).unwrap(), queue.take(None).unwrap()];
        assert_eq!((length(&threads[0]), length(&threads[1])), (2, 1), "the rails with the most work first");
        let mut taken = threads.each_ref().map(|next| (next.run, next.rail.clone())).to_vec();
        'all: loop {
            for last in &mut threads {
                let Some(next) = queue.take(Some(last)) else { break 'all };
                taken.push((next.run, next.rail.clone()));
                if taken.len() <= 8 {
                    assert_eq!(length(&next), length(last), "a thread stays with its rail");
                }
                *last = next;
            }
        }
        for (one, rail) in &taken {
            for (other, another) in &taken {
                let shared = Arc::ptr_eq(rail.as_ref().unwrap(), another.as_ref().unwrap());
                assert_eq!(shared, study.runs[*one].choice[1] == study.runs[*other].choice[1]);
            }
        }
        let mut runs: Vec<usize> = taken.iter().map(|(run, _)| *run).collect();
        runs.sort_unstable();
        assert!(runs.into_iter().eq(0..12));
    }

    #[test]
    fn nothing_is_kept_for_a_run_that_shares_nothing() {
        for (lists, engine) in [("friction = 0.1", "xfem"), ("friction = [0.1, 0.2]", "dislocation")] {
            let study = study(lists, engine);
            let queue = queue(&study);
            let taken: Vec<_> = std::iter::from_fn(|| queue.take(None)).collect();
            assert_eq!(taken.len(), study.runs.len());
            assert!(taken.iter().all(|next| next.rail.is_none()));
        }
    }
}
