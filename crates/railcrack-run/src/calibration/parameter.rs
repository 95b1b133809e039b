//! Calibration of a parameter on which the path depends, by runs with several values of it.

use super::coefficient::{CalibrationError, Compared, student};

/// A run with one value of the parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial {
    /// The value.
    pub value: f64,
    /// Each measurement compared with the run; none for one outside its sizes.
    pub compared: Vec<Option<Compared>>,
}

/// The value that fits best.
#[derive(Debug, Clone, PartialEq)]
pub struct ParameterFit {
    /// The value.
    pub value: f64,
    /// Measurements that were used.
    pub used: usize,
    /// Standard deviation of ln N from measurement to measurement; none for a single one.
    pub log_std: Option<f64>,
    /// The value is between these with 95 %, for deviations of ln N that are normal; none for a
    /// single measurement.
    pub interval: Option<(f64, f64)>,
    /// Whether it is at an end of the range of the trials: the best one may be beyond.
    pub is_at_end: bool,
}

/// ln N of a measurement between two trials: deviation at the first one, and its change to the
/// second one.
type Line = (f64, f64);

/// Fits a parameter, which errors call `key`, to runs with two values of it or more: the least
/// squares of ln(computed/measured tonnage), each linear between neighbouring trials. Of the ranges
/// between two trials those with most measurements within the sizes of both runs count.
///
/// Errors: no measurement is within the sizes of two neighbouring runs; the parameter has no
/// effect.
pub fn fit_parameter(key: &str, trials: &[Trial]) -> Result<ParameterFit, CalibrationError> {
    let mut trials: Vec<&Trial> = trials.iter().collect();
    trials.sort_by(|a, b| a.value.total_cmp(&b.value));
    let ranges: Vec<(&Trial, &Trial, Vec<Line>)> =
        trials.windows(2).map(|pair| (pair[0], pair[1], lines(pair[0], pair[1]))).collect();
    let most = ranges.iter().map(|(_, _, lines)| lines.len()).max().unwrap_or(0);
    if most == 0 {
        return Err(CalibrationError::NothingToCompare { from: 0.0, to: 0.0 });
    }
    let best = ranges
        .iter()
        .filter(|(_, _, lines)| lines.len() == most)
        .map(|(low, high, lines)| {
            let (share, squares) = least(lines);
            (low, high, lines, share, squares)
        })
        .reduce(|a, b| if b.4 < a.4 { b } else { a });
    let Some((low, high, lines, share, squares)) = best else {
        return Err(CalibrationError::NothingToCompare { from: 0.0, to: 0.0 });
    };
    let width = high.value - low.value;
    let slopes: f64 = lines.iter().map(|(_, change)| (change / width).powi(2)).sum();
    if slopes.sqrt() * (trials[trials.len() - 1].value - trials[0].value) < FLAT {
        return Err(CalibrationError::NoInfluence { key: key.to_owned() });
    }
    let value = low.value + share * width;
    let log_std = (most > 1).then(|| (squares / (most - 1) as f64).sqrt());
    let reach = log_std.map(|std| student(most - 1) * std / slopes.sqrt());
    let ends = [trials[0].value, trials[trials.len() - 1].value];
    let is_end = |end: &f64| (end - value).abs() <= ROUNDING * (ends[1] - ends[0]);
    Ok(ParameterFit {
        value,
        used: most,
        log_std,
        interval: reach.map(|reach| (value - reach, value + reach)),
        is_at_end: ends.iter().any(is_end),
    })
}

/// A parameter that changes ln N by less over all trials is without influence: the error of a run.
const FLAT: f64 = 1e-4;

/// Values that differ by less over the range of the trials are one.
const ROUNDING: f64 = 1e-12;

/// ln(computed/measured) of every measurement that both trials have.
fn lines(low: &Trial, high: &Trial) -> Vec<Line> {
    let both = low.compared.iter().zip(&high.compared);
    let line = |(a, b): (&Option<Compared>, &Option<Compared>)| {
        let (from, to) = (a.as_ref()?.ratio.ln(), b.as_ref()?.ratio.ln());
        Some((from, to - from))
    };
    both.filter_map(line).collect()
}

/// The minimum of the sum of squares of lines between the first and the second trial: its position
/// and value.
fn least(lines: &[Line]) -> (f64, f64) {
    let (mut product, mut square) = (0.0, 0.0);
    for (from, change) in lines {
        product += from * change;
        square += change * change;
    }
    let share = if square > 0.0 { (-product / square).clamp(0.0, 1.0) } else { 0.0 };
    (share, lines.iter().map(|(from, change)| (from + share * change).powi(2)).sum())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::calibration::Measured;

    /// N at three sizes is in proportion to e^(−3 p), and measured with deviations of ln N.
    fn trial(value: f64, truth: f64, deviations: [f64; 3]) -> Trial {
        let compared = [1.0, 2.0, 3.0].into_iter().zip(deviations).map(|(size, deviation)| {
            let mgt = size * (-3.0 * truth + deviation).exp();
            let computed_mgt = size * (-3.0 * value).exp();
            Some(Compared { measured: Measured { mgt, size }, computed_mgt, ratio: computed_mgt / mgt })
        });
        Trial { value, compared: compared.collect() }
    }

    #[test]
    fn synthetic_data_give_their_parameter_back() {
        let trials = |deviations| [0.1, 0.3, 0.2, 0.4].map(|value| trial(value, 0.27, deviations));
        let exact = fit_parameter("p", &trials([0.0; 3])).unwrap();
        assert!((exact.value - 0.27).abs() < 1e-12 && exact.used == 3 && !exact.is_at_end, "{exact:?}");
        let scattered = fit_parameter("p", &trials([0.1, -0.1, 0.0])).unwrap();
        // Slopes of −3 each: the deviations have no mean, s = 0.1 and SE = s/(3 √3).
        let reach = 4.303 * 0.1 / (3.0 * 3f64.sqrt());
        let (low, high) = scattered.interval.unwrap();
        assert!((scattered.value - 0.27).abs() < 1e-12, "{scattered:?}");
        assert!((scattered.log_std.unwrap() - 0.1).abs() < 1e-12);
        assert!((high - low - 2.0 * reach).abs() < 1e-12 && low < 0.27 && 0.27 < high);
    }

    #[test]
    fn ends_and_parameters_without_influence_are_said() {
        let beyond = [0.1, 0.2].map(|value| trial(value, 0.5, [0.0; 3]));
        let fit = fit_parameter("p", &beyond).unwrap();
        assert!(fit.is_at_end && fit.value == 0.2);
        let mut flat = trial(0.1, 0.2, [0.0; 3]);
        let other = Trial { value: 0.3, ..flat.clone() };
        let error = fit_parameter("p", &[flat.clone(), other.clone()]).unwrap_err().to_string();
        assert!(error.contains("p has no effect"), "{error}");
        flat.compared.iter_mut().for_each(|compared| *compared = None);
        assert!(fit_parameter("p", &[flat, other]).is_err());
    }
}
