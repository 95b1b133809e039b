//! Calibration of a parameter on which the path depends, by runs with several values of it.

use super::fit::{CalibrationError, from_squares, unknown, usual_error};
use super::observed::{Observations, Observed, UsualError};
use super::posterior::{NORMAL, Posterior, Prior, SiteLikelihood, posterior};

/// A run with one value of the parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial {
    /// The value.
    pub value: f64,
    /// The measurements of each site compared with the run.
    pub sites: Vec<Observations>,
}

/// The coefficient of the growth law while a parameter is fitted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Coefficient {
    /// It stays that of the case.
    OfCase,
    /// It is fitted at every value of the parameter.
    Fitted,
    /// It is the parameter, with this value in the case: its prior counts.
    Searched(f64),
}

/// The value that fits best.
#[derive(Debug, Clone, PartialEq)]
pub struct ParameterFit {
    /// The value.
    pub value: f64,
    /// Measurements that were used.
    pub used: usize,
    /// The value is between these with 95 %; none at a side where no trial is excluded.
    pub interval: (Option<f64>, Option<f64>),
    /// The end of the comparable trials at which the value is, if it is at one.
    pub end: Option<BracketEnd>,
    /// The posterior of ln(C/C0) at the value. Its mean is 0 without a fitted coefficient; of a
    /// searched one it is relative to the value, with the standard deviation of the interval.
    pub posterior: Posterior,
    /// With a fitted coefficient: mean and standard deviation of ln(C/C0) over all comparable values,
    /// each with its posterior, weighted by its evidence (evenly in the logarithm before the
    /// measurements).
    pub weighted: Option<(f64, f64)>,
    /// By how much the deviance of the worst comparable value exceeds that of the best one, by the
    /// measurements alone.
    pub contrast: f64,
    /// Deviance over value, less that of the best one.
    pub profile: Vec<(f64, f64)>,
}

/// An end of a bracket.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BracketEnd {
    /// The lower one.
    Low,
    /// The upper one.
    High,
}

impl ParameterFit {
    /// Whether the measurements exclude no value that was tried.
    #[must_use]
    pub fn is_indistinct(&self) -> bool {
        self.contrast < EXCLUDED
    }

    /// Where the comparable values end before the tried ones, because the runs beyond do not reach
    /// the measured sizes: the last value at `end`, and the next one that was tried.
    fn beyond(&self, end: BracketEnd, tried: &[f64]) -> Option<(f64, f64)> {
        let (first, last) = (self.profile.first()?.0, self.profile.last()?.0);
        let all = tried.iter().copied();
        match end {
            BracketEnd::Low => Some((first, all.filter(|value| *value < first).max_by(f64::total_cmp)?)),
            BracketEnd::High => Some((last, all.filter(|value| *value > last).min_by(f64::total_cmp)?)),
        }
    }
}

/// χ² of 95 % with one degree of freedom: a deviance larger by that much excludes a value.
const EXCLUDED: f64 = 3.841_459;
/// A parameter that changes ln N by less over all trials is without influence: the error of a run.
const FLAT: f64 = 1e-4;
/// Deviance beyond which a value has no weight: less than e^−8 of that of the best one.
const NEGLIGIBLE: f64 = 16.0;
/// Standard deviation of ln C of a prior that says nothing.
const VAGUE: f64 = 30.0;
/// Points between two trials at which the deviance is evaluated, and with classes and a fitted
/// coefficient, which are integrated numerically.
const FINE: usize = 40;
const COARSE: usize = 6;

/// The scale on which values are compared: logarithms unless a value is zero or the signs differ.
#[derive(Debug, Clone, Copy)]
enum Scale {
    Logarithmic { sign: f64 },
    Linear,
}

impl Scale {
    fn of(low: f64, high: f64) -> Self {
        if low * high > 0.0 { Self::Logarithmic { sign: low.signum() } } else { Self::Linear }
    }

    fn to(self, value: f64) -> f64 {
        match self {
            Self::Logarithmic { sign } => sign * value.abs().ln(),
            Self::Linear => value,
        }
    }

    fn back(self, x: f64) -> f64 {
        match self {
            Self::Logarithmic { sign } => sign * (sign * x).exp(),
            Self::Linear => x,
        }
    }
}

