//! The result of a calibration, with what its text, file and page are made of.

use super::fit::Calibration;
use super::measured::{Finding, Site};
use super::parameter::ParameterFit;
use super::posterior::{Posterior, Prior};
use railcrack_case::Case;
use railcrack_case::normal::QUANTILE_97_5;

/// The scatter of a rail that was not measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NewRail {
    /// Standard deviation of ln C.
    pub std: f64,
    /// Whether it is that of the case from rail to rail, which the sites do not show to be smaller.
    pub is_of_case: bool,
}

/// Scatter of ln C from rail to rail where the case gives none.
const USUAL: f64 = 0.3;

impl NewRail {
    /// By the `posterior` of `sites` sites.
    pub fn of(posterior: &Posterior, prior: Prior, sites: usize, case: &Case) -> Self {
        let usual = case.scatter.as_ref().map_or(USUAL, |scatter| scatter.rail_log_std);
        let kept = posterior.std.hypot(usual);
        let (low, high) = posterior.new_interval;
        let std = (high - low) / (2.0 * QUANTILE_97_5);
        let is_shown = sites > 1 && (posterior.largest_discrepancy < usual || std >= kept);
        if prior.discrepancy.is_some() || is_shown {
            Self { std, is_of_case: false }
        } else {
            Self { std: kept, is_of_case: true }
        }
    }

    /// The setting of the case that carries it.
    pub fn setting(self) -> String {
        format!("scatter.paris_c_log_std={:?}", self.std)
    }
}

/// The settings of a calibrated case that name the number of its sites, and the depths that were
/// measured.
pub fn calibrated_by(sites: &[Site]) -> Vec<String> {
    let measured = sites.iter().flat_map(|site| &site.measured);
    let depths = measured.filter_map(|one| match one.finding {
        Finding::Size(size) => Some([size; 2]),
        Finding::Within(from, to) if from.is_finite() && to.is_finite() => Some([from, to]),
        Finding::Within(..) => None,
    });
    let mut settings = vec![format!("calibration.sites={}", sites.len())];
    let range = depths.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
    if let Some([least, greatest]) = range {
        settings.push(format!("calibration.least_depth_mm={least:?}"));
        settings.push(format!("calibration.greatest_depth_mm={greatest:?}"));
    }
    settings
}

/// The fit of a coefficient or of another number.
#[derive(Debug, Clone, PartialEq)]
pub enum Fitted {
    /// The coefficient of the growth law, in closed form.
    Coefficient {
        /// The fit.
        calibration: Calibration,
        /// Its scatter on a rail that was not measured.
        new: NewRail,
    },
    /// Another number, or the coefficient, by runs.
    Parameter {
        /// The fit.
        fit: ParameterFit,
        /// Number of runs.
        runs: usize,
        /// Key and value in the case of the coefficient of the growth law, if it was fitted too.
        coefficient: Option<(String, f64)>,
        /// Scatter of the coefficient on a rail that was not measured.
        new: Option<NewRail>,
    },
}

/// The result of a calibration.
#[derive(Debug, Clone, PartialEq)]
pub struct CalibrationResult<'a> {
    /// Title of the case.
    pub title: &'a str,
    /// Key of the number that was fitted.
    pub key: String,
    /// Its value in the case.
    pub value: f64,
    /// The prior of the coefficient.
    pub prior: Prior,
    /// The measurements.
    pub sites: &'a [Site],
    /// The fit.
    pub fitted: Fitted,
}

/// The 95 % interval of a coefficient whose ln(C/`value`) is normal.
pub(super) fn interval_95(value: f64, mean: f64, std: f64) -> [f64; 2] {
    [-QUANTILE_97_5, QUANTILE_97_5].map(|z| value * (mean + z * std).exp())
}
