//! Sensitivity of a result: rank correlation and first-order Sobol indices of the keys of a study,
//! from its runs alone.

/// A number with the interval in which it lies with 95 % probability.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Estimate {
    pub value: f64,
    pub low: f64,
    pub high: f64,
}

/// Parts into which the values of a key are divided, at most; a list with as many values has a part
/// for each.
const PARTS: usize = 24;
/// Fewest runs in a part.
const LEAST: usize = 8;
/// Fewest runs for an estimate.
const FEWEST: usize = 20;
/// Samples of the runs for the interval of an index.
const RESAMPLED: usize = 100;

/// Spearman's rank correlation of `x` and `y`, equal values sharing their mean rank; the interval
/// by Fisher's transform with the variance of Bonett and Wright (2000). None of few runs, or where
/// one of both does not vary.
pub(crate) fn rank_correlation(x: &[f64], y: &[f64]) -> Option<Estimate> {
    if x.len() < FEWEST || x.len() != y.len() {
        return None;
    }
    let (a, b) = (ranks(x), ranks(y));
    let mean = 0.5 * (x.len() as f64 - 1.0);
    let product = |one: &[f64], other: &[f64]| -> f64 {
        one.iter().zip(other).map(|(one, other)| (one - mean) * (other - mean)).sum()
    };
    let size = (product(&a, &a) * product(&b, &b)).sqrt();
    if size <= 0.0 {
        return None;
    }
    let value = (product(&a, &b) / size).clamp(-1.0, 1.0);
    let deviation = ((1.0 + 0.5 * value * value) / (x.len() as f64 - 3.0)).sqrt();
    let centre = value.clamp(-0.999_999, 0.999_999).atanh();
    let [low, high] = [-1.96, 1.96].map(|by| (centre + by * deviation).tanh());
    Some(Estimate { value, low: low.min(value), high: high.max(value) })
}

/// The first-order Sobol index of `x`: the share of the variance of `y` that the mean of `y` at
/// given `x` has. The runs are divided into parts of like `x`; what chance alone would give between
/// parts is taken off (the adjusted correlation ratio, Kelley 1935). The interval: quantiles over
/// samples of the runs (Efron 1979).
pub(crate) fn first_order(x: &[f64], y: &[f64]) -> Option<Estimate> {
    if x.len() < FEWEST || x.len() != y.len() {
        return None;
    }
    let part = parts(x);
    let all: Vec<usize> = (0..x.len()).collect();
    let value = ratio(&part, y, &all)?;
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let mut others: Vec<f64> = (0..RESAMPLED)
        .filter_map(|_| {
            let sample: Vec<usize> = (0..x.len()).map(|_| random.below(x.len())).collect();
            ratio(&part, y, &sample)
        })
        .collect();
    others.sort_by(f64::total_cmp);
    let at = |share: f64| others.get(((others.len() as f64 - 1.0) * share).round() as usize).copied();
    // A sample with repetition has a ratio of its own: only its spread counts.
    let middle = at(0.5)?;
    let shifted = |share: f64| (at(share).unwrap_or(middle) - middle + value).clamp(0.0, 1.0);
    Some(Estimate { value, low: shifted(0.025).min(value), high: shifted(0.975).max(value) })
}

/// The adjusted correlation ratio of `y` over the parts, of the runs `sample`.
fn ratio(part: &[usize], y: &[f64], sample: &[usize]) -> Option<f64> {
    let count = part.iter().max()? + 1;
    let mean = sample.iter().map(|&i| y[i]).sum::<f64>() / sample.len() as f64;
    let (mut sums, mut counts, mut total) = (vec![0.0; count], vec![0usize; count], 0.0);
    for &i in sample {
        sums[part[i]] += y[i] - mean;
        counts[part[i]] += 1;
        total += (y[i] - mean).powi(2);
    }
    let used = counts.iter().filter(|count| **count > 0).count();
    let rest = sample.len().checked_sub(used).filter(|rest| *rest > 0)?;
    if total <= 0.0 {
        return None;
    }
    let between: f64 =
        sums.iter().zip(&counts).filter(|(_, n)| **n > 0).map(|(sum, &n)| sum * sum / n as f64).sum();
    let within = (total - between) / rest as f64;
    Some(((between - (used as f64 - 1.0) * within) / total).clamp(0.0, 1.0))
}