/// Fits a parameter, which errors call `key`, to runs with two values of it or more.
///
/// The deviance −2 ln(evidence) is evaluated along the values, with every measurement linear
/// between neighbouring trials over the logarithm of the value. Of the ranges between two trials
/// those with the same and most measurements within the sizes of both runs count. The 95 % interval
/// is where the deviance is within 3.84 of the least. The deviance of a searched coefficient has
/// ((ln(C/C0) − μ)/τ)² of its prior.
///
/// Errors: no measurement is within the sizes of two neighbouring runs; the parameter has no
/// effect.
pub fn fit_parameter(
    key: &str,
    trials: &[Trial],
    prior: Prior,
    coefficient: Coefficient,
) -> Result<ParameterFit, CalibrationError> {
    let mut trials: Vec<&Trial> = trials.iter().collect();
    trials.sort_by(|a, b| a.value.total_cmp(&b.value));
    let nothing = || CalibrationError::NothingToCompare { from: 0.0, to: 0.0 };
    let (Some(first), Some(last)) = (trials.first(), trials.last()) else { return Err(nothing()) };
    let scale = Scale::of(first.value, last.value);
    let masks: Vec<Vec<bool>> = trials.windows(2).map(|pair| mask(pair[0], pair[1])).collect();
    let count = |mask: &[bool]| mask.iter().filter(|both| **both).count();
    let Some(best) = masks.iter().max_by_key(|mask| count(mask)).filter(|mask| count(mask) > 0) else {
        return Err(nothing());
    };
    // What the measurements say of the parameter must not come from the prior of the coefficient.
    let fixed = Prior { mean: 0.0, log_std: 0.0, ..prior };
    let (of_result, vague) = match coefficient {
        Coefficient::OfCase | Coefficient::Searched(_) => (fixed, fixed),
        Coefficient::Fitted => (prior, Prior { log_std: VAGUE, ..prior }),
    };
    let has_classes =
        first.sites.iter().flatten().flatten().any(|observed| matches!(observed, Observed::Class(_)));
    let parts = if has_classes && coefficient == Coefficient::Fitted { COARSE } else { FINE };
    // Points along the values: x, and the measurements there.
    let mut points: Vec<(f64, Vec<Observations>)> = Vec::new();
    let mut is_beyond = [false; 2];
    for (i, pair) in trials.windows(2).enumerate().filter(|(i, _)| masks[*i] == *best) {
        is_beyond[0] |= points.is_empty() && i > 0;
        is_beyond[1] = i + 2 < trials.len();
        let (low, high) = (scale.to(pair[0].value), scale.to(pair[1].value));
        for part in 0..=parts {
            let share = part as f64 / parts as f64;
            points.push((low + share * (high - low), between(pair[0], pair[1], share, best)));
        }
    }
    if spread(&points) < FLAT {
        return Err(CalibrationError::NoInfluence { key: key.to_owned() });
    }
    let usual = error_of_readings(&points, coefficient);
    let likelihoods = |sites: &Vec<Observations>| -> Vec<SiteLikelihood> {
        sites.iter().map(|site| SiteLikelihood::of(site, usual)).collect()
    };
    let measured: Vec<f64> =
        points.iter().map(|(_, sites)| -2.0 * posterior(&likelihoods(sites), vague).log_evidence).collect();
    let before = |x: f64| match coefficient {
        Coefficient::Searched(of_case) => {
            (((scale.back(x) / of_case).ln() - prior.mean) / prior.log_std).powi(2)
        }
        Coefficient::OfCase | Coefficient::Fitted => 0.0,
    };
    let deviances: Vec<f64> =
        points.iter().zip(&measured).map(|((x, _), deviance)| deviance + before(*x)).collect();
    let least = (0..points.len()).fold(0, |least, i| if deviances[i] < deviances[least] { i } else { least });
    let excess: Vec<(f64, f64)> =
        points.iter().zip(&deviances).map(|((x, _), deviance)| (*x, deviance - deviances[least])).collect();
    let end = match least {
        0 => Some(BracketEnd::Low),
        i if i + 1 == points.len() => Some(BracketEnd::High),
        _ => None,
    };
    let crossing = |from: &(f64, f64), to: &(f64, f64)| {
        scale.back(from.0 + (EXCLUDED - from.1) / (to.1 - from.1) * (to.0 - from.0))
    };
    let low = excess[..=least].windows(2).rev().find(|pair| pair[0].1 > EXCLUDED);
    let high = excess[least..].windows(2).find(|pair| pair[1].1 > EXCLUDED);
    let interval =
        (low.map(|pair| crossing(&pair[1], &pair[0])), high.map(|pair| crossing(&pair[0], &pair[1])));
    let sites = likelihoods(&points[least].1);
    let mut found = posterior(&sites, of_result);
    if let (Coefficient::Searched(_), (Some(low), Some(high))) = (coefficient, interval) {
        found = found.known_to((high / low).ln().abs() / (2.0 * NORMAL), &sites, prior);
    }
    // Values of negligible weight are left out: with classes each takes an integration.
    let all = points.iter().zip(&excess).filter(|(_, (_, deviance))| *deviance < NEGLIGIBLE);
    let all: Vec<(f64, Posterior, f64)> = match coefficient {
        Coefficient::Fitted => all
            .map(|((x, sites), (_, deviance))| (*x, posterior(&likelihoods(sites), prior), *deviance))
            .collect(),
        Coefficient::OfCase | Coefficient::Searched(_) => Vec::new(),
    };
    let (smallest, largest) =
        measured.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (x.min(low), x.max(high)));
    Ok(ParameterFit {
        value: scale.back(vertex(&excess, least)),
        used: count(best),
        interval,
        end,
        posterior: found,
        weighted: (!all.is_empty()).then(|| weighted(&all)),
        contrast: largest - smallest,
        profile: excess.iter().map(|(x, deviance)| (scale.back(*x), *deviance)).collect(),
    })
}

