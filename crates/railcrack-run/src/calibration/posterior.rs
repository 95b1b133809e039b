//! The coefficient of a growth law by measurements at several sites, in closed form.
//!
//! y_ij = ln(N_pred(C0)/N_meas) = b + d_j + e_ij of measurement i at site j, with b = ln(C/C0) ~
//! N(μ, τ²), the discrepancy d_j ~ N(0, s²) of a site and the error e_ij ~ N(0, σ_ij²). With m_j
//! and v_j the weighted mean and variance of a site, b has the precision
//!
//! > 1/τ² + Σ 1/(v_j + s²)
//!
//! and the mean μ/τ² + Σ m_j/(v_j + s²) over it; s maximises the evidence. A new rail has the
//! variance of b plus s². Classes of sizes make the likelihood of their site another function of
//! b + d_j; then b and d_j are integrated numerically.

use super::observed::{Observations, Observed, UsualError, tabulated};
use crate::statistics::student;
use railcrack::math::{Ties, golden_section};
use railcrack_case::CalibrationPrior;
use railcrack_case::normal::{QUANTILE_97_5, log_density};

/// The prior of ln C and of the discrepancy.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prior {
    /// μ, the mean of ln(C/C0).
    pub mean: f64,
    /// τ, the standard deviation of ln C; 0 for the coefficient of the case.
    pub log_std: f64,
    /// s, the standard deviation of the discrepancy from site to site; none for that of the largest
    /// evidence.
    pub discrepancy: Option<f64>,
}

impl From<CalibrationPrior> for Prior {
    fn from(of: CalibrationPrior) -> Self {
        Self { mean: of.log_mean, log_std: of.log_std, discrepancy: of.discrepancy }
    }
}

impl Prior {
    /// The setting of a calibrated case, to whose coefficient the mean would be relative; none
    /// where that changes nothing.
    pub fn reset(self) -> Option<String> {
        (self.mean != 0.0).then(|| "calibration.prior_log_mean=0.0".to_owned())
    }
}

/// The likelihood of ln(C/C0) by the measurements at one site.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SiteLikelihood {
    /// Weighted mean and variance of its readings.
    readings: Option<(f64, f64)>,
    /// ln of the density of the readings given their mean, which does not depend on C.
    within: f64,
    /// Tables of ln P of its classes.
    classes: Vec<Vec<f64>>,
}

/// The coefficient at one site.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SitePosterior {
    /// Mean of ln(C/C0).
    pub mean: f64,
    /// Its standard deviation.
    pub std: f64,
}

/// The posterior of ln(C/C0).
#[derive(Debug, Clone, PartialEq)]
pub struct Posterior {
    /// Mean of b.
    pub mean: f64,
    /// Standard deviation of b.
    pub std: f64,
    /// b is between these with 95 %.
    pub interval: (f64, f64),
    /// s.
    pub discrepancy: f64,
    /// The largest s that the measurements do not exclude with 95 %; s itself where it is given.
    pub largest_discrepancy: f64,
    /// ln of the evidence with this s.
    pub log_evidence: f64,
    /// Standard deviation of ln(C/C0) of a rail that was not measured.
    pub new_std: f64,
    /// ln(C/C0) of such a rail is between these with 95 %: wider than by `new_std` where s was
    /// found from few sites.
    pub new_interval: (f64, f64),
    /// The coefficient at each site.
    pub sites: Vec<SitePosterior>,
}

/// The least standard deviation of a reading: a table of exact numbers has no error, and 1/σ²
/// must be finite.
const LEAST_SIGMA: f64 = 1e-6;
/// The largest s that is looked at: a factor of 20 from site to site.
const LARGEST_DISCREPANCY: f64 = 3.0;
/// Half of χ² of 95 % with one degree of freedom: an s whose evidence is smaller by more than that
/// in its logarithm is excluded.
const EXCLUDED: f64 = 1.920_729;
/// Values of s that are tried before the best one is refined.
const TRIED: usize = 24;
/// Halvings of the range of s by the golden section.
const SECTIONS: usize = 24;
/// Points of the grid of b, and grids, each over what the last one left.
const POINTS: usize = 161;
const GRIDS: usize = 4;
/// Points on either side of the integral over d, and its reach in standard deviations: the
/// trapezoidal rule is exact to 1e-8 for smooth functions, and to 3 % for the step of a class
/// without an error of reading.
const NODES: i32 = 40;
const NODES_REACH: f64 = 6.0;
/// ln of the density, relative to the peak, beyond which b is left out.
const NEGLIGIBLE: f64 = -30.0;

