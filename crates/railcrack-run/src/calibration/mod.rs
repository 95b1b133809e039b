//! Calibration by measured depths or lengths over traffic.

mod coefficient;
mod parameter;

pub use coefficient::{
    Calibration, CalibrationError, Compared, Measure, Measured, calibrate, compared, read_measured,
};
pub use parameter::{ParameterFit, Trial, fit_parameter};
