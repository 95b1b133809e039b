//! Lives of two runs, to the same length of the same crack.

use super::comparison::Comparison;
use super::tables::TipComparison;

/// Load cycles of both runs to the largest length that the crack has in both.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SameLength {
    /// The crack, from 1: the one that grows most in both.
    pub crack: usize,
    /// The length, mm.
    pub length: f64,
    /// Load cycles to it, of each run.
    pub load_cycles: [f64; 2],
    /// Million gross tonnes, where both runs have axle loads.
    pub million_gross_tonnes: Option<[f64; 2]>,
}

impl Comparison {
    /// The lives of both runs; none where no crack grows in both.
    pub fn life(&self) -> Option<SameLength> {
        let mut cracks: Vec<usize> = self.tips.iter().map(|tip| tip.crack).collect();
        cracks.sort_unstable();
        cracks.dedup();
        let of_crack = |crack: usize| -> Option<(f64, SameLength)> {
            let rows: Vec<&TipComparison> =
                self.tips.iter().filter(|tip| (tip.crack, tip.tip) == (crack, 1)).collect();
            let (first, last) = (rows.first()?, rows.last()?);
            let growth =
                (0..2).map(|run| last.lengths[run] - first.lengths[run]).fold(f64::INFINITY, f64::min);
            let length = last.lengths[0].min(last.lengths[1]);
            let load_cycles = [cycles_to(&rows, 0, length)?, cycles_to(&rows, 1, length)?];
            let million_gross_tonnes = self.tonnes_of(load_cycles);
            (growth > 0.0)
                .then_some((growth, SameLength { crack, length, load_cycles, million_gross_tonnes }))
        };
        let all = cracks.into_iter().filter_map(of_crack);
        all.reduce(|most, next| if next.0 > most.0 { next } else { most }).map(|(_, life)| life)
    }

    /// Million gross tonnes of load cycles of each run.
    fn tonnes_of(&self, load_cycles: [f64; 2]) -> Option<[f64; 2]> {
        let of = |run: usize| {
            let label = &self.runs[run];
            let per_cycle =
                label.million_gross_tonnes.filter(|_| label.load_cycles > 0.0)? / label.load_cycles;
            Some(per_cycle * load_cycles[run])
        };
        Some([of(0)?, of(1)?])
    }
}

/// Load cycles of a run to `length`, at a constant rate between two steps.
fn cycles_to(rows: &[&TipComparison], run: usize, length: f64) -> Option<f64> {
    let pair =
        rows.windows(2).find(|pair| pair[0].lengths[run] < length && pair[1].lengths[run] >= length)?;
    let [from, to] = [pair[0], pair[1]];
    let part = (length - from.lengths[run]) / (to.lengths[run] - from.lengths[run]);
    Some(from.load_cycles[run] + part * (to.load_cycles[run] - from.load_cycles[run]))
}