impl SiteLikelihood {
    /// Of the `observations`, with the error `usual` of readings that have none of their own.
    #[must_use]
    pub fn of(observations: &Observations, usual: UsualError) -> Self {
        let all = || observations.iter().flatten();
        let readings = all().filter_map(|observed| observed.reading(usual));
        let readings: Vec<(f64, f64)> = readings.map(|(y, sigma)| (y, sigma.max(LEAST_SIGMA))).collect();
        let table = |observed: &Observed| match observed {
            Observed::Class(table) => Some(table.clone()),
            Observed::Reading { .. } => None,
        };
        Self { classes: all().filter_map(table).collect(), ..Self::of_readings(&readings) }
    }

    /// The same with errors `factor` times as large: ln P over its square.
    #[must_use]
    pub fn widened(self, factor: f64) -> Self {
        if factor == 1.0 {
            return self;
        }
        let square = factor * factor;
        let over = |table: Vec<f64>| table.into_iter().map(|log| log / square).collect();
        Self {
            readings: self.readings.map(|(mean, variance)| (mean, variance * square)),
            classes: self.classes.into_iter().map(over).collect(),
            ..self
        }
    }

    /// Of readings (y, σ).
    #[must_use]
    pub fn of_readings(readings: &[(f64, f64)]) -> Self {
        let precision: f64 = readings.iter().map(|(_, sigma)| sigma.powi(-2)).sum();
        if precision <= 0.0 {
            return Self::default();
        }
        let variance = precision.recip();
        let mean = variance * readings.iter().map(|(y, sigma)| y * sigma.powi(-2)).sum::<f64>();
        let all: f64 = readings.iter().map(|(y, sigma)| log_density(*y, mean, sigma * sigma)).sum();
        let within = all - log_density(mean, mean, variance);
        Self { readings: Some((mean, variance)), within, classes: Vec::new() }
    }

    /// Weighted mean and standard deviation of its readings.
    #[must_use]
    pub fn mean(&self) -> Option<(f64, f64)> {
        self.readings.map(|(mean, variance)| (mean, variance.sqrt()))
    }

    fn log_of_classes(&self, theta: f64) -> f64 {
        self.classes.iter().map(|table| tabulated(table, theta)).sum()
    }

    /// Of θ = b + d: ln of the likelihood of `b`, and mean and variance of θ.
    fn given(&self, b: f64, s: f64) -> (f64, f64, f64) {
        let (spread, centre, smooth) = match self.readings {
            Some((mean, variance)) => {
                let spread = s * s * variance / (s * s + variance);
                let centre = (b * variance + mean * s * s) / (s * s + variance);
                (spread, centre, self.within + log_density(mean, b, variance + s * s))
            }
            None => (s * s, b, 0.0),
        };
        if self.classes.is_empty() {
            return (smooth, centre, spread);
        }
        if spread <= 0.0 {
            return (smooth + self.log_of_classes(b), b, 0.0);
        }
        let width = spread.sqrt();
        let node = |i: i32| {
            let z = NODES_REACH * f64::from(i) / f64::from(NODES);
            let theta = centre + z * width;
            (theta, self.log_of_classes(theta) - 0.5 * z * z)
        };
        let nodes: Vec<(f64, f64)> = (-NODES..=NODES).map(node).collect();
        let moments = Moments::of(nodes.iter().copied());
        let step = NODES_REACH / f64::from(NODES);
        let normal = moments.log_sum + (step / (2.0 * std::f64::consts::PI).sqrt()).ln();
        (smooth + normal, moments.mean, moments.variance)
    }
}

/// Sum, mean and variance of weighted points.
struct Moments {
    log_sum: f64,
    mean: f64,
    variance: f64,
}

impl Moments {
    /// Of points (x, ln weight).
    fn of(points: impl Iterator<Item = (f64, f64)> + Clone) -> Self {
        let peak = points.clone().map(|(_, log)| log).fold(f64::NEG_INFINITY, f64::max);
        let (mut total, mut first, mut second) = (0.0, 0.0, 0.0);
        // About the first point: the square of a mean far from zero would swallow the variance.
        let origin = points.clone().next().map_or(0.0, |(x, _)| x);
        for (x, log) in points {
            let weight = (log - peak).exp();
            let x = x - origin;
            total += weight;
            first += weight * x;
            second += weight * x * x;
        }
        let mean = first / total;
        let variance = (second / total - mean * mean).max(0.0);
        Self { log_sum: peak + total.ln(), mean: origin + mean, variance }
    }
}

