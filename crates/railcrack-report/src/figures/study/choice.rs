//! Selection of the runs of a large study that a chart shows.

use railcrack_run::study::PlannedRun;
use std::cmp::Reverse;

/// At most `most` of `runs`, in their order: those at the indices `first`, and others that cover
/// the values of every key as evenly as possible. A constant stride would omit values whenever it
/// divides the number of values of the faster keys.
///
/// The next run is always the one that adds the most values not shown yet; among equals, the one
/// whose values are shown least; among these, one in a fixed pseudo-random order, so that the
/// values of two keys are not correlated.
pub(crate) fn stratified(runs: &[&PlannedRun], first: &[usize], most: usize) -> Vec<usize> {
    if runs.len() <= most {
        return (0..runs.len()).collect();
    }
    let mut shown = ShownRuns::of(runs);
    let mut taken = vec![false; runs.len()];
    let mut count = 0;
    for &place in first.iter().filter(|place| **place < runs.len()) {
        if count < most && !std::mem::replace(&mut taken[place], true) {
            shown.add(runs[place]);
            count += 1;
        }
    }
    while count < most {
        let waiting = (0..runs.len()).filter(|&place| !taken[place]);
        let best = waiting.min_by_key(|&place| {
            let (fresh, before) = shown.rank(runs[place]);
            (Reverse(fresh), before, disorder(runs[place].number))
        });
        let Some(best) = best else { break };
        taken[best] = true;
        shown.add(runs[best]);
        count += 1;
    }
    (0..runs.len()).filter(|&place| taken[place]).collect()
}

/// Number of times that each value of each axis is shown.
struct ShownRuns {
    /// By axis and value: times shown.
    times: Vec<Vec<usize>>,
    /// Weight of an axis: its number of values, so that times shown compare as shares.
    weights: Vec<usize>,
}

impl ShownRuns {
    fn of(runs: &[&PlannedRun]) -> Self {
        let axes = runs.iter().map(|run| run.choice.len()).max().unwrap_or(0);
        let mut there: Vec<Vec<bool>> = vec![Vec::new(); axes];
        for run in runs {
            for (values, &value) in there.iter_mut().zip(&run.choice) {
                if values.len() <= value {
                    values.resize(value + 1, false);
                }
                values[value] = true;
            }
        }
        let weights = there.iter().map(|values| values.iter().filter(|there| **there).count()).collect();
        Self { times: there.iter().map(|values| vec![0; values.len()]).collect(), weights }
    }

    fn add(&mut self, run: &PlannedRun) {
        for (times, &value) in self.times.iter_mut().zip(&run.choice) {
            times[value] += 1;
        }
    }

    /// Number of its values not shown yet, and the weighted counts of all its values.
    fn rank(&self, run: &PlannedRun) -> (usize, usize) {
        let times = || self.times.iter().zip(&run.choice).map(|(times, &value)| times[value]);
        let fresh = times().filter(|times| *times == 0).count();
        (fresh, times().zip(&self.weights).map(|(times, weight)| times * weight).sum())
    }
}