/// Where the parabola through the least of `points` and its neighbours is least; the point itself
/// at an end, and where two points are at one place.
fn vertex(points: &[(f64, f64)], least: usize) -> f64 {
    let (x, _) = points[least];
    if least == 0 || least + 1 == points.len() {
        return x;
    }
    let [(a, at_a), (b, at_b)] = [points[least - 1], points[least + 1]];
    let (left, right) = (x - a, b - x);
    if left <= 0.0 || right <= 0.0 {
        return x;
    }
    let (slope_left, slope_right) = (at_a / left, at_b / right);
    let turn = slope_left + slope_right;
    if turn > 0.0 {
        x + (0.5 * (slope_left * right - slope_right * left) / turn).clamp(-left, right)
    } else {
        x
    }
}

/// The posterior of ln(C/C0) with the value of one `trial`.
#[must_use]
pub fn coefficient_at(trial: &Trial, prior: Prior) -> Posterior {
    let usual = usual_error(&trial.sites);
    let sites: Vec<SiteLikelihood> = trial.sites.iter().map(|site| SiteLikelihood::of(site, usual)).collect();
    posterior(&sites, prior)
}

/// Mean and standard deviation of ln(C/C0) over points (x, posterior, deviance), by the trapezoidal
/// rule in x.
fn weighted(points: &[(f64, Posterior, f64)]) -> (f64, f64) {
    let width = |i: usize| {
        let (before, after) = (i.saturating_sub(1), (i + 1).min(points.len() - 1));
        0.5 * (points[after].0 - points[before].0)
    };
    let (mut total, mut first, mut second) = (0.0, 0.0, 0.0);
    for (i, (_, of, deviance)) in points.iter().enumerate() {
        let weight = width(i) * (-0.5 * deviance).exp();
        total += weight;
        first += weight * of.mean;
        second += weight * (of.std.powi(2) + of.mean.powi(2));
    }
    let mean = first / total;
    (mean, (second / total - mean * mean).max(0.0).sqrt())
}

/// Whether each measurement is within the sizes of both runs.
fn mask(low: &Trial, high: &Trial) -> Vec<bool> {
    let flat = |trial: &Trial| trial.sites.iter().flatten().map(Option::is_some).collect::<Vec<bool>>();
    flat(low).into_iter().zip(flat(high)).map(|(a, b)| a && b).collect()
}

/// The measurements of `mask` at `share` of the range from one trial to another.
fn between(low: &Trial, high: &Trial, share: f64, mask: &[bool]) -> Vec<Observations> {
    let linear = |a: f64, b: f64| a + share * (b - a);
    let mut counts = mask.iter();
    let of = |(a, b): (&Option<Observed>, &Option<Observed>)| {
        if !counts.next().copied().unwrap_or(false) {
            return None;
        }
        match (a.as_ref()?, b.as_ref()?) {
            (Observed::Reading { y, per_mm, std }, Observed::Reading { y: to, per_mm: slope, .. }) => {
                Some(Observed::Reading { y: linear(*y, *to), per_mm: linear(*per_mm, *slope), std: *std })
            }
            (Observed::Class(a), Observed::Class(b)) => {
                Some(Observed::Class(a.iter().zip(b).map(|(a, b)| linear(*a, *b)).collect()))
            }
            _ => None,
        }
    };
    let mut of = of;
    low.sites.iter().zip(&high.sites).map(|(a, b)| a.iter().zip(b).map(&mut of).collect()).collect()
}

