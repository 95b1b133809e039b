//! Graded subdivision of an interval.

/// Interior points that divide [a, b] into intervals with equal integrals of `density` (elements
/// per length). The number of intervals is the rounded-up integral over [a, b], so that the
/// elements of this graded mesh have the size 1/density or slightly less.
pub(crate) fn quantiles(a: f64, b: f64, density: impl Fn(f64) -> f64) -> Vec<f64> {
    const CELLS: usize = 400;
    let step = (b - a) / CELLS as f64;
    let mut sums = vec![0.0];
    for i in 0..CELLS {
        sums.push(sums[i] + step * density(a + (i as f64 + 0.5) * step));
    }
    let total = sums[CELLS];
    // Slightly below the ceiling, so that a uniform density gives exactly the number of elements it
    // stands for.
    let count = (total - 1e-6).ceil().max(1.0) as usize;
    (1..count)
        .map(|k| {
            let want = total * k as f64 / count as f64;
            let cell = sums.partition_point(|&sum| sum <= want).clamp(1, CELLS) - 1;
            a + step * (cell as f64 + (want - sums[cell]) / (sums[cell + 1] - sums[cell]))
        })
        .collect()
}
