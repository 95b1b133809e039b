//! The search for the value of a parameter: a range that widens, and the next value to be tried.

use super::parameter::{BracketEnd, ParameterFit, Scale};

/// The range in which a value is looked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bracket {
    /// Its ends.
    pub low: f64,
    /// Its ends.
    pub high: f64,
    /// The accepted values of the key, both ends.
    pub accepted: (f64, f64),
    /// How often it may be doubled at an end.
    pub widenings: usize,
}

/// The next step of a search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Next {
    /// A run with this value.
    Try(f64),
    /// The fit is settled.
    Settled,
    /// The best value is at this end, and the bracket is not widened.
    AtEnd(BracketEnd),
}

/// Values over the range at first.
const FIRST: usize = 5;
/// Values that are added within the range at most, each where the fit so far is best.
const ADDED: usize = 6;
/// A fit that is as near to a value as this is settled: in the logarithm, or as a share of a range
/// that includes zero.
const SETTLED: f64 = 3e-3;

/// Doublings of the range: 256 times the value, far beyond any that is meant.
const WIDENINGS: usize = 7;
/// Values at most.
const MOST: usize = FIRST + ADDED + WIDENINGS;
/// Distance from the last run that reaches the measured sizes to the next that does not, in the
/// logarithm or as a share of a range that includes zero, at which no run between them is tried.
const BRANCH: f64 = 0.02;

impl Bracket {
    /// From half to twice `value`, which is not zero; doubled where the best value is at an end.
    #[must_use]
    pub fn about(value: f64, accepted: (f64, f64)) -> Self {
        let (low, high) = if value < 0.0 { (2.0 * value, 0.5 * value) } else { (0.5 * value, 2.0 * value) };
        Self { low: low.max(accepted.0), high: high.min(accepted.1), accepted, widenings: WIDENINGS }
    }

    /// The given range, which is not widened.
    #[must_use]
    pub fn given(low: f64, high: f64) -> Self {
        Self { low, high, accepted: (low, high), widenings: 0 }
    }

    /// The first values, evenly spaced in the logarithm where the ends have the same sign, with the
    /// value `own` of the case where it is among them.
    #[must_use]
    pub fn values(&self, own: f64) -> Vec<f64> {
        let scale = Scale::of(self.low, self.high);
        let (low, high) = (scale.to(self.low), scale.to(self.high));
        let inner = (1..FIRST - 1).map(|i| scale.back(low + (high - low) * i as f64 / (FIRST - 1) as f64));
        let mut values: Vec<f64> = std::iter::once(self.low).chain(inner).chain([self.high]).collect();
        // The middle of half and twice the value is the value only to rounding: two runs that
        // differ by it would look like two values.
        match values.iter_mut().find(|value| (**value - own).abs() <= 1e-9 * own.abs()) {
            Some(value) => *value = own,
            None if (self.low..=self.high).contains(&own) => values.push(own),
            None => (),
        }
        values
    }

    /// The next step after `fit` of runs with `tried` values.
    pub fn next(&mut self, fit: &ParameterFit, tried: &[f64]) -> Next {
        let scale = Scale::of(self.low, self.high);
        let width = match scale {
            Scale::Logarithmic { .. } => 1.0,
            Scale::Linear => self.high - self.low,
        };
        let distance = |a: f64, b: f64| (scale.to(a) - scale.to(b)).abs() / width;
        if let Some(end) = fit.end {
            return match beyond(fit, end, tried) {
                Some((last, next)) if distance(last, next) > BRANCH && tried.len() < MOST => {
                    Next::Try(scale.back(0.5 * (scale.to(last) + scale.to(next))))
                }
                Some(_) => Next::AtEnd(end),
                None => self.widened(end, tried).map_or(Next::AtEnd(end), Next::Try),
            };
        }
        if tried.iter().any(|value| distance(*value, fit.value) <= SETTLED) || tried.len() >= MOST {
            return Next::Settled;
        }
        Next::Try(fit.value)
    }

    /// A value beyond an end at which no value is excluded, for an interval with two ends; none
    /// where it has them, and where the bracket is not widened.
    pub fn closing(&mut self, fit: &ParameterFit, tried: &[f64]) -> Option<f64> {
        let open = match fit.interval {
            (None, _) => BracketEnd::Low,
            (_, None) => BracketEnd::High,
            (Some(_), Some(_)) => return None,
        };
        if beyond(fit, open, tried).is_some() { None } else { self.widened(open, tried) }
    }

    /// Doubles the range at `end`; the new end, none where it is not widened further.
    fn widened(&mut self, end: BracketEnd, tried: &[f64]) -> Option<f64> {
        let scale = Scale::of(self.low, self.high);
        let doubled = |value: f64, outwards: f64| match scale {
            Scale::Logarithmic { .. } => scale.back(scale.to(value) + outwards * 2f64.ln()),
            Scale::Linear => value,
        };
        let wider = match end {
            BracketEnd::Low => doubled(self.low, -1.0).max(self.accepted.0),
            BracketEnd::High => doubled(self.high, 1.0).min(self.accepted.1),
        };
        let is_there = |value: &f64| (value - wider).abs() <= 1e-12 * wider.abs();
        if self.widenings == 0 || tried.iter().any(is_there) || wider == 0.0 {
            return None;
        }
        self.widenings -= 1;
        match end {
            BracketEnd::Low => self.low = wider,
            BracketEnd::High => self.high = wider,
        }
        Some(wider)
    }
}

/// Where the comparable values end before the tried ones, because the runs beyond do not reach the
/// measured sizes: the last value at `end`, and the next one that was tried.
fn beyond(fit: &ParameterFit, end: BracketEnd, tried: &[f64]) -> Option<(f64, f64)> {
    let (first, last) = (fit.profile.first()?.0, fit.profile.last()?.0);
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-9 * a.abs().max(b.abs());
    let all = tried.iter().copied();
    match end {
        BracketEnd::Low => {
            let below = all.filter(|value| *value < first && !near(*value, first));
            Some((first, below.max_by(f64::total_cmp)?))
        }
        BracketEnd::High => {
            let above = all.filter(|value| *value > last && !near(*value, last));
            Some((last, above.min_by(f64::total_cmp)?))
        }
    }
}

#[cfg(test)]
#[path = "search_tests.rs"]
mod tests;
