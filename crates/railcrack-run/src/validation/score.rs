//! Scores of a prediction against a measured value.

use super::computed::Predicted;
use crate::statistics::{crps_of_samples, quantile_of_sorted};
use railcrack_case::Grade;
use railcrack_case::normal::{QUANTILE_97_5, distribution};

/// A prediction against a measured value; logarithms throughout, as both are positive and known by
/// factors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Score {
    /// Geometric mean of the ends of the measured value.
    pub measured: f64,
    /// 2.5 %, 50 % and 97.5 % of the samples.
    pub predicted: [f64; 3],
    /// Standard deviation of the logarithm of the samples.
    pub log_std: f64,
    /// Predicted median over measured value.
    pub factor: f64,
    /// Probability integral transform: the probability, by the samples and the error of
    /// measurement, of a value at or below the measured one.
    pub pit: f64,
    /// Continuous ranked probability score of the logarithm.
    pub crps: f64,
    /// Share of the samples without a value.
    pub without: f64,
}

/// Deviates by which the error of measurement is added to each sample: the quantiles of the middles
/// of nine equal shares of the normal distribution.
const DEVIATES: [f64; 9] =
    [-1.593_219, -0.967_422, -0.589_456, -0.282_216, 0.0, 0.282_216, 0.589_456, 0.967_422, 1.593_219];

impl Score {
    /// Of `predicted` against a value between `low` and `high` with 95 %; none without samples.
    #[must_use]
    pub fn of(predicted: &Predicted, (low, high): (f64, f64)) -> Option<Self> {
        let logs: Vec<f64> = predicted.values.iter().map(|value| value.ln()).collect();
        if logs.is_empty() {
            return None;
        }
        let measured = 0.5 * (low.ln() + high.ln());
        let sigma = (high.ln() - low.ln()) / (2.0 * QUANTILE_97_5);
        let pit =
            logs.iter().map(|log| distribution((measured - log) / sigma)).sum::<f64>() / logs.len() as f64;
        let mut blurred: Vec<f64> = logs.iter().flat_map(|log| DEVIATES.map(|z| log + sigma * z)).collect();
        blurred.sort_by(f64::total_cmp);
        let at = |share: f64| quantile_of_sorted(&logs, share).exp();
        let all = predicted.values.len() + predicted.without;
        Some(Self {
            measured: measured.exp(),
            predicted: [at(0.025), at(0.5), at(0.975)],
            log_std: deviation(&logs),
            factor: (quantile_of_sorted(&logs, 0.5) - measured).exp(),
            pit,
            crps: crps_of_samples(&blurred, measured),
            without: predicted.without as f64 / all as f64,
        })
    }

    /// Whether the measured value is within the 95 % of the prediction, both errors included.
    #[must_use]
    pub fn is_inside(&self) -> bool {
        (0.025..=0.975).contains(&self.pit)
    }

    /// Whether the predicted median is within this factor of the measured value.
    #[must_use]
    pub fn is_within(&self, factor: f64) -> bool {
        self.factor.ln().abs() <= factor.ln()
    }
}

/// Standard deviation of `values`; zero for a single one.
fn deviation(values: &[f64]) -> f64 {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    (squares / (values.len() as f64 - 1.0).max(1.0)).sqrt()
}

/// The scores of the entries of one grade.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GradeScore {
    /// The grade.
    pub grade: Grade,
    /// Number of scored entries.
    pub entries: usize,
    /// How many are within their 95 %.
    pub inside: usize,
    /// How many medians are within a factor of 2.
    pub within_2: usize,
    /// How many medians are within a factor of 5.
    pub within_5: usize,
    /// Mean of the ranked probability scores.
    pub crps: f64,
    /// exp of the mean of ln(predicted median/measured).
    pub factor: f64,
}

/// The scores by grade, of the `scored` entries alone.
#[must_use]
pub fn grade_scores(scored: &[(Grade, Score)]) -> Vec<GradeScore> {
    let of = |grade: Grade| {
        let own: Vec<&Score> = scored.iter().filter(|(of, _)| *of == grade).map(|(_, score)| score).collect();
        let count = |is: &dyn Fn(&Score) -> bool| own.iter().filter(|score| is(score)).count();
        let mean =
            |of: &dyn Fn(&Score) -> f64| own.iter().map(|score| of(score)).sum::<f64>() / own.len() as f64;
        (!own.is_empty()).then(|| GradeScore {
            grade,
            entries: own.len(),
            inside: count(&Score::is_inside),
            within_2: count(&|score| score.is_within(2.0)),
            within_5: count(&|score| score.is_within(5.0)),
            crps: mean(&|score| score.crps),
            factor: mean(&|score| score.factor.ln()).exp(),
        })
    };
    [Grade::Track, Grade::Rig, Grade::Law].into_iter().filter_map(of).collect()
}

