//! Files that a case names.

mod companion;
mod field;
mod profile;

pub use companion::{CaseFile, Companion, FieldFile, ProfileFile};

pub(crate) use field::read_field;
pub(crate) use profile::read_profile;
