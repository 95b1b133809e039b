//! Lengths of the cracks against load cycles, at round values of the one or the other.

use super::stored::RunFolder;
use crate::numbers::{fixed, given, grouped, tonnage};
use crate::row::NamedCrack;
use crate::svg::round_step;
use crate::table::{MISSING, Table};
use railcrack_run::csv::TipRow;
use railcrack_run::run_folder::cycles_to;

/// Approximate number of rows in the table of lengths.
const LENGTHS: usize = 8;
/// Maximum number of cracks in the table of lengths.
const LENGTH_CRACKS: usize = 9;

/// Growth as a table with the tonnage: for a single crack, load cycles to round lengths; for
/// several cracks, lengths after round numbers of load cycles; for many, only the `named` ones.
/// None without growth.
pub(super) fn lengths(run: &RunFolder, named: Option<&[NamedCrack]>) -> Option<Table> {
    let is_named = |crack: usize| named.is_none_or(|named| named.iter().any(|named| named.crack == crack));
    let tips: Vec<(usize, usize)> = run
        .tips()
        .into_iter()
        .filter(|&(crack, tip)| tip == 1 && is_named(crack))
        .take(LENGTH_CRACKS)
        .collect();
    let histories: Vec<(usize, Vec<&TipRow>)> =
        tips.iter().map(|&(crack, tip)| (crack, run.history(crack, tip).collect())).collect();
    match &histories[..] {
        [(_, rows)] => cycles_to_lengths(rows, run.case.axle_load),
        _ => lengths_after_cycles(&histories, run.case.axle_load),
    }
}

/// Cycles are interpolated linearly in the length between two steps.
fn cycles_to_lengths(rows: &[&TipRow], load: Option<f64>) -> Option<Table> {
    let milestones = milestones(rows.first()?.length, rows.last()?.length);
    if milestones.is_empty() {
        return None;
    }
    let headings = ["Length (mm)", "Load cycles"].into_iter().chain(load.map(|_| "Million gross tonnes"));
    let mut table = Table::new(headings);
    table.caption = "Load cycles to reach a given length; one cycle is one axle".to_owned();
    for length in milestones {
        let cycles = cycles_to(rows, length);
        let mut cells = vec![fixed(length, 2), cycles.map_or_else(|| MISSING.to_owned(), grouped)];
        cells.extend(
            load.map(|load| cycles.map_or_else(|| MISSING.to_owned(), |cycles| tonnage(cycles * load / 1e6))),
        );
        table.row(cells);
    }
    Some(table)
}

/// Lengths are interpolated linearly in the cycles between two steps; a crack that has joined
/// another one keeps its last length.
fn lengths_after_cycles(cracks: &[(usize, Vec<&TipRow>)], load: Option<f64>) -> Option<Table> {
    let last = cracks.iter().filter_map(|(_, rows)| Some(rows.last()?.load_cycles)).reduce(f64::max)?;
    let milestones = milestones(0.0, last);
    if milestones.is_empty() {
        return None;
    }
    let mut headings = vec!["Load cycles".to_owned()];
    headings.extend(load.map(|_| "Million gross tonnes".to_owned()));
    headings.extend(cracks.iter().map(|(crack, _)| format!("Crack {crack} (mm)")));
    let mut table = Table::new(headings);
    table.caption = match load {
        Some(load) => {
            format!("Crack lengths against load cycles; one cycle is one axle of {} t", given(load))
        }
        None => "Crack lengths against load cycles; one cycle is one axle".to_owned(),
    };
    for cycles in milestones {
        let mut cells = vec![grouped(cycles)];
        cells.extend(load.map(|load| tonnage(cycles * load / 1e6)));
        cells.extend(
            cracks
                .iter()
                .map(|(_, rows)| length_after(rows, cycles).map_or_else(String::new, |l| fixed(l, 2))),
        );
        table.row(cells);
    }
    Some(table)
}

/// The length of a crack after `cycles`; none where it has no rows.
fn length_after(rows: &[&TipRow], cycles: f64) -> Option<f64> {
    let last = rows.last()?;
    let pair = rows.windows(2).find(|pair| (pair[0].load_cycles..=pair[1].load_cycles).contains(&cycles));
    Some(pair.map_or(last.length, |pair| {
        let span = pair[1].load_cycles - pair[0].load_cycles;
        let part = if span > 0.0 { (cycles - pair[0].load_cycles) / span } else { 1.0 };
        pair[0].length + part * (pair[1].length - pair[0].length)
    }))
}

/// Round values between `from` and `to`, and `to` itself; none where they are the same.
fn milestones(from: f64, to: f64) -> Vec<f64> {
    if to <= from {
        return Vec::new();
    }
    let step = round_step(to - from, LENGTHS);
    // A crack of 3 mm up to round-off does not grow through 3 mm.
    let below = |value: f64| (value / step + 1e-9).floor() as i64;
    let round = (below(from) + 1..=below(to)).map(|i| multiple(i, step));
    round.filter(|value| (value - to).abs() > 0.2 * step).chain([to]).collect()
}

/// `i` times a round `step`, as people write it: steps below 1 are whole parts of 1, of which the
/// quotient is the nearest number.
fn multiple(i: i64, step: f64) -> f64 {
    if step < 1.0 { i as f64 / (1.0 / step).round() } else { i as f64 * step }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn milestones_are_round_and_end_at_the_last_length() {
        assert_eq!(milestones(6.0, 15.995), [8.0, 10.0, 12.0, 14.0, 15.995]);
        assert_eq!(milestones(3.0 - 1e-12, 3.25)[0], 3.05);
        assert_eq!(milestones(6.0, 6.0), [0.0; 0]);
    }
}
