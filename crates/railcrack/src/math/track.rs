//! Histories of jumps and forces along the path of the wheel.

use super::{Matrix, axpy};

/// Values at coordinates of a load path, with linear interpolation between them.
#[derive(Debug, Clone)]
pub(crate) struct Track {
    /// The coordinates, in the order of travel.
    at: Vec<f64>,
    /// A row for each of them.
    values: Matrix,
}

impl Track {
    /// The rows of `values` at the coordinates `at`, in order.
    pub fn new(at: Vec<f64>, values: Matrix) -> Self {
        Self { at, values }
    }

    /// A thinned selection of `samples`, such that linear interpolation reproduces all others to
    /// within `tolerance`.
    pub fn thinned(samples: &[(f64, Vec<f64>)], tolerance: f64) -> Self {
        let mut keeps = vec![false; samples.len()];
        let mut spans = vec![(0, samples.len() - 1)];
        while let Some((first, last)) = spans.pop() {
            (keeps[first], keeps[last]) = (true, true);
            let farthest = (first + 1..last)
                .map(|i| (off_line(samples, (first, last), i), i))
                .max_by(|a, b| a.0.total_cmp(&b.0));
            if let Some((_, i)) = farthest.filter(|(off, _)| *off > tolerance) {
                spans.extend([(first, i), (i, last)]);
            }
        }
        let kept: Vec<&(f64, Vec<f64>)> =
            samples.iter().zip(&keeps).filter(|(_, k)| **k).map(|(w, _)| w).collect();
        let values = Matrix::from_fn(kept.len(), kept[0].1.len(), |i, c| kept[i].1[c]);
        Self { at: kept.iter().map(|(at, _)| *at).collect(), values }
    }

    /// Every second row of the values.
    pub fn halved(&self) -> Self {
        let kept: Vec<usize> = every_second(self.at.len()).collect();
        let values = Matrix::from_fn(kept.len(), self.values.columns(), |i, c| self.values[(kept[i], c)]);
        Self { at: kept.iter().map(|&i| self.at[i]).collect(), values }
    }

    /// The coordinates.
    pub fn at(&self) -> &[f64] {
        &self.at
    }

    /// The values, a row for each coordinate.
    pub fn values(&self) -> &Matrix {
        &self.values
    }

    /// The rows adjacent to `at` with their interpolation weights.
    fn adjacent_rows(&self, at: f64) -> [(usize, f64); 2] {
        let last = self.at.len() - 1;
        let travel = self.at[last] - self.at[0];
        let after = self.at.partition_point(|x| (x - at) * travel <= 0.0).clamp(1.min(last), last);
        let before = after.saturating_sub(1);
        let step = self.at[after] - self.at[before];
        let share = if step == 0.0 { 1.0 } else { ((at - self.at[before]) / step).clamp(0.0, 1.0) };
        [(before, 1.0 - share), (after, share)]
    }

    /// Adds the values at `at` to `sum`.
    pub fn add(&self, at: f64, sum: &mut [f64]) {
        for (row, share) in self.adjacent_rows(at) {
            if share != 0.0 {
                axpy(share, self.values.row(row), sum);
            }
        }
    }

    /// The values interpolated at other coordinates, a row for each.
    pub fn resampled(&self, at: &[f64]) -> Matrix {
        let mut values = Matrix::zeros(at.len(), self.values.columns());
        for (i, &x) in at.iter().enumerate() {
            self.add(x, values.row_mut(i));
        }
        values
    }
}

/// Every second of `count` indices, and the last one.
pub(crate) fn every_second(count: usize) -> impl Iterator<Item = usize> {
    (0..count).filter(move |&i| i % 2 == 0 || i + 1 == count)
}

/// The largest deviation of sample `i` from the straight line between two others.
fn off_line(samples: &[(f64, Vec<f64>)], (first, last): (usize, usize), i: usize) -> f64 {
    let ((from, before), (to, after)) = (&samples[first], &samples[last]);
    let (at, values) = &samples[i];
    let share = if to == from { 1.0 } else { (at - from) / (to - from) };
    let off = |((value, a), b): ((&f64, &f64), &f64)| (value - (1.0 - share) * a - share * b).abs();
    values.iter().zip(before).zip(after).map(off).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_values_are_kept_and_all_others_lie_near_the_lines_between_them() {
        // A tolerance that equals none of the deviations of the parabola from its chords, (0.05
        // k)².
        const TOLERANCE: f64 = 0.012;
        let kink = |x: f64| if x < 3.7 { vec![0.2 * x, 0.0] } else { vec![0.74, (x - 3.7).powi(2)] };
        let samples: Vec<(f64, Vec<f64>)> =
            (0..=100).map(|i| 0.1 * f64::from(i)).map(|x| (x, kink(x))).collect();
        let track = Track::thinned(&samples, TOLERANCE);
        let all = track.resampled(&samples.iter().map(|(at, _)| *at).collect::<Vec<f64>>());
        for (i, (at, values)) in samples.iter().enumerate() {
            for (c, value) in values.iter().enumerate() {
                assert!((all[(i, c)] - value).abs() <= TOLERANCE, "at {at}");
            }
        }
        assert!(track.at().len() < 40 && track.at().iter().any(|at| (at - 3.7).abs() < 0.01));
        let halved = track.halved();
        assert!(halved.at().len() <= track.at().len() / 2 + 1 && halved.at().ends_with(&[samples[100].0]));
    }

    #[test]
    fn values_are_linear_between_coordinates_in_either_direction() {
        for travel in [1.0, -1.0] {
            let at: Vec<f64> = [0.0, 1.0, 4.0].iter().map(|x| travel * x).collect();
            let track = Track::new(at, Matrix::from_fn(3, 2, |i, c| [1.0, 3.0, 0.0][i] * (1.0 + c as f64)));
            let sample = [-1.0, 0.0, 0.5, 1.0, 2.0, 4.0, 9.0].map(|x| travel * x);
            let values = track.resampled(&sample);
            for (i, want) in [1.0, 1.0, 2.0, 3.0, 2.0, 0.0, 0.0].into_iter().enumerate() {
                assert!((values[(i, 0)] - want).abs() < 1e-15 && (values[(i, 1)] - 2.0 * want).abs() < 1e-15);
            }
        }
    }
}
