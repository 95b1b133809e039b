//! Verification: whether the files of a folder hold what was written to them.

mod folder;
mod results;

pub use folder::verify;
pub use results::Verification;
pub(crate) use results::check_numbers;
