//! Calibration by measured depths or lengths over traffic at one or several sites.

mod consistency;
mod course;
mod document;
mod fit;
mod measured;
mod observed;
mod parameter;
mod posterior;
mod result;
mod search;
mod table;
mod text;

pub use consistency::{Consistency, equal_sites, shrinking};
pub use course::SizeCurve;
pub use fit::{Calibration, CalibrationError, SiteFit, calibrate, observe, usual_error};
pub use measured::{Finding, Measure, Measured, Site, read_measured};
pub use observed::{Observations, Observed, UsualError};
pub use parameter::{BracketEnd, Coefficient, ParameterFit, Trial, coefficient_at, fit_parameter};
pub use posterior::{Posterior, Prior, SiteLikelihood, SitePosterior, log_evidence, posterior};
pub use result::{CalibrationResult, Fitted, NewRail, calibrated_by};
pub use search::{Bracket, Next};
pub use table::{coefficient_table, quantities, trials_table};
pub use text::number;
