//! Interpolation along lines of Gauss points of a grid.

/// The two Gauss points of each cell between neighbouring `lines`, increasing.
pub(crate) fn gauss_lines(lines: &[f64]) -> Vec<f64> {
    let at = 1.0 / 3f64.sqrt();
    let pair = |cell: &[f64]| {
        let (middle, half) = (0.5 * (cell[0] + cell[1]), 0.5 * (cell[1] - cell[0]));
        [middle - at * half, middle + at * half]
    };
    lines.windows(2).flat_map(pair).collect()
}

/// Weights of the Lagrange polynomial through the four points of `at` nearest to `x` (all, if there
/// are fewer), and the index of the first.
pub(super) fn lagrange(at: &[f64], x: f64) -> (usize, Vec<f64>) {
    let count = at.len().min(4);
    let above = at.partition_point(|&point| point <= x);
    let first = above.saturating_sub(count / 2).min(at.len() - count);
    let points = &at[first..first + count];
    let weight = |j: usize| {
        let others = points.iter().enumerate().filter(|(k, _)| *k != j);
        others.map(|(_, point)| (x - point) / (points[j] - point)).product()
    };
    (first, (0..count).map(weight).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cubics_are_reproduced_inside_and_beyond_the_ends() {
        let at = gauss_lines(&[0.0, 1.0, 1.5, 4.0]);
        let cubic = |x: f64| 1.0 - x + 0.5 * x * x - 0.2 * x * x * x;
        for x in [0.0, 0.1, 0.9, 1.0, 1.7, 3.9, 4.0] {
            let (first, weights) = lagrange(&at, x);
            let got: f64 = weights.iter().enumerate().map(|(k, w)| w * cubic(at[first + k])).sum();
            assert!((got - cubic(x)).abs() < 1e-12, "at {x}"); // round-off of weights of order 10
        }
        assert_eq!(lagrange(&gauss_lines(&[0.0, 1.0]), 0.5).1.len(), 2);
    }
}
