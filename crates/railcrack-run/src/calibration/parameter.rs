//! Calibration of a parameter on which the path depends, by runs with several values of it.

use super::fit::{CalibrationError, from_squares, unknown, usual_error};
use super::observed::{Observations, Observed, UsualError};
use super::posterior::{Posterior, Prior, SiteLikelihood, posterior};
use railcrack_case::normal::QUANTILE_97_5;

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
    /// With a fitted coefficient: mean and standard deviation of ln(C/C0) over all comparable
    /// values, each with its posterior, weighted by its evidence (evenly in the logarithm before
    /// the measurements).
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

impl BracketEnd {
    /// The end at which the point `place` of `count` is.
    fn at(place: usize, count: usize) -> Option<Self> {
        match place {
            0 => Some(Self::Low),
            _ if place + 1 == count => Some(Self::High),
            _ => None,
        }
    }
}

impl ParameterFit {
    /// Whether the measurements exclude no value that was tried.
    #[must_use]
    pub fn is_indistinct(&self) -> bool {
        self.contrast < EXCLUDED
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
pub(super) enum Scale {
    Logarithmic { sign: f64 },
    Linear,
}

impl Scale {
    pub fn of(low: f64, high: f64) -> Self {
        if low * high > 0.0 { Self::Logarithmic { sign: low.signum() } } else { Self::Linear }
    }

    pub fn to(self, value: f64) -> f64 {
        match self {
            Self::Logarithmic { sign } => sign * value.abs().ln(),
            Self::Linear => value,
        }
    }

    pub fn back(self, x: f64) -> f64 {
        match self {
            Self::Logarithmic { sign } => sign * (sign * x).exp(),
            Self::Linear => x,
        }
    }
}

/// The measurements along the values of the parameter.
struct Along {
    scale: Scale,
    /// Place on the scale, and the measurements there.
    points: Vec<(f64, Vec<Observations>)>,
    /// Measurements that count.
    used: usize,
}

impl Along {
    /// Between two neighbouring trials every measurement is linear over the logarithm of the value.
    /// Of these ranges, those with the same and most measurements within the sizes of both runs
    /// count; `None` without any.
    fn of(trials: &[Trial], coefficient: Coefficient) -> Option<Self> {
        let mut trials: Vec<&Trial> = trials.iter().collect();
        trials.sort_by(|a, b| a.value.total_cmp(&b.value));
        let (first, last) = (trials.first()?, trials.last()?);
        let scale = Scale::of(first.value, last.value);
        let masks: Vec<Vec<bool>> = trials.windows(2).map(|pair| mask(pair[0], pair[1])).collect();
        let count = |mask: &[bool]| mask.iter().filter(|both| **both).count();
        let best = masks.iter().max_by_key(|mask| count(mask)).filter(|mask| count(mask) > 0)?;
        let has_classes =
            first.sites.iter().flatten().flatten().any(|observed| matches!(observed, Observed::Class(_)));
        let parts = if has_classes && coefficient == Coefficient::Fitted { COARSE } else { FINE };
        let mut points = Vec::new();
        for (pair, _) in trials.windows(2).zip(&masks).filter(|(_, mask)| *mask == best) {
            let (low, high) = (scale.to(pair[0].value), scale.to(pair[1].value));
            for part in 0..=parts {
                let share = part as f64 / parts as f64;
                points.push((low + share * (high - low), between(pair[0], pair[1], share, best)));
            }
        }
        Some(Self { scale, points, used: count(best) })
    }

    /// The deviance at each point, with `prior` for the coefficient.
    fn deviances(&self, usual: UsualError, prior: Prior) -> Vec<f64> {
        let deviance =
            |sites: &[Observations]| -2.0 * posterior(&likelihoods(sites, usual), prior).log_evidence;
        self.points.iter().map(|(_, sites)| deviance(sites)).collect()
    }

    /// The 95 % interval around the point `least`, by the deviances less the least one.
    fn interval(&self, excess: &[(f64, f64)], least: usize) -> (Option<f64>, Option<f64>) {
        let crossing = |from: &(f64, f64), to: &(f64, f64)| {
            self.scale.back(from.0 + (EXCLUDED - from.1) / (to.1 - from.1) * (to.0 - from.0))
        };
        let low = excess[..=least].windows(2).rev().find(|pair| pair[0].1 > EXCLUDED);
        let high = excess[least..].windows(2).find(|pair| pair[1].1 > EXCLUDED);
        (low.map(|pair| crossing(&pair[1], &pair[0])), high.map(|pair| crossing(&pair[0], &pair[1])))
    }

    /// Mean and standard deviation of a fitted ln(C/C0) over all values.
    fn over_all(&self, excess: &[(f64, f64)], usual: UsualError, prior: Prior) -> (f64, f64) {
        // Values of negligible weight are left out: with classes each takes an integration.
        let of = |((x, sites), (_, deviance)): (&(f64, Vec<Observations>), &(f64, f64))| {
            (*deviance < NEGLIGIBLE).then(|| (*x, posterior(&likelihoods(sites, usual), prior), *deviance))
        };
        weighted(&self.points.iter().zip(excess).filter_map(of).collect::<Vec<_>>())
    }
}

fn likelihoods(sites: &[Observations], usual: UsualError) -> Vec<SiteLikelihood> {
    sites.iter().map(|site| SiteLikelihood::of(site, usual)).collect()
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
    let along =
        Along::of(trials, coefficient).ok_or(CalibrationError::NothingToCompare { from: 0.0, to: 0.0 })?;
    let Along { scale, points, used } = &along;
    if spread(points) < FLAT {
        return Err(CalibrationError::NoInfluence { key: key.to_owned() });
    }
    // What the measurements say of the parameter must not come from the prior of the coefficient.
    let fixed = Prior { mean: 0.0, log_std: 0.0, ..prior };
    let (of_result, vague) = match coefficient {
        Coefficient::OfCase | Coefficient::Searched(_) => (fixed, fixed),
        Coefficient::Fitted => (prior, Prior { log_std: VAGUE, ..prior }),
    };
    let usual = error_of_readings(points, coefficient);
    let measured = along.deviances(usual, vague);
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
    let interval = along.interval(&excess, least);
    let sites = likelihoods(&points[least].1, usual);
    let mut found = posterior(&sites, of_result);
    if let (Coefficient::Searched(_), (Some(low), Some(high))) = (coefficient, interval) {
        found = found.known_to((high / low).ln().abs() / (2.0 * QUANTILE_97_5), &sites, prior);
    }
    let (smallest, largest) =
        measured.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (x.min(low), x.max(high)));
    Ok(ParameterFit {
        value: scale.back(vertex(&excess, least)),
        used: *used,
        interval,
        end: BracketEnd::at(least, points.len()),
        posterior: found,
        weighted: (coefficient == Coefficient::Fitted).then(|| along.over_all(&excess, usual, prior)),
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
    posterior(&likelihoods(&trial.sites, usual), prior)
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