/// A hash independent of the order of the runs (the finaliser of MurmurHash3, Appleby 2011).
fn disorder(number: usize) -> u64 {
    let mut bits = number as u64;
    bits = (bits ^ (bits >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd);
    bits = (bits ^ (bits >> 33)).wrapping_mul(0xc4ce_b9fe_1a85_ec53);
    bits ^ (bits >> 33)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The runs of a product of axes with so many values; the last one changes fastest.
    fn product(lengths: &[usize]) -> Vec<PlannedRun> {
        let count: usize = lengths.iter().product();
        (0..count)
            .map(|run| {
                let mut left = run;
                let mut choice: Vec<usize> = lengths
                    .iter()
                    .rev()
                    .map(|length| {
                        let value = left % length;
                        left /= length;
                        value
                    })
                    .collect();
                choice.reverse();
                PlannedRun { number: run + 1, folder: String::new(), choice, case: None }
            })
            .collect()
    }

    /// Times that each value of an axis is shown.
    fn times(runs: &[&PlannedRun], chosen: &[usize], axis: usize, length: usize) -> Vec<usize> {
        let mut times = vec![0; length];
        chosen.iter().for_each(|&place| times[runs[place].choice[axis]] += 1);
        times
    }

    #[test]
    fn every_value_of_every_key_is_shown_evenly_whatever_the_product() {
        let shapes: [&[usize]; 12] = [
            &[5, 6, 5, 2],
            &[2, 5, 6, 5],
            &[300],
            &[2, 150],
            &[150, 2],
            &[3, 100],
            &[7, 11, 13],
            &[10, 10, 10],
            &[2, 2, 2, 2, 2, 2, 2, 2, 2],
            &[4, 4, 4, 4, 4],
            &[25, 24, 2],
            &[1, 151, 2, 1, 2],
        ];
        for shape in shapes {
            let all = product(shape);
            let runs: Vec<&PlannedRun> = all.iter().collect();
            for most in [50, 150] {
                let chosen = stratified(&runs, &[], most);
                assert_eq!(chosen.len(), most.min(runs.len()), "{shape:?}");
                assert!(chosen.is_sorted());
                for (axis, &length) in shape.iter().enumerate() {
                    let times = times(&runs, &chosen, axis, length);
                    let (least, most_times) = (*times.iter().min().unwrap(), *times.iter().max().unwrap());
                    assert!(length > most || least > 0, "{shape:?}, axis {axis}: {times:?}");
                    let even = most as f64 / length as f64;
                    assert!(
                        (least as f64) >= 0.5 * even - 1.0 && (most_times as f64) <= 1.5 * even + 2.0,
                        "{shape:?}, axis {axis}: {times:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn runs_without_a_part_of_the_product_still_show_every_value() {
        // A shard of two: with two values of the last key, one of these is not there.
        for (shape, shard) in [([5, 6, 5, 4], 3), ([9, 8, 7, 2], 2), ([20, 20, 2, 1], 7)] {
            let all = product(&shape);
            let runs: Vec<&PlannedRun> = all.iter().filter(|run| run.number % shard == 1).collect();
            let chosen = stratified(&runs, &[], 60);
            for axis in 0..shape.len() {
                let there = |value: &usize| runs.iter().any(|run| run.choice[axis] == *value);
                let shown = |value: usize| chosen.iter().any(|&place| runs[place].choice[axis] == value);
                assert!((0..shape[axis]).filter(there).all(shown), "{shape:?}, axis {axis}");
            }
        }
    }

    #[test]
    fn named_runs_are_among_them_and_a_zip_is_sampled_from_end_to_end() {
        let zip: Vec<PlannedRun> = (0..1000)
            .map(|run| PlannedRun { number: run + 1, folder: String::new(), choice: vec![run], case: None })
            .collect();
        let runs: Vec<&PlannedRun> = zip.iter().collect();
        let chosen = stratified(&runs, &[3, 997, 3], 50);
        assert!(chosen.contains(&3) && chosen.contains(&997) && chosen.len() == 50);
        for tenth in 0..10 {
            let in_it = chosen.iter().filter(|place| **place / 100 == tenth).count();
            assert!(in_it > 0, "runs {}00 to {}99: none", tenth, tenth);
        }
        assert_eq!(stratified(&runs[..20], &[], 50), (0..20).collect::<Vec<_>>());
        assert_eq!(stratified(&runs, &[5000], 50).len(), 50);
    }

    #[test]
    fn two_keys_do_not_go_in_step() {
        let all = product(&[10, 10, 10]);
        let runs: Vec<&PlannedRun> = all.iter().collect();
        let chosen = stratified(&runs, &[], 150);
        let mut pairs: Vec<[usize; 2]> =
            chosen.iter().map(|&place| [runs[place].choice[0], runs[place].choice[1]]).collect();
        pairs.sort_unstable();
        pairs.dedup();
        assert!(pairs.len() > 60, "{} of 100 pairs of values are shown", pairs.len());
    }
}
