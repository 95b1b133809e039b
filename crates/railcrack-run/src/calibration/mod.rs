//! Calibration by measured depths or lengths over traffic at one or several sites.

mod course;
mod fit;
mod measured;
mod observed;
mod parameter;
mod posterior;
mod search;

pub use course::SizeCurve;
pub use fit::{Calibration, CalibrationError, SiteFit, calibrate, observe, usual_error};
pub use measured::{Finding, Measure, Measured, Site, read_measured};
pub use observed::{Observations, Observed, UsualError};
pub use parameter::{BracketEnd, Coefficient, ParameterFit, Trial, coefficient_at, fit_parameter};
pub use posterior::{Posterior, Prior, SiteLikelihood, SitePosterior, log_evidence, posterior};
pub use search::{Bracket, Next};
