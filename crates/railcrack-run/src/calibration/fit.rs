//! Calibration of the coefficient of the growth law by one run.

use super::consistency::Consistency;
use super::course::SizeCurve;
use super::measured::{Measure, Site};
use super::observed::{Observations, Observed, READING, UsualError, observations};
use super::posterior::{Posterior, Prior, SiteLikelihood, SitePosterior, posterior};
use crate::error::OutputError;
use crate::statistics::student;
use railcrack_case::normal::QUANTILE_97_5;
use thiserror::Error;

/// One site of a calibration.
#[derive(Debug, Clone, PartialEq)]
pub struct SiteFit {
    /// Weighted mean and standard deviation of ln(C/C0) of its readings.
    pub readings: Option<(f64, f64)>,
    /// The coefficient at this site.
    pub posterior: SitePosterior,
    /// Its measurements compared with the run; none outside the sizes of the run.
    pub observations: Observations,
    /// Whether they agree; none of fewer than two.
    pub consistency: Option<Consistency>,
}

/// The fitted coefficient of the growth law.
#[derive(Debug, Clone, PartialEq)]
pub struct Calibration {
    /// The posterior of ln(C/C0).
    pub posterior: Posterior,
    /// The sites, in their order.
    pub sites: Vec<SiteFit>,
    /// Error of the readings whose standard deviation is not given.
    pub usual: UsualError,
}

/// Measurements that cannot be used for calibration.
#[derive(Debug, Error)]
pub enum CalibrationError {
    /// A run folder that cannot be read.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// A parameter without effect.
    #[error("{key} has no effect on the tonnage at which the measured sizes are reached")]
    NoInfluence {
        /// The parameter.
        key: String,
    },
    /// No measurement within the sizes of the run.
    #[error(
        "no measurement lies within the sizes of the run, from {from:.3} to {to:.3} mm (the first excluded), at a tonnage above 0 MGT"
    )]
    NothingToCompare {
        /// The smallest and the largest size of the run, mm.
        from: f64,
        /// See `from`.
        to: f64,
    },
}

/// The measurements of `site` compared with a run whose crack grows along `curve`.
#[must_use]
pub fn observe(site: &Site, curve: &SizeCurve) -> Observations {
    observations(site, curve)
}

/// The error of readings without one: by their scatter about the mean of their site, widened by
/// Student's over the normal quantile, where some site has two of them; otherwise 0.5 mm.
#[must_use]
pub fn usual_error(sites: &[Observations]) -> UsualError {
    let (mut squares, mut degrees) = (0.0, 0);
    for site in sites {
        let of = unknown(site);
        let mean = of.iter().sum::<f64>() / of.len() as f64;
        squares += of.iter().map(|y| (y - mean).powi(2)).sum::<f64>();
        degrees += of.len().saturating_sub(1);
    }
    from_squares(squares, degrees)
}

/// y of the readings of a site without an error of their own.
pub(super) fn unknown(site: &Observations) -> Vec<f64> {
    let y = |observed: &Observed| match observed {
        Observed::Reading { y, std: None, .. } => Some(*y),
        _ => None,
    };
    site.iter().flatten().filter_map(y).collect()
}

/// The error by a sum of squares with its degrees of freedom.
pub(super) fn from_squares(squares: f64, degrees: usize) -> UsualError {
    match degrees {
        0 => UsualError::OfSize(READING),
        _ => UsualError::OfLife((squares / degrees as f64).sqrt() * student(degrees) / QUANTILE_97_5),
    }
}

