//! `railcrack calibrate`.

mod arguments;
mod coefficient;
mod page;
mod parameter;
mod results;

pub use arguments::CalibrateArguments;
pub use coefficient::calibrate;
