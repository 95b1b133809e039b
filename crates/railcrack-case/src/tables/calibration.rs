//! `[calibration]`: prior and discrepancy of a calibration by measurements.

use crate::schema::{NumberOr, SectionValues, closed, integer, number, number_or, positive, section};

section! {
    CALIBRATION "calibration", Optional,
        "Prior of the coefficient C of the growth law for `railcrack calibrate`.";
    PRIOR_LOG_MEAN: NumberOr = number_or("prior_log_mean", closed(-20.0, 20.0), "suite",
        "Prior mean of ln C, relative to the case; \"suite\" takes that of the residuals of `railcrack validate`: -0.02 in the plane, 0.26 in space.");
    PRIOR_LOG_STD: NumberOr = number_or("prior_log_std", positive(10.0), "suite",
        "Prior standard deviation of ln C; \"suite\" likewise takes 1.27 in the plane, 1.28 in space.");
    DISCREPANCY_LOG_STD: NumberOr = number_or("discrepancy_log_std", closed(0.0, 10.0), "evidence",
        "Standard deviation of ln C from site to site; \"evidence\" takes the value that makes the measurements most probable.");
    LEAST_DEPTH: f64 = number("least_depth_mm", "mm", closed(0.0, 1e3), 1.0,
        "Least measured depth (or length), written by `railcrack calibrate`.").optional();
    GREATEST_DEPTH: f64 = number("greatest_depth_mm", "mm", closed(0.0, 1e3), 3.0,
        "Greatest measured depth (or length), beyond which a decision says that nothing was measured.").optional();
    SITES: usize = integer("sites", (1, 100_000), 1,
        "Number of measured sites, written by `railcrack calibrate`; without it, a decision says that absolute rates are not known.").optional();
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
    /// The least and the greatest depth of the measurements, mm, where they are known.
    pub depths: Option<[f64; 2]>,
}

impl CalibrationPrior {
    /// Of a plane case, by the residuals of the eight rates of growth in track that `railcrack
    /// validate` compares with the plane: ln(measured/predicted) in the mean, and its standard
    /// deviation from entry to entry together with that from place to place.
    pub const PLANE: Self =
        Self { log_mean: -0.02, log_std: 1.27, discrepancy: None, sites: None, depths: None };
    /// Of a case in space, by the residuals of the same rates there.
    pub const SPACE: Self = Self { log_mean: 0.26, log_std: 1.28, ..Self::PLANE };
}

/// The prior of `section`, with the values `suite` where it takes those of the suite.
pub(crate) fn read_calibration(section: &SectionValues, suite: CalibrationPrior) -> Option<CalibrationPrior> {
    let number = |given: NumberOr| match given {
        NumberOr::Number(value) => Some(value),
        NumberOr::Word => None,
    };
    Some(CalibrationPrior {
        log_mean: number(section.get(PRIOR_LOG_MEAN)?).unwrap_or(suite.log_mean),
        log_std: number(section.get(PRIOR_LOG_STD)?).unwrap_or(suite.log_std),
        discrepancy: number(section.get(DISCREPANCY_LOG_STD)?),
        sites: section.get(SITES),
        depths: section.get(LEAST_DEPTH).zip(section.get(GREATEST_DEPTH)).map(|(from, to)| [from, to]),
    })
}
