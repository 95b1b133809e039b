//! Two runs set against each other, from their folders alone.

mod again;
mod align;
mod case_keys;
mod comparison;
mod files;
mod json;
mod notes;
mod parting;
mod stored;
mod text;

pub(crate) use align::Aligned;
pub use case_keys::CaseDifference;
pub(crate) use case_keys::keys as case_keys;
pub use comparison::{Comparison, SifDifference, TipComparison, TipSifs};
pub use files::{COMPARE_COLUMNS, COMPARE_POSITIONS_COLUMNS};
pub(crate) use files::{JSON_FILE, rebuild};
pub use parting::Parting;
pub use stored::RunLabel;
