//! Which run is computed next, and on which rail.

use super::plan::Job;
use crate::case::{Case, RailKey, SharedRail};
use std::collections::{HashMap, VecDeque};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// A rail that several runs share, once one of them has made it; none where it cannot be made: the runs say why themselves.
pub(super) type RailSlot = Arc<OnceLock<Option<SharedRail>>>;

/// A run to compute.
pub(super) struct Next {
    /// Its place among the jobs.
    pub job: usize,
    /// Where it finds the rail that it shares with others; none where it shares none.
    pub rail: Option<RailSlot>,
    group: usize,
}

/// Runs that share a rail.
#[derive(Default)]
struct Group {
    waiting: VecDeque<usize>,
    effort: f64,
    rail: Option<RailSlot>,
    is_begun: bool,
}

/// The runs that wait. A thread stays with its rail as long as runs wait for it, so that few rails are kept at a time; otherwise it begins the
/// rail with the most work left, so that the threads end together.
pub(super) struct Queue {
    groups: Mutex<Vec<Group>>,
}

impl Queue {
    /// Those of `jobs` that are `waiting`, by their places, with their cases.
    pub(super) fn new(waiting: Vec<usize>, jobs: &[Job], cases: &[Case]) -> Self {
        let mut groups: Vec<Group> = Vec::new();
        let mut places: HashMap<RailKey, usize> = HashMap::new();
        for i in waiting {
            let fresh = groups.len();
            let place = cases[i].rail_key().map_or(fresh, |key| *places.entry(key).or_insert(fresh));
            if place == fresh {
                groups.push(Group::default());
            }
            groups[place].waiting.push_back(i);
            groups[place].effort += jobs[i].effort;
        }
        for group in groups.iter_mut().filter(|group| group.waiting.len() > 1) {
            group.rail = Some(RailSlot::default());
        }
        groups.sort_by(|a, b| b.effort.total_cmp(&a.effort));
        Self { groups: Mutex::new(groups) }
    }

    /// The next run of a thread that has done `last`; none when all are taken.
    pub(super) fn take(&self, last: Option<&Next>) -> Option<Next> {
        let mut groups = self.groups.lock().unwrap_or_else(PoisonError::into_inner);
        let waits = |group: &Group| !group.waiting.is_empty();
        let same = last.map(|last| last.group).filter(|&i| waits(&groups[i]));
        let fresh = || groups.iter().position(|group| !group.is_begun);
        let longest = || (0..groups.len()).rev().max_by_key(|&i| groups[i].waiting.len());
        let place = same.or_else(fresh).or_else(longest)?;
        let group = &mut groups[place];
        let job = group.waiting.pop_front()?;
        group.is_begun = true;
        let rail = group.rail.clone();
        if group.waiting.is_empty() {
            group.rail = None;
        }
        Some(Next { job, rail, group: place })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::paper::plan::plan;

    #[test]
    fn threads_stay_with_their_rail_and_every_run_comes_once() {
        let jobs = plan(&[17]);
        let cases: Vec<Case> = jobs
            .iter()
            .map(|job| Case::parse(&job.text, &job.name, std::path::Path::new("")).unwrap())
            .collect();
        let waiting: Vec<usize> = (1..jobs.len()).collect();
        let queue = Queue::new(waiting.clone(), &jobs, &cases);
        let mut threads: [Option<Next>; 2] = [None, None];
        let (mut taken, mut kept, mut shared) = (Vec::new(), 0, 0);
        'all: loop {
            for last in &mut threads {
                let Some(next) = queue.take(last.as_ref()) else { break 'all };
                if next.rail.is_some() {
                    shared += 1;
                    let same = |last: &Next| {
                        last.rail.as_ref().is_some_and(|rail| Arc::ptr_eq(rail, next.rail.as_ref().unwrap()))
                    };
                    kept += usize::from(last.as_ref().is_some_and(same));
                    assert_eq!(cases[next.job].rail_key(), cases[first_of_group(&next, &taken)].rail_key());
                }
                taken.push((next.job, next.group));
                *last = Some(next);
            }
        }
        let mut jobs_taken: Vec<usize> = taken.iter().map(|(job, _)| *job).collect();
        jobs_taken.sort_unstable();
        assert_eq!(jobs_taken, waiting);
        assert!(
            shared > 20 && 2 * kept > shared,
            "{kept} of {shared} runs stay with the rail of their thread"
        );
    }

    /// The first run that was taken of the group of `next`, or itself.
    fn first_of_group(next: &Next, taken: &[(usize, usize)]) -> usize {
        taken.iter().find(|(_, group)| *group == next.group).map_or(next.job, |(job, _)| *job)
    }
}
