//! Many wheels over one crack: the open crack as a surrogate, groups, representatives.

mod groups;
#[cfg(test)]
mod groups_tests;
mod open_crack;

pub use groups::{Grouped, Groups};
pub use open_crack::OpenCrack;