/// The posterior of b for a given s, as a grid; a single point where τ = 0.
fn grid(sites: &[SiteLikelihood], (mu, tau): (f64, f64), s: f64) -> Vec<(f64, f64)> {
    let log_of = |b: f64| -> f64 { sites.iter().map(|site| site.given(b, s).0).sum() };
    if tau <= 0.0 {
        return vec![(mu, log_of(mu))];
    }
    let (mut low, mut high) = (mu - 8.0 * tau, mu + 8.0 * tau);
    let mut points = Vec::new();
    for _ in 0..GRIDS {
        let step = (high - low) / (POINTS - 1) as f64;
        let at = |i: usize| {
            let b = low + step * i as f64;
            (b, log_of(b) + log_density(b, mu, tau * tau) + step.ln())
        };
        points = (0..POINTS).map(at).collect();
        let peak = points.iter().map(|(_, log)| *log).fold(f64::NEG_INFINITY, f64::max);
        let first = points.iter().position(|(_, log)| log - peak > NEGLIGIBLE).unwrap_or(0);
        let last = points.iter().rposition(|(_, log)| log - peak > NEGLIGIBLE).unwrap_or(POINTS - 1);
        (low, high) = (points[first.saturating_sub(1)].0, points[(last + 1).min(POINTS - 1)].0);
    }
    points
}

/// ln of the probability density of all measurements of `sites` with the standard deviation `s` of
/// the discrepancy, and (μ, τ) of the prior.
#[must_use]
pub fn log_evidence(sites: &[SiteLikelihood], of_prior: (f64, f64), s: f64) -> f64 {
    if sites.iter().all(|site| site.classes.is_empty()) {
        return closed(sites, of_prior, s).2;
    }
    Moments::of(grid(sites, of_prior, s).into_iter()).log_sum
}

/// Mean and variance of b, and ln of the evidence, of readings alone.
fn closed(sites: &[SiteLikelihood], (mu, tau): (f64, f64), s: f64) -> (f64, f64, f64) {
    // About the mean of the prior.
    let read = sites.iter().filter_map(|site| site.readings).map(|(mean, v)| (mean - mu, v));
    let within: f64 = sites.iter().map(|site| site.within).sum();
    let apart: f64 = read.clone().map(|(mean, v)| log_density(mean, 0.0, v + s * s)).sum();
    if tau <= 0.0 {
        return (mu, 0.0, within + apart);
    }
    let precision = tau.powi(-2) + read.clone().map(|(_, v)| (v + s * s).recip()).sum::<f64>();
    let mean = read.map(|(mean, v)| mean / (v + s * s)).sum::<f64>() / precision;
    let evidence = within + apart - 0.5 * (tau * tau * precision).ln() + 0.5 * mean * mean * precision;
    (mu + mean, precision.recip(), evidence)
}

/// The s of the largest evidence, and the largest one that is not excluded; fewer than two sites do
/// not show how sites differ: 0, and the largest of all.
fn best_discrepancy(sites: &[SiteLikelihood], of_prior: (f64, f64)) -> (f64, f64) {
    let says = |site: &&SiteLikelihood| site.readings.is_some() || !site.classes.is_empty();
    if sites.iter().filter(says).count() < 2 {
        return (0.0, LARGEST_DISCREPANCY);
    }
    let at = |i: usize| LARGEST_DISCREPANCY * (i as f64 / TRIED as f64).powi(2);
    let evidence = |s: f64| log_evidence(sites, of_prior, s);
    let tried: Vec<f64> = (0..=TRIED).map(|i| evidence(at(i))).collect();
    let best = (0..=TRIED).fold(0, |best, i| if tried[i] > tried[best] { i } else { best });
    let around = [at(best.saturating_sub(1)), at((best + 1).min(TRIED))];
    let found = golden_section(around, SECTIONS, Ties::First, evidence);
    let top = evidence(found).max(tried[0]);
    let found = if evidence(found) > tried[0] { found } else { 0.0 };
    let least = top - EXCLUDED;
    let largest = match (0..=TRIED).rfind(|i| tried[*i] >= least) {
        Some(TRIED) => LARGEST_DISCREPANCY,
        Some(i) => at(i) + (tried[i] - least) / (tried[i] - tried[i + 1]) * (at(i + 1) - at(i)),
        None => found,
    };
    (found, largest.max(found))
}