/// Fits the coefficient of the growth law of a run to `sites`; `curve` gives its crack over traffic
/// by a measured quantity.
///
/// The number of cycles between two sizes is in proportion to 1/C, so that each measurement gives a
/// C in closed form: that of the run times computed over measured tonnage. Errors of a site whose
/// measurements at several times contradict one another are widened.
///
/// Errors: no measurement is within the sizes of the run.
pub fn calibrate(
    sites: &[Site],
    curve: impl Fn(Measure) -> SizeCurve,
    prior: Prior,
) -> Result<Calibration, CalibrationError> {
    let observed: Vec<Observations> =
        sites.iter().map(|site| observations(site, &curve(site.measure))).collect();
    if observed.iter().flatten().all(Option::is_none) {
        let (from, to) = curve(sites.first().map_or(Measure::Depth, |site| site.measure)).ends();
        return Err(CalibrationError::NothingToCompare { from, to });
    }
    let usual = usual_error(&observed);
    let consistencies: Vec<Option<Consistency>> =
        sites.iter().zip(&observed).map(|(site, own)| Consistency::of(site, own, usual)).collect();
    let widening = |consistency: &Option<Consistency>| consistency.map_or(1.0, |own| own.widening());
    let likelihoods: Vec<SiteLikelihood> = observed
        .iter()
        .zip(&consistencies)
        .map(|(site, own)| SiteLikelihood::of(site, usual).widened(widening(own)))
        .collect();
    let posterior = posterior(&likelihoods, prior);
    let each = likelihoods.iter().zip(&posterior.sites).zip(observed).zip(consistencies);
    let sites = each
        .map(|(((likelihood, own), observations), consistency)| SiteFit {
            readings: likelihood.mean(),
            posterior: *own,
            observations,
            consistency,
        })
        .collect();
    Ok(Calibration { posterior, sites, usual })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::calibration::{Finding, Measured};

    /// A tip that is 2 + MGT/10 mm deep.
    fn curve(_: Measure) -> SizeCurve {
        SizeCurve::through((0..5).map(|i| (10.0 * f64::from(i), 2.0 + f64::from(i))).collect())
    }

    fn site(measured: Vec<(f64, f64, Option<f64>)>) -> Site {
        let of = |(mgt, size, std)| Measured { mgt, finding: Finding::Size(size), std };
        Site { measured: measured.into_iter().map(of).collect(), ..Site::named("a.csv", Measure::Depth) }
    }

    const PRIOR: Prior = Prior { mean: 0.0, log_std: 1.0, discrepancy: None };

    #[test]
    fn synthetic_data_give_their_coefficient_back() {
        // A crack that grows 1.5 times as fast, measured with 10 % of scatter that cancels out.
        let at = |depth: f64, scatter: f64| (10.0 * (depth - 2.0) / 1.5 * scatter, depth, None);
        let all = vec![at(2.5, 1.1), at(3.5, 1.0 / 1.1), at(4.5, 1.1), at(5.5, 1.0 / 1.1), at(7.0, 1.0)];
        let fit = calibrate(&[site(all)], curve, PRIOR).unwrap();
        assert_eq!(fit.sites[0].observations.iter().flatten().count(), 4, "one is deeper than the run");
        let std = 1.1_f64.ln() * (4.0_f64 / 3.0).sqrt() * 3.182_446_305_284 / QUANTILE_97_5 / 2.0;
        let (mean, width) = fit.sites[0].readings.unwrap();
        assert!((mean - 1.5_f64.ln()).abs() < 1e-12 && (width - std).abs() < 1e-12, "{fit:?}");
        // The prior pulls towards the case by v/(τ² + v).
        assert!((fit.posterior.mean - mean / (1.0 + std * std)).abs() < 1e-12);
    }

    #[test]
    fn errors_of_reading_become_errors_of_life() {
        // At 3 mm ln N changes by 1/(3 − 2) per mm, at 4 mm by half of it.
        let fit = calibrate(&[site(vec![(10.0, 3.0, Some(0.2)), (20.0, 4.0, Some(0.2))])], curve, PRIOR);
        let (mean, std) = fit.unwrap().sites[0].readings.unwrap();
        let precision = 0.2_f64.powi(-2) + 0.1_f64.powi(-2);
        assert!(mean.abs() < 1e-12 && (std - precision.sqrt().recip()).abs() < 1e-12);
        // A single reading without an error has that of eddy current.
        let fit = calibrate(&[site(vec![(10.0, 3.0, None)])], curve, PRIOR).unwrap();
        assert_eq!(fit.usual, UsualError::OfSize(READING));
        assert!((fit.sites[0].readings.unwrap().1 - READING).abs() < 1e-12);
    }

    #[test]
    fn the_interval_spans_readings_that_contradict_one_another() {
        let readings = vec![(10.0, 3.0, Some(0.05)), (10.0, 5.0, Some(0.05)), (25.0, 3.5, Some(0.05))];
        let fit = calibrate(&[site(readings)], curve, Prior { log_std: 10.0, ..PRIOR }).unwrap();
        let (low, high) = fit.posterior.interval;
        let of_each = fit.sites[0].observations.iter().flatten();
        for (y, _) in of_each.filter_map(|observed| observed.reading(fit.usual)) {
            assert!(low < y && y < high, "{y} in {low} to {high}");
        }
    }

    #[test]
    fn measurements_beyond_the_run_are_refused() {
        let far = calibrate(&[site(vec![(1.0, 50.0, None)])], curve, PRIOR);
        let refused = far.unwrap_err().to_string();
        assert!(refused.contains("from 2.000 to 6.000"), "{refused}");
    }
}
