//! Numbers that a calibration found.

use railcrack_case::Case;
use railcrack_case::normal::QUANTILE_97_5;
use railcrack_run::calibration::{Calibration, ParameterFit, Posterior, Prior, Site};

/// The scatter of a rail that was not measured.
#[derive(Debug, Clone, Copy)]
pub(super) struct New {
    /// Standard deviation of ln C.
    pub std: f64,
    /// Whether it is that of the case from rail to rail, which the sites do not show to be smaller.
    pub is_of_case: bool,
}

/// Scatter of ln C from rail to rail where the case gives none.
const USUAL: f64 = 0.3;

impl New {
    /// By the `posterior` of `sites` sites.
    pub fn of(posterior: &Posterior, prior: Prior, sites: usize, case: &Case) -> Self {
        let usual = case.scatter.as_ref().map_or(USUAL, |scatter| scatter.c_log_std);
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

    /// The key of the case that carries it.
    pub fn setting(self) -> String {
        format!("scatter.paris_c_log_std={:?}", self.std)
    }
}

/// The key of a calibrated case that says so.
pub(super) fn calibrated_by(sites: &[Site]) -> String {
    format!("calibration.sites={}", sites.len())
}

/// The result of a fit.
pub(super) enum Fitted<'a> {
    /// The coefficient of the growth law.
    Coefficient { calibration: &'a Calibration, new: New },
    /// Another number, or the coefficient by runs; `coefficient` is the key and value of the growth
    /// law's if it was fitted as well, `new` its scatter on a rail that was not measured.
    Parameter { fit: &'a ParameterFit, runs: usize, coefficient: Option<(String, f64)>, new: Option<New> },
}

/// A calibration.
pub(super) struct Found<'a> {
    pub title: &'a str,
    /// The number that was fitted, and its value in the case.
    pub key: String,
    pub value: f64,
    pub prior: Prior,
    pub sites: &'a [Site],
    pub fitted: Fitted<'a>,
}
