//! Rows of many cracks: what every crack is in every step, and which of them have names.

mod history;
mod named;

pub(crate) use history::{CrackRow, CrackState};
pub(crate) use named::{NamedCrack, named};

use crate::chart::CATEGORIES;

/// Whether there are more `cracks` than colours that people tell apart.
pub(crate) fn is_many(cracks: usize) -> bool {
    cracks > CATEGORIES
}
