//! The tip that stands for a run, and when it is where.

use super::csv::TipRow;
use std::borrow::Borrow;

/// The rows, by step, of the tip that stands for a run with the rows `growth`: that of the crack that grew most; of equals, the one
/// with the largest ΔK_eq of step 0, then the first. None without rows.
pub(crate) fn leading_tip(growth: &[TipRow]) -> Option<Vec<&TipRow>> {
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

/// Load cycles until a crack of these `rows` is `length` long; none where it never is, or was from the
/// beginning. Between two steps the rate is constant.
pub(crate) fn cycles_to<R: Borrow<TipRow>>(rows: &[R], length: f64) -> Option<f64> {
    let reached = |pair: &&[R]| pair[0].borrow().length < length && pair[1].borrow().length >= length;
    let pair = rows.windows(2).find(reached)?;
    let (from, to) = (pair[0].borrow(), pair[1].borrow());
    let part = (length - from.length) / (to.length - from.length);
    Some(from.load_cycles + part * (to.load_cycles - from.load_cycles))
}