/// The part of each value: one for each value of a few, else of equal numbers of runs.
fn parts(x: &[f64]) -> Vec<usize> {
    let mut values = x.to_vec();
    values.sort_by(f64::total_cmp);
    values.dedup();
    if values.len() <= PARTS {
        return x.iter().map(|x| values.partition_point(|value| value < x)).collect();
    }
    let count = (x.len() / LEAST).clamp(2, PARTS);
    let mut order: Vec<usize> = (0..x.len()).collect();
    order.sort_by(|&one, &other| x[one].total_cmp(&x[other]));
    let mut parts = vec![0; x.len()];
    for (rank, &run) in order.iter().enumerate() {
        parts[run] = rank * count / x.len();
    }
    parts
}

/// Ranks from 0; equal values have the mean of theirs.
fn ranks(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&one, &other| values[one].total_cmp(&values[other]));
    let mut ranks = vec![0.0; values.len()];
    let mut first = 0;
    while first < order.len() {
        let same = |&&run: &&usize| values[run] == values[order[first]];
        let count = order[first..].iter().take_while(same).count();
        for &run in &order[first..first + count] {
            ranks[run] = first as f64 + 0.5 * (count as f64 - 1.0);
        }
        first += count;
    }
    ranks
}

/// A sequence without order (Marsaglia 2003): the same page has the same bytes.
struct Random(u64);

impl Random {
    fn below(&mut self, count: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        ((self.0 >> 11) as f64 / (1u64 << 53) as f64 * count as f64) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// Points of the unit cube, evenly (Weyl's sequence by square roots of primes).
    fn points(count: usize) -> Vec<[f64; 3]> {
        let steps = [2f64, 3.0, 5.0].map(f64::sqrt);
        (1..=count).map(|i| steps.map(|step| (step * i as f64).fract())).collect()
    }

    #[test]
    fn indices_are_those_of_ishigami() {
        // y = sin x1 + 7 sin² x2 + 0.1 x3⁴ sin x1 on [−π, π]³ (Ishigami and Homma 1990):
        // S1 = 0.3139, S2 = 0.4424, S3 = 0.
        let points = points(8192);
        let x = |i: usize| -> Vec<f64> { points.iter().map(|point| (2.0 * point[i] - 1.0) * PI).collect() };
        let (a, b, c) = (x(0), x(1), x(2));
        let y: Vec<f64> = (0..a.len())
            .map(|i| a[i].sin() + 7.0 * b[i].sin().powi(2) + 0.1 * c[i].powi(4) * a[i].sin())
            .collect();
        for (x, want) in [(&a, 0.3139), (&b, 0.4424), (&c, 0.0)] {
            let index = first_order(x, &y).unwrap();
            // Parts of 1/24 of the range flatten the mean by about 1 %.
            assert!((index.value - want).abs() < 0.012, "{index:?} for {want}");
            assert!(index.low <= want + 0.012 && index.high >= want - 0.012, "{index:?} for {want}");
        }
    }

    #[test]
    fn the_correlation_of_ranks_is_that_of_their_order() {
        let x: Vec<f64> = (0..50).map(f64::from).collect();
        let grows: Vec<f64> = x.iter().map(|x| x.exp()).collect();
        assert_eq!(rank_correlation(&x, &grows).unwrap().value, 1.0);
        let falls: Vec<f64> = x.iter().map(|x| -x.powi(3)).collect();
        assert_eq!(rank_correlation(&x, &falls).unwrap().value, -1.0);
        assert!(rank_correlation(&x, &[1.0; 50]).is_none() && rank_correlation(&x[..5], &x[..5]).is_none());
        assert_eq!(ranks(&[3.0, 1.0, 3.0, 2.0]), [2.5, 0.0, 2.5, 1.0]);
        let noise: Vec<f64> = points(400).iter().map(|point| point[0]).collect();
        let other: Vec<f64> = points(400).iter().map(|point| point[2]).collect();
        let none = rank_correlation(&noise, &other).unwrap();
        assert!(none.low < 0.0 && none.high > 0.0, "{none:?}");
    }

    #[test]
    fn what_does_not_matter_has_no_share() {
        let points = points(500);
        let x: Vec<f64> = points.iter().map(|point| point[0]).collect();
        let y: Vec<f64> = points.iter().map(|point| point[1]).collect();
        assert!(first_order(&x, &y).unwrap().value < 0.03);
        assert!(first_order(&x, &x).unwrap().value > 0.97);
    }
}