/// The largest change of ln N or ln P of any measurement over all points.
fn spread(points: &[(f64, Vec<Observations>)]) -> f64 {
    let Some((_, first)) = points.first() else { return 0.0 };
    let change = |a: &Option<Observed>, b: &Option<Observed>| match (a, b) {
        (Some(Observed::Reading { y: a, .. }), Some(Observed::Reading { y: b, .. })) => (a - b).abs(),
        (Some(Observed::Class(a)), Some(Observed::Class(b))) => {
            a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        }
        _ => 0.0,
    };
    let of = |sites: &Vec<Observations>| {
        let pairs = first.iter().flatten().zip(sites.iter().flatten());
        pairs.map(|(a, b)| change(a, b)).fold(0.0, f64::max)
    };
    points.iter().map(|(_, sites)| of(sites)).fold(0.0, f64::max)
}

/// The error of readings without one, by their scatter about the best fit.
fn error_of_readings(points: &[(f64, Vec<Observations>)], coefficient: Coefficient) -> UsualError {
    let of = |sites: &Vec<Observations>| -> (f64, usize) {
        let known: Vec<Vec<f64>> = sites.iter().map(unknown).filter(|site| !site.is_empty()).collect();
        let about_means = known.len() > 1 || coefficient == Coefficient::Fitted;
        let squares = known.iter().map(|site| {
            let mean = if about_means { site.iter().sum::<f64>() / site.len() as f64 } else { 0.0 };
            site.iter().map(|y| (y - mean).powi(2)).sum::<f64>()
        });
        let means = if about_means { known.len() } else { 0 };
        let count: usize = known.iter().map(Vec::len).sum();
        // The parameter itself takes another degree of freedom.
        (squares.sum(), count.saturating_sub(means + 1))
    };
    let best = points.iter().map(|(_, sites)| of(sites)).reduce(|a, b| if b.0 < a.0 { b } else { a });
    match (best, points.first()) {
        (Some((squares, degrees)), _) if degrees > 0 => from_squares(squares, degrees),
        (_, Some((_, sites))) if coefficient == Coefficient::Fitted => match usual_error(sites) {
            UsualError::OfLife(_) => from_squares(0.0, 0),
            size @ UsualError::OfSize(_) => size,
        },
        _ => from_squares(0.0, 0),
    }
}

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
        // The middle of half and twice the value is the value only to rounding: two runs that differ
        // by it would look like two values.
        match values.iter_mut().find(|value| (**value - own).abs() <= 1e-9 * own.abs()) {
            Some(value) => *value = own,
            None if (self.low..=self.high).contains(&own) => values.push(own),
            None => (),
        }
        values
    }

    /// The next step after `fit` of runs with `tried` values.
    pub fn next(&mut self, fit: &ParameterFit, tried: &[f64]) -> Next {
        if let Some(end) = fit.end {
            let scale = Scale::of(self.low, self.high);
            if let Some((last, next)) = fit.beyond(end, tried) {
                let distance = match scale {
                    Scale::Logarithmic { .. } => (next / last).ln().abs(),
                    Scale::Linear => (next - last).abs() / (self.high - self.low),
                };
                let is_open = distance > BRANCH && tried.len() < MOST;
                let between = scale.back(0.5 * (scale.to(last) + scale.to(next)));
                return if is_open { Next::Try(between) } else { Next::AtEnd(end) };
            }
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
                return Next::AtEnd(end);
            }
            self.widenings -= 1;
            match end {
                BracketEnd::Low => self.low = wider,
                BracketEnd::High => self.high = wider,
            }
            return Next::Try(wider);
        }
        let scale = Scale::of(self.low, self.high);
        let width = match scale {
            Scale::Logarithmic { .. } => 1.0,
            Scale::Linear => self.high - self.low,
        };
        let near = |value: &&f64| (scale.to(**value) - scale.to(fit.value)).abs() <= SETTLED * width;
        if tried.iter().any(|value| near(&value)) || tried.len() >= MOST {
            return Next::Settled;
        }
        Next::Try(fit.value)
    }
}

#[cfg(test)]
#[path = "parameter_tests.rs"]
mod tests;
