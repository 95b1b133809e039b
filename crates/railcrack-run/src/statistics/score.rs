//! Scores of a predicted distribution against what was observed.

use railcrack_case::normal::{density, distribution};
use std::f64::consts::PI;

/// The continuous ranked probability score ∫ (F(x) − 1[x ≥ `observed`])² dx of a normal
/// distribution:
///
/// > σ (z (2 Φ(z) − 1) + 2 φ(z) − 1/√π),  z = (observed − mean)/σ
///
/// Source: Gneiting & Raftery 2007, J. Am. Stat. Assoc. 102, 359–378, eq. 21.
#[must_use]
pub fn crps_of_normal(mean: f64, std: f64, observed: f64) -> f64 {
    let z = (observed - mean) / std;
    std * (z * (2.0 * distribution(z) - 1.0) + 2.0 * density(z) - PI.sqrt().recip())
}

/// The same score of the distribution of `sorted` samples, ascending, all equally probable:
/// mean |x − observed| less half of the mean |x − x′|. NaN without samples.
#[must_use]
pub fn crps_of_samples(sorted: &[f64], observed: f64) -> f64 {
    let count = sorted.len() as f64;
    let distance = sorted.iter().map(|x| (x - observed).abs()).sum::<f64>() / count;
    // Σ_ij |x_i − x_j| = 2 Σ_i (2 i + 1 − n) x_i of ascending samples.
    let weighted = |(i, x): (usize, &f64)| (2.0 * i as f64 + 1.0 - count) * x;
    distance - sorted.iter().enumerate().map(weighted).sum::<f64>() / (count * count)
}

/// The quantile of `share` of `sorted` samples, ascending: linear between them, the first and the
/// last one at the ends. NaN without samples.
#[must_use]
pub fn quantile_of_sorted(sorted: &[f64], share: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else { return f64::NAN };
    let at = share.clamp(0.0, 1.0) * last as f64;
    let below = at.floor() as usize;
    let above = (below + 1).min(last);
    sorted[below] + (at - below as f64) * (sorted[above] - sorted[below])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn score_of_a_normal_distribution() {
        // By the formula: (√2 − 1)/√π at the mean.
        assert!((crps_of_normal(0.0, 1.0, 0.0) - 0.233_695).abs() < 5e-7);
        assert!((crps_of_normal(0.0, 1.0, 1.0) - 0.602_441).abs() < 5e-7);
        assert!((crps_of_normal(5.0, 2.0, 7.0) - 2.0 * 0.602_441).abs() < 1e-6);
    }

    #[test]
    fn score_of_samples() {
        // ∫ (F − H)² of two steps of a half at 0 and 2, observed 1: ¼ over a length of two.
        assert!((crps_of_samples(&[0.0, 2.0], 1.0) - 0.5).abs() < 1e-15);
        assert!((crps_of_samples(&[3.0], 1.0) - 2.0).abs() < 1e-15);
        // Many quantiles of the normal distribution tend to its score.
        let count = 2000;
        let at = |share: f64| {
            let (mut low, mut high) = (-9.0, 9.0);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if distribution(middle) < share { low = middle } else { high = middle }
            }
            low
        };
        let samples: Vec<f64> = (0..count).map(|i| at((i as f64 + 0.5) / f64::from(count))).collect();
        assert!((crps_of_samples(&samples, 1.0) - crps_of_normal(0.0, 1.0, 1.0)).abs() < 1e-3);
    }

    #[test]
    fn quantiles() {
        assert_eq!([0.0, 0.5, 1.0].map(|share| quantile_of_sorted(&[1.0, 2.0, 4.0], share)), [1.0, 2.0, 4.0]);
        assert_eq!([0.25, 0.875].map(|share| quantile_of_sorted(&[1.0, 2.0, 4.0], share)), [1.5, 3.5]);
        assert!(quantile_of_sorted(&[], 0.5).is_nan());
    }
}
