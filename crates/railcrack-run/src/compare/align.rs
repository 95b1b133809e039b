//! Two histories at the same wheel positions.

use crate::run_folder::History;

/// K of two runs at common wheel positions, in ascending order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Aligned {
    /// x_c/a.
    pub xc_over_a: Vec<f64>,
    /// `ki[run][position]`, MPa √m.
    pub ki: [Vec<f64>; 2],
    /// `kii[run][position]`, MPa √m.
    pub kii: [Vec<f64>; 2],
    /// The run (0 or 1) that was interpolated at the positions of the other, if any.
    pub interpolated: Option<usize>,
}

/// Positions closer than this, relative to the extent of the passage, are the same: they differ by
/// the round-off of x_c/a.
const SAME_POSITION: f64 = 1e-9;

/// Brings two histories to common positions: their own where they agree; otherwise, within the
/// range of both, the positions of the one that has fewer there, at which the other is interpolated
/// linearly.
pub(super) fn align(histories: [&History; 2]) -> Aligned {
    let rows = histories.map(rows);
    let [first, second] = &rows;
    let extent = |rows: &[[f64; 3]]| rows.last().map_or(0.0, |last| last[0] - rows[0][0]);
    let same = SAME_POSITION * extent(first).max(extent(second)).max(1.0);
    let agree = first.len() == second.len()
        && first.iter().zip(second).all(|(one, other)| (one[0] - other[0]).abs() <= same);
    if agree {
        return aligned(first, second, None);
    }
    let (Some(ends_of_first), Some(ends_of_second)) = (ends(first), ends(second)) else {
        return Aligned::default();
    };
    let low = ends_of_first[0].max(ends_of_second[0]) - same;
    let high = ends_of_first[1].min(ends_of_second[1]) + same;
    let [of_first, of_second] = [first, second]
        .map(|rows| rows.iter().filter(|row| (low..=high).contains(&row[0])).copied().collect::<Vec<_>>());
    // The one with fewer positions is the coarser; with none in this range it has nothing to offer.
    let takes_first = of_second.is_empty() || (!of_first.is_empty() && of_first.len() <= of_second.len());
    if takes_first {
        aligned(&of_first, &interpolated(second, &of_first), Some(1))
    } else {
        aligned(&interpolated(first, &of_second), &of_second, Some(0))
    }
}

/// x_c/a, K_I, K_II of each position, in ascending order: a wheel that runs towards −x passes them
/// in reverse order.
fn rows(history: &History) -> Vec<[f64; 3]> {
    let mut rows: Vec<[f64; 3]> = (history.xc_over_a.iter())
        .zip(&history.ki)
        .zip(&history.kii)
        .map(|((&x, &ki), &kii)| [x, ki, kii])
        .collect();
    rows.sort_by(|one, other| one[0].total_cmp(&other[0]));
    rows
}

fn ends(rows: &[[f64; 3]]) -> Option<[f64; 2]> {
    Some([rows.first()?[0], rows.last()?[0]])
}

/// `rows` at the positions of `at`, which are within its range up to round-off.
fn interpolated(rows: &[[f64; 3]], at: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let value = |x: f64| {
        let after = rows.partition_point(|row| row[0] < x).clamp(1, rows.len().max(2) - 1);
        let (Some(left), Some(right)) = (rows.get(after - 1), rows.get(after)) else {
            return rows.first().map_or([x, 0.0, 0.0], |only| [x, only[1], only[2]]);
        };
        let span = right[0] - left[0];
        let part = if span > 0.0 { ((x - left[0]) / span).clamp(0.0, 1.0) } else { 0.0 };
        [x, left[1] + part * (right[1] - left[1]), left[2] + part * (right[2] - left[2])]
    };
    at.iter().map(|row| value(row[0])).collect()
}

fn aligned(first: &[[f64; 3]], second: &[[f64; 3]], interpolated: Option<usize>) -> Aligned {
    let column = |rows: &[[f64; 3]], c: usize| rows.iter().map(|row| row[c]).collect::<Vec<f64>>();
    Aligned {
        xc_over_a: column(first, 0),
        ki: [column(first, 1), column(second, 1)],
        kii: [column(first, 2), column(second, 2)],
        interpolated,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn history(xc_over_a: &[f64]) -> History {
        let line = |slope: f64| xc_over_a.iter().map(|x| slope * x).collect();
        History { xc_over_a: xc_over_a.to_vec(), ki: line(2.0), kii: line(-3.0), ..History::default() }
    }

    #[test]
    fn equal_positions_are_kept_whatever_the_travel() {
        let forwards = history(&[-1.0, 0.0, 0.5]);
        let backwards = history(&[0.5, 1e-12, -1.0]);
        let aligned = align([&forwards, &backwards]);
        assert_eq!((aligned.interpolated, aligned.xc_over_a), (None, vec![-1.0, 0.0, 0.5]));
        assert_eq!(aligned.ki[0], [-2.0, 0.0, 1.0]);
        assert_eq!(aligned.ki[1], [-2.0, 2e-12, 1.0]);
    }

    #[test]
    fn the_finer_history_is_interpolated_within_the_range_of_both() {
        let fine = history(&[-2.0, -1.5, -0.9, -0.1, 0.3, 1.0, 1.2]);
        let coarse = history(&[-3.0, -1.0, 0.0, 1.0, 2.0]);
        for (pair, run) in [([&fine, &coarse], 0), ([&coarse, &fine], 1)] {
            let aligned = align(pair);
            assert_eq!((aligned.interpolated, &aligned.xc_over_a[..]), (Some(run), &[-1.0, 0.0, 1.0][..]));
            for (k, want) in [(&aligned.ki[run], 2.0), (&aligned.kii[run], -3.0)] {
                // Linear histories are interpolated to round-off.
                for (k, x) in k.iter().zip([-1.0, 0.0, 1.0]) {
                    assert!((k - want * x).abs() < 1e-14, "{k} at {x}");
                }
            }
        }
    }

    #[test]
    fn apart_or_empty_histories_have_no_common_position() {
        let left = history(&[-2.0, -1.0]);
        let right = history(&[1.0, 2.0]);
        assert!(align([&left, &right]).xc_over_a.is_empty());
        assert!(align([&left, &history(&[])]).xc_over_a.is_empty());
        assert_eq!(align([&history(&[0.5]), &history(&[0.0, 1.0])]).ki[1], [1.0]);
        assert_eq!(align([&history(&[0.0, 1.0]), &history(&[0.5])]).kii[0], [-1.5]);
    }
}
