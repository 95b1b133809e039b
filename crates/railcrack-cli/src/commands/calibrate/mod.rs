//! `railcrack calibrate`.

mod arguments;
mod coefficient;
mod document;
mod finish;
mod found;
mod page;
mod parameter;
mod plot;
mod rows;
mod table;
mod text;

pub use arguments::CalibrateArguments;
pub use coefficient::calibrate;
