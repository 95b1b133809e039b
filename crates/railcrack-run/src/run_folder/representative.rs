//! The representative tip of a run, and when its crack has a given length.

use super::history::History;
use super::read::RunFolder;
use crate::csv::{SifRow, TipRow};
use crate::error::OutputError;
use std::borrow::Borrow;

/// The representative tip of a run.
#[derive(Debug, Clone)]
pub struct RepresentativeTip {
    /// Its row of step 0.
    pub first: TipRow,
    /// Its rows, by step.
    pub rows: Vec<TipRow>,
    /// K of step 0.
    pub history: History,
}

impl RepresentativeTip {
    /// The representative tip of the run in `folder`; none without a finished step.
    ///
    /// Errors: a table is damaged; the system refuses.
    pub(crate) fn of(folder: &RunFolder) -> Result<Option<Self>, OutputError> {
        let growth = folder.growth()?;
        let Some(rows) = representative_tip(&growth) else { return Ok(None) };
        let rows: Vec<TipRow> = rows.into_iter().copied().collect();
        let first = rows[0];
        let own = |history: &History| (history.crack, history.tip) == (first.crack, first.tip);
        let histories = if folder.has::<SifRow>() { folder.histories(1)? } else { Vec::new() };
        let history = histories.into_iter().find(own).unwrap_or_default();
        Ok(Some(Self { first, rows, history }))
    }

    /// Its row in the last step.
    pub fn last(&self) -> &TipRow {
        self.rows.last().unwrap_or(&self.first)
    }
}

/// The rows, by step, of the representative tip of a run with the rows `growth`: that of the crack
/// that grew most; of equals, the one with the largest ΔK_eq in step 0, then the first. None
/// without rows.
pub fn representative_tip(growth: &[TipRow]) -> Option<Vec<&TipRow>> {
    let mut tips: Vec<Vec<&TipRow>> = Vec::new();
    for row in growth {
        let same = |rows: &&mut Vec<&TipRow>| {
            rows.first().is_some_and(|first| (first.crack, first.tip) == (row.crack, row.tip))
        };
        match tips.iter_mut().find(same) {
            Some(rows) => rows.push(row),
            None => tips.push(vec![row]),
        }
    }
    let grown = |rows: &[&TipRow]| rows.last().map_or(0.0, |last| last.length) - rows[0].length;
    let leads = |one: &Vec<&TipRow>, other: &Vec<&TipRow>| {
        grown(one).total_cmp(&grown(other)).then(one[0].delta_keq.total_cmp(&other[0].delta_keq))
    };
    // Of equals the first: the last one of a maximum from behind.
    tips.into_iter().rev().max_by(leads)
}

/// Relative round-off of a length: runs with the same increments end at lengths that differ in
/// their last digits, and all of them have reached the shortest of these.
const ROUND_OFF: f64 = 1e-12;

/// Load cycles until a crack of these `rows` is `length` long, up to round-off; none where it never
/// is, or was from the beginning. Between two steps the rate is constant.
pub fn cycles_to<R: Borrow<TipRow>>(rows: &[R], length: f64) -> Option<f64> {
    let enough = length * (1.0 - ROUND_OFF);
    let reached = |pair: &&[R]| pair[0].borrow().length < enough && pair[1].borrow().length >= enough;
    let pair = rows.windows(2).find(reached)?;
    let (from, to) = (pair[0].borrow(), pair[1].borrow());
    let part = ((length - from.length) / (to.length - from.length)).min(1.0);
    Some(from.load_cycles + part * (to.load_cycles - from.load_cycles))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(step: usize, crack: usize, length: f64, delta_keq: f64) -> TipRow {
        TipRow { crack, length, delta_keq, load_cycles: 100.0 * step as f64, ..TipRow::idle(step) }
    }

    #[test]
    fn the_crack_that_grew_most_represents_the_run() {
        let growth = [row(0, 1, 6.0, 9.0), row(0, 2, 3.0, 1.0), row(1, 1, 6.1, 9.0), row(1, 2, 3.2, 1.0)];
        let representative = representative_tip(&growth).unwrap();
        assert_eq!(
            representative.iter().map(|row| (row.step, row.crack)).collect::<Vec<_>>(),
            [(0, 2), (1, 2)]
        );
        // Without growth the one that is loaded most, then the first.
        assert_eq!(representative_tip(&growth[..2]).unwrap()[0].crack, 1);
        assert_eq!(representative_tip(&[row(0, 1, 6.0, 1.0), row(0, 2, 3.0, 1.0)]).unwrap()[0].crack, 1);
        assert!(representative_tip(&[]).is_none());
    }

    #[test]
    fn cycles_are_linear_in_the_length_between_steps() {
        let rows = [row(0, 1, 6.0, 1.0), row(1, 1, 6.4, 1.0), row(2, 1, 7.2, 1.0)];
        for (length, cycles) in [(6.8, 150.0), (7.2, 200.0)] {
            let found = cycles_to(&rows, length).unwrap();
            assert!((found - cycles).abs() < 1e-9, "{length} mm: {found}");
        }
        assert_eq!([cycles_to(&rows, 6.0), cycles_to(&rows, 7.3)], [None, None]);
        // A run that ends a last digit short of another one has reached its length.
        assert_eq!(cycles_to(&rows, 7.2_f64.next_up()), Some(200.0));
    }
}
