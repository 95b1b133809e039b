//! `[calibration]`: prior and discrepancy of a calibration by measurements.

use crate::schema::{NumberOr, SectionValues, closed, integer, number, number_or, positive, section};

section! {
    CALIBRATION "calibration", Optional,
        "Calibration by `railcrack calibrate`: what is assumed about the coefficient C of the growth law before anything is measured.";
    PRIOR_LOG_MEAN: f64 = number("prior_log_mean", "", closed(-20.0, 20.0), 0.0,
        "Mean of ln C before the measurements, relative to the coefficient of the case; `railcrack validate` gives that of its residuals.");
    PRIOR_LOG_STD: f64 = number("prior_log_std", "", positive(10.0), 1.0,
        "Standard deviation of ln C before the measurements; 1.0 is the scatter of measured rates from place to place, and `railcrack validate` gives that of its residuals.");
    DISCREPANCY_LOG_STD: NumberOr = number_or("discrepancy_log_std", closed(0.0, 10.0), "evidence",
        "Standard deviation by which ln C differs from site to site; \"evidence\" takes the value under which the measurements are most probable.");
    SITES: usize = integer("sites", (1, 100_000), 1,
        "Number of measured sites by which this case has been calibrated, as `railcrack calibrate` writes it into its result; without, a decision says that absolute rates are not known.").optional();
}

/// Prior of a calibration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CalibrationPrior {
    /// Mean of ln C before the measurements, relative to that of the case.
    pub log_mean: f64,
    /// Standard deviation of ln C before the measurements.
    pub log_std: f64,
    /// Standard deviation of ln C from site to site; `None` for that of the largest evidence.
    pub discrepancy: Option<f64>,
    /// Number of sites by which the case has been calibrated; `None` where it has not.
    pub sites: Option<usize>,
}

/// The defaults of the section.
impl Default for CalibrationPrior {
    fn default() -> Self {
        Self { log_mean: 0.0, log_std: 1.0, discrepancy: None, sites: None }
    }
}

/// The prior of `section`.
pub(crate) fn read_calibration(section: &SectionValues) -> Option<CalibrationPrior> {
    let discrepancy = match section.get(DISCREPANCY_LOG_STD)? {
        NumberOr::Number(value) => Some(value),
        NumberOr::Word => None,
    };
    let (log_mean, log_std) = (section.get(PRIOR_LOG_MEAN)?, section.get(PRIOR_LOG_STD)?);
    Some(CalibrationPrior { log_mean, log_std, discrepancy, sites: section.get(SITES) })
}
