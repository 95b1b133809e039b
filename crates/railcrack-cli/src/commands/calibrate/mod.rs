//! `railcrack calibrate`.

mod arguments;
mod coefficient;
mod finish;
mod growth;
mod parameter;

pub use arguments::CalibrateArguments;
pub use coefficient::calibrate;
