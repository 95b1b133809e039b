//! Comparison of two runs, from their folders alone.

mod again;
mod align;
mod case_keys;
mod comparison;
mod files;
mod json;
mod life;
mod notes;
mod parting;
mod stored;
mod tables;
mod text;
mod tip;

pub use again::stored_comparison;
pub use align::Aligned;
pub use case_keys::CaseDifference;
pub use case_keys::keys as case_keys;
pub use comparison::Comparison;
pub use files::{COMPARISON, FIRST_STEP, LAST_STEP, PATHS};
pub use life::SameLength;
pub use parting::Parting;
pub use stored::RunLabel;
pub use tables::{PositionRow, TipComparison};
pub use tip::{SifDifference, TipSifs};