/// The posterior of `sites`.
#[must_use]
pub fn posterior(sites: &[SiteLikelihood], prior: Prior) -> Posterior {
    let of_prior = (prior.mean, prior.log_std);
    let (s, largest_discrepancy) =
        prior.discrepancy.map_or_else(|| best_discrepancy(sites, of_prior), |s| (s, s));
    let (mean, std, interval, log_evidence, of_b);
    if sites.iter().all(|site| site.classes.is_empty()) {
        let (centre, variance, evidence) = closed(sites, of_prior, s);
        (mean, std, log_evidence) = (centre, variance.sqrt(), evidence);
        interval = (mean - QUANTILE_97_5 * std, mean + QUANTILE_97_5 * std);
        of_b = Vec::new();
    } else {
        let points = grid(sites, of_prior, s);
        let moments = Moments::of(points.iter().copied());
        (mean, std, log_evidence) = (moments.mean, moments.variance.sqrt(), moments.log_sum);
        interval = (quantile(&points, &moments, 0.025), quantile(&points, &moments, 0.975));
        of_b = points;
    }
    let of_site = |site: &SiteLikelihood| {
        // θ given b is linear in b for readings alone; otherwise b is integrated.
        let (mean, variance) = if of_b.is_empty() {
            let (_, at, spread) = site.given(mean, s);
            let share =
                site.readings.map_or(1.0, |(_, v)| if v + s * s > 0.0 { v / (v + s * s) } else { 1.0 });
            (at, spread + (share * std).powi(2))
        } else {
            let given: Vec<(f64, f64, f64)> = of_b
                .iter()
                .map(|&(b, log)| {
                    let (_, mean, variance) = site.given(b, s);
                    (mean, variance, log)
                })
                .collect();
            let means = Moments::of(given.iter().map(|&(mean, _, log)| (mean, log)));
            let spread = Moments::of(given.iter().map(|&(_, variance, log)| (variance, log)));
            (means.mean, means.variance + spread.mean)
        };
        SitePosterior { mean, std: variance.sqrt() }
    };
    let of_sites = sites.iter().map(of_site).collect();
    let new_std = std.hypot(s);
    let reach = QUANTILE_97_5 * new_std * widening(sites, prior, new_std);
    let new_interval = (mean - reach, mean + reach);
    Posterior {
        mean,
        std,
        interval,
        discrepancy: s,
        largest_discrepancy,
        log_evidence,
        new_std,
        new_interval,
        sites: of_sites,
    }
}

impl Posterior {
    /// The same with the standard deviation `std` of b, found by other means from `sites`.
    #[must_use]
    pub(super) fn known_to(self, std: f64, sites: &[SiteLikelihood], prior: Prior) -> Self {
        let new_std = std.hypot(self.discrepancy);
        let reach = QUANTILE_97_5 * new_std * widening(sites, prior, new_std);
        Self {
            std,
            interval: (self.mean - QUANTILE_97_5 * std, self.mean + QUANTILE_97_5 * std),
            new_std,
            new_interval: (self.mean - reach, self.mean + reach),
            ..self
        }
    }
}

/// By what the interval of a new rail is wider than its standard deviation says: where s was found
/// from a few sites, Student's distribution takes the place of the normal one, but no rail is less
/// known than before the measurements.
fn widening(sites: &[SiteLikelihood], prior: Prior, new_std: f64) -> f64 {
    let count = sites.iter().filter(|site| site.readings.is_some() || !site.classes.is_empty()).count();
    if prior.discrepancy.is_some() || count < 2 || new_std <= 0.0 {
        return 1.0;
    }
    (student(count - 1) / QUANTILE_97_5).min((prior.log_std / new_std).max(1.0))
}

/// The quantile of `share` of a grid.
fn quantile(points: &[(f64, f64)], moments: &Moments, share: f64) -> f64 {
    // Half of the weight of a point lies on either side of it.
    let mut sum = 0.0;
    for pair in points.windows(2) {
        let [from, to] = [pair[0].1, pair[1].1].map(|log| 0.5 * (log - moments.log_sum).exp());
        if sum + from + to >= share {
            return pair[0].0 + (share - sum) / (from + to) * (pair[1].0 - pair[0].0);
        }
        sum += from + to;
    }
    points.last().map_or(moments.mean, |point| point.0)
}

#[cfg(test)]
#[path = "posterior_tests.rs"]
mod tests;
