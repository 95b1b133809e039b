//! Contact of measured profiles of wheel and rail: search, patches, pressure.

mod kik_piotrowski;
mod pair;
mod profile;
#[cfg(test)]
mod tests;

pub use kik_piotrowski::ProfileContact;
pub use pair::{ProfilePair, SearchError, WheelPosition};
pub use profile::{Profile, ProfileShapeError, RAIL_HEAD_DEPTH};
