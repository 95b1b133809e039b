//! Steps of a run in progress, thinned out to a limited number; K over the stabilised passages.

use super::step_table::StepTable;
use crate::chart::CATEGORIES;
use railcrack_run::OutputError;
use railcrack_run::csv::{SifRow, StepBlock};
use railcrack_run::run_folder::History;

/// Of the steps of a run, every 2ⁿ-th and the newest one. Whatever step it is at, n follows from
/// the steps before alone.
#[derive(Debug, Clone)]
pub(crate) struct Thinned<T> {
    every: usize,
    /// Every `every`-th step.
    kept: Vec<(usize, T)>,
    /// The newest step, if it is not one of them.
    newest: Option<(usize, T)>,
}

impl<T> Default for Thinned<T> {
    fn default() -> Self {
        Self { every: 1, kept: Vec::new(), newest: None }
    }
}

impl<T> Thinned<T> {
    /// Adds the step after the last one.
    pub(crate) fn push(&mut self, step: usize, item: T) {
        self.newest = None;
        if self.is_kept(step) {
            self.kept.push((step, item));
        } else {
            self.newest = Some((step, item));
        }
    }

    /// Whether a step stays once there are newer ones, as far as is known by now.
    pub(crate) fn is_kept(&self, step: usize) -> bool {
        step.is_multiple_of(self.every)
    }

    /// Leaves out every other one of the steps that are kept, until their weights are `most`
    /// together or only the first is left.
    pub(crate) fn thin_to(&mut self, most: usize, weight: impl Fn(&T) -> usize) {
        while self.kept.len() > 1 && self.weight(&weight) > most {
            self.every *= 2;
            let every = self.every;
            let last = self.kept.pop_if(|(step, _)| !step.is_multiple_of(every));
            self.newest = self.newest.take().or(last);
            self.kept.retain(|(step, _)| step.is_multiple_of(every));
        }
    }

    /// The weights of the steps that are kept, together.
    pub(crate) fn weight(&self, weight: impl Fn(&T) -> usize) -> usize {
        self.kept.iter().map(|(_, item)| weight(item)).sum()
    }

    /// All items, by step.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (usize, &T)> {
        self.kept.iter().chain(&self.newest).map(|(step, item)| (*step, item))
    }

    /// All items, by step.
    pub(crate) fn values_mut(&mut self) -> impl Iterator<Item = &mut T> {
        self.kept.iter_mut().chain(&mut self.newest).map(|(_, item)| item)
    }

    /// The item of a step.
    pub(crate) fn get(&self, step: usize) -> Option<&T> {
        self.iter().find(|(at, _)| *at == step).map(|(_, item)| item)
    }
}

/// Maximum number of values of K shown (tips × positions × steps), for a page below 3 MB.
const VALUES: usize = 300_000;
/// The same for many tips, of which the page shows the part near each crack.
const OF_MANY: usize = 4 * VALUES;

/// The histories of the steps shown, by wheel. Those of a mix in the plane may take twice as much.
#[derive(Debug, Clone, Default)]
pub(crate) struct HistoryData {
    pub steps: Thinned<Vec<Vec<History>>>,
}

impl StepTable for HistoryData {
    type OfStep = Vec<Vec<History>>;
    type TableRow = SifRow;

    fn keeps(&self, step: usize) -> bool {
        self.steps.is_kept(step)
    }

    fn read(&self, block: &StepBlock<SifRow>) -> Result<Vec<Vec<History>>, OutputError> {
        History::by_wheel(block.rows())
    }

    fn push(&mut self, step: usize, wheels: Vec<Vec<History>>) {
        let tips = wheels.first().map_or(0, Vec::len);
        let most = if tips > CATEGORIES { OF_MANY } else { VALUES };
        let is_in_space = wheels.iter().flatten().any(|history| !history.kiii.is_empty());
        let times = if is_in_space { 1 } else { wheels.len().min(2) };
        self.steps.push(step, wheels);
        let values = |wheels: &Vec<Vec<History>>| {
            wheels.iter().flatten().map(|history| history.ki.len()).sum::<usize>()
        };
        self.steps.thin_to(times * most, values);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_power_of_two_and_the_newest() {
        let mut thinned = Thinned::default();
        for step in 0..=1000 {
            thinned.push(step, step);
            thinned.thin_to(10, |_| 1);
            let steps: Vec<usize> = thinned.iter().map(|(step, _)| step).collect();
            assert!(thinned.iter().all(|(step, &item)| step == item));
            assert_eq!((steps[0], *steps.last().unwrap()), (0, step));
            // With the newest one 11 at most, and never less than half of what may be there.
            assert!(steps.len() <= 11 && steps.len() >= 5.min(step + 1), "{steps:?}");
            assert!(
                steps.windows(2).rev().skip(1).all(|pair| pair[1] - pair[0] == thinned.every),
                "{steps:?}"
            );
        }
        assert_eq!(thinned.every, 128);
    }

    #[test]
    fn the_first_and_the_newest_stay_however_heavy() {
        let mut thinned = Thinned::default();
        for step in 0..=5 {
            thinned.push(step, ());
            thinned.thin_to(10, |()| 1000);
        }
        assert_eq!(thinned.iter().map(|(step, ())| step).collect::<Vec<_>>(), [0, 5]);
    }
}