/// The prior of ln(C/C0) on a line before it is measured, by the entries of growth in depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Residuals {
    /// Number of entries.
    pub entries: usize,
    /// Mean of ln(measured/predicted median).
    pub mean: f64,
    /// Standard deviation of ln(C/C0) of a place: that of the residuals from entry to entry, and
    /// the mean square of the scatter from place to place of each entry.
    pub log_std: f64,
}

impl Residuals {
    /// Of scores with the standard deviation of ln of the quantity from place to place; none of
    /// fewer than two.
    #[must_use]
    pub fn of(scores: &[(Score, f64)]) -> Option<Self> {
        if scores.len() < 2 {
            return None;
        }
        let residuals: Vec<f64> = scores.iter().map(|(score, _)| -score.factor.ln()).collect();
        let count = scores.len() as f64;
        let places = scores.iter().map(|(_, place)| place * place).sum::<f64>() / count;
        Some(Self {
            entries: scores.len(),
            mean: residuals.iter().sum::<f64>() / count,
            log_std: deviation(&residuals).hypot(places.sqrt()),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn predicted(values: &[f64]) -> Predicted {
        Predicted { values: values.to_vec(), without: 0 }
    }

    #[test]
    fn a_prediction_that_is_right_and_one_that_is_not() {
        let spread: Vec<f64> = (0..200).map(|i| (f64::from(i) / 100.0 - 1.0).exp()).collect();
        let right = Score::of(&predicted(&spread), (0.9, 1.0 / 0.9)).unwrap();
        assert!((right.pit - 0.5).abs() < 0.01 && right.is_inside() && right.is_within(2.0), "{right:?}");
        // Even from −1 to 1: the standard deviation is 1/√3.
        assert!((right.log_std - 3f64.sqrt().recip()).abs() < 0.005, "{right:?}");
        let fast = Score::of(&predicted(&spread), (0.09, 0.1)).unwrap();
        assert!(fast.pit < 1e-6 && !fast.is_inside() && !fast.is_within(5.0), "{fast:?}");
        // The score of a single exact sample is its distance, less the error of measurement's own.
        let exact = Score::of(&predicted(&[2.0]), (0.999_999, 1.000_001)).unwrap();
        assert!((exact.crps - 2f64.ln()).abs() < 1e-5 && (exact.factor - 2.0).abs() < 1e-5, "{exact:?}");
        assert!(Score::of(&predicted(&[]), (1.0, 2.0)).is_none());
    }

    #[test]
    fn the_prior_has_both_scatters() {
        let score = |factor: f64| Score::of(&predicted(&[factor]), (0.999, 1.0 / 0.999)).unwrap();
        let of = Residuals::of(&[(score(2.0), 1.0), (score(4.0), 1.0), (score(8.0), 1.0)]).unwrap();
        // ln of 1/2, 1/4, 1/8: mean −ln 4, sd ln 2.
        assert!((of.mean + 4f64.ln()).abs() < 1e-6, "{of:?}");
        assert!((of.log_std - (1.0 + 2f64.ln().powi(2)).sqrt()).abs() < 1e-6, "{of:?}");
        assert!(Residuals::of(&[(score(2.0), 1.0)]).is_none());
    }

    #[test]
    fn grades_are_not_mixed() {
        let score = |values: &[f64]| Score::of(&predicted(values), (0.9, 1.1)).unwrap();
        let scored =
            [(Grade::Track, score(&[1.0])), (Grade::Track, score(&[4.0])), (Grade::Law, score(&[1.5]))];
        let grades = grade_scores(&scored);
        assert_eq!(grades.len(), 2);
        assert_eq!((grades[0].entries, grades[0].within_2, grades[0].within_5), (2, 1, 2));
        assert!((grades[0].factor - 2.0).abs() < 0.02 && (grades[1].factor - 1.5).abs() < 0.02);
    }
}
