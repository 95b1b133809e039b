//! Measurements as statements about the coefficient of the growth law.

use super::course::SizeCurve;
use super::measured::{Finding, Site};
use railcrack_case::normal::log_of_interval;

/// ln(C/C0) at which the probability of a class is tabulated: from −`REACH` to `REACH`.
const REACH: f64 = 12.0;
/// Intervals of the table: 0.006 each, less than a hundredth of any change of a rate.
const INTERVALS: usize = 4000;
/// The logarithm of the probability of a sharp class that the size is not in: a finding that
/// contradicts every value of the coefficient still leaves a posterior.
const IMPOSSIBLE: f64 = -700.0;

/// Standard deviation (mm) of a reading where neither the file nor the scatter of its site gives
/// one: 1 mm with 95 %, the error of eddy current for a head check of 10 mm (Pohl and others 2004,
/// NDT&E Int. 37, 89–94).
pub(super) const READING: f64 = 0.5;

/// The statement of a measurement about ln(C/C0) of its site, C0 the coefficient of the run.
#[derive(Debug, Clone, PartialEq)]
pub enum Observed {
    /// y = ln(N_pred(C0)/N_meas), with the standard deviation σ_depth |d ln N/d depth|.
    Reading {
        /// y.
        y: f64,
        /// |d ln N/d depth|, 1/mm.
        per_mm: f64,
        /// σ_depth, mm, where it is given.
        std: Option<f64>,
    },
    /// ln P(finding | ln(C/C0)), tabulated.
    Class(Vec<f64>),
}

/// The measurements of a site, each as such a statement; none for a size outside those of the run.
pub type Observations = Vec<Option<Observed>>;

/// The error of readings whose standard deviation is not given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum UsualError {
    /// Standard deviation of y.
    OfLife(f64),
    /// Standard deviation of the size, mm.
    OfSize(f64),
}

impl Observed {
    /// y and its standard deviation; none of a class.
    #[must_use]
    pub fn reading(&self, usual: UsualError) -> Option<(f64, f64)> {
        let Self::Reading { y, per_mm, std } = self else { return None };
        let sigma = match (*std, usual) {
            (Some(std), _) | (None, UsualError::OfSize(std)) => std * per_mm,
            (None, UsualError::OfLife(sigma)) => sigma,
        };
        Some((*y, sigma))
    }
}

/// The measurements of `site` compared with a run whose crack grows along `curve`; a class below
/// the initial size or beyond the last one is none of them.
///
/// With the coefficient C = C0 e^θ the crack reaches after N what the run reaches after N e^θ, so
/// that a class from a to b is found with the probability Φ((b − size)/σ) − Φ((a − size)/σ), sharp
/// without an error of reading.
pub(super) fn observations(site: &Site, curve: &SizeCurve) -> Observations {
    let observed = |measured: &super::Measured| -> Option<Observed> {
        if measured.mgt <= 0.0 {
            return None;
        }
        match measured.finding {
            Finding::Size(size) => {
                let (mgt, per_mm) = curve.reaches(size)?;
                Some(Observed::Reading { y: (mgt / measured.mgt).ln(), per_mm, std: measured.std })
            }
            Finding::Within(from, to) => {
                // As a size outside of those of the run, such a class cannot be compared.
                let (first, last) = curve.ends();
                if to <= first || from >= last {
                    return None;
                }
                let at = |i: usize| {
                    log_of_class(curve.at(measured.mgt * theta_at(i).exp()), (from, to), measured.std)
                };
                Some(Observed::Class((0..=INTERVALS).map(at).collect()))
            }
        }
    };
    site.measured.iter().map(observed).collect()
}

/// ln P of the class `from` to `to` for a crack of `size`.
fn log_of_class(size: f64, (from, to): (f64, f64), std: Option<f64>) -> f64 {
    match std {
        Some(std) => log_of_interval((from - size) / std, (to - size) / std),
        None if size > from && size <= to => 0.0,
        None => IMPOSSIBLE,
    }
}

/// The values of ln(C/C0) at which the probability of a class is tabulated.
pub(super) fn theta_of_tables() -> impl Iterator<Item = f64> {
    (0..=INTERVALS).map(theta_at)
}

fn theta_at(i: usize) -> f64 {
    REACH * (2.0 * i as f64 / INTERVALS as f64 - 1.0)
}

/// A tabulated ln P at `theta`, linear between its points, constant outside.
pub(super) fn tabulated(table: &[f64], theta: f64) -> f64 {
    let last = table.len().saturating_sub(1);
    let at = ((theta / REACH + 1.0) * 0.5 * last as f64).clamp(0.0, last as f64);
    let below = at.floor() as usize;
    let above = (below + 1).min(last);
    table[below] + (at - below as f64) * (table[above] - table[below])
}
