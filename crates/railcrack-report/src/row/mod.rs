//! Rows of many cracks: the state of every crack in every step, and the highlighted cracks.

mod history;
mod named;

pub(crate) use history::{CrackRow, CrackState};
pub(crate) use named::{NamedCrack, named};

use crate::chart::CATEGORIES;

/// Whether there are more `cracks` than distinguishable colours.
pub(crate) fn is_many(cracks: usize) -> bool {
    cracks > CATEGORIES
}
