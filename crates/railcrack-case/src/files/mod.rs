//! Files that a case names.

mod columns;
mod companion;
mod field;
mod profile;
mod rates;

pub use companion::{CaseFile, Companion, FieldFile, ProfileFile, RatesFile};

pub(crate) use field::read_field;
pub(crate) use profile::read_profile;
pub(crate) use rates::read_rates;
